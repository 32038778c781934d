"""The command line as tests call it."""

from typing import Protocol

import pytest

from fctd.cli import main


class Command(Protocol):
    """``fctd ARGUMENTS``, which must end with a code; gives what it printed, ``out`` and ``err``."""

    def __call__(self, *arguments: object, code: int = 0) -> "pytest.CaptureResult[str]": ...


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    """Exit code of ``fctd ARGUMENTS``."""
    monkeypatch.setattr("sys.argv", ["fctd", *map(str, arguments)])
    with pytest.raises(SystemExit) as stopped:
        main.main()
    return int(stopped.value.code or 0)
