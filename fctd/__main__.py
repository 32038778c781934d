"""``python -m fctd``."""

from fctd.cli import main

main()
