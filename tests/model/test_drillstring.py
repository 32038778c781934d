"""The layout of a string, its stiffness, and strings that do not fit."""

import re
from contextlib import nullcontext
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from fctd import Case
from fctd.case.errors import InputError
from fctd.mechanics import state
from fctd.mechanics.state import MAX_SEGMENTS
from fctd.model import drillstring
from fctd.model.drillstring import SHORTEST_LONG_SEGMENT, check_fit, fill, lay_out, section_of, shear_coefficient
from fctd.model.wellbore import build_wellbore
from fctd.simulation.run import prepare
from tests.cases import make_case, pipe, rotation, trip


def test_shear_coefficient_limits() -> None:
    """Hutchinson 2001: solid circle 6(1+ν)²/(7+12ν+4ν²), thin tube (1+ν)/(2+ν)."""
    for nu in (0.0, 0.3, 0.5):
        solid = 6 * (1 + nu) ** 2 / (7 + 12 * nu + 4 * nu**2)
        assert shear_coefficient(1.0, 0.0, nu) == pytest.approx(solid, rel=1e-12)
        assert shear_coefficient(1.0, 1.0 - 1e-9, nu) == pytest.approx((1 + nu) / (2 + nu), rel=1e-7)


def test_shear_coefficient_between_its_limits() -> None:
    """A bore of half the diameter, ν = 0.3, by hand: 15.84375/24.105."""
    assert shear_coefficient(3.0, 1.5, 0.3) == pytest.approx(15.84375 / 24.105, rel=1e-12)


def test_buoyancy_lowers_weight_and_not_mass() -> None:
    component = make_case(components=[pipe(1000, 20)]).string.components[0]
    air, mud = section_of(component, 0.0), section_of(component, 1570.0)
    assert mud.mass == air.mass == pytest.approx(7850 * np.pi / 4 * (0.127**2 - 0.07**2))
    assert mud.weight == pytest.approx(0.8 * air.weight)


def test_filled_rows_by_hand() -> None:
    """From the top: three segments of pipe, a stabiliser that touches at its middle, two collars."""
    case = filled_case(pipe(None, None, segment_length=30.0))
    string = lay_out(case, 112.0)
    collar, blade, top = string.sections
    S = state.new_state(6)
    fed = fill(S, string, case)
    length = np.array([30, 30, 30, 2, 10, 10])
    sections = [top, top, top, blade, collar, collar]
    expected = {
        state.MASS: [s.mass * m for s, m in zip(sections, length, strict=True)],
        state.WEIGHT: [s.weight * m for s, m in zip(sections, length, strict=True)],
        state.J_AXIAL: [s.axial_inertia * m for s, m in zip(sections, length, strict=True)],
        state.J_TRANSVERSE: [s.mass * m**3 / 12 + s.tilt_inertia * m for s, m in zip(sections, length, strict=True)],
        state.ARM_TOP: length / 2,
        state.ARM_BOTTOM: length / 2,
        state.ARM_CONTACT: [15, 15, 15, 0, 5, 5],
        state.RADIUS: [0.0635, 0.0635, 0.0635, 0.1, 0.0795, 0.0795],
        state.TRIBUTARY: [30, 30, 16, 2, 10, 5],
        state.MUD_AXIAL: 3.0 * length,
        state.MUD_LATERAL: 5.0 * length,
        state.MUD_SPIN: 0.7 * length,
    }
    for row, name in ((state.K_AXIAL, "EA"), (state.K_SHEAR, "shear"), (state.K_BEND, "EI"), (state.K_TWIST, "GJ")):
        p, b, c = (getattr(section, name) for section in (top, blade, collar))
        expected[row] = [p / 15, p / 30, p / 30, 1 / (15 / p + 1 / b), 1 / (1 / b + 5 / c), c / 10]
    check_rows(S, expected)
    assert fed == (
        top.mass, 0.0, top.axial_inertia, top.EA, top.GJ, top.EI, top.shear, 3.0, 5.0, 0.7,
    )  # fmt: skip
    # Stiffness of a point: every contact counts once.
    case = filled_case(pipe(None, None, segment_length=30.0), stiffness=1e7)
    fill(S, lay_out(case, 112.0), case)
    np.testing.assert_array_equal(state.row(S, state.TRIBUTARY, 6), 1.0)


