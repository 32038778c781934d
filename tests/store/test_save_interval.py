"""When a computation is kept: as often as wanted, within a hundredth of its time by either clock."""

import numpy as np
import pytest

from fctd.store import save_interval
from fctd.store.save_interval import SHARE, SaveInterval


class Machine:
    """A machine whose clocks are moved by hand; a process gets the share ``idle`` of the time on the wall."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.wall = self.own = 0.0
        monkeypatch.setattr(save_interval, "clocks", lambda: np.array([self.wall, self.own]))

    def compute(
        self, interval: SaveInterval, until: float, cost: tuple[float, float], busy: float = 1.0
    ) -> list[float]:
        """Compute in steps of 10 ms of the process's own time, and keep where it is due; the times of that."""
        kept = []
        while self.wall < until:
            self.wall, self.own = self.wall + 0.01 * busy, self.own + 0.01
            if interval.due():
                kept.append(self.wall)
                with interval.saving():
                    self.wall, self.own = self.wall + cost[0], self.own + cost[1]
        return kept


@pytest.fixture
def machine(monkeypatch: pytest.MonkeyPatch) -> Machine:
    return Machine(monkeypatch)


def test_it_is_due_as_often_as_wanted(machine: Machine) -> None:
    kept = machine.compute(SaveInterval(10.0), 101.0, (0.02, 0.01))
    assert kept == pytest.approx([10.0 + 10.02 * k for k in range(10)], abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cost", "busy"),
    [((0.05, 0.05), 1.0), ((0.5, 0.01), 1.0), ((0.03, 0.03), 5.0), ((0.019, 0.019), 1.0)],
    ids=["at leisure", "slow disk", "busy machine", "first ones"],
)
def test_it_takes_a_hundredth_of_either_clock_at_most(machine: Machine, cost: tuple[float, float], busy: float) -> None:
    """Kept as often as allowed.  On a busy machine a write is not interrupted, and the steps between two are."""
    interval = SaveInterval(0.0)
    kept = machine.compute(interval, 400.0, cost, busy)
    assert len(kept) > 5
    assert 0.8 * SHARE < (interval.spent / interval.passed).max() <= SHARE
    assert interval.passed[0] == machine.wall


def test_a_slow_disk_is_made_up_for(machine: Machine) -> None:
    """One time that takes twenty times as long is followed by none until the share is as before."""
    interval = SaveInterval(1.0)
    machine.compute(interval, 10.0, (0.01, 0.001))
    machine.compute(interval, 12.0, (1.0, 0.001))
    before = machine.wall
    later = machine.compute(interval, 400.0, (0.01, 0.001))
    assert later[0] - before > 80
    assert interval.spent[0] <= SHARE * machine.wall


def test_reports_count_and_put_nothing_off(machine: Machine) -> None:
    interval = SaveInterval(1.0)
    machine.compute(interval, 3.5, (0.01, 0.01))
    expected = interval.spent[0]
    with interval.reporting():
        machine.wall += 0.002
    assert interval.spent[0] == pytest.approx(expected + 0.002)
    assert save_interval.FIRST > 0


def test_another_process_counts_on(machine: Machine) -> None:
    """Its share is one of the whole computation; time between the two processes does not count."""
    interval = SaveInterval(0.0)
    machine.compute(interval, 50.0, (0.05, 0.05))
    facts = interval.facts()
    machine.wall, machine.own = machine.wall + 1000.0, 1.0
    again = SaveInterval(0.0)
    again.restore(facts)
    assert again.passed == pytest.approx((50.0, 50.0), abs=0.1)
    machine.compute(again, 1100.0, (0.05, 0.05))
    assert again.spent[0] == pytest.approx(SHARE * again.passed[0], abs=0.1)
