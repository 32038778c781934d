"""Segment lengths by default: chords within the clearance of bends, short at the bit, long elsewhere."""

from random import Random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import Case
from fctd.case.errors import InputError
from fctd.model.default_layout import (
    AT_BIT,
    AT_MOVING_BIT,
    COURSE,
    GROWTH,
    LEAST_CLEARANCE,
    LONGEST,
    DefaultLayout,
    sagittas,
)
from fctd.model.drillstring import lay_out
from fctd.model.layouts import resolved, segments_in_hole, with_components
from tests.cases import make_case, pipe
from validation.parts.random_wells import well

BUILD = [[0, 0, 0], [600, 0, 0], [900, 60, 0], [2000, 60, 0]]
CURVATURE = np.radians(60) / 300
CLEARANCE = 0.5 * (0.2159 - 0.127)  # of the pipe in the hole of `make_case`
IN_BEND = np.sqrt(8 * CLEARANCE / CURVATURE)  # the chord of this length is a clearance off its arc: 10.1 m


def whole_case(*parts: dict[str, object], stations: list[list[float]] = BUILD) -> Case:
    return make_case(stations, list(parts) or [pipe(None, None)])


def ends(lengths: np.ndarray) -> np.ndarray:
    """Depths of the segments' ends, of a string from the surface."""
    return np.concatenate([[0.0], np.cumsum(lengths)])


def test_a_straight_hole_has_long_segments_but_at_the_bit() -> None:
    """All by one share of the largest lengths, as their number is whole; at the bit these grow as AT_BIT + GROWTH s."""
    string = lay_out(whole_case(stations=[[0, 0, 0], [1000, 0, 0]]), 1000.0)
    share = string.length[0] / LONGEST
    assert 1 - 1 / string.segments < share <= 1
    at_bit = AT_BIT / GROWTH * np.expm1(GROWTH * share)
    assert string.length[-1] == pytest.approx(at_bit, rel=2e-3)  # samples 5 m apart
    assert (np.diff(string.length) <= 1e-9).all()  # shorter towards the bit


def test_a_chord_in_a_bend_is_within_the_clearance() -> None:
    string = lay_out(whole_case(), 2000.0)
    top, bottom = ends(string.length)[:-1], ends(string.length)[1:]
    in_bend = (top > 600 + COURSE) & (bottom < 900 - COURSE)
    sag = CURVATURE * string.length[in_bend] ** 2 / 8
    assert sag.max() <= CLEARANCE * (1 + 1e-9)
    assert sag.min() >= 0.9 * CLEARANCE
    straight = (bottom < 400) | ((top > 1100) & (bottom < 1800))
    assert string.length[straight].min() > 0.9 * LONGEST


def test_neighbours_differ_little() -> None:
    length = lay_out(whole_case(), 2000.0).length
    assert np.abs(np.log(length[1:] / length[:-1])).max() < np.log(1.35)


def test_two_close_stations_are_no_bend() -> None:
    """A tenth of a degree within a tenth of a metre is 30°/30 m between the stations and 0.1°/30 m in the hole."""
    rounded = [[0, 0, 0], [500, 0, 0], [500.1, 0.1, 0], [1000, 0.1, 0]]
    length = lay_out(whole_case(stations=rounded), 1000.0).length
    assert length[:-20].min() > 0.9 * LONGEST


def test_a_tight_tool_does_not_make_segments_of_centimetres() -> None:
    tight = pipe(50.0, None, contact_diameter=0.2158)
    layout = DefaultLayout(whole_case(tight, pipe(None, None)), 800.0, 800.0)
    assert layout.limit.min() == pytest.approx(np.sqrt(8 * LEAST_CLEARANCE / CURVATURE), rel=1e-6)


@given(bit=st.floats(20.0, 2000.0), collars=st.floats(1.0, 300.0), explicit=st.booleans())
@settings(max_examples=40)
def test_a_layout_is_the_whole_string(bit: float, collars: float, explicit: bool) -> None:
    lower = pipe(collars, None, outer=0.17) | ({"segments": 4} if explicit else {})
    case = whole_case(lower, pipe(None, None))
    string = lay_out(case, bit)  # raises AssertionError unless lengths and components agree
    by_default = string.component == 1 if explicit else string.component >= 0
    assert string.length[by_default].max(initial=0.0) <= LONGEST
    assert segments_in_hole(case, bit) == pytest.approx(string.segments, abs=1)
    if explicit and collars < bit:
        assert (string.component == 0).sum() == 4


