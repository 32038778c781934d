"""Limits of time and memory: a run that reaches one ends, is kept, and says so."""

import sys

import pytest

from fctd.simulation import limits
from fctd.simulation.limits import LimitReached, Limits, largest_memory
from fctd.simulation.simulate import simulate
from tests.simulation.kept import tripping


def test_the_time_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(limits, "monotonic", lambda: now[0])
    watched = Limits(time=60.0, began=100.0)
    now[0] = 159.0
    watched.check()
    now[0] = 160.0
    with pytest.raises(LimitReached, match="the time limit of 60 s"):
        watched.check()


def test_the_memory_limit() -> None:
    Limits(memory=1e15).check()
    if sys.platform != "win32":
        assert 2e7 < largest_memory() < 1e12  # bytes, not kilobytes
        with pytest.raises(LimitReached, match="MB of memory are in use, the limit is 10 MB"):
            Limits(memory=1e7).check()


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
