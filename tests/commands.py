"""The command line as tests call it, and how tests wait for what another process or thread does."""

import multiprocessing.process
import time
from collections.abc import Callable
from typing import Protocol, TypeVar

import pytest

from fctd.cli import main

HANG = 300.0  # [s]: what takes longer hangs, on a busy machine too.  It guards, and measures nothing.
Found = TypeVar("Found")


class Command(Protocol):
    """``fctd ARGUMENTS``, which must end with a code; gives what it printed, ``out`` and ``err``."""

    def __call__(self, *arguments: object, code: int = 0) -> "pytest.CaptureResult[str]": ...


def run(monkeypatch: pytest.MonkeyPatch, *arguments: object) -> int:
    """Exit code of ``fctd ARGUMENTS``."""
    monkeypatch.setattr("sys.argv", ["fctd", *map(str, arguments)])
    with pytest.raises(SystemExit) as stopped:
        main.main()
    return int(stopped.value.code or 0)


def until(wanted: Callable[[], Found]) -> Found:
    """Wait for an event; returns what it gave."""
    end = time.monotonic() + HANG
    while not (found := wanted()):
        assert time.monotonic() < end, "what is waited for does not come"
        time.sleep(0.02)
    return found


def exit_code(process: multiprocessing.process.BaseProcess) -> int | None:
    """The exit code of a process, which is waited for; None of one that hangs, which is ended."""
    process.join(HANG)
    found = process.exitcode
    process.kill()
    return found