def test_filled_rows_below_a_long_segment_by_hand() -> None:
    """The pipe is one segment of 90 m: its springs have its whole length, its end half its mass and no arm below."""
    case = filled_case(pipe(None, 1))
    string = lay_out(case, 112.0)
    collar, blade, top = string.sections
    S = state.new_state(4)
    fed = fill(S, string, case)
    expected = {
        state.MASS: [top.mass * 45, blade.mass * 2, collar.mass * 10, collar.mass * 10],
        state.WEIGHT: [top.weight * 45, blade.weight * 2, collar.weight * 10, collar.weight * 10],
        state.J_AXIAL: [top.axial_inertia * 45, blade.axial_inertia * 2, *[collar.axial_inertia * 10] * 2],
        state.J_TRANSVERSE: [
            top.mass * 45 * 90**2 / 3,
            blade.mass * 8 / 12 + blade.tilt_inertia * 2,
            *[collar.mass * 1000 / 12 + collar.tilt_inertia * 10] * 2,
        ],
        state.ARM_TOP: [90, 1, 5, 5],
        state.ARM_BOTTOM: [0, 1, 5, 5],
        state.ARM_CONTACT: [0, 0, 5, 5],
        state.RADIUS: [0.0635, 0.1, 0.0795, 0.0795],
        state.TRIBUTARY: [1, 2, 10, 5],
        state.MUD_AXIAL: [135, 6, 30, 30],
        state.MUD_LATERAL: [225, 10, 50, 50],
        state.MUD_SPIN: [31.5, 1.4, 7, 7],
    }
    for row, name in ((state.K_AXIAL, "EA"), (state.K_SHEAR, "shear"), (state.K_BEND, "EI"), (state.K_TWIST, "GJ")):
        p, b, c = (getattr(section, name) for section in (top, blade, collar))
        expected[row] = [p / 90, b, 1 / (1 / b + 5 / c), c / 10]
    check_rows(S, expected)
    assert fed == (
        top.mass, top.weight, top.axial_inertia, top.EA, top.GJ, top.EI, top.shear, 3.0, 5.0, 0.7,
    )  # fmt: skip


def filled_case(top: dict[str, Any], **stiffness: float) -> Case:
    """20 m of collars, a stabiliser of 2 m and a component above them, in damping mud."""
    mud = {"density": 1200, "axial_damping": 3.0, "lateral_damping": 5.0, "rotational_damping": 0.7}
    components = [pipe(20, 2, outer=0.159), pipe(2, 1, outer=0.2), top]
    return make_case(components=components, mud=mud, wellbore=stiffness or {"stiffness_per_length": 1e6})


def check_rows(S: np.ndarray, expected: dict[int, Any]) -> None:
    """Rows of the buffer, and the inverses of masses and inertias."""
    for inverse, of in (
        (state.INVERSE_MASS, state.MASS),
        (state.INVERSE_JT, state.J_TRANSVERSE),
        (state.INVERSE_JA, state.J_AXIAL),
    ):
        expected[inverse] = 1 / np.asarray(expected[of])
    for row, values in expected.items():
        np.testing.assert_allclose(state.row(S, row, len(values)), values, rtol=1e-12)


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
    string = lay_out(make_case(components=[{**component, "segment_length": 25.0}]), 1000)
    assert string.segments == 40


def test_unlike_neighbours_are_in_series_and_the_clamp_is_half_a_segment_away() -> None:
    case = make_case(components=[pipe(100, 2, outer=0.159), pipe(900, 9)])
    string = lay_out(case, 1000.0)
    stiffness = string.joints("EA")
    collar, tube = string.sections[0].EA, string.sections[1].EA
    assert stiffness[0] == pytest.approx(2 * tube / 100)
    assert stiffness[1] == pytest.approx(tube / 100)
    assert stiffness[9] == pytest.approx(1 / (50 / tube + 25 / collar))
    assert stiffness[10] == pytest.approx(collar / 50)


