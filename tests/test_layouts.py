"""Uniform and graded layouts: the same string, cut where it matters."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import Case
from fctd.drillstring import lay_out
from fctd.layouts import LONGEST, coarseness, graded, segments_in_hole, uniform, with_components
from tests.cases import make_case, pipe

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [2000, 60, 0]]


def build_case(components: list[dict[str, Any]] | None = None) -> Case:
    return make_case(BUILD, components or [pipe(None, None, segment_length=10.0)])


@st.composite
def strings(draw: st.DrawFn) -> list[dict[str, Any]]:
    """One to four components, the last to surface, now and then as one long segment or with an excess."""
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
        assert string.of("weight") @ string.length == pytest.approx(whole.of("weight") @ whole.length, rel=1e-6)
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
    """Contact in the middle of a segment belongs to whole components alone."""
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
    # Neighbours are of like length, but for what is left over at the top.
    ratio = string.length[2:] / string.length[1:-1]
    assert (ratio < 4.1).all()
    assert (ratio > 1 / 4.1).all()


def test_length_goes_with_the_root_of_curvature() -> None:
    """A chord h misses a bend by κh²/8: a bend half as sharp allows √2 times the length; a straight hole the most."""
    stations = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [1500, 60, 0], [1800, 90, 0], [2600, 90, 0]]
    case = make_case(stations, [pipe(None, None, segment_length=10.0)])
    above_bit, factor = coarseness(case, 2600.0)
    sharp, mild, straight = (float(np.interp(2600.0 - md, above_bit, factor)) for md in (750.0, 1650.0, 300.0))
    assert sharp == pytest.approx(1.0)
    assert mild == pytest.approx(math.sqrt(2.0))
    assert straight == pytest.approx(LONGEST)
    assert factor[0] == 1.0


def test_factor_grows_with_the_distance_in_waves() -> None:
    """Above the end of a bend: one more for every 2π (EI r/w)^¼."""
    case = build_case()
    above_bit, factor = coarseness(case, 2000.0)
    area = math.pi / 4 * (0.127**2 - 0.07**2)
    EI = 206.8e9 * math.pi / 64 * (0.127**4 - 0.07**4)
    wave = 2 * math.pi * (EI * 0.5 * (0.2159 - 0.127) / (area * 7850 * 9.80665)) ** 0.25
    found = float(np.interp(2000.0 - (600.0 - 3 * wave), above_bit, factor))
    assert found == pytest.approx(4.0, abs=0.05)


def test_a_bent_housing_stays_at_its_upper_end() -> None:
    housing = pipe(200.0, 4, bend="1.5 deg", toolface="30 deg")
    case = build_case([housing, pipe(None, None, segment_length=10.0)])
    pieces = graded(case, 2000.0, 5.0)
    bends = [part.bend for part in pieces]
    assert np.count_nonzero(bends) == 1
    at = int(np.argmax(bends))
    assert sum(part.length or 0.0 for part in pieces[: at + 1]) == pytest.approx(200.0)
    assert pieces[at].toolface == pytest.approx(math.radians(30))


def test_a_long_segment_stays_one() -> None:
    case = build_case([pipe(1450.0, 50), pipe(None, 1)])
    for layout in (uniform, graded):
        pieces = layout(case, 2000.0, 20.0)
        assert pieces[-1] == case.string.components[-1]


def test_a_short_sharp_course_makes_no_stabiliser() -> None:
    """The one short segment that would do there is two, or it would touch at its middle."""
    stations = [[0, 0, 0], [600, 0, 0], [610, 6, 0], [1400, 6, 0]]
    case = make_case(stations, [pipe(None, None, segment_length=10.0)])
    for length in range(20, 120):
        string = lay_out(with_components(case, graded(case, 1400.0, float(length))), 1400.0)
        assert not string.mid_contact().any()
