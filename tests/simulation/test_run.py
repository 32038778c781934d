"""The strings at a run's start and end have the length, weight and components of the steady solver's."""

import sys
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from fctd import Case, equilibrium, simulate
from fctd.mechanics import state, topdrive
from fctd.model.drillstring import SHORTEST_LONG_SEGMENT, String, lay_out
from fctd.model.layouts import graded, uniform, with_components
from fctd.model.operations import Phase, depth_range, schedule
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [1400, 60, 0]]
MUD = {"density": 1200.0}
# Weight per metre in mud of a pipe of tests.cases by its outer diameter, by hand [N/m].
WEIGHT = {
    outer: 9.80665 * (7850 - 1200) * np.pi / 4 * (outer**2 - 0.07**2) for outer in (0.127, 0.15, 0.16)
}  # fmt: skip
SEGMENT = st.floats(1.0, 30.0)


def cut(draw: st.DrawFn, length: float | None, outer: float) -> dict[str, Any]:
    """A component in a number of segments, or in segments of a length."""
    if draw(st.booleans()):
        return pipe(length, None, outer=outer, segment_length=draw(SEGMENT))
    return pipe(length, draw(st.integers(2, 40 if length is None else max(int(length), 2))), outer=outer)


@st.composite
def strings(draw: st.DrawFn) -> list[dict[str, Any]]:
    """Up to two components of collars, and pipe: to surface, more of it than there is hole, or one long segment."""
    collars = [cut(draw, draw(st.floats(2.0, 80.0)), outer) for outer in (0.16, 0.15)[: draw(st.integers(0, 2))]]
    last = draw(st.sampled_from(["to surface", "excess", "long segment"]))
    if last == "long segment":
        return [*collars, pipe(None, 1)]
    return [
        *collars,
        cut(draw, None, 0.127) if last == "to surface" else pipe(3000, None, segment_length=draw(SEGMENT)),
    ]


@st.composite
def operations(draw: st.DrawFn) -> list[dict[str, Any]]:
    """One to three operations, each from where the one before ended."""
    depths = draw(st.lists(st.floats(200.0, 590.0), min_size=2, max_size=4))
    return [trip(a, b) if abs(a - b) > 1e-3 else rotation(a, 5.0) for a, b in pairwise(depths)]


def metres(string: String) -> np.ndarray:
    """How much of each component is in the hole (k,) [m]."""
    return np.bincount(string.component, string.length)


def weight_of(case: Case, string: String) -> float:
    """Buoyed weight [N] of the components in a vertical hole, by hand."""
    parts = case.string.components
    return sum(WEIGHT[parts[k].outer_diameter] * length for k, length in enumerate(metres(string)))


@pytest.mark.slow
@settings(max_examples=40)
@given(components=strings(), moves=operations(), top_md=st.sampled_from([0.0, 37.0]))
def test_a_run_starts_and_ends_with_the_string_of_the_steady_solver(
    components: list[dict[str, Any]], moves: list[dict[str, Any]], top_md: float
) -> None:
    case = make_case(components=components, operations=moves, top_md=top_md, mud=MUD)
    first, shallowest, deepest = depth_range(case)
    end = case.operations[-1].end_md
    whole = lay_out(case, shallowest)
    assume(metres(whole)[-1] >= SHORTEST_LONG_SEGMENT)  # or it is refused: too short to be fed from
    run, phases = prepare(case)
    string, S, n = run.string, run.S, run.segments
    fed = sum(0.5 * (m.feed_from + m.feed_to) * m.duration for m, _ in phases)
    for depth, laid in ((first, string), (end, string.lengthened(end - first)), (first + fed, string.lengthened(fed))):
        assert laid.bit_depth == pytest.approx(depth, abs=1e-6)
        assert top_md + laid.length.sum() == pytest.approx(depth, abs=1e-6)
        np.testing.assert_allclose(metres(laid), metres(lay_out(case, depth)), atol=1e-6)
    # Below the top segment, which alone grows, all is as at the shallowest depth.
    np.testing.assert_array_equal(string.length[1:], whole.length[whole.segments - n + 1 :])
    np.testing.assert_array_equal(string.component[1:], whole.component[whole.segments - n + 1 :])
    # What hangs is what the bodies weigh, and the half of a long segment that the top drive carries itself.
    held = 0.5 * run.pipe.weight * run.top[topdrive.TOP_LENGTH]
    assert state.row(S, state.WEIGHT, n).sum() + held == pytest.approx(weight_of(case, string), rel=1e-9)
    assert string.long_segment == (deepest > shallowest or is_long(components))
    assert run.top[topdrive.TOP_LENGTH] == (string.length[0] if string.long_segment else 0.0)


def is_long(components: list[dict[str, Any]]) -> bool:
    """Whether the string ends in the paper's long segment."""
    return "length" not in components[-1] and components[-1].get("segments") == 1


