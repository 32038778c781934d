"""What ``python -m references list`` prints."""

from unittest.mock import patch

from typer.testing import CliRunner

from references.commands import app, screen


def listed() -> str:
    """The list on a screen wide enough for a line for each row."""
    with patch.object(screen, "_width", 400):
        return CliRunner().invoke(app, ["list"]).output
