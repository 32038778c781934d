"""Result files: replaced atomically; a file that cannot be written is refused before the computation."""

import os
import re
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from fctd.case.errors import InputError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """A temporary file that replaces ``path`` once it is written completely; missing folders are made.

    A full disk or an interruption leaves the earlier file.  A symlink stays: the file it leads to is replaced.  Raises
    InputError, which names ``path``, where the file cannot be written.
    """
    target = Path(os.path.realpath(path))
    scratch = _scratch(target)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        for left in left_overs(target):
            left.unlink(missing_ok=True)
        yield scratch
        scratch.replace(target)
    except OSError as error:
        raise InputError(f"a file that can be written ({error.strerror or error})", value=path) from error
    finally:
        with suppress(OSError):
            scratch.unlink()


def check_file(path: Path, key: str = "") -> None:
    """Raise InputError, which names ``key`` and ``path``, for a file that ``whole_file`` could not write."""
    target = Path(os.path.realpath(path))
    try:
        if target.exists() and not stat.S_ISREG(target.stat().st_mode):
            raise InputError("a regular file that can be written, no folder, pipe or device", key=key, value=path)
        check_new(_scratch(target))
        if target.exists() and not os.access(target, os.W_OK):
            raise PermissionError(None, "Permission denied")
    except OSError as error:
        raise InputError(f"a file that can be written ({error.strerror or error})", key=key, value=path) from None


def check_new(path: Path) -> None:
    """Raise OSError where neither ``path`` nor the folders on the way to it can be made."""
    with suppress(FileNotFoundError):
        path.lstat()  # raises OSError for a path that is too long or leads through a file
    folder = next(parent for parent in path.parents if parent.exists())
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(None, "Permission denied")
    for name in path.relative_to(folder).parts:
        with suppress(FileNotFoundError):
            (folder / name).lstat()  # raises OSError for a name that is too long


def left_overs(path: Path) -> list[Path]:
    """Temporary files that killed processes left beside ``path``."""
    return [left for left, _ in left_by_dead(path.parent, rf"\.{re.escape(path.stem)}-PID{re.escape(path.suffix)}")]


def left_by_dead(folder: Path, pattern: str) -> list[tuple[Path, int]]:
    """Entries of a folder whose names match a pattern, and the id at PID in it, where that process has ended."""
    names = re.compile(pattern.replace("PID", r"([1-9][0-9]{0,6})"))
    try:
        found = [(folder / name, match) for name in os.listdir(folder) if (match := names.fullmatch(name))]
    except OSError:  # no such folder
        return []
    return [(path, int(match[1])) for path, match in found if not _runs(int(match[1]))]


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:  # another user's
        return True
    return True


def _scratch(path: Path) -> Path:
    return path.with_stem(f".{path.stem}-{os.getpid()}")  # the suffix stays: it may say the format