@settings(max_examples=30)
@given(components=strings(), depth=st.floats(200.0, 1000.0), kind=st.sampled_from(["trip_in", "rotate_off_bottom"]))
def test_the_steady_hook_load_in_vertical_hole_is_the_buoyed_weight(
    components: list[dict[str, Any]], depth: float, kind: str
) -> None:
    case = make_case(components=components, mud=MUD, contact={"enabled": False})
    point = equilibrium(case, kind, depth)
    assert point.status == "converged"
    assert point.hookload == pytest.approx(weight_of(case, lay_out(case, depth)), rel=1e-6)


@pytest.mark.parametrize(
    ("components", "moves"),
    [
        ([pipe(None, None, segment_length=9.0)], [trip(100, 102, speed=0.05)]),
        (
            [pipe(80, None, outer=0.16, segment_length=7.0), pipe(3000, None, segment_length=13.0)],
            [trip(165, 163, speed=0.05)],
        ),
        (
            [pipe(40, 5, outer=0.15), pipe(None, None, segment_length=3.0)],
            [trip(72, 71, speed=0.05), trip(71, 73, speed=0.05)],
        ),
    ],
    ids=["nine metres", "remainder", "down again"],
)
def test_a_run_carries_the_weight_of_its_own_depth(components: list[dict[str, Any]], moves: list[Any]) -> None:
    """Vertical hole without a wall: at every row the hook carries the pipe below it, and so does the steady solver."""
    case = make_case(components=components, operations=moves, mud=MUD, contact={"enabled": False})
    result = simulate(case)
    assert result.status == "completed", result.message
    last = result.history.iloc[-1]
    end = case.operations[-1]
    assert last["bit_depth_m"] == pytest.approx(end.end_md, abs=1e-6)
    assert last["bit_md_m"] == pytest.approx(end.end_md, abs=0.05)  # stretched
    still = equilibrium(case, end.kind, end.end_md)
    for _, row in result.history.iterrows():
        expected = weight_of(case, lay_out(case, row["bit_depth_m"]))
        # A row's loads are means over its second, in which 50 mm of pipe pass; the ramps speed up by 15 mm/s² at most.
        assert row["hookload_N"] == pytest.approx(expected, rel=3e-3)
    assert last["hookload_N"] == pytest.approx(still.hookload, rel=3e-3)


def test_a_steep_ramp_read_at_odd_times_feeds_its_depth() -> None:
    """Steps of unequal length have an error of h²/24 times the change of a ramp's slope, which is allowed."""
    moves = [trip(400, 410, speed=5.0, ramp=0.3), trip(410, 402, speed=3.0, ramp=0.2)]
    string = [pipe(200, 4), pipe(None, None, segment_length=50.0)]
    sections = {"record": {"interval": 0.13}, "contact": {"enabled": False}}
    result = simulate(make_case(components=string, operations=moves, **sections))
    assert result.status == "completed"
    assert result.history["bit_depth_m"].iloc[-1] == pytest.approx(402.0, abs=1e-4)


def test_a_run_that_feeds_another_depth_than_its_schedule_is_a_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    def prepare_wrongly(case: Case, contact: None) -> tuple[Run, list[Phase]]:
        run, phases = prepare(case, contact)
        return run, [s._replace(motion=s.motion._replace(feed_to=1.0001 * s.motion.feed_to)) for s in phases]

    monkeypatch.setattr(sys.modules["fctd.simulation.simulate"], "prepare", prepare_wrongly)
    case = make_case(components=[pipe(None, 4)], operations=[trip(300, 301)], contact={"enabled": False})
    with pytest.raises(AssertionError, match=r"ends at 301\.0000\d+ m, the schedule at 301\.000000 m"):
        simulate(case)


@given(moves=operations())
def test_a_schedule_feeds_what_its_operations_say(moves: list[dict[str, Any]]) -> None:
    case = make_case(operations=moves)
    phases = schedule(case.operations)
    for k, operation in enumerate(case.operations):
        own = [m for m, index in phases if index == k]
        fed = sum(0.5 * (m.feed_from + m.feed_to) * m.duration for m in own)
        assert fed == pytest.approx(operation.end_md - operation.start_md, abs=1e-6)
    clock = 0.0
    for motion, _ in phases:
        assert motion.start == pytest.approx(clock, abs=1e-9)
        clock += motion.duration


@pytest.mark.slow
@settings(max_examples=25)
@given(components=strings(), bit=st.floats(950.0, 1400.0), length=st.floats(2.0, 60.0))
def test_other_layouts_are_as_long_and_as_heavy(components: list[dict[str, Any]], bit: float, length: float) -> None:
    """Uniform and graded: as lay_out has the string itself, and as a run of it starts."""
    case = make_case(BUILD, components, [rotation(bit, 5.0)], mud=MUD)
    assume(not is_long(components))
    expected = weight_of(case, lay_out(case, bit))
    for layout in (uniform, graded):
        other = with_components(case, layout(case, bit, length))
        run, _ = prepare(other)
        assert run.string.length.sum() == pytest.approx(bit, abs=1e-6)
        assert weight_of(other, run.string) == pytest.approx(expected, rel=1e-8)
        assert weight_of(other, lay_out(other, bit)) == pytest.approx(expected, rel=1e-8)
