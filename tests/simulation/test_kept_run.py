"""A run in its folder: when it is written, what is read back, and what a damaged or failing disk costs."""

import errno
import io
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import BinaryIO

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.results.tables import SimulationResult
from fctd.simulation import kept_run
from fctd.simulation.kept_run import CHECKPOINT, KeptRun, kept_so_far
from fctd.simulation.simulate import Simulation, simulate
from fctd.store import run_folder, save_interval
from fctd.store.limits import LimitReached
from fctd.store.run_folder import RunFolder, numbered, progress_of
from tests.simulation.kept import same, tripping


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[RunFolder]:
    folder = RunFolder.take(tmp_path / "out")
    yield folder
    folder.leave(remove=True)


class Stop(Exception):  # noqa: N818
    """The process ends."""


def killed_after(folder: RunFolder, records: int, every: float = 0.0) -> KeptRun:
    """A run that ends after so many records, without a word."""
    keeper = KeptRun(folder, every)

    def progress(now: float, total: float, factor: float) -> None:
        nonlocal records
        records -= 1
        if records == 0:
            raise Stop

    with pytest.raises(Stop):
        simulate(tripping(), progress=progress, keeper=keeper)
    return keeper


@pytest.fixture(autouse=True)
def always_due(monkeypatch: pytest.MonkeyPatch) -> None:
    """A checkpoint at every record of a run with ``every`` 0, whatever it costs."""
    monkeypatch.setattr(save_interval, "SHARE", 1e9)


@cache
def undisturbed() -> SimulationResult:
    return simulate(tripping())


def at(record: int) -> float:
    """Time of a record [s], counted from 1."""
    return float(undisturbed().history["time_s"].iloc[record - 1])


def test_a_run_goes_on_in_another_process(folder: RunFolder) -> None:
    killed_after(folder, 25)
    said: list[str] = []
    again = KeptRun(folder, 0.0, tell=said.append)
    found = simulate(tripping(), keeper=again)
    same(found, undisturbed())
    assert said == [f"the run goes on from {at(25):.4g} s"]
    assert len(numbered(folder.path, CHECKPOINT)) == 2


