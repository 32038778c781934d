"""The folder of a run that has not ended: ``.NAME-run`` beside the file or folder NAME that its result will be.

- ``lock``: of the process that writes here (lock.py).
- ``run.json``: what is computed, of which files, with which options (``describe``).
- copies of the files that the run reads.
- numbered chunks of the results so far (``chunks_of``), each complete or not there at all.
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
from typing import Any, NamedTuple, Self

from fctd.case.errors import InputError
from fctd.store.lock import NAME as LOCK
from fctd.store.lock import FolderLock, HeldError, Holder, holder_of
from fctd.store.log import Log
from fctd.store.whole_file import write_whole

ABOUT, PROGRESS = "run.json", "progress.json"
# Of the folder; one of another form is refused.
FORM = 2
KEYS = ("command", "program", "case", "options", "origin", "files", "copies", "identity")


class RunProgress(NamedTuple):
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

        Raises InputError, which names ``key`` and the target, while another process writes there, where the folder
        holds files of others, or where the system refuses.
        """
        path = run_path(target)
        try:
            while True:
                path.mkdir(parents=True, exist_ok=True)
                if (names := os.listdir(path)) and not {LOCK, ABOUT} & set(names):
                    expected = f"another place (its runs are kept in {path}, and that folder holds files of others)"
                    raise InputError(expected, key=key, value=target)
                with suppress(FileNotFoundError):  # another process has just removed the folder
                    return cls(target, FolderLock.take(path))
        except HeldError as held:
            here = f"no other run writes to (process {held.holder.process} does, since {clock(held.holder.since)})"
            raise InputError(f"a place that {here}: wait for it, or name another", key=key, value=target) from None
        except OSError as error:
            with suppress(OSError):
                path.rmdir()  # where this has made it
            expected = f"a place beside which the run can be kept ({error.strerror or error})"
            raise InputError(expected, key=key, value=target) from error

    def describe(self, about: Mapping[str, Any], copies: Mapping[str, bytes]) -> None:
        """Write what is computed, and copies of files by their names, in place of all that was here; raises OSError."""
        self.clear()
        for name, content in copies.items():
            write_whole(self.path / name, content, lasting=True)
        write_whole(self.path / ABOUT, json.dumps({"form": FORM, **about}).encode(), lasting=True)

    def report(self, progress: RunProgress) -> None:
        """Say how far the run is; a disk that is full does not stop it here."""
        with suppress(OSError):
            write_whole(self.path / PROGRESS, json.dumps(progress._asdict()).encode())

    def clear(self) -> None:
        """Remove all files but the lock; the description first, without which there is no run here."""
        for name in (ABOUT, *os.listdir(self.path)):
            if name != LOCK:
                (self.path / name).unlink(missing_ok=True)

    def leave(self, *, remove: bool) -> None:
        """Release the lock; remove : also the folder, of a run that has ended or has nothing to keep."""
        if remove:
            with suppress(OSError):
                self.clear()
                shutil.rmtree(self.path)
        self._lock.release()


def run_path(target: Path) -> Path:
    """Where the run of a result is kept; the result of a symlink is what it leads to."""
    target = Path(os.path.realpath(target))
    return target.parent / f".{target.name}-run"  # also of the root, which has no name


def chunks_of(folder: Path) -> Log:
    """What has been kept of the run in a folder."""
    return Log(folder, tail="-chunk.zip")


def about_of(target: Path) -> dict[str, Any] | None:
    """What is computed in the folder of a result's run; None where there is no run.

    Raises InputError for a description that this version of the program has not written.
    """
    path = run_path(target) / ABOUT
    try:
        found: dict[str, Any] = json.loads(path.read_bytes())
        if (form := found.get("form", 1)) == FORM:
            return {key: found[key] for key in KEYS}
    except (FileNotFoundError, NotADirectoryError):
        return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        expected = f"the description of a run ({getattr(error, 'strerror', None) or error}): remove the folder"
        raise InputError(expected, value=path) from None
    expected = (
        f"an unfinished run of this version of fctd, form {FORM} (this one has form {form}): go on with the version "
        "that began it, or drop it and begin anew with --restart"
    )
    raise InputError(expected, value=path)


def progress_of(target: Path) -> RunProgress | None:
    """How far the run of a result is; None where it has not begun."""
    try:
        return RunProgress(**json.loads((run_path(target) / PROGRESS).read_bytes()))
    except (OSError, ValueError, TypeError):
        return None


def writer_of(target: Path) -> Holder | None:
    """The process that computes a result; None where there is none."""
    return holder_of(run_path(target))


def clock(moment: float) -> str:
    """A moment, seconds since the epoch, in words."""
    return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(moment))
