"""``python -m references``."""

from fctd.cli.interrupts import ends_at_once, ends_program

with ends_program():
    from fctd.cli.main import run
    from references.commands import app

if __name__ == "__main__":
    with ends_at_once():
        run(app)
