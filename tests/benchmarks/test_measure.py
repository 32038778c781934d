"""Samples: which disturbances cancel, and the exchange with the processes that measure."""

import inspect
from pathlib import Path

import pytest

from benchmarks import measure, worker
from benchmarks.subjects import ARCS, CYLINDERS, FREE, REFERENCE
from fctd.case.errors import InputError


def test_a_disturbance_of_both_processes_cancels() -> None:
    """All costs doubled by load, or a slower reference kernel of one side, do not change the compared ratios."""
    quiet = measure.in_units([{REFERENCE: 4.0, FREE: 20.0}, {REFERENCE: 6.0, FREE: 22.0}])
    loaded = measure.in_units([{REFERENCE: 8.0, FREE: 40.0}, {REFERENCE: 12.0, FREE: 44.0}])
    assert [each[FREE] for each in quiet] == [each[FREE] for each in loaded]
    assert quiet[1][FREE] / quiet[0][FREE] == pytest.approx(22 / 20)


def test_a_process_is_told_by_its_shorter_rounds_but_not_by_one() -> None:
    rounds = [{"x": cost} for cost in [5.0] + [10.0] * 30 + [30.0] * 17]
    assert measure.shorter(rounds) == {"x": 10.0}


def test_kernels_of_the_gate() -> None:
    costs = {REFERENCE: [1.0, 1.0], FREE: [5.0, 6.0], CYLINDERS: [8.0, 9.0], ARCS: [10.0, 9.0]}
    assert measure.judged(costs) == {
        FREE: [5.0, 6.0], CYLINDERS: [8.0, 9.0], ARCS: [10.0, 9.0],
        "contact's addition, cylinders": [3.0, 3.0], "contact's addition, arcs": [5.0, 3.0],
    }  # fmt: skip
    assert measure.judged({REFERENCE: [1.0], "joint loads": [2.0]}) == {"joint loads": [2.0]}
    assert measure.summed({"a": [1.0, 2.0], "b": [4.0, 8.0], "c": [9.0, 9.0]}, ["a", "b"]) == pytest.approx([2.0, 4.0])


def test_a_call_is_timed_by_the_clock_of_its_thread_from_a_depth_of_the_stack(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, depths = [0.0], []

    def act() -> None:
        clock[0] += 3.0
        depths.append(len(inspect.stack(0)))

    monkeypatch.setattr(worker.time, "thread_time", lambda: clock[0])
    assert [worker.spent(act, depth) for depth in (0, 1, 7)] == [3.0] * 3
    assert len(depths) == 3
    assert depths[1] - depths[0] == (depths[2] - depths[1]) / 6 >= 1


def test_rounds_use_all_depths_alike() -> None:
    used = [worker.STRIDE * k % worker.DEPTHS for k in range(measure.ROUNDS)]
    assert {used.count(depth) for depth in range(worker.DEPTHS)} == {measure.ROUNDS // worker.DEPTHS}


FAKE = """
from types import SimpleNamespace
import pathlib, time

now = [0.0]
time.thread_time = lambda: now[0]

def subjects():
    cost = float(pathlib.Path("cost").read_text())
    def spend(seconds):
        now[0] += seconds
    return {
        "reference": SimpleNamespace(act=lambda: spend(4.0), count=1),
        "x": SimpleNamespace(act=lambda: spend(cost), count=2),
    }
"""


def sources(root: Path, cost: float) -> Path:
    """Sources with a subject of the given cost."""
    package = root / "benchmarks"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    (package / "subjects.py").write_text(FAKE)
    (root / "cost").write_text(str(cost))
    return root


def test_two_commits_take_turns_in_pairs_of_processes(tmp_path: Path) -> None:
    """Each with its own subjects, both measured by the worker of today's sources."""
    earlier, today = sources(tmp_path / "a", 80.0), sources(tmp_path / "b", 120.0)
    before, now = measure.side_by_side(earlier, today, 2)
    assert before == {REFERENCE: [4e9, 4e9], "x": pytest.approx([10.0, 10.0])}
    assert now == {REFERENCE: [4e9, 4e9], "x": pytest.approx([15.0, 15.0])}


def test_sources_whose_subjects_do_not_run_are_named(tmp_path: Path) -> None:
    broken = sources(tmp_path / "broken", 1.0)
    (broken / "benchmarks" / "subjects.py").write_text("raise SystemExit('failed')")
    with pytest.raises(InputError, match="whose subjects run") as caught:
        measure.side_by_side(broken, sources(tmp_path / "whole", 1.0), 1)
    assert caught.value.value == broken
