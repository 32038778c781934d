"""The layout of a string, its contact points and its stiffness."""

import re
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.model import drillstring
from fctd.model.drillstring import SHORTEST_LONG_SEGMENT, lay_out
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe, rotation, trip


def test_components_are_laid_from_the_bit_and_the_top_takes_the_remainder() -> None:
    case = make_case(components=[pipe(100, 10, outer=0.159), pipe(500, 20), pipe(1000, 40)])
    string = lay_out(case, 810.0)
    assert string.bit_depth == pytest.approx(810)
    np.testing.assert_allclose(string.length[-10:], 10)
    np.testing.assert_allclose(string.length[-30:-10], 25)
    assert 12.5 <= string.length[0] < 37.5
    assert list(np.bincount(string.component)) == [10, 20, 8]
    assert not string.long_segment


@pytest.mark.parametrize("depth", [1000.0, 990.0, 976.0, 975.0, 963.0])
def test_remainder_is_between_half_and_one_and_a_half(depth: float) -> None:
    string = lay_out(make_case(components=[pipe(1000, 40)]), depth)
    assert 12.5 - 1e-9 <= string.length[0] < 37.5
    assert string.length.sum() == pytest.approx(depth)


def test_segment_length_instead_of_count() -> None:
    component = pipe(1000, 1)
    del component["segments"]
    assert lay_out(make_case(components=[{**component, "segment_length": 25.0}]), 1000).segments == 40


@pytest.mark.parametrize(("length", "nominal"), [(81.6, 9.6), (25.0, 10.0), (95.0, 10.0)])
def test_halfway_between_two_counts_rounding_does_not_choose(length: float, nominal: float) -> None:
    """8.5 nominal lengths are nine segments, also where a length in feet is one digit shorter or longer."""
    components = [pipe(length, None), pipe(1000, 40)]
    for times in (1 - 1e-15, 1.0, 1 + 1e-15):
        components[0]["segment_length"] = nominal * times
        string = lay_out(make_case(components=components), 500.0)
        assert np.bincount(string.component)[0] == int(length / nominal + 0.5 + 1e-9)


def test_a_mass_beside_the_axis_makes_no_body_of_its_own() -> None:
    """It acts in time alone: stresses beside tool joints are those of one body."""
    beside = pipe(20, 2, outer=0.159) | {"eccentricity": 0.001}
    string = lay_out(make_case(components=[beside, pipe(100, 10, outer=0.159), pipe(1000, 40)]), 500.0)
    assert list(np.unique(string.bodies)) == [0, 2]


def test_unlike_neighbours_are_in_series_and_the_clamp_is_half_a_segment_away() -> None:
    string = lay_out(make_case(components=[pipe(100, 2, outer=0.159), pipe(900, 9)]), 1000.0)
    stiffness = string.joints("EA")
    collar, tube = string.sections[0].EA, string.sections[1].EA
    assert stiffness[0] == pytest.approx(2 * tube / 100)
    assert stiffness[1] == pytest.approx(tube / 100)
    assert stiffness[9] == pytest.approx(1 / (50 / tube + 25 / collar))
    assert stiffness[10] == pytest.approx(collar / 50)


def test_long_segment_puts_its_whole_length_at_the_top() -> None:
    string = lay_out(make_case(components=[pipe(500, 10), pipe(None, 1)]), 1000.0, 1100.0)
    assert string.long_segment
    stiffness = string.joints("GJ")
    assert stiffness[0] == pytest.approx(string.sections[1].GJ / 500)
    assert stiffness[1] == pytest.approx(string.sections[0].GJ / 25)
    np.testing.assert_allclose(stiffness[2:], string.sections[0].GJ / 50)


def test_contact_radius_is_the_larger_at_unlike_neighbours() -> None:
    case = make_case(components=[pipe(50, 2, outer=0.159), pipe(950, 10, contact_diameter=0.168)])
    np.testing.assert_allclose(lay_out(case, 1000.0).contact_radius()[-3:], [0.084, 0.0795, 0.0795])


def test_a_short_component_touches_at_its_middle() -> None:
    stabiliser = pipe(2, 1, outer=0.2)
    case = make_case(components=[pipe(50, 5), stabiliser, pipe(948, 90)], operations=[rotation(1000, 1)])
    run, _ = prepare(case)
    k = run.segments - 6
    assert run.string.length[k] == 2
    assert run.string.mid_contact()[k]
    assert run.string.mid_contact().sum() == 1
    radius = run.string.contact_radius()
    assert radius[k] == 0.1
    assert radius[k - 1] == pytest.approx(0.0635)  # the joints beside it are the pipe's
    assert run.S[state.ARM_CONTACT + k + 1] == 0


