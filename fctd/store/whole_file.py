"""Result files: replaced atomically; a file that cannot be written is refused before the computation."""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from fctd.case.errors import InputError
from fctd.store.scratch import left_over, scratch_file, scratch_name


@contextmanager
def replaced(path: Path, *, lasting: bool = False, mode: int = 0o666) -> Iterator[Path]:
    """A temporary file that takes the place of ``path`` when the block ends without an error.

    A full disk or an interruption leaves the earlier file.  A symlink stays: the file it leads to is replaced.
    lasting : the new file outlasts a failure of power.  mode : of the new file, less what the user's mask forbids.
    Raises OSError.
    """
    target = Path(os.path.realpath(path))
    for left in left_over(target):
        left.unlink(missing_ok=True)
    with scratch_file(target, mode) as scratch:
        try:
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
    with writing(path):
        Path(os.path.realpath(path)).parent.mkdir(parents=True, exist_ok=True)
        with replaced(path, lasting=lasting) as scratch:
            yield scratch


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Inside, an OSError becomes an InputError, which names ``path``."""
    try:
        yield
    except OSError as error:
        raise InputError(f"a file that can be written ({error.strerror or error})", value=path) from error


def write_whole(path: Path, content: bytes, *, lasting: bool = False, mode: int = 0o666) -> None:
    """Write a file as ``replaced`` does; raises OSError."""
    with replaced(path, lasting=lasting, mode=mode) as scratch, open_file(scratch) as file:
        file.write(content)


def open_file(path: Path) -> BinaryIO:
    """The file that ``write_whole`` writes to."""
    return path.open("wb")


def check_file(path: Path, key: str = "") -> None:
    """Raise InputError, which names ``key`` and ``path``, for a file that ``whole_file`` could not write."""
    target = Path(os.path.realpath(path))
    try:
        if target.exists() and not stat.S_ISREG(target.stat().st_mode):
            raise InputError("a regular file that can be written, no folder, pipe or device", key=key, value=path)
        check_new(scratch_name(target))
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


def _sync(path: Path) -> None:
    """Make the contents of a file, or the names in a folder, outlast a failure of power."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
