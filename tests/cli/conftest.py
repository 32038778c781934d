"""Fixtures of the commands."""

from pathlib import Path

import pytest

from tests.cli.tiny import CASE


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    """The tiny case as a file; files of tests of other cases have a fixture of their own."""
    path = tmp_path / "tiny.toml"
    path.write_text(CASE)
    return path
