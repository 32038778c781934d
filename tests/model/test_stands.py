"""The tally of a string that is tripped stand by stand."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import InputError
from fctd.mechanics import state
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.stands import Tally, hang, lay_out_stands
from fctd.model.string_in_hole import fill
from fctd.model.wellbore import build_wellbore
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [300, 0, 0], [600, 60, 0], [1000, 60, 0]]


def tally_of(components: list[dict[str, Any]], stand: float, deepest: float = 900.0) -> Tally:
    case = make_case(BUILD, components, rig={"stand_length": stand}, mud={"density": 1200.0})
    return lay_out_stands(case, 100.0, deepest)


@st.composite
def components(draw: st.DrawFn) -> list[dict[str, Any]]:
    """Up to three kinds of pipe in any order, of any length, cut in any way; the last may reach the table."""
    parts = []
    for outer in draw(st.permutations([0.127, 0.15, 0.16]))[: draw(st.integers(1, 3))]:
        cut = draw(st.sampled_from(["segments", "segment_length", "default"]))
        length = draw(st.floats(5.0, 400.0))
        parts.append(
            pipe(length, draw(st.integers(1, 30)) if cut == "segments" else None, outer=outer)
            | ({"segment_length": draw(st.floats(2.0, 40.0))} if cut == "segment_length" else {})
        )
    return [*parts, pipe(None, None, segment_length=draw(st.floats(3.0, 40.0)))]


@settings(max_examples=30)
@given(parts=components(), stand=st.floats(9.0, 36.0), deepest=st.floats(150.0, 990.0))
def test_stands_have_whole_segments_and_the_string_all_of_its_metres(
    parts: list[dict[str, Any]], stand: float, deepest: float
) -> None:
    tally = tally_of(parts, stand, deepest)
    whole, ends = tally.whole, np.cumsum([part.get("length", np.inf) for part in parts])
    total = float(whole.length.sum())
    assert deepest - 1e-9 <= total <= deepest + 1.1 * stand
    # Every stand is within a tenth of the wanted length, and the segments of a component are those of its length.
    assert np.abs(np.diff(tally.reach) - stand).max() <= 0.1 * stand + 1e-9
    wanted = np.diff(np.append(0.0, np.minimum(ends, total)))
    np.testing.assert_allclose(np.bincount(whole.component, whole.length, len(parts)), wanted, atol=1e-6)
    # Segments are no shorter than half of what their component asks for, where stand and component are not shorter.
    for k in range(tally.stands):
        string = tally.string(k + 1, 0.5 * (tally.reach[k] + tally.reach[k + 1]))
        assert string.segments == tally.count[k + 1]
        assert float(string.length.sum()) == pytest.approx(tally.reach[k + 1], abs=1e-6)
        assert string.top_md == pytest.approx(-0.5 * tally.length_of(k + 1), abs=1e-6)
        np.testing.assert_array_equal(string.length, whole.length[-string.segments :])


@settings(max_examples=40)
@given(parts=components(), depth=st.floats(1.0, 900.0))
def test_as_many_stands_as_reach_the_depth(parts: list[dict[str, Any]], depth: float) -> None:
    tally = tally_of(parts, 28.5)
    k = tally.stands_for(depth)
    assert tally.reach[k - 1] < depth <= tally.reach[k] + 1e-9


def test_stands_end_where_a_component_ends_nearby() -> None:
    """28.5 m stands: 56 m of collars end 1 m before the second stand, and the string 2 m before its last."""
    tally = tally_of(
        [pipe(56, None, outer=0.16, segment_length=9.5), pipe(82.5, None, segment_length=9.5)], 28.5, 138.5
    )
    np.testing.assert_allclose(tally.reach, [0, 28.5, 56, 84.5, 113, 138.5])
    np.testing.assert_array_equal(tally.count, [0, 3, 6, 9, 12, 15])
    # A part stand, too short to be joined to its neighbour.
    part = tally_of([pipe(100, None, segment_length=9.5)], 28.5, 100.0)
    np.testing.assert_allclose(part.reach, [0, 28.5, 57, 85.5, 100])


def test_a_long_segment_becomes_whole_stands() -> None:
    tally = tally_of([pipe(None, 1)], 28.5, 100.0)
    np.testing.assert_allclose(tally.whole.length, np.full(4, 28.5))


def test_a_string_that_hangs_knows_its_buoyancy() -> None:
    case = make_case(BUILD, [pipe(100, 10)], rig={"feed": "stands"}, mud={"density": 1200.0, "axial_damping": 3.0})
    tally = lay_out_stands(case, 50.0, 100.0)
    n = tally.whole.segments
    S = state.new_state(n)
    fill(S, tally.whole, case, build_wellbore(case))
    hang(S, n)
    buoyancy = state.row(S, state.MASS, n) * GRAVITY * 1200 / 7850  # of steel
    np.testing.assert_allclose(state.row(S, state.BUOYANCY, n), buoyancy)
    np.testing.assert_allclose(state.row(S, state.IN_MUD_AXIAL, n), 3.0 * tally.whole.length)


@pytest.mark.parametrize(
    ("sections", "pattern"),
    [
        ({"rig": {"stand_length": 41.0}}, r"rig\.stand_length.*41 m.*rig\.derrick_height, 40 m"),
        ({"rig": {"stand_length": 0.0}}, r"(?s)rig\.stand_length.*above 0"),
        ({"rig": {"stand_length": "-3 m"}}, r"(?s)rig\.stand_length.*-3 m.*above 0"),
        ({"rig": {"connection_time": 0.0}}, r"(?s)rig\.connection_time.*above 0"),
        ({"rig": {"derrick_height": 20.0}}, r"rig\.stand_length.*28\.5 m.*rig\.derrick_height, 20 m"),
        ({"components": [pipe(20, 4)], "operations": [trip(10, 15)]}, r"rig\.stand_length.*at most the string, 20 m"),
        ({"components": [pipe(300, 30)]}, r"string\.components.*300 m of string.*bit depth of 400 m"),
        ({"top_md": 5.0}, r"string\.top_md.*5 m.*0 m, the rotary table"),
        ({"stations": [[0, 70, 0], [1000, 70, 0]]}, r"wellbore.*70 deg.*within 60 deg of vertical at the rotary table"),
        ({"components": [pipe(100, 10, outer=0.3), pipe(None, 40)]}, r"contact_diameter.*300 mm.*at most the hole's"),
    ],
)
def test_what_cannot_be_tripped_is_refused(sections: dict[str, Any], pattern: str) -> None:
    given: dict[str, Any] = {"operations": [trip(380, 400)], **sections}
    rig = {"feed": "stands"} | given.pop("rig", {})
    with pytest.raises(ValueError, match=pattern):
        prepare(make_case(given.pop("stations", BUILD), given.pop("components", [pipe(None, None)]), rig=rig, **given))


@pytest.mark.parametrize("seed", range(4))
def test_the_steepest_hole_stays_so_with_rounding(seed: int) -> None:
    """60 deg are within 60 deg in whatever unit they are written, and with noise of the size of rounding."""
    steepest: list[list[float]] = [[0, 60, 0], [1000, 60, 0]]
    case = make_case(steepest, [pipe(None, None)], [trip(380, 400)], rig={"feed": "stands"}, solver={"perturbed": seed})
    run, _ = prepare(case)
    assert run.segments > 0


def test_a_string_longer_than_the_buffer_is_refused() -> None:
    case = make_case(BUILD, [pipe(None, None, segment_length=0.05)], [trip(800, 900)], rig={"feed": "stands"})
    with pytest.raises(InputError, match=r"string\.components.*at most 10000 segments"):
        prepare(case)


def test_stands_are_moved_where_the_long_segment_does_not_fit() -> None:
    """In the vertical part pipe is fed into the long segment, below it stands are moved; a rotation moves nothing."""
    string = [pipe(None, None, segment_length=10.0)]
    for moves, hung in (([trip(200, 280)], False), ([trip(500, 900)], True), ([rotation(700, 5.0)], False)):
        run, _ = prepare(make_case(BUILD, string, moves))
        assert run.upper_end.in_derrick == hung
    with pytest.raises(InputError, match=r"within 1 deg of vertical"):
        prepare(make_case(BUILD, [pipe(100, 10), pipe(None, 1)], [trip(500, 900)]))


@pytest.mark.parametrize("segments", [1, 4])
@pytest.mark.parametrize("below", [26.0, 27.5, 28.0, 28.4])
def test_no_stand_ends_within_a_component_that_touches_at_a_point(below: float, segments: int) -> None:
    """Its place of contact would move when the stand above it is racked back."""
    parts = [pipe(below, 3), pipe(1.5, segments, outer=0.2), pipe(None, 40)]
    tally = lay_out_stands(make_case(components=parts), 700.0, 900.0)
    assert not ((tally.reach > below + 1e-6) & (tally.reach < below + 1.5 - 1e-6)).any()


def test_a_point_longer_than_a_stand_is_refused() -> None:
    parts = [pipe(20.0, 2), pipe(60.0, 6, contact="point"), pipe(None, 40)]
    with pytest.raises(InputError, match="derrick_height"):
        lay_out_stands(make_case(components=parts), 700.0, 900.0)