@pytest.mark.parametrize("travel", [0.0, 3.0, 250.0, 1400.0])
def test_a_moving_string_has_the_lengths_that_every_depth_needs(travel: float) -> None:
    case, first = whole_case(pipe(100.0, None, outer=0.17), pipe(None, None)), 600.0
    above = np.linspace(0.0, first, 301)
    moving = DefaultLayout(case, first, first + travel).at(above)
    for bit in np.linspace(first, first + travel, 15).tolist():
        assert (moving <= DefaultLayout(case, bit, bit).at(above) + 0.5).all()
    # The end of the trip alone would give longer segments than the whole way.
    assert (moving <= DefaultLayout(case, first, first).at(above) + 0.5).all()


def test_a_string_that_moves_keeps_its_longer_segments_at_the_bit() -> None:
    """The time step falls with the shortest segment; away from the bit both strings are cut alike."""
    case = whole_case()
    steady, moving = lay_out(case, 2000.0).length, lay_out(case, 2000.0, 2000.0).length
    assert steady[-1] < 1.2 * AT_BIT
    assert moving.min() > 0.8 * AT_MOVING_BIT
    assert 0 < len(steady) - len(moving) <= 16
    np.testing.assert_allclose(steady[:40], moving[:40], rtol=0.02)


def test_the_pipe_fed_at_the_top_is_not_cut() -> None:
    string = lay_out(whole_case(), 590.0, 700.0)
    assert string.long_segment
    assert string.length[0] >= 10.0


def test_the_papers_long_segment_stays() -> None:
    string = lay_out(whole_case(pipe(1500.0, None), pipe(None, 1)), 2000.0)
    assert string.long_segment
    assert string.length[0] == pytest.approx(500.0)


def test_more_segments_than_can_be_computed_with_are_refused() -> None:
    far = [[0, 0, 0], *[[100.0 * k, 60.0, 180.0 * (k % 2)] for k in range(1, 401)]]  # 120° in every 100 m
    with pytest.raises(InputError, match="at most 10000 segments in all"):
        lay_out(whole_case(pipe(None, None, contact_diameter=0.2158), stations=far), 40_000.0)


def test_a_buckled_stretch_is_cut_finer_and_the_rest_stays() -> None:
    case = whole_case(pipe(200.0, 20), pipe(None, None))
    md = np.linspace(0.0, 2000.0, 401)
    fine = with_components(case, resolved(case, 2000.0, md, np.where((md > 1300) & (md < 1500), 2.0, np.inf)))
    length, before = lay_out(fine, 2000.0).length, lay_out(case, 2000.0).length
    at = ends(length)
    buckled = (at[:-1] > 1300) & (at[1:] < 1500)
    assert length[buckled].max() <= 2.0
    assert length[~buckled].max() <= LONGEST
    assert (length[-20:] == before[-20:]).all()
    assert length[(at[:-1] > 620) & (at[1:] < 880)].max() <= 1.001 * IN_BEND
    all_long = with_components(case, resolved(case, 2000.0, md, np.full(401, np.inf)))
    assert (lay_out(all_long, 2000.0).length == before).all()


def test_the_short_segments_at_the_bit_do_not_keep_others_short() -> None:
    """A component of the whole string, cut finer where it is buckled: at most eight times as long had been 4 m."""
    case, md = whole_case(), np.linspace(0.0, 2000.0, 401)
    fine = with_components(case, resolved(case, 2000.0, md, np.where((md > 1300) & (md < 1500), 2.0, np.inf)))
    length = lay_out(fine, 2000.0).length
    assert length[-1] < 1.2 * AT_BIT
    assert length.max() > 15.0
    assert len(length) < 260


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000))
def test_segments_by_default_hardly_miss_a_bend_by_more_than_the_clearance(seed: int) -> None:
    """Random wells and depths: far below the four clearances from which on there is a note."""
    raw = well(Random(seed))
    for part in raw["string"]["components"]:
        del part["segment_length"]
    case = Case.model_validate(raw)
    least, most = case.depths
    string = lay_out(case, least + Random(seed).uniform(0.2, 1.0) * (most - least))
    middle = string.bit_depth - 0.5 * (string.above_bit[1:] + string.above_bit[:-1])
    missed, clearance = sagittas(case, middle, string.length, string.of("contact_radius"))
    assert (missed / np.maximum(clearance, LEAST_CLEARANCE)).max() < 1.3


def test_a_sagitta_is_that_of_the_mean_curvature_over_the_segment() -> None:
    """Over 30 m where the segment is shorter, and over all of a segment that is longer than its bend."""
    md, length, radius = np.array([750.0, 750.0, 300.0]), np.array([10.0, 600.0, 10.0]), np.full(3, 0.0635)
    missed, clearance = sagittas(whole_case(), md, length, radius)
    expected = [CURVATURE * 100 / 8, np.radians(60) / 600 * 600**2 / 8, 0.0]
    assert missed == pytest.approx(expected)
    assert clearance == pytest.approx(CLEARANCE)
