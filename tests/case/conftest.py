"""The valid case of the strategies as a file, for every test of this room."""

from pathlib import Path

import pytest

from tests.rules import CASE


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    """The valid case as a file."""
    path = tmp_path / "well.toml"
    path.write_text(CASE, encoding="utf-8")
    return path
