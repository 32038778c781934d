"""``python -m fctd``, also the command ``fctd``."""

from fctd.cli.interrupts import ends_program

with ends_program():
    from fctd.cli.main import main

if __name__ == "__main__":
    main()
