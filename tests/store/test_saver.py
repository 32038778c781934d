"""A computation that is saved: its chunks, how far it is, and a disk that fails."""

import errno
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.store import save_interval, saver, whole_file
from fctd.store.log import read
from fctd.store.run_folder import RunFolder, progress_of
from fctd.store.saver import Saver

PARTS = {"rows.json": b"[1, 2]"}


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """A clock that is moved by hand."""
    now = [0.0]
    monkeypatch.setattr(save_interval, "clocks", lambda: np.array([now[0], now[0]]))
    monkeypatch.setattr(saver.time, "monotonic", lambda: now[0])
    return now


@pytest.fixture
def saving(tmp_path: Path, clock: list[float]) -> Iterator[Saver]:
    folder = RunFolder.take(tmp_path / "out")
    yield Saver(folder, 2.0, "rows", "--out")
    folder.leave(remove=True)


def test_chunks_follow_each_other_and_their_time_is_spent(saving: Saver, clock: list[float]) -> None:
    def parts() -> dict[str, bytes]:
        clock[0] += 0.25
        return PARTS

    for number in (1, 2):
        saving.write(3.0 * number, parts)
        assert (saving.number, saving.kept, saving.interval.spent[0]) == (number, 3.0 * number, 0.25 * number)
    assert [read(path) for path in saving.chunks.files.values()] == [PARTS, PARTS]


def test_progress_is_reported_once_a_second_or_now(saving: Saver, clock: list[float], tmp_path: Path) -> None:
    def reported() -> Any:
        found = progress_of(tmp_path / "out")
        return None if found is None else (found.done, found.total, found.unit, found.kept, found.took)

    clock[0] = 0.9
    saving.report(1.0, 10.0)
    assert reported() is None
    clock[0] = 1.0
    saving.report(2.0, 10.0)
    saving.report(3.0, 10.0)
    assert reported() == (2.0, 10.0, "rows", 0.0, 1.0)
    saving.report(4.0, 10.0, now=True)
    assert reported() == (4.0, 10.0, "rows", 0.0, 1.0)


class Failing(io.FileIO):
    """A file on a disk that fails."""

    def write(self, content: object) -> int:
        raise OSError(errno.EIO, "Input/output error")


def test_a_disk_that_fails_costs_one_chunk(saving: Saver, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message names the place and, once something is kept, the way on; nothing half written is left."""
    for kept, way_on in ((0.0, ""), (3.0, ", and go on with --resume from 3 rows")):
        with monkeypatch.context() as patched:
            patched.setattr(whole_file, "open_file", lambda path: Failing(path, "wb"))
            with pytest.raises(InputError) as refused:
                saving.write(9.0, lambda: PARTS)
            saving.report(1.0, 10.0, now=True)  # which a full disk does not stop
        expected = f"a place where the run can be kept (Input/output error): make room there{way_on}"
        assert str(refused.value) == f'--out = "{tmp_path / ".out-run"}": expected {expected}'
        assert (saving.number, saving.kept) == (int(kept > 0), kept)
        assert not [path for path in saving.folder.path.iterdir() if path.name.startswith(".")]
        saving.write(3.0, lambda: PARTS)
