"""The schedule of a rig that moves stands."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import InputError
from fctd.model.operations import Phase
from fctd.model.stands import lay_out_stands
from fctd.model.strokes import GENTLY, PICK_UP, ExpectedDrilling, Stroke, stand_schedule
from tests.cases import make_case, pipe, rotation, trip

STRING = [pipe(100, None, outer=0.16, segment_length=9.0), pipe(None, None, segment_length=9.5)]


def planned(moves: list[dict[str, Any]], stand: float = 28.5) -> tuple[Any, list[Phase], list[Stroke]]:
    case = make_case(components=STRING, operations=moves, rig={"stand_length": stand, "connection_time": 40.0})
    depths = [d for o in case.operations for d in (o.start_md, o.end_md)]
    tally = lay_out_stands(case, min(depths), max(depths))
    return tally, *stand_schedule(case.operations, tally, case.rig)


def fed(phases: list[Phase]) -> float:
    return sum(0.5 * (m.feed_from + m.feed_to) * m.duration for m, _ in phases)


def test_a_trip_of_two_and_a_half_stands() -> None:
    """40 to 100 m with stands of 28.5 m: 17 m, a stand, and 14.5 m of the next; the last stroke ends in motion."""
    _, phases, strokes = planned([trip(40.0, 100.0, speed=0.5)])
    assert [s.travel for s in strokes] == pytest.approx([17.0, 0, 28.5, 0, 14.5])
    assert [s.change for s in strokes] == [0, 0, 1, 0, 1]
    assert [s.target for s in strokes] == pytest.approx([0, 0, 0, 0, 14.0])
    # A stroke of s metres that ramps up and down in 5 s takes s/0.5 + 5 s, one that ends in motion 2.5 s less.
    lasts = np.diff([s.start for s in strokes] + [phases[-1].motion.start + phases[-1].motion.duration])
    np.testing.assert_allclose(lasts, [17 / 0.5 + 5, 40, 28.5 / 0.5 + 5, 40, 14.5 / 0.5 + 2.5])
    assert phases[-1].motion.feed_to == 0.5


def test_a_trip_out_racks_a_stand_before_the_connection() -> None:
    _, _, strokes = planned([trip(100.0, 40.0, speed=0.5)])
    assert [s.travel for s in strokes] == pytest.approx([-14.5, 0, -28.5, 0, -17.0])
    assert [s.change for s in strokes] == [0, -1, 0, -1, 0]
    assert [s.target for s in strokes] == pytest.approx([28.5, 0, 28.5, 0, 17.0])


def test_the_string_does_not_turn_in_the_slips() -> None:
    moves = [
        {"kind": "trip_in", "from_md": 40.0, "to_md": 57.0, "speed": 0.5, "rpm": 60.0, "ramp_time": 5.0},
        rotation(57.0, 20.0, rpm=30.0),
        {"kind": "trip_in", "from_md": 57.0, "to_md": 90.0, "speed": 0.5, "rpm": 60.0, "ramp_time": 5.0},
    ]
    _, phases, strokes = planned(moves)
    for stroke in strokes:
        if stroke.in_slips:
            (motion,) = [m for m, _ in phases if m.start == pytest.approx(stroke.start)]
            assert motion[2:6] == (0.0, 0.0, 0.0, 0.0)
    for (before, _), (after, _) in pairwise(phases):
        assert before.start + before.duration == pytest.approx(after.start)
        assert before.spin_to == after.spin_from
        assert before.feed_to == after.feed_from
    assert phases[-1].motion.spin_to == pytest.approx(2 * np.pi)


@settings(max_examples=30)
@given(depths=st.lists(st.floats(5.0, 900.0), min_size=2, max_size=4), stand=st.floats(9.0, 36.0))
def test_a_schedule_leads_to_its_depths_and_balances_its_stands(depths: list[float], stand: float) -> None:
    moves = [trip(a, b) if abs(a - b) > 1e-2 else rotation(a, 5.0) for a, b in pairwise(depths)]
    moves = [move | ({"at_md": depths[k]} if "at_md" in move else {}) for k, move in enumerate(moves)]
    for k, move in enumerate(moves[1:], start=1):
        end = moves[k - 1].get("to_md", moves[k - 1].get("at_md"))
        move["from_md" if "from_md" in move else "at_md"] = end
    tally, phases, strokes = planned(moves, stand)
    end = moves[-1].get("to_md", moves[-1].get("at_md"))
    assert fed(phases) == pytest.approx(end - depths[0], abs=1e-6)
    stands, depth = tally.stands_for(depths[0]), depths[0]
    for stroke in strokes:
        stands += stroke.change
        depth += stroke.travel
        height = tally.reach[stands] - depth
        assert -1e-6 <= height <= tally.length_of(stands) + 1e-6
        if stroke.travel:
            assert stroke.target == pytest.approx(height, abs=1e-6)
    assert stands in {tally.stands_for(end), tally.stands_for(end) + 1}


def test_an_operation_that_ends_before_its_first_step_is_refused() -> None:
    with pytest.raises(InputError, match=r"operations\[0\].*at least 1 ms"):
        planned([rotation(40.0, 1e-4)])


def test_an_autodriller_lifts_the_bit_before_a_connection_and_tares_after_it() -> None:
    """40 to 70 m over the connection at 57 m, at 0.02 m/s; then a trip out, for which the weight comes off the bit."""
    moves = [
        {"kind": "drill_rotating", "from_md": 40.0, "to_md": 70.0, "speed": 0.01, "rpm": 60.0, "ramp_time": 5.0},
        trip(70.0, 60.0, speed=0.5),
    ]
    case = make_case(components=STRING, operations=moves, rig={"stand_length": 28.5, "connection_time": 40.0})
    tally = lay_out_stands(case, 40.0, 70.0)
    phases, strokes = stand_schedule(case.operations, tally, case.rig, ExpectedDrilling([0.02, 0.0], 12.0))
    drilled = [motion for motion, k in phases if k == 0]
    assert [(s.change, s.by_weight) for s in strokes] == [
        (0, True), (0, False), (1, True), (0, False),
    ]  # fmt: skip
    assert [s.travel for s in strokes] == pytest.approx([17.0, 0.0, 13.0 + PICK_UP, -10.0])
    moved = PICK_UP / GENTLY - 1.0
    assert [m.duration for m in drilled] == pytest.approx(
        [5, 17 / 0.02, 5, 1, moved, 1, 5, 40, 5, 12, 1, moved, 1, 5, 13 / 0.02, 5]
    )
    assert [m.bit_to for m in drilled] == [1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0]
    assert [m.driller.taring for m in drilled].index(True) == 9
    assert sum(m.driller.taring for m in drilled) == 1
    assert fed(phases[: len(drilled)]) == pytest.approx(0.0)  # up and down off bottom; the rest follows the weight
    np.testing.assert_allclose([m.spin_to for m in drilled[:6]], 2 * np.pi)
    assert drilled[7].spin_from == drilled[7].spin_to == 0.0
