"""The folder of a run that has not ended: ``.NAME-run`` beside the file or folder NAME that its result will be.

- ``lock``: of the process that writes here (lock.py).
- ``run.json``: what is computed, of which files, with which options (``describe``).
- copies of the files that the run reads.
- numbered chunks and checkpoints of the results so far (``write``), each complete or not there at all.
- ``progress.json``: how far the process is.

A process may be killed at any moment: what was written before stays as it was.
"""

import json
import os
import shutil
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple, Self

from fctd.case.errors import InputError
from fctd.store.lock import FolderLock, HeldError, Holder, holder_of

ABOUT, PROGRESS = "run.json", "progress.json"
# Time between two reports of the progress of a run [s].
REPORTED_EVERY = 1.0
KEYS = ("command", "program", "case", "options", "origin", "files", "copies", "identity")


class Progress(NamedTuple):
    """How far a run is, in units of ``unit``; kept : what a process killed now would keep; took [s] so far.

    now : when this was written, seconds since the epoch.
    """

    done: float
    total: float
    unit: str
    kept: float
    took: float
    now: float


class RunFolder:
    """The folder of the run of a result, which this process alone writes to, from ``take`` until ``leave``."""

    def __init__(self, target: Path, lock: FolderLock) -> None:
        self.path, self._lock = run_path(target), lock

    @classmethod
    def take(cls, target: Path, key: str = "") -> Self:
        """Lock the folder for the result ``target``, and make it where there is none.

        Raises InputError, which names ``key`` and the target, while another process writes there or where the system
        refuses.
        """
        path = run_path(target)
        try:
            while True:
                path.mkdir(parents=True, exist_ok=True)
                with suppress(FileNotFoundError):  # another process has just removed the folder
                    return cls(target, FolderLock.take(path))
        except HeldError as held:
            raise taken(held.holder, target, key) from None
        except OSError as error:
            expected = f"a place beside which the run can be kept ({error.strerror or error})"
            raise InputError(expected, key=key, value=target) from error

    def describe(self, about: Mapping[str, Any], copies: Mapping[str, bytes]) -> None:
        """Write what is computed, and copies of files by their names, in place of all that was here."""
        self.clear()
        for name, content in copies.items():
            self.write(name, content)
        self.write(ABOUT, json.dumps(about).encode())

    def write(self, name: str, content: bytes, *, lasting: bool = True) -> None:
        """Write a file completely or not at all; it outlasts a failure of power where it is ``lasting``.

        Raises OSError.
        """
        scratch = self.path / f".{name}"
        try:
            with open_file(scratch) as file:
                file.write(content)
                file.flush()
                if lasting:
                    os.fsync(file.fileno())
            os.replace(scratch, self.path / name)
            if lasting:
                _sync(self.path)
        finally:
            with suppress(OSError):
                scratch.unlink()

    def report(self, progress: Progress) -> None:
        """Say how far the run is; a disk that is full does not stop it here."""
        with suppress(OSError):
            self.write(PROGRESS, json.dumps(progress).encode(), lasting=False)

    def remove(self, names: set[str]) -> None:
        """Remove files, those that are there."""
        for name in names:
            (self.path / name).unlink(missing_ok=True)

    def clear(self) -> None:
        """Remove all files but the lock; the description first, without which there is no run here."""
        (self.path / ABOUT).unlink(missing_ok=True)
        self.remove({name for name in os.listdir(self.path) if name != "lock"})

    def leave(self, *, remove: bool) -> None:
        """Release the lock; remove : also the folder, of a run that has ended or has nothing to keep."""
        if remove:
            with suppress(OSError):
                self.clear()
                shutil.rmtree(self.path)
        self._lock.release()


def taken(writer: Holder, target: Path, key: str) -> InputError:
    """The refusal of a result that another process computes."""
    here = f"no other run writes to (process {writer.process} does, since {clock(writer.since)})"
    return InputError(f"a place that {here}: wait for it, or name another", key=key, value=target)


def cannot_keep(error: OSError, folder: RunFolder, key: str, kept: str) -> InputError:
    """The refusal of a place where a run cannot be kept any longer; kept : what it has kept, in words."""
    on = f", and go on with --resume from {kept}" if kept else ""
    expected = f"a place where the run can be kept ({error.strerror or error}): make room there{on}"
    return InputError(expected, key=key, value=folder.path)


def open_file(path: Path) -> BinaryIO:
    """The file that ``RunFolder.write`` writes to."""
    return path.open("wb")


def run_path(target: Path) -> Path:
    """Where the run of a result is kept; the result of a symlink is what it leads to."""
    target = Path(os.path.realpath(target))
    return target.parent / f".{target.name}-run"  # also of the root, which has no name


def about_of(target: Path) -> dict[str, Any] | None:
    """What is computed in the folder of a result's run; None where there is no run.

    Raises InputError for a description that this program has not written.
    """
    path = run_path(target) / ABOUT
    try:
        found: dict[str, Any] = json.loads(path.read_bytes())
        return {key: found[key] for key in KEYS}
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError, KeyError, TypeError) as error:
        expected = f"the description of a run ({getattr(error, 'strerror', None) or error}): remove the folder"
        raise InputError(expected, value=path) from None


def progress_of(target: Path) -> Progress | None:
    """How far the run of a result is; None where it has not begun."""
    try:
        return Progress(*json.loads((run_path(target) / PROGRESS).read_bytes()))
    except (OSError, ValueError, TypeError):
        return None


def writer_of(target: Path) -> Holder | None:
    """The process that computes a result; None where there is none."""
    return holder_of(run_path(target))


def numbered(folder: Path, kind: str) -> dict[int, str]:
    """The files ``N-KIND`` of a folder by their numbers."""
    found = {}
    with suppress(OSError):
        for name in os.listdir(folder):
            number, _, rest = name.partition("-")
            if rest == kind and number.isdecimal():
                found[int(number)] = name
    return dict(sorted(found.items()))


def clock(moment: float) -> str:
    """A moment, seconds since the epoch, in words."""
    return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(moment))


def _sync(folder: Path) -> None:
    """Make the names in a folder outlast a failure of power."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