def test_it_is_written_when_it_is_time_to(folder: RunFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every two seconds; once writing takes long, less often: a hundredth of the time goes into it."""
    monkeypatch.setattr(save_interval, "SHARE", 0.01)
    now = [0.0]
    monkeypatch.setattr(save_interval.Clocks, "now", lambda: save_interval.Clocks(now[0], now[0]))
    keeper = KeptRun(folder, 2.0)
    simulation, written, cost = Simulation(tripping()), [], 0.005
    real = keeper._write

    def slow(of: Simulation) -> None:
        real(of)
        now[0] += cost
        written.append(round(now[0], 2))

    keeper._write = slow  # type: ignore[method-assign]
    keeper.begin(simulation)
    for k, _ in enumerate(simulation):
        cost = 0.005 if k < 10 else 0.1
        now[0] += 0.5
        keeper.keep(simulation)
        if k == 50:
            break
    assert written == pytest.approx([2.0, 4.01, 6.11], abs=0.01)
    assert keeper.spent == pytest.approx((0.11, 0.11))
    assert simulation.keeping == keeper.spent


def test_a_clock_that_jumps_changes_nothing(folder: RunFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    """The clock on the wall is set back by a day and on by a year; intervals are those of another clock."""
    jumps = iter([1e9, 1e9 - 86400, 1e9 + 3e7] * 1000)
    monkeypatch.setattr(kept_run.time, "time", lambda: next(jumps))
    killed_after(folder, 25)
    same(simulate(tripping(), keeper=KeptRun(folder, 0.0, tell=lambda _: None)), undisturbed())


@pytest.mark.parametrize("damage", ["cut", "flipped", "gone"])
def test_a_damaged_checkpoint_costs_what_came_after_the_one_before(folder: RunFolder, damage: str) -> None:
    killed_after(folder, 25)
    number, name = list(numbered(folder.path, CHECKPOINT).items())[-1]
    _damage(folder.path / name, damage)
    said: list[str] = []
    found = simulate(tripping(), keeper=KeptRun(folder, 1e9, tell=said.append))
    same(found, undisturbed())
    if damage != "gone":
        assert said[0].startswith(f"checkpoint {number} cannot be used")
    assert said[-1] == f"the run goes on from {at(24):.4g} s"


@pytest.mark.parametrize("damage", ["cut", "flipped", "gone"])
def test_a_damaged_chunk_is_never_read_as_another(folder: RunFolder, damage: str) -> None:
    """An early one is part of both checkpoints: the run begins anew, and says so."""
    killed_after(folder, 25)
    _damage(folder.path / "3-history.parquet", damage)
    said: list[str] = []
    same(simulate(tripping(), keeper=KeptRun(folder, 1e9, tell=said.append)), undisturbed())
    assert [line.partition(" cannot")[0] for line in said] == ["checkpoint 25", "checkpoint 24", "the run begins anew"]
    assert numbered(folder.path, "history.parquet") == {}


def _damage(path: Path, how: str) -> None:
    content = bytearray(path.read_bytes())
    if how == "gone":
        path.unlink()
        return
    if how == "cut":
        content = content[: len(content) // 2]
    else:
        for k in range(100, len(content), 97):
            content[k] ^= 0x55
    path.write_bytes(content)


def test_what_is_kept_so_far_can_be_looked_at(folder: RunFolder) -> None:
    """It changes nothing, and is that of the checkpoint before where the last one is damaged."""
    with pytest.raises(InputError, match="a run of which something has been kept"):
        kept_so_far(folder.path, tripping())
    killed_after(folder, 25)
    for damaged, records in ((False, 25), (True, 24)):
        if damaged:
            (name,) = list(numbered(folder.path, CHECKPOINT).values())[-1:]
            _damage(folder.path / name, "cut")
        before = {path.name: path.read_bytes() for path in folder.path.iterdir()}
        found = kept_so_far(folder.path, tripping())
        pd.testing.assert_frame_equal(found.history, undisturbed().history[:records], check_exact=True)
        assert (found.status, found.message) == ("interrupted", f"at {at(records):.4g} s")
        assert {path.name: path.read_bytes() for path in folder.path.iterdir()} == before


class Failing(io.FileIO):
    """A file on a disk that fails after so many bytes of all files."""

    left = 0

    def write(self, content: bytes) -> int:  # type: ignore[override]
        Failing.left -= len(content)
        if Failing.left < 0:
            raise OSError(errno.EIO, "Input/output error")
        return super().write(content)


@pytest.mark.parametrize("after", [0, 40_000, 400_000])
def test_a_disk_that_fails_costs_one_chunk(folder: RunFolder, after: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The run ends with a message; what had been written can be gone on with."""

    def failing(path: Path) -> BinaryIO:
        return Failing(path, "wb")  # type: ignore[return-value]

    Failing.left = after
    with monkeypatch.context() as patched:
        patched.setattr(run_folder, "open_file", failing)
        with pytest.raises(InputError, match=r"Input/output error.*make room there") as refused:
            simulate(tripping(), keeper=KeptRun(folder, 0.0, key="--out"))
    kept = len(numbered(folder.path, "history.parquet"))
    assert (kept > 0) == (after > 0)
    assert ("go on with --resume" in str(refused.value)) == bool(numbered(folder.path, CHECKPOINT))
    assert not [path for path in folder.path.iterdir() if path.name.startswith(".")]
    same(simulate(tripping(), keeper=KeptRun(folder, 1e9, tell=lambda _: None)), undisturbed())


def test_the_progress_is_reported(folder: RunFolder, tmp_path: Path) -> None:
    killed_after(folder, 25)
    progress = progress_of(tmp_path / "out")
    assert progress is not None
    assert (progress.unit, progress.kept) == ("s", pytest.approx(at(25)))
    assert progress.done == pytest.approx(at(25))
    assert progress.total == Simulation(tripping()).end


def test_a_run_that_reaches_a_limit_keeps_its_records() -> None:
    def progress(now: float, total: float, factor: float) -> None:
        if now >= 3:
            raise LimitReached("the time limit of 3 s is reached")

    result = simulate(tripping(), progress=progress)
    assert (result.status, result.message) == ("stopped", "at 3 s: the time limit of 3 s is reached")
    assert result.history["time_s"].iloc[-1] == pytest.approx(3.0)


def test_a_limit_while_the_string_settles() -> None:
    def settling(now: float, imbalance: float) -> None:
        raise LimitReached("the time limit of 3 s is reached")

    result = simulate(tripping(), settling=settling)
    assert (result.status, len(result.history)) == ("stopped", 0)
    assert result.message.startswith("before the start")