def test_long_segment_puts_its_whole_length_at_the_top() -> None:
    case = make_case(components=[pipe(500, 10), pipe(None, 1)])
    string = lay_out(case, 1000.0, 1100.0)
    assert string.long_segment
    stiffness = string.joints("GJ")
    assert stiffness[0] == pytest.approx(string.sections[1].GJ / 500)
    assert stiffness[1] == pytest.approx(string.sections[0].GJ / 25)


def test_contact_radius_is_the_larger_at_unlike_neighbours() -> None:
    case = make_case(components=[pipe(50, 2, outer=0.159), pipe(950, 10, contact_diameter=0.168)])
    string = lay_out(case, 1000.0)
    np.testing.assert_allclose(string.contact_radius()[-3:], [0.084, 0.0795, 0.0795])


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


@pytest.mark.parametrize(
    ("above", "below", "short"),
    [(8.0, 10.0, False), (10.0, 8.0, False), (10.0, 10.0, True), (9.0, 10.0, False), (10.0, 9.0, False)],
)
def test_a_short_component_is_shorter_than_both_neighbours(above: float, below: float, short: bool) -> None:
    """One segment of 9 m; longer segments that are not its neighbours do not matter."""
    far, near = pipe(300, 10), pipe(4 * above, 4)
    stabiliser, nearer = pipe(9, 1, outer=0.2), pipe(4 * below, 4)
    case = make_case(components=[pipe(300, 10), nearer, stabiliser, near, far, pipe(None, 20)])
    string = lay_out(case, 1000.0)
    (k,) = np.flatnonzero(string.component == 2)
    assert np.flatnonzero(string.mid_contact()).tolist() == ([k] if short else [])
    radius = string.contact_radius()
    assert radius[k] == 0.1
    assert radius[k - 1] == (0.0635 if short else 0.1)


def test_a_short_component_at_the_top_has_no_neighbour_above() -> None:
    string = lay_out(make_case(components=[pipe(950, 10), pipe(50, 1, outer=0.2)]), 1000.0)
    assert not string.mid_contact().any()
    np.testing.assert_array_equal(string.contact_radius(), [0.1] + [0.0635] * 10)


def test_a_bit_touches_at_its_end_with_its_own_radius() -> None:
    string = lay_out(make_case(components=[pipe(1, 1, outer=0.2), pipe(None, 99)]), 1000.0)
    assert not string.mid_contact().any()
    np.testing.assert_array_equal(string.contact_radius(), [0.0635] * 99 + [0.1])


def test_tributary_length_for_stiffness_per_metre() -> None:
    case = make_case(
        components=[pipe(100, 10, outer=0.159), pipe(900, 30)],
        wellbore={"stiffness_per_length": 1e6},
        operations=[rotation(1000, 1)],
    )
    run, _ = prepare(case)
    tributary = state.row(run.S, state.TRIBUTARY, run.segments)
    np.testing.assert_allclose(tributary[[0, 28, 29, 30, -1]], [30, 30, 20, 10, 5])


@pytest.mark.parametrize(
    ("case", "pattern"),
    [
        (
            {"components": [pipe(1000, 20, contact_diameter=0.23)]},
            r"string\.components\[0\]\.contact_diameter.*230 mm.*at most the hole's 215\.9 mm",
        ),
        (
            {"components": [pipe(500, 20)]},
            r"string\.components.*500 m of string.*reach from the bit at 1000 m",
        ),
        (
            {"components": [pipe(999.5, 20)]},
            r"string\.components.*999\.5 m of string.*reach from the bit at 1000 m",
        ),
        (
            {"components": [pipe(1000, MAX_SEGMENTS + 1)]},
            rf"string\.components.*{MAX_SEGMENTS + 1} segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(500, MAX_SEGMENTS), pipe(None, 1000)]},
            rf"string\.components.*{MAX_SEGMENTS + 1000} segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(1000, None, segment_length=1e-7)]},
            rf"string\.components.*1e\+10 segments.*at most {MAX_SEGMENTS}",
        ),
        (
            {"components": [pipe(990.5, 20), pipe(None, 1)]},
            r"string\.components\[1\].*9\.5 m of it at the top.*at least 10 m",
        ),
        (
            {"components": [pipe(5e-7, 1), pipe(None, 20)]},
            r"string\.components\[0\].*5e-07 m of it in one segment.*segments of at least 1e-06 m",
        ),
        (
            {"components": [pipe(995, 20), pipe(None, 1)]},
            r"string\.components\[1\].*5 m of it at the top.*at least 10 m",
        ),
        (
            {
                "stations": [[0, 0, 0], [300, 0, 0], [1000, 60, 0]],
                "components": [pipe(500, 20), pipe(None, 1)],
            },
            r"string\.components\[1\].*500 m at the top.*within 1 deg of vertical",
        ),
        ({"solver": {"step": 0.1}}, r"solver\.step.*0\.1 s.*at most the stable step"),
    ],
)
def test_what_does_not_fit_is_refused(case: dict, pattern: str) -> None:
    with pytest.raises(InputError, match=pattern):
        prepare(make_case(operations=[rotation(1000, 1)], **case))


