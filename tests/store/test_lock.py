"""One process at a time holds the lock of a folder; one that is killed releases it."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fctd.store.lock import FolderLock, HeldError, holder_of

pytest.importorskip("fcntl")
HOLD = (
    "import sys, time; from pathlib import Path; from fctd.store.lock import FolderLock\n"
    "lock = FolderLock.take(Path(sys.argv[1])); print('held', flush=True); time.sleep(3600)\n"
)


def test_a_second_holder_is_refused_with_the_number_of_the_first(tmp_path: Path) -> None:
    lock = FolderLock.take(tmp_path)
    with pytest.raises(HeldError) as held:
        FolderLock.take(tmp_path)
    assert held.value.holder.process == os.getpid()
    assert holder_of(tmp_path) == held.value.holder
    lock.release()
    lock.release()
    assert holder_of(tmp_path) is None
    FolderLock.take(tmp_path).release()


@pytest.mark.parametrize("room", [0, 1])
def test_a_full_disk_leaves_no_lock(room: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing or a byte is written: the place is not one that "process 0" writes to."""
    write = os.write

    def full(file: int, data: bytes) -> int:
        if not room:
            raise OSError(27, "File too large")
        return write(file, data[:room])

    monkeypatch.setattr(os, "write", full)
    with pytest.raises(OSError, match=r"File too large|No space left"):
        FolderLock.take(tmp_path)
    monkeypatch.undo()
    FolderLock.take(tmp_path).release()


def test_the_lock_of_a_killed_process_is_free(tmp_path: Path) -> None:
    """Also where a process with its number runs again: the file says so, the system knows better."""
    other = subprocess.Popen([sys.executable, "-c", HOLD, str(tmp_path)], stdout=subprocess.PIPE, cwd=Path.cwd())
    assert other.stdout is not None
    assert other.stdout.readline() == b"held\n"
    holder = holder_of(tmp_path)
    assert holder is not None
    assert holder.process == other.pid
    other.send_signal(signal.SIGKILL)
    other.wait()
    other.stdout.close()
    (tmp_path / "lock").write_text(json.dumps([os.getpid(), time.time()]))
    assert holder_of(tmp_path) is None
    lock = FolderLock.take(tmp_path)
    assert json.loads((tmp_path / "lock").read_text())[0] == os.getpid()
    lock.release()


def test_a_lock_that_its_holder_removed_does_not_count(tmp_path: Path) -> None:
    first = FolderLock.take(tmp_path)
    (tmp_path / "lock").unlink()
    second = FolderLock.take(tmp_path)
    first.release()
    with pytest.raises(HeldError):
        FolderLock.take(tmp_path)
    second.release()


def test_the_holder_is_seen_by_who_may_only_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As ``fctd status`` does with the run of another user; a library that opens a lock for writing does not see it."""
    lock, opened = FolderLock.take(tmp_path), os.open

    def reading(path: Path, flags: int, mode: int = 0o777) -> int:
        if flags & (os.O_RDWR | os.O_WRONLY | os.O_CREAT):
            raise PermissionError(13, "Permission denied")
        return opened(path, flags, mode)

    monkeypatch.setattr(os, "open", reading)
    holder = holder_of(tmp_path)
    assert holder is not None
    assert holder.process == os.getpid()
    lock.release()
    assert holder_of(tmp_path) is None


def test_no_folder_has_no_holder(tmp_path: Path) -> None:
    assert holder_of(tmp_path / "none") is None
    with pytest.raises(OSError, match="No such file"):
        FolderLock.take(tmp_path / "none")
