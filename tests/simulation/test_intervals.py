"""Where a run is recorded: the grid of a whole schedule, equal parts of a window."""

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import InputError
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import Phase
from fctd.simulation.intervals import Window, prolonged, whole_schedule, within

PHASES = [Phase(Motion(0.0, 2.5, 0.0, 1.0, 0.0, 0.0), 0), Phase(Motion(2.5, 3.5, 1.0, 1.0, 0.0, 0.0), 1)]


def test_a_schedule_is_recorded_on_the_grid_and_at_the_ends_of_its_phases() -> None:
    parts = whole_schedule(PHASES, 1.0)
    assert [part.end for part in parts] == [1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0]
    assert [part.operation for part in parts] == [0, 0, 0, 1, 1, 1, 1]
    assert parts[3].motion == PHASES[1].motion


@pytest.mark.parametrize(
    ("interval", "ends"), [(2.0, [2.0, 2.5, 4.0, 6.0]), (1.25, [1.25, 2.5, 3.75, 5.0, 6.0]), (10.0, [2.5, 6.0])]
)
def test_no_interval_is_empty_where_a_phase_begins_or_ends_on_the_grid(interval: float, ends: list[float]) -> None:
    assert [part.end for part in whole_schedule(PHASES, interval)] == ends


def test_no_interval_is_empty_where_the_grid_is_rounded() -> None:
    """2.1 s are 7.000000000000001 times 0.3 s."""
    phase = Phase(Motion(0.0, 2.1, 0.0, 1.0, 0.0, 0.0), 0)
    assert [part.end for part in whole_schedule([phase], 0.3)] == pytest.approx([0.3 * k for k in range(1, 8)])


def test_a_window_has_equal_parts_of_every_phase_it_meets() -> None:
    parts = within(PHASES, Window(1.5, 3.0), 0.75)
    assert [part.end for part in parts] == pytest.approx([2.0, 2.5, 2.5 + 2 / 3, 2.5 + 4 / 3, 4.5])
    assert [part.operation for part in parts] == [0, 0, 1, 1, 1]


def test_one_part_a_phase_where_no_length_is_asked_for() -> None:
    assert [part.end for part in within(PHASES, Window(0.0, 6.0), float("inf"))] == [2.5, 6.0]


@given(start=st.floats(0.0, 5.0), duration=st.floats(0.01, 1.0), longest=st.floats(0.05, 3.0))
def test_the_parts_of_a_window_follow_each_other_to_its_end(start: float, duration: float, longest: float) -> None:
    parts = within(PHASES, Window(start, duration), longest)
    ends = [start, *(part.end for part in parts)]
    assert ends[-1] == pytest.approx(start + duration)
    assert all(0 < b - a <= longest * (1 + 1e-6) for a, b in pairwise(ends))


@pytest.mark.parametrize("window", [Window(-1.0, 1.0), Window(0.0, 0.0), Window(5.0, 1.5)])
def test_a_window_that_is_empty_or_outside_is_refused(window: Window) -> None:
    with pytest.raises(InputError, match="window"):
        within(PHASES, window, 1.0)


def test_a_motion_that_lasts_longer_moves_the_rest() -> None:
    intervals = whole_schedule(PHASES, 1.0)
    first, second = (phase.motion for phase in PHASES)
    moved, phases = prolonged(intervals, PHASES, first, 0.7)
    assert [phase.motion for phase in phases] == [first._replace(duration=3.2), second._replace(start=3.2)]
    for before, after in zip(intervals, moved, strict=True):
        assert after.end == pytest.approx(before.end + (0.7 if before.motion is second else 0.0))
        assert after.motion.duration == (3.2 if before.motion is first else 3.5)
    assert prolonged(intervals, PHASES, second, -1.0)[1][0].motion is first