def test_what_just_fits_is_laid_out() -> None:
    """As many segments as the buffer holds, a long segment of 10 m, a fed one of 10 m, pipe as wide as its hole."""
    assert lay_out(make_case(components=[pipe(1000, MAX_SEGMENTS)]), 1000.0).segments == MAX_SEGMENTS
    assert lay_out(make_case(components=[pipe(990, 20), pipe(None, 1)]), 1000.0).length[0] == SHORTEST_LONG_SEGMENT
    fed = lay_out(make_case(components=[pipe(None, None, segment_length=10.0)]), 100.0, 200.0)
    np.testing.assert_allclose(fed.length, np.full(10, 10.0))
    case = make_case(components=[pipe(None, 20, contact_diameter=0.2159)])
    check_fit(case, lay_out(case, 1000.0), build_wellbore(case), 1000.0)


def test_a_long_segment_hangs_in_the_vertical_part_alone() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0], [1000, 60, 0]], [pipe(900, 36), pipe(None, 1)])
    check_fit(case, lay_out(case, 1000.0), build_wellbore(case), 1000.0)


def test_a_narrow_hole_above_the_top_of_the_string_does_not_matter() -> None:
    intervals = [{"to_md": 99.5, "diameter": 0.1, "friction": 0.2}, {"to_md": 1000, "diameter": 0.3, "friction": 0.2}]
    case = make_case(components=[pipe(None, 20)], top_md=100.0, wellbore={"intervals": intervals})
    check_fit(case, lay_out(case, 1000.0), build_wellbore(case), 1000.0)


@pytest.mark.parametrize(("depth", "fits"), [(850.0, True), (900.0, True), (900.1, False), (1000.0, False)])
def test_wide_pipe_fits_where_the_hole_is_wide(depth: float, fits: bool) -> None:
    """400 m of pipe below 250 mm of it, in 320 mm of hole to 500 m and 215.9 mm below."""
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.2},
        {"to_md": 1000, "diameter": 0.2159, "friction": 0.2},
    ]
    components = [pipe(400, 10), pipe(None, None, outer=0.25, segment_length=20.0)]
    case = make_case(components=components, wellbore={"intervals": intervals})
    hole, string = build_wellbore(case), lay_out(case, depth)
    refused = pytest.raises(InputError, match=r"components\[1\]\.contact_diameter.*250 mm.*at most the hole's 215\.9")
    with nullcontext() if fits else refused:
        check_fit(case, string, hole, depth)
    # The same depth reached by feeding.
    fed = case.model_copy(update={"operations": make_case(operations=[trip(840, depth)]).operations})
    with nullcontext() if fits else refused:
        prepare(fed)


def test_a_wide_bottom_stands_below_a_narrow_hole() -> None:
    intervals = [{"to_md": 500, "diameter": 0.2, "friction": 0.2}, {"to_md": 1000, "diameter": 0.3, "friction": 0.2}]
    case = make_case(components=[pipe(300, 10, outer=0.25), pipe(None, 20)], wellbore={"intervals": intervals})
    hole = build_wellbore(case)
    for depth in (1000.0, 800.0):
        check_fit(case, lay_out(case, depth), hole, depth)
    with pytest.raises(InputError, match=r"components\[0\]\.contact_diameter.*at most the hole's 200 mm"):
        check_fit(case, lay_out(case, 799.0), hole, 799.0)


