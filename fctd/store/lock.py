"""The lock of a folder that one process at a time may write to.

The system holds it: it is free again as soon as the process has ended, however it ended, also where another process has
its number since.  The file names the process, for messages alone.
"""

import errno
import json
import os
import time
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple, Self

try:
    import fcntl
except ImportError:  # Windows, where a second run on one folder is not noticed
    fcntl = None  # type: ignore[assignment]

NAME = "lock"
# A process that only looks whether a lock is held has it for microseconds.
ATTEMPTS, PAUSE = 5, 0.02


class Holder(NamedTuple):
    """The process that holds a lock; since : when it took it, seconds since the epoch."""

    process: int
    since: float


class HeldError(Exception):
    """Another process holds the lock."""

    def __init__(self, holder: Holder) -> None:
        super().__init__(f"process {holder.process} holds the lock")
        self.holder = holder


class FolderLock:
    """A lock that this process holds, from ``take`` until ``release``."""

    def __init__(self, file: int) -> None:
        self._file = file

    @classmethod
    def take(cls, folder: Path) -> Self:
        """Take the lock of a folder that exists; raises HeldError, and OSError where nothing can be written."""
        for attempt in range(ATTEMPTS):
            file = _locked(folder / NAME, shared=False)
            if file is not None:
                try:
                    os.ftruncate(file, 0)
                    text = json.dumps(Holder(os.getpid(), time.time())).encode()
                    if os.write(file, text) < len(text):
                        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
                except OSError:  # a full disk: a lock that stays would be one of a process that nobody knows
                    (folder / NAME).unlink()
                    os.close(file)
                    raise
                return cls(file)
            if attempt + 1 < ATTEMPTS:
                time.sleep(PAUSE)
        raise HeldError(_holder(folder / NAME))

    def release(self) -> None:
        """Give the lock back; a second call has no effect."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


def holder_of(folder: Path) -> Holder | None:
    """The process that holds the lock of a folder; None where there is none."""
    try:
        file = _locked(folder / NAME, shared=True)
    except OSError:  # no such file, or a folder that may only be read
        return None
    if file is None:
        return _holder(folder / NAME)
    os.close(file)
    return None


def _locked(path: Path, *, shared: bool) -> int | None:
    """The open file once it is locked; None where another process holds it."""
    while True:
        file = os.open(path, os.O_RDONLY if shared else os.O_RDWR | os.O_CREAT, 0o644)
        try:
            if fcntl is not None:
                fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(file)
            return None
        except OSError:
            os.close(file)
            raise
        with suppress(FileNotFoundError):
            if os.path.samestat(os.fstat(file), os.stat(path)):
                return file
        os.close(file)  # its holder has removed it meanwhile
        if not path.parent.is_dir() or shared:
            raise FileNotFoundError(None, "No such file", str(path))


def _holder(path: Path) -> Holder:
    """What a lock says of its holder, who may just be writing it."""
    for _ in range(ATTEMPTS):
        with suppress(OSError, ValueError, TypeError):
            process, since = json.loads(path.read_bytes())
            return Holder(int(process), float(since))
        time.sleep(PAUSE)
    return Holder(0, time.time())