@pytest.mark.parametrize("beside", [0.5, 1.49, 1.5, 1.51, 10.0])
@pytest.mark.parametrize("segments", [1, 2, 3, 4, 7])
def test_a_point_touches_at_one_place_whatever_the_segments(beside: float, segments: int) -> None:
    """A bit of 0.3 m at its end, a stabiliser at its middle; the joints within and beside them are the collar's."""
    around = {"outer": 0.16, "segment_length": beside, "segments": None}
    parts = [
        pipe(0.3, segments, outer=0.2),
        pipe(9.0, **around),
        pipe(1.5, segments, outer=0.18, contact_diameter=0.2),
        pipe(9.0, **around),
        pipe(None, 90),
    ]
    string = lay_out(make_case(components=parts), 1000.0)
    below = np.append(np.cumsum(string.length[::-1])[::-1][1:], 0.0)  # of the lower end of each segment, to the bit
    place = np.where(string.mid_contact(), below + 0.5 * string.length, below)
    radius, bearing = string.contact_radius(), string.tributary()
    wide = radius == 0.1
    np.testing.assert_allclose(place[wide], [0.3 + 9.0 + 0.75, 0.0], atol=1e-9)
    np.testing.assert_allclose(bearing[wide], [1.5, 0.3])
    assert set(radius[(place < 18) & ~wide]) == {0.08}
    assert not string.mid_contact()[~wide].any()


@pytest.mark.parametrize("beside", [1.99, 2.0, 2.01, 10.0])
@pytest.mark.parametrize("segments", [1, 2, 5])
def test_a_sleeve_touches_at_both_ends_whatever_the_segments(beside: float, segments: int) -> None:
    """A sleeve of 2 m that says so, and a motor of 8 m that need not; what is longer is one by default."""
    around = {"outer": 0.16, "segment_length": beside, "segments": None}
    sleeve = pipe(2.0, segments, outer=0.2, contact="sleeve")
    parts = [pipe(12.0, **around), sleeve, pipe(12.0, **around), pipe(8.0, segments, outer=0.2), pipe(None, 90)]
    string = lay_out(make_case(components=parts), 1000.0)
    below = np.append(np.cumsum(string.length[::-1])[::-1][1:], 0.0)
    ends = below[string.contact_radius() == 0.1]
    expected = [np.linspace(34.0, 26.0, segments + 1), np.linspace(14.0, 12.0, segments + 1)]
    np.testing.assert_allclose(ends, np.concatenate(expected))
    assert not string.mid_contact().any()


def test_points_side_by_side_lie_within_the_sleeves_beside_them() -> None:
    """A bit and the near-bit stabiliser above it, cut into segments: no joint between them touches as wide as they."""
    parts = [pipe(0.5, 5, outer=0.2), pipe(1.5, 3, outer=0.2), pipe(100, 10, outer=0.16), pipe(None, 90)]
    string = lay_out(make_case(components=parts), 1000.0)
    assert np.flatnonzero(string.contact_radius() == 0.1).tolist() == [string.segments - 7, string.segments - 1]
    assert np.flatnonzero(string.mid_contact()).tolist() == [string.segments - 7]
    np.testing.assert_array_equal(string.contact_radius()[-6:-1], 0.08)


def test_a_short_component_at_the_top_has_no_neighbour_above() -> None:
    string = lay_out(make_case(components=[pipe(950, 10), pipe(50, 1, outer=0.2)]), 1000.0)
    assert not string.mid_contact().any()
    np.testing.assert_array_equal(string.contact_radius(), [0.1] + [0.0635] * 10)


def test_a_bit_touches_at_its_end_with_its_own_radius() -> None:
    string = lay_out(make_case(components=[pipe(1, 1, outer=0.2), pipe(None, 99)]), 1000.0)
    assert not string.mid_contact().any()
    np.testing.assert_array_equal(string.contact_radius(), [0.0635] * 99 + [0.1])


