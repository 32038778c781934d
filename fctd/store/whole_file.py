"""Result files: replaced atomically; a file that cannot be written is refused before the computation."""

import os
import re
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from fctd.case.errors import InputError


@contextmanager
def replaced(path: Path, *, lasting: bool = False) -> Iterator[Path]:
    """A temporary file that takes the place of ``path`` when the block ends without an error.

    A full disk or an interruption leaves the earlier file.  A symlink stays: the file it leads to is replaced.
    lasting : the new file outlasts a failure of power.  Raises OSError.
    """
    target = Path(os.path.realpath(path))
    scratch = _scratch(target)
    try:
        for left in left_overs(target):
            left.unlink(missing_ok=True)
        yield scratch
        if lasting:
            _sync(scratch)
        scratch.replace(target)
        if lasting:
            _sync(target.parent)
    finally:
        with suppress(OSError):
            scratch.unlink()


@contextmanager
def whole_file(path: Path, *, lasting: bool = False) -> Iterator[Path]:
    """The same; missing folders are made, and InputError, which names ``path``, says that it cannot be written."""
    try:
        Path(os.path.realpath(path)).parent.mkdir(parents=True, exist_ok=True)
        with replaced(path, lasting=lasting) as scratch:
            yield scratch
    except OSError as error:
        raise InputError(f"a file that can be written ({error.strerror or error})", value=path) from error


def write_whole(path: Path, content: bytes, *, lasting: bool = False, mode: int = 0o666) -> None:
    """Write a file as ``replaced`` does; mode : of a new one, less what the user's mask forbids.  Raises OSError."""
    with replaced(path, lasting=lasting) as scratch, open_file(scratch, mode) as file:
        file.write(content)


def open_file(path: Path, mode: int) -> BinaryIO:
    """The file that ``write_whole`` writes to."""
    return open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, mode), "wb")


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


def _sync(path: Path) -> None:
    """Make the contents of a file, or the names in a folder, outlast a failure of power."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
