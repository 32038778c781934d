"""Temporary files beside a user's own: names that this program alone gives, and whether their writers live.

A name holds a mark of this machine and a token that is drawn.  The file is made where no file was, and its writer has
it locked.  The system frees the lock as soon as the writer has ended, so a file of this machine that can be locked is
what a killed writer left.  The number of a process would not tell: containers that share a folder count their own.
"""

import hashlib
import os
import platform
import re
import secrets
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows, where what a killed writer leaves stays
    fcntl = None  # type: ignore[assignment]

LOCKS = fcntl is not None
TOKEN_BYTES = 4


@contextmanager
def scratch_file(target: Path, mode: int = 0o666) -> Iterator[Path]:
    """A new, empty file beside ``target`` with a name of its own; nobody takes it for left over inside the block.

    mode : less what the user's mask forbids.  Raises OSError.
    """
    file = None
    while file is None:
        path = scratch_name(target)
        file = _made(path, mode)
    try:
        yield path
    finally:
        if file >= 0:
            os.close(file)


def left_over(target: Path) -> Iterator[Path]:
    """Files that killed processes of this machine left beside ``target``; no other process has one meanwhile."""
    if not LOCKS:
        return
    names = re.compile(rf"\.{re.escape(target.stem)}-{_mark()}-[0-9a-f]{{{2 * TOKEN_BYTES}}}{re.escape(target.suffix)}")
    try:
        found = [target.with_name(name) for name in os.listdir(target.parent) if names.fullmatch(name)]
    except OSError:  # no such folder
        return
    for path in found:
        with suppress(OSError):  # a writer lives, the file is gone, is another user's, or cannot be locked there
            file = os.open(path, os.O_RDWR | os.O_NOFOLLOW)
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if os.path.samestat(os.fstat(file), os.stat(path)):
                    yield path
            finally:
                os.close(file)


def scratch_name(target: Path) -> Path:
    """A name for a temporary file beside ``target``; the suffix stays, which may say the format."""
    return target.with_stem(f".{target.stem}-{_mark()}-{secrets.token_hex(TOKEN_BYTES)}")


def _made(path: Path, mode: int) -> int | None:
    """A new file, open and locked, -1 where there are no locks; None where another process takes it for left over."""
    file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, mode)
    if not LOCKS:
        os.close(file)
        return -1
    try:
        with suppress(FileNotFoundError):
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(file), os.stat(path)):
                return file
    except BlockingIOError:
        pass
    except OSError:  # a file system without locks, where nobody takes any file for left over
        return file
    os.close(file)
    return None


@cache
def _mark() -> str:
    """What tells this program on this machine from others that write to the same folder.

    A container without an id of its own has the running system's, whose locks it shares.
    """
    machine = platform.node()
    for place in ("/etc/machine-id", "/proc/sys/kernel/random/boot_id"):
        with suppress(OSError, ValueError):
            if text := Path(place).read_text(encoding="ascii").strip():
                machine = text
                break
    return f"fctd-{hashlib.sha256(f'fctd {machine}'.encode()).hexdigest()[:8]}"