def test_a_whole_component_is_cut_evenly_and_a_part_of_it_nominally() -> None:
    case = make_case(
        components=[pipe(100, None, outer=0.159, segment_length=30.0), pipe(None, None, segment_length=30)]
    )
    np.testing.assert_allclose(lay_out(case, 1000.0).length[-3:], 100 / 3)
    np.testing.assert_allclose(lay_out(case, 1000.0).length[:-3], 30)
    for depth, lengths in ((95.0, [35, 30, 30]), (14.0, [14]), (40.0, [40]), (99.5, [39.5, 30, 30])):
        np.testing.assert_allclose(lay_out(case, depth).length, lengths)
    short = make_case(components=[pipe(10, None, segment_length=30.0), pipe(None, None, segment_length=30.0)])
    np.testing.assert_allclose(lay_out(short, 70.0).length, [30, 30, 10])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"bit_depth": 1000.1}, "end -0.1 m below the bit depth, 1000.1 m"),
        ({"top_md": 1e-5}, "end 1e-05 m below the bit depth, 1000 m"),
        ({"length": np.full(3, np.nan)}, "end nan m below"),
        ({"length": np.array([1100.0, -200.0, 100.0])}, "a segment of -200 m"),
        ({"length": np.array([800.0, 0.0, 200.0])}, "a segment of 0 m"),
        ({"component": np.array([1, 0])}, "order of the components"),
        ({"component": np.array([0, 1, 0])}, "order of the components"),
        ({"component": np.array([1, 1, 1])}, "order of the components"),
        ({"component": np.array([0, 0, 0])}, "order of the components"),
    ],
)
def test_a_layout_that_is_not_its_string_is_a_defect(change: dict, message: str) -> None:
    string = lay_out(make_case(components=[pipe(400, 2, outer=0.159), pipe(None, 1)]), 1000.0)
    with pytest.raises(AssertionError, match=re.escape(message)):
        replace(string, **change)
    assert string.lengthened(2e-7 - 1.0).bit_depth == pytest.approx(999.0)


def test_metres_of_the_wrong_component_are_a_defect() -> None:
    """A string of the right length may still be made of the wrong pipe."""
    case = make_case(components=[pipe(400, None, outer=0.159, segment_length=10.0), pipe(None, 1)])
    string = lay_out(case, 1000.0)
    drillstring.check_lengths(string, [400.0, 600.0])
    with pytest.raises(AssertionError, match=r"a component do not add up.*\[401\.0, 599\.0\] m"):
        drillstring.check_lengths(string, [401.0, 599.0])
    with pytest.raises(AssertionError, match=r"a component do not add up"):
        drillstring.check_lengths(string, [400.0, 599.0])


def test_a_layout_of_the_wrong_pipe_is_a_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    case = make_case(components=[pipe(400, 1, outer=0.159), pipe(None, 1)])
    wrong = iter([[401.0], [599.0]])
    monkeypatch.setattr(drillstring, "_divide", lambda part, take: next(wrong))
    with pytest.raises(AssertionError, match=r"of component 0 do not add up.* 400\.0 m"):
        lay_out(case, 1000.0)


def test_a_string_is_not_changed_in_place() -> None:
    string = lay_out(make_case(), 1000.0)
    with pytest.raises(FrozenInstanceError):
        string.bit_depth = 900.0


@pytest.mark.parametrize(
    ("components", "operation"),
    [
        ([pipe(None, None, segment_length=9.0)], trip(100, 102)),
        ([pipe(200, 20, outer=0.159), pipe(4000, None, segment_length=12.0)], trip(267, 300)),
        ([pipe(200, 20, outer=0.159), pipe(None, None, segment_length=4.0)], trip(300, 213)),
        ([pipe(4006, None, segment_length=13.0)], trip(20, 30)),
    ],
)
def test_a_short_top_segment_joins_the_one_below_it(components: list, operation: dict) -> None:
    """A fed segment is made at least 10 m long from its component; the string keeps its length."""
    case = make_case(components=components, operations=[operation])
    shallowest = min(operation["from_md"], operation["to_md"])
    plain, run = lay_out(case, shallowest), prepare(case)[0]
    fed = lay_out(case, shallowest, 1000.0)
    joined = plain.segments - fed.segments + 1
    assert joined > 1
    np.testing.assert_allclose(fed.length, [plain.length[:joined].sum(), *plain.length[joined:]])
    assert plain.length[: joined - 1].sum() < SHORTEST_LONG_SEGMENT <= fed.length[0]
    assert run.string.bit_depth == pytest.approx(operation["from_md"], abs=1e-6)
    assert run.string.length.sum() == pytest.approx(operation["from_md"], abs=1e-6)
