"""Fixtures of the commands."""

from pathlib import Path

import pytest

from tests.cli.tiny import CASE, SMALL
from tests.commands import Command, run


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    """The tiny case as a file; files of tests of other cases have a fixture of their own."""
    path = tmp_path / "tiny.toml"
    path.write_text(CASE)
    return path


@pytest.fixture
def small_file(tmp_path: Path) -> Path:
    """The small case as a file, which runs in time too."""
    path = tmp_path / "small.toml"
    path.write_text(SMALL)
    return path


@pytest.fixture
def cli(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """The command line; what was printed before a command does not count to what it prints."""

    def ended(*arguments: object, code: int = 0) -> "pytest.CaptureResult[str]":
        capsys.readouterr()
        found = run(monkeypatch, *arguments)
        printed = capsys.readouterr()
        assert found == code, printed.err
        return printed

    return ended