@pytest.mark.parametrize(("narrow_to", "bit"), [(0.5, 900.0), (1000.0, 0.9)])
def test_the_first_metre_counts(narrow_to: float, bit: float) -> None:
    """The check includes a narrow interval at the surface, and a string that has just entered the hole."""
    intervals = [
        {"to_md": narrow_to, "diameter": 0.1, "friction": 0.2},
        {"to_md": 2000, "diameter": 0.3, "friction": 0},
    ]
    case = make_case(components=[pipe(None, 4)], wellbore={"intervals": intervals})
    with pytest.raises(InputError, match=r"contact_diameter.*127 mm.*at most the hole's 100 mm"):
        check_fit(case, lay_out(case, bit), build_wellbore(case), bit)


def test_a_trip_feeds_to_the_end_of_its_component() -> None:
    case = make_case(components=[pipe(300, 12), pipe(500, 20)], top_md=100.0)
    assert lay_out(case, 850.0, 900.0).long_segment
    with pytest.raises(InputError, match=r"components\[1\]\.length.*depth of 900 m.*depth of 900\.1 m"):
        lay_out(case, 850.0, 900.1)


def test_a_whole_component_is_cut_evenly_and_a_part_of_it_nominally() -> None:
    case = make_case(
        components=[pipe(100, None, outer=0.159, segment_length=30.0), pipe(None, None, segment_length=30)]
    )
    np.testing.assert_allclose(lay_out(case, 1000.0).length[-3:], 100 / 3)
    np.testing.assert_allclose(lay_out(case, 1000.0).length[:-3], 30)
    np.testing.assert_allclose(lay_out(case, 95.0).length, [35, 30, 30])
    np.testing.assert_allclose(lay_out(case, 14.0).length, [14])
    np.testing.assert_allclose(lay_out(case, 40.0).length, [40])
    np.testing.assert_allclose(lay_out(case, 99.5).length, [39.5, 30, 30])
    short = make_case(components=[pipe(10, None, segment_length=30.0), pipe(None, None, segment_length=30.0)])
    np.testing.assert_allclose(lay_out(short, 70.0).length, [30, 30, 10])


def test_a_bit_at_the_top_of_the_string_is_refused() -> None:
    for depth in (100.0, 90.0):
        with pytest.raises(InputError, match=rf"string\.top_md.*100 m.*less than the bit depth, {depth:g} m"):
            lay_out(make_case(top_md=100.0), depth)


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
    case = make_case(components=[pipe(400, 2, outer=0.159), pipe(None, 1)])
    string = lay_out(case, 1000.0)
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


def test_a_fed_top_segment_must_stay_in_vertical_hole() -> None:
    stations = [[0, 0, 0], [100, 0, 0], [1000, 60, 0]]
    with pytest.raises(InputError, match=r"string\.components\[0\].*within 1 deg of vertical"):
        prepare(make_case(stations, [pipe(1000, 20)], [trip(600, 900)]))


def test_a_case_without_operations_cannot_be_simulated() -> None:
    with pytest.raises(InputError, match=r"operations.*at least one operation"):
        prepare(make_case())


@pytest.mark.parametrize(
    ("components", "operation"),
    [
        ([pipe(700, 28)], trip(600, 900)),  # more string than there is
        ([pipe(100, 10, outer=0.159), pipe(500, 20), pipe(1000, 40)], trip(590, 900)),  # of the wrong component
    ],
)
def test_a_trip_feeds_one_component_and_no_more_than_there_is(components: list, operation: dict) -> None:
    with pytest.raises(InputError, match=r"string\.components\[\d\]\.length.*to reach a bit depth of 900 m"):
        prepare(make_case(components=components, operations=[operation]))


