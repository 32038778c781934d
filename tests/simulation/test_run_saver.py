"""A run in its folder: when it is written, what is read back, and what a damaged or failing disk costs."""

from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.results.tables import SimulationResult
from fctd.simulation.guards import Guards
from fctd.simulation.hung import Hung
from fctd.simulation.recorder import Recorder
from fctd.simulation.run import Run
from fctd.simulation.run_saver import RunSaver, checkpoints_of, kept_so_far
from fctd.simulation.series import SegmentSeries
from fctd.simulation.simulate import Simulation, simulate
from fctd.store import save_interval
from fctd.store.facts import Restorable
from fctd.store.run_folder import RunFolder, chunks_of, progress_of
from tests.simulation.kept import same, tripping


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[RunFolder]:
    folder = RunFolder.take(tmp_path / "out")
    yield folder
    folder.leave(remove=True)


class Stop(Exception):  # noqa: N818
    """The process ends."""


def killed_after(folder: RunFolder, records: int, every: float = 0.0) -> RunSaver:
    """A run that ends after so many records, without a word."""
    checkpointer = RunSaver(folder, every)

    def progress(now: float, total: float, factor: float) -> None:
        nonlocal records
        records -= 1
        if records == 0:
            raise Stop

    with pytest.raises(Stop):
        simulate(tripping(), progress=progress, checkpointer=checkpointer)
    return checkpointer


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


@pytest.mark.slow
def test_a_run_goes_on_in_another_process(folder: RunFolder, tmp_path: Path) -> None:
    """Every record is a chunk; the progress that is reported and the times are those of the whole run."""
    before = killed_after(folder, 25)
    progress = progress_of(tmp_path / "out")
    assert progress is not None
    assert (progress.unit, progress.kept, progress.done) == ("s", at(25), at(25))
    assert progress.total == Simulation(tripping()).end
    said: list[str] = []
    again = RunSaver(folder, 0.0, tell=said.append)
    found = simulate(tripping(), checkpointer=again)
    same(found, undisturbed())
    assert said == [f"the run goes on from {at(25):.4g} s"]
    assert list(checkpoints_of(folder.path).files) == [again.number - 1, again.number]
    assert list(chunks_of(folder.path).files) == list(range(1, len(undisturbed().history) + 1))
    assert found.run["checkpoints_s"] == again.interval.spent[1] > before.interval.spent[1]


@pytest.mark.slow
@pytest.mark.parametrize("damage", ["cut", "flipped", "gone"])
def test_a_damaged_checkpoint_costs_what_came_after_the_one_before(folder: RunFolder, damage: str) -> None:
    killed_after(folder, 25)
    number, path = list(checkpoints_of(folder.path).files.items())[-1]
    _damage(path, damage)
    said: list[str] = []
    same(simulate(tripping(), checkpointer=RunSaver(folder, 1e9, tell=said.append)), undisturbed())
    if damage != "gone":
        assert said[0].startswith(f"checkpoint {number} cannot be used")
    assert said[-1] == f"the run goes on from {at(24):.4g} s"


@pytest.mark.slow
@pytest.mark.parametrize("damage", ["cut", "flipped", "gone"])
def test_a_damaged_chunk_is_never_read_as_another(folder: RunFolder, damage: str) -> None:
    """An early one is part of both checkpoints: the run begins anew, and says so."""
    killed_after(folder, 25)
    _damage(chunks_of(folder.path).path(3), damage)
    said: list[str] = []
    same(simulate(tripping(), checkpointer=RunSaver(folder, 1e9, tell=said.append)), undisturbed())
    assert [line.partition(" cannot")[0] for line in said] == ["checkpoint 25", "checkpoint 24", "the run begins anew"]
    assert chunks_of(folder.path).files == {}


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
            _damage(checkpoints_of(folder.path).path(25), "cut")
        before = {path.name: path.read_bytes() for path in folder.path.iterdir()}
        found = kept_so_far(folder.path, tripping())
        pd.testing.assert_frame_equal(found.history, undisturbed().history[:records], check_exact=True)
        assert (found.status, found.message) == ("interrupted", f"at {at(records):.4g} s")
        assert {path.name: path.read_bytes() for path in folder.path.iterdir()} == before


OWNERS: dict[type[Restorable], Callable[[Simulation], Restorable]] = {
    Simulation: lambda simulation: simulation,
    Run: lambda simulation: simulation.run,
    Hung: lambda simulation: simulation.run.upper_end,
    Recorder: lambda simulation: simulation.recorder,
    Guards: lambda simulation: simulation.recorder.guards,
    SegmentSeries: lambda simulation: simulation.recorder.series,
}


@pytest.mark.parametrize("owner", OWNERS)
def test_a_field_that_an_owner_adds_is_kept(
    owner: type[Restorable], folder: RunFolder, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It names the field among its facts, and nothing else is changed: neither other owners nor what writes them."""
    monkeypatch.setattr(owner, "FACTS", (*owner.FACTS, "added"))
    monkeypatch.setattr(owner, "added", (0, np.zeros(1)), raising=False)
    simulation, checkpointer = Simulation(tripping()), RunSaver(folder, 0.0)
    checkpointer.begin(simulation)
    for k in range(3):
        next(simulation)
        vars(OWNERS[owner](simulation))["added"] = (k, np.full(2, np.pi))
        checkpointer.keep(simulation)
    again = Simulation(tripping())
    RunSaver(folder, 0.0, tell=lambda _: None).begin(again)
    number, array = getattr(OWNERS[owner](again), "added")  # noqa: B009 (the class has no such name)
    assert (number, array.tolist()) == (2, [np.pi, np.pi])


def test_a_checkpoint_without_a_fact_is_refused(folder: RunFolder, monkeypatch: pytest.MonkeyPatch) -> None:
    """As that of a version that had no such field: it is named, and nothing is dropped."""
    killed_after(folder, 5)
    before = {path.name for path in folder.path.iterdir()}
    monkeypatch.setattr(Guards, "FACTS", (*Guards.FACTS, "added"))
    monkeypatch.setattr(Guards, "added", 0, raising=False)
    refused = r"a run of this version of fctd \(its checkpoint has no 'added'\)"
    with pytest.raises(InputError, match=refused):
        simulate(tripping(), checkpointer=RunSaver(folder, 0.0))
    with pytest.raises(InputError, match=refused):
        kept_so_far(folder.path, tripping())
    assert {path.name for path in folder.path.iterdir()} == before
