"""Uniform and graded layouts: the same string, with short segments in bends and near the bit."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import Case
from fctd.case.errors import InputError
from fctd.case.string import ComponentSpec
from fctd.model.drillstring import lay_out
from fctd.model.layouts import (
    LAYOUTS,
    LONGEST,
    _grade,
    _least,
    _walk,
    _wave,
    by_default,
    coarseness,
    graded,
    resolved,
    segments_in_hole,
    uniform,
    with_components,
)
from tests.cases import make_case, pipe

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [2000, 60, 0]]


def build_case(components: list[dict[str, Any]] | None = None) -> Case:
    return make_case(BUILD, components or [pipe(None, None, segment_length=10.0)])


@st.composite
def strings(draw: st.DrawFn) -> list[dict[str, Any]]:
    """One to four components; the last reaches the surface, sometimes as one long segment, or longer than needed."""
    parts = [
        pipe(draw(st.floats(2.0, 300.0)), draw(st.integers(1, 9)), outer=0.15) for _ in range(draw(st.integers(0, 3)))
    ]
    last = draw(st.sampled_from([{"segment_length": 12.0}, {"segments": 1}, {"length": 3000.0, "segments": 40}]))
    return [*parts, pipe(None, None) | last]


@given(components=strings(), bit=st.floats(950.0, 2000.0), length=st.floats(2.0, 120.0))
@settings(max_examples=40)
def test_a_layout_is_the_same_string(components: list[dict[str, Any]], bit: float, length: float) -> None:
    case = build_case(components)
    whole = lay_out(case, bit)
    for layout in (uniform, graded):
        cut = with_components(case, layout(case, bit, length))
        Case.model_validate(cut.model_dump())
        string = lay_out(cut, bit)
        assert string.bit_depth == pytest.approx(bit, abs=1e-6)
        assert string.weight @ string.length == pytest.approx(whole.weight @ whole.length, rel=1e-6)
        assert string.long_segment == whole.long_segment
        given_lengths = [part.length for part in cut.string.components]
        if None not in given_lengths:
            total = sum(part.length or 0.0 for part in case.string.components)
            assert sum(part or 0.0 for part in given_lengths) == pytest.approx(total, abs=1e-6)
        assert segments_in_hole(cut, bit) == pytest.approx(string.segments, abs=len(given_lengths))
        most = LONGEST if layout is graded else 1.0
        cuts = string.length[1:] if string.long_segment else string.length
        assert cuts.max(initial=0.0) <= 1.5 * most * length + 1e-6


@given(components=strings(), length=st.floats(2.0, 120.0))
@settings(max_examples=40)
def test_no_piece_of_pipe_passes_for_a_stabiliser(components: list[dict[str, Any]], length: float) -> None:
    """Only a component of one segment touches at its middle, never a piece of a divided one."""
    case = build_case(components)
    string = lay_out(with_components(case, graded(case, 2000.0, length)), 2000.0)
    whole = {part.get("length") for part in components}
    for k in np.flatnonzero(string.mid_contact()):
        assert any(size is not None and size == pytest.approx(string.length[k]) for size in whole)


def test_segments_are_short_in_bends_and_near_the_bit() -> None:
    case = build_case()
    string = lay_out(with_components(case, graded(case, 2000.0, 5.0)), 2000.0)
    bottom = np.cumsum(string.length)
    middle = bottom - 0.5 * string.length
    short = string.length < 5.5
    assert short[(middle > 605) & (middle < 895)].all()
    assert short[-1]
    assert string.length[middle < 400].min() > 0.9 * LONGEST * 5.0
    assert string.length[(middle > 1200) & (middle < 1700)].min() > 0.9 * LONGEST * 5.0
    # Neighbours have similar lengths, except the remainder at the top.
    ratio = string.length[2:] / string.length[1:-1]
    assert (ratio < 4.1).all()
    assert (ratio > 1 / 4.1).all()


def test_length_goes_with_the_root_of_curvature() -> None:
    """A chord h misses a bend by κh²/8: a bend half as sharp allows √2 times the length; a straight hole the most."""
    stations = [[0, 0, 0], [600, 0, 0], [700, 20, 0], [900, 60, 0], [1500, 60, 0], [1800, 90, 0], [2600, 90, 0]]
    above_bit, factor = coarseness(make_case(stations, [pipe(None, None, segment_length=10.0)]), 2600.0)
    sharp, mild, straight = (float(np.interp(2600.0 - md, above_bit, factor)) for md in (750.0, 1650.0, 300.0))
    assert sharp == pytest.approx(1.0)
    assert mild == pytest.approx(math.sqrt(2.0))
    assert straight == pytest.approx(LONGEST)
    assert factor[0] == 1.0


def test_a_gentle_bend_counts_against_half_a_degree_in_thirty_metres() -> None:
    """A hole without a sharper bend: 0.1° in 30 m allows √5 times the length of 0.5°, far from the bit."""
    stations = [[0, 0, 0], [900, 3, 0], [3000, 3, 0]]
    above_bit, factor = coarseness(make_case(stations, [pipe(None, None, segment_length=10.0)]), 3000.0)
    assert np.interp(2700.0, above_bit, factor) == pytest.approx(math.sqrt(5.0))


def test_factor_grows_with_the_distance_in_waves() -> None:
    """Above the end of a bend: one more for every 2π (EI r/w)^¼."""
    above_bit, factor = coarseness(build_case(), 2000.0)
    area = math.pi / 4 * (0.127**2 - 0.07**2)
    EI = 206.8e9 * math.pi / 64 * (0.127**4 - 0.07**4)
    wave = 2 * math.pi * (EI * 0.5 * (0.2159 - 0.127) / (area * 7850 * 9.80665)) ** 0.25
    assert float(np.interp(2000.0 - (600.0 - 3 * wave), above_bit, factor)) == pytest.approx(4.0, abs=0.05)


def test_factor_grows_from_the_bit_in_the_waves_of_each_pipe() -> None:
    """In straight hole: one more at the bit for each wave of the collars, then for each of the pipe."""
    case = make_case(components=[pipe(100, 10, outer=0.159), pipe(None, None, segment_length=10.0)], top_md=50.0)
    above_bit, factor = coarseness(case, 800.0)
    collars, above = (float(_wave(case, 800.0 - at, at)[0]) for at in (np.array([0.0]), np.array([200.0])))
    assert (above_bit[0], above_bit[-1]) == (0.0, 750.0)
    near = above_bit < 100.0 - (above_bit[1] - above_bit[0])
    np.testing.assert_allclose(factor[near], 1.0 + above_bit[near] / collars, rtol=1e-12)
    expected = 1.0 + 100.0 / collars + 50.0 / above
    assert np.interp(150.0, above_bit, factor) == pytest.approx(expected, abs=0.01)


def test_every_component_is_graded_where_it_lies() -> None:
    case = make_case(
        BUILD, [pipe(200, 20, outer=0.159), pipe(300, 30), pipe(None, None, segment_length=10.0)], top_md=100.0
    )
    collars, below, above = case.string.components
    factor = coarseness(case, 2000.0)
    assert graded(case, 2000.0, 5.0) == (
        *_grade(collars, _walk(0.0, 200.0, 5.0, *factor)),
        *_grade(below, _walk(200.0, 500.0, 5.0, *factor)),
        *_grade(above, _walk(500.0, 1900.0, 5.0, *factor)),
    )
    # Half a metre of the third one is in the hole.
    assert graded(case, 600.5, 5.0)[-1].segment_length == 0.5
    # What is not in the hole stays as it is.
    assert graded(case, 600.0, 5.0)[-1] == above
    assert graded(case, 300.0, 5.0)[-2:] == (below, above)


def test_a_component_that_rounding_alone_leaves_in_the_hole_stays_as_it_is() -> None:
    """100.1 m and 200.2 m are 60 femtometres less than 300.3 m."""
    case = make_case(components=[pipe(100.1, 10), pipe(200.2, 20), pipe(None, None, segment_length=10.0)])
    cut = with_components(case, graded(case, 300.3, 5.0))
    assert cut.string.components[-1] == case.string.components[-1]
    assert lay_out(cut, 300.3).length.sum() == pytest.approx(300.3)


def test_a_string_that_is_too_short_is_graded_and_then_refused() -> None:
    case = make_case(components=[pipe(200, 20), pipe(300, 30)])
    cut = with_components(case, graded(case, 900.0, 5.0))
    assert sum(part.length or 0.0 for part in cut.string.components) == pytest.approx(500.0)
    with pytest.raises(InputError, match="enough to reach from the bit at 900 m"):
        lay_out(cut, 900.0)


def test_a_bent_housing_stays_at_its_upper_end() -> None:
    housing = pipe(200.0, 4, bend="1.5 deg", toolface="30 deg")
    pieces = graded(build_case([housing, pipe(None, None, segment_length=10.0)]), 2000.0, 5.0)
    bends = [part.bend for part in pieces]
    assert np.count_nonzero(bends) == 1
    at = int(np.argmax(bends))
    assert sum(part.length or 0.0 for part in pieces[: at + 1]) == pytest.approx(200.0)
    assert pieces[at].toolface == pytest.approx(math.radians(30))


def test_layouts_have_the_names_that_commands_take() -> None:
    assert (LAYOUTS["uniform"], LAYOUTS["graded"]) == (uniform, graded)


def test_a_long_segment_stays_one() -> None:
    case = build_case([pipe(1450.0, 50), pipe(None, 1)])
    for layout in (uniform, graded):
        assert layout(case, 2000.0, 20.0)[-1] == case.string.components[-1]


def test_a_short_sharp_course_makes_no_stabiliser() -> None:
    """Two short segments in place of one, which would touch at its middle."""
    stations = [[0, 0, 0], [600, 0, 0], [610, 6, 0], [1400, 6, 0]]
    case = make_case(stations, [pipe(None, None, segment_length=10.0)])
    for length in range(20, 120):
        string = lay_out(with_components(case, graded(case, 1400.0, float(length))), 1400.0)
        assert not string.mid_contact().any()


ABOVE = np.linspace(0.0, 1000.0, 4001)


@pytest.mark.parametrize(
    ("end", "beyond", "runs"),
    [
        # Equal segments; what is left over at the top is one of them from half a segment on, else joins the last.
        (105.0, 1.0, [(105.0, 11)]),
        (104.9, 1.0, [(104.9, 10)]),
        (3.0, 1.0, [(3.0, 1)]),
        (14.0, 1.0, [(14.0, 1)]),
        (15.0, 1.0, [(15.0, 2)]),
        # Lengths double while the factor allows them all along the segment.
        (500.0, 8.0, [(100.0, 10), (400.0, 5)]),
        (500.0, 80.0, [(100.0, 10), (400.0, 5)]),
        (480.0, 8.0, [(100.0, 10), (380.0, 5)]),
        (455.0, 8.0, [(100.0, 10), (355.0, 4)]),
        (130.0, 8.0, [(100.0, 10), (30.0, 1)]),
        (115.0, 8.0, [(100.0, 10), (15.0, 1)]),
        (114.9, 8.0, [(114.9, 11)]),
        (120.0, 8.0, [(100.0, 10), (20.0, 1)]),
        (500.0, 4.0, [(100.0, 10), (400.0, 10)]),
        (500.0, 3.9, [(100.0, 10), (400.0, 20)]),
        (500.0, 1.99, [(500.0, 50)]),
        (500.0, 1.999, [(500.0, 50)]),
        (500.0, 2.0, [(100.0, 10), (400.0, 20)]),
    ],
)
def test_runs_of_equal_segments_by_hand(end: float, beyond: float, runs: list[tuple[float, int]]) -> None:
    """Segments of 10 m below 100 m above the bit, ``beyond`` times as long above it."""
    assert _walk(0.0, end, 10.0, ABOVE, np.where(ABOVE < 100.0, 1.0, beyond)) == runs


def test_a_walk_begins_where_the_component_does() -> None:
    factor = np.where(ABOVE < 100.0, 1.0, 2.0)
    assert _walk(80.0, 160.0, 10.0, ABOVE, factor) == [(20.0, 2), (60.0, 3)]
    assert _walk(995.0, 1030.0, 10.0, ABOVE, factor) == [(35.0, 2)]
    # A stretch of 10 m holds no segment of 20 m.
    assert _walk(0.0, 200.0, 10.0, ABOVE, np.where(np.abs(ABOVE - 105.0) <= 5.0, 8.0, 1.0)) == [(200.0, 20)]
    # One of 20 m holds one, next to shorter ones.
    stretch = np.where(np.abs(ABOVE - 110.0) <= 10.0, 8.0, 1.0)
    assert _walk(0.0, 200.0, 10.0, ABOVE, stretch) == [(100.0, 10), (20.0, 1), (80.0, 8)]


def test_runs_are_rounded_to_millimetres() -> None:
    assert _walk(0.0, 33.33333, 10.0, ABOVE, np.ones_like(ABOVE)) == [(33.333, 3)]
    # Ten tenths are a little less than one.
    assert _walk(0.0, 1.0, 0.1, ABOVE, np.ones_like(ABOVE)) == [(1.0, 10)]


@pytest.mark.parametrize(
    ("start", "end", "step", "expected"),
    [(0.5, 2.5, -1, 2.0), (1.0, 2.0, -1, 3.0), (1.0, 2.0, 1, 2.0), (9.0, 10.0, -1, 1.0), (9.0, 10.0, 1, 5.0)],
)
def test_the_least_factor_counts_both_ends(start: float, end: float, step: int, expected: float) -> None:
    factor = np.array([1.0, 2.0, 3.0, 4.0, 5.0])[::step].copy()
    assert _least(start, end, np.arange(5.0), factor) == expected


def test_waves_are_those_of_each_pipe_in_its_hole() -> None:
    """2π (EI r/w)^¼ by hand: collars at the bit, pipe above them, in open hole and in casing."""
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.1},
        {"to_md": 900, "diameter": 0.2159, "friction": 0.2},
    ]
    case = make_case(
        BUILD, [pipe(200, 20, outer=0.159), pipe(None, None, segment_length=10.0)], wellbore={"intervals": intervals}
    )
    above_bit = np.array([0.0, 199.0, 201.0, 750.0])
    found = _wave(case, 1000.0 - above_bit, above_bit)

    def wave(outer: float, hole: float) -> float:
        area, second = math.pi / 4 * (outer**2 - 0.07**2), math.pi / 64 * (outer**4 - 0.07**4)
        return 2 * math.pi * (206.8e9 * second * 0.5 * (hole - outer) / (area * 7850 * 9.80665)) ** 0.25

    expected = [wave(0.159, 0.2159), wave(0.159, 0.2159), wave(0.127, 0.2159), wave(0.127, 0.32)]
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    # A pipe without clearance has the wave of a clearance of 1 mm.
    tight = make_case(BUILD, [pipe(None, None, segment_length=10.0, contact_diameter=0.2159)])
    ratio = _wave(tight, np.array([500.0]), np.array([0.0]))[0] / wave(0.127, 0.2159)
    assert ratio == pytest.approx((1e-3 / (0.5 * (0.2159 - 0.127))) ** 0.25)


@pytest.mark.parametrize(("bit", "count"), [(1000.0, 10 + 1 + 36), (50.0, 5), (102.0, 10 + 1), (103.0, 10 + 1 + 1)])
def test_how_many_segments_by_hand(bit: float, count: int) -> None:
    """100 m in tens, a stabiliser, and pipe of 25 m; a component in the hole has at least one segment."""
    components = [pipe(100, 10), pipe(2, 1, outer=0.2), pipe(None, None, segment_length=25.0)]
    assert segments_in_hole(make_case(components=components), bit) == count
    assert segments_in_hole(make_case(components=components, top_md=20.0), bit + 20.0) == count
    assert segments_in_hole(make_case(components=[pipe(None, 8)]), bit) == 8


def test_resolved_joints_stay_or_become_finer() -> None:
    """Uniform and graded layouts leave them alone; a buckled stretch cuts all bodies alike; the default has none."""
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165}
    part = pipe(None, None, joint=joint, joint_segments=4)
    case = make_case(BUILD, [pipe(100, 10, outer=0.159), part])
    jointed = case.string.components[1]
    assert uniform(case, 900.0, 23.0)[-1] == graded(case, 900.0, 23.0)[-1] == jointed
    (plain,) = by_default(case)[1:]
    assert (plain.joint_segments, plain.cut_by_default, plain.joint) == (None, True, jointed.joint)
    assert segments_in_hole(case, 900.0) == lay_out(case, 900.0).segments == 10 + 80 * 5
    md = np.linspace(0.0, 900.0, 100)
    assert resolved(case, 900.0, md, np.full(100, 20.0))[-1] == jointed
    finer = resolved(case, 900.0, md, np.where(md < 500, 1.0, 20.0))
    string = lay_out(with_components(case, finer), 900.0)
    assert string.length[string.origin == 1].max() <= 1.0
    assert finer[-1].joint_segments == 13


def test_a_component_is_cut_by_hand() -> None:
    components = [pipe(100, 10), pipe(90, None, segment_length=9.0), pipe(8, 3), pipe(None, 8)]
    parts = uniform(make_case(components=components), 1000.0, 23.0)
    assert [(part.length, part.segments, part.segment_length) for part in parts] == [
        (100.0, 4, None), (90.0, 4, None), (8.0, 1, None), (None, None, 23.0),
    ]  # fmt: skip


def test_a_component_is_graded_by_hand() -> None:
    """The piece at the top has the rest of the component's length, or none where the component has none."""
    bent = {"bend": 0.02, "toolface": 0.3}
    case = make_case(components=[pipe(100, 10, **bent), pipe(None, None, segment_length=25.0)])
    whole, endless = case.string.components

    def graded_as(part: ComponentSpec, runs: list[tuple[float, int]]) -> list[tuple[object, ...]]:
        return [(p.length, p.segments, p.segment_length, p.bend, p.toolface) for p in _grade(part, runs)]

    assert graded_as(whole, [(100.0, 4)]) == [(100.0, 4, None, 0.02, 0.3)]
    assert graded_as(whole, [(100.0, 1)]) == [(100.0, 1, None, 0.02, 0.3)]
    for run, piece in (
        ((60.0, 3), (60.0, 3, None, 0.02, 0.3)),
        # More of it than is in the hole: cut as below, by length.
        ((30.0, 1), (60.0, None, 30.0, 0.02, 0.3)),
        ((59.995, 3), (60.0, 3, None, 0.02, 0.3)),
        ((59.988, 3), (60.0, None, 19.996, 0.02, 0.3)),
        ((30.0, 7), (60.0, None, 4.285714, 0.02, 0.3)),
    ):
        assert graded_as(whole, [(40.0, 4), run]) == [(40.0, 4, None, 0.0, 0.3), piece]
    assert graded_as(endless, [(40.0, 4), (30.0, 2)]) == [(40.0, 4, None, 0.0, 0.0), (None, None, 15.0, 0.0, 0.0)]