@pytest.mark.parametrize(
    ("sections", "pattern"),
    [
        ({"record": {"profile_at": [5000]}}, r"record\.profile_at\[0\].*5000 m.*1000 to 1000 m"),
        ({"record": {"interval": 1e-9}}, r"record\.interval.*at most 200000 records"),
        ({"record": {"profile_at": [1000.0] * 100_000}}, r"record\.profile_at.*100000 depths.*at most \d+ profiles"),
        ({"wellbore": {"stiffness": 1e20}}, r"solver\.step.*at most 4\.2e\+10 steps of 20 segments"),
        ({"solver": {"step": 1e-12}}, r"solver\.step.*1e-12 s for 60 s.*at most 4\.2e\+10 steps"),
        ({"wellbore": {"cylinder_length": 1e-6, "overlap": 0}}, r"wellbore\.cylinder_length.*cylinders"),
    ],
)
def test_what_would_run_for_hours_is_refused(sections: dict, pattern: str) -> None:
    with pytest.raises(InputError, match=pattern):
        prepare(make_case(operations=[rotation(1000, 60)], **sections))


@pytest.mark.parametrize(
    "operation", [rotation(1000, 1e-10), trip(1000, 1000 - 1e-9), trip(1000, 1000 - 1e-12, speed=10.0)]
)
def test_an_operation_that_is_over_before_it_begins_is_refused(operation: dict) -> None:
    with pytest.raises(InputError, match=r"operations\[0\].* s\": expected an operation that lasts at least 1 ms"):
        prepare(make_case(operations=[operation]))


def test_cost_counts_the_steps_of_every_segment() -> None:
    """A number of steps that is accepted for twenty segments is refused for five thousand."""
    schedule, solver = [rotation(1000, 3600)], {"step": 2e-6}
    prepare(make_case(operations=schedule, solver=solver))
    with pytest.raises(InputError, match=r"solver\.step.*at most 2e\+08 steps of 5000 segments"):
        prepare(make_case(components=[pipe(1000, 5000)], operations=schedule, solver=solver))


def test_mud_must_be_lighter_than_the_string() -> None:
    with pytest.raises(Exception, match="a density below the string's, 7850"):
        make_case(mud={"density": 7850})


def test_inertia_of_a_segment_by_hand() -> None:
    """A rigid hollow cylinder: m (L²/12 + (a² + b²)/4) across, m (a² + b²)/2 along."""
    run, _ = prepare(make_case(components=[pipe(1000, 500)], operations=[rotation(1000, 1)]))
    mass = 7850 * 8.819236e-3 * 2
    square = 0.0635**2 + 0.035**2
    for row, inverse, expected in (
        (state.MASS, state.INVERSE_MASS, mass),
        (state.J_TRANSVERSE, state.INVERSE_JT, mass * (4 / 12 + square / 4)),
        (state.J_AXIAL, state.INVERSE_JA, mass * square / 2),
    ):
        np.testing.assert_allclose(state.row(run.S, row, 500), expected, rtol=1e-6)
        np.testing.assert_allclose(state.row(run.S, inverse, 500), 1 / expected, rtol=1e-6)


def test_section_by_hand() -> None:
    """5 in 19.5 lb/ft pipe: numbers worked out from the formulas of a hollow circle."""
    component = make_case(components=[pipe(1000, 20)]).string.components[0]
    section = section_of(component, 0.0)
    b, a = 0.0635, 0.035
    assert pytest.approx(206.8e9 * 8.819236e-3, rel=1e-6) == section.EA
    assert pytest.approx(206.8e9 * np.pi * (b**4 - a**4) / 4) == section.EI
    assert pytest.approx(206.8e9 / 2.6 * np.pi * (b**4 - a**4) / 2) == section.GJ
    assert section.axial_inertia == pytest.approx(7850 * np.pi * (b**4 - a**4) / 2)
    assert section.weight == pytest.approx(7850 * 8.819236e-3 * 9.80665, rel=1e-6)
    shear_area = shear_coefficient(b, a, 0.3) * np.pi * (b * b - a * a)
    assert section.shear == pytest.approx(206.8e9 / 2.6 * shear_area)
    assert (section.outer, section.inner, section.contact_radius) == (b, a, b)


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
