"""``python -m fctd``, also the command ``fctd``."""

from fctd.cli.interrupts import ends_at_once, ends_program

with ends_program():
    from fctd.cli.main import main as commands


def main() -> None:
    """Entry point of the program."""
    with ends_at_once():
        commands()


if __name__ == "__main__":
    main()
