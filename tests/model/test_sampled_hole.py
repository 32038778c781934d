"""Cells of a sampled hole: what the arms measured lies where they measured it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import fctd
from fctd import InputError
from fctd.arrays import Array
from fctd.mechanics import contact, sampled
from fctd.model.frames import hole_frame
from fctd.model.perturbed import with_noise
from fctd.model.sampled_hole import in_cells, turns, wall_around
from fctd.model.wellbore import Wellbore, build_wellbore
from tests.calipers import BORE, FIRST, LAST, SIZES, bent_case, bent_hole, rough, sampled_hole
from tests.cases import make_case, pipe


@pytest.mark.slow
def test_the_reference_direction_goes_with_the_hole_without_turning_about_it() -> None:
    """From piece to piece it is the same vector; a step along the hole turns it about the hole by nothing."""
    hole = sampled_hole(rough(1))
    pieces, turn = hole.pieces, turns(hole.pieces)
    tangent = pieces[:, contact.DIRECTION : contact.DIRECTION + 3]
    normal = pieces[:, contact.NORMAL : contact.NORMAL + 3]
    binormal = np.cross(tangent, normal)
    angle = pieces[:, contact.CURVATURE] * pieces[:, contact.LENGTH]
    at_end = np.cos(angle)[:, None] * normal - np.sin(angle)[:, None] * tangent
    starts = np.cos(turn)[:, None] * normal + np.sin(turn)[:, None] * binormal
    ends = np.cos(turn)[:, None] * at_end + np.sin(turn)[:, None] * binormal
    np.testing.assert_allclose(ends[:-1], starts[1:], atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("reference", ["high_side", "north"])
def test_an_oval_hole_is_widest_where_the_caliper_says(reference: str) -> None:
    """40° clockwise from the high side, or from north, in hole that builds and turns."""
    rows = [[md, 0.30, 0.2159] for md in np.arange(FIRST, LAST, 5.0)]
    given = {"rows": rows, "reference": reference, "first_arm": np.radians(40)}
    hole = build_wellbore(bent_case("sampled", caliper=given))
    md, tangent = np.array([560.0, 640.0, 720.0]), hole.at(np.array([560.0, 640.0, 720.0]))[1]
    up, right = hole_frame(tangent)
    if reference == "north":
        up = np.array([1.0, 0, 0]) - tangent[:, :1] * tangent
        up /= np.linalg.norm(up, axis=1)[:, None]
        right = np.cross(tangent, up)
    for turn, radius in ((40, 0.15), (130, 0.10795), (220, 0.15), (310, 0.10795)):
        towards = np.cos(np.radians(turn)) * up + np.sin(np.radians(turn)) * right
        found = hole.radii_towards(md, towards[:, None])[:, 0]
        np.testing.assert_allclose(found, radius, atol=6e-4)  # flattened by cells of 10° around the hole


def test_a_hole_that_is_wide_on_its_high_side_is_so_there_alone() -> None:
    rows = [[md, 0.15, 0.11, 0.11, 0.11] for md in np.arange(FIRST, LAST, 5.0)]
    hole = build_wellbore(bent_case("sampled", caliper={"rows": rows, "values": "radius"}))
    md = np.array([560.0, 640.0])
    up, _ = hole_frame(hole.at(md)[1])
    np.testing.assert_allclose(hole.radii_towards(md, np.stack([up, -up], axis=1)), [[0.15, 0.11]] * 2, atol=6e-4)


def test_casing_and_gaps_keep_the_size_of_their_interval() -> None:
    """The caliper begins in casing, has a gap, and ends above total depth."""
    sizes = [[md, 0.26] for md in (*range(460, 640, 4), *range(700, 900, 4))]
    rows = [*sizes[:45], [640, 0.26], [641, 0.26], *sizes[45:]]
    hole = build_wellbore(bent_case("sampled", caliper={"rows": sorted(rows)}))
    wall = hole.walls(hole.at(np.array([480.0, 560.0, 950.0]))[0])
    np.testing.assert_allclose(wall.radius, [0.15, 0.13, 0.5 * BORE], atol=1e-9)


def test_a_measured_circle_is_that_circle_at_its_shoe_and_below_its_end() -> None:
    """Whatever the nominal size is: no ledge lies below the casing, nor where the string stretches past the end."""
    stations, shoe, total = [[0, 0, 0], [200, 20, 0], [400, 60, 30]], 250.0, 400.0

    def hole_of(nominal: float, **more: object) -> Wellbore:
        sizes = [{"to_md": shoe, "diameter": 0.3154, "friction": 0.2, "kind": "cased"},
                 {"to_md": total, "diameter": nominal, "friction": 0.2, "kind": "open"}]  # fmt: skip
        return build_wellbore(make_case(stations, [pipe(100, 10)], wellbore={"intervals": sizes, **more}))

    caliper = {"rows": [[0.0, 0.3112], [total, 0.3112]]}
    circle = hole_of(0.3112, geometry="arcs")
    measured = hole_of(0.33, geometry="sampled", caliper=caliper, cell=0.1)
    md = np.append(np.linspace(shoe - 0.3, shoe + 0.5, 60), [390.0, total - 0.05, total + 0.3, total + 2.0])
    points = circle.off_axis(md, np.zeros(64), np.full(64, 0.1))
    radius, expected = measured.walls(points).radius, circle.walls(points).radius
    assert radius.min() > 0.5 * 0.3112 - 1e-4
    assert radius.max() < 0.5 * 0.3154 + 1e-4
    np.testing.assert_allclose(radius[60:], expected[60:], atol=1e-9)


@pytest.mark.parametrize("borders", [[630.0], [600.03, 600.04, 700.0], [560.0, 1000.0 - 1e-3]])
def test_equal_intervals_are_one_however_many_a_case_writes(borders: list[float]) -> None:
    """Measured hole in pieces has the cells of the whole, and friction that differs later begins at the border."""
    md = np.arange(FIRST, LAST + 1e-9, 0.5)
    measured = {"rows": np.column_stack([md, rough(3)(md)]).tolist(), "values": "radius"}
    cased, whole = SIZES
    split = [cased, *(whole | {"to_md": border} for border in borders), whole]
    one, cut = (build_wellbore(bent_case("sampled", caliper=measured, intervals=of)) for of in (SIZES, split))
    within = [of.pieces[of.pieces[:, sampled.AROUND_CELLS] > 0] for of in (one, cut)]
    np.testing.assert_allclose(within[1], within[0], rtol=1e-12, atol=1e-12)
    own, along = one.wall_along(), cut.wall_along()  # of which the annulus has its radius
    np.testing.assert_allclose(np.interp(along[:, 0], own[:, 0], own[:, 1]), along[:, 1], rtol=1e-12)
    unlike = cut.with_friction([0.2, 0.3, *(0.4 for _ in borders)])
    near = unlike.walls(unlike.at(borders[0] + np.array([-0.3, 0.3]))[0])
    np.testing.assert_allclose(near.friction / near.friction[0], [1.0, 4 / 3], rtol=1e-6)


@pytest.mark.parametrize("cell", [0.1, 0.25])
@pytest.mark.parametrize("shift", [2e-10, -2e-10])
def test_depths_that_a_unit_rounds_leave_the_cells_as_they_are(shift: float, cell: float) -> None:
    """Rows and borders lie on ends of cells, with a gap between rows; some move by rounding, others do not."""

    def hole(moved: float) -> Array:
        md = np.array([*np.arange(FIRST, 600.0, 0.5), *np.arange(610.0, LAST + 1e-9, 0.5)])
        rows = np.column_stack([md, rough(5)(md)])
        rows[md == 605.0 - 5.0, 1:] = np.nan
        rows[0, 0], rows[-1, 0], rows[100, 0] = rows[0, 0] - moved, rows[-1, 0] + moved, rows[100, 0] + moved
        given = {"rows": rows.tolist(), "values": "radius"}
        return build_wellbore(bent_case("sampled", cell=cell, caliper=given)).pieces

    np.testing.assert_allclose(hole(shift), hole(0.0), atol=1e-7)


def test_cells_have_the_mean_of_the_rows_in_them() -> None:
    caliper = bent_case("sampled", caliper={"rows": [[520, 0.2], [521, 0.3], [522, 0.2], [524, 0.2]]}).wellbore.calipers
    assert caliper is not None
    means, _ = in_cells(caliper, np.array([520.0, 520.5, 521.5]), np.array([522.0, 521.5, 524.0]))
    np.testing.assert_allclose(means[:, 0], [0.125, 0.1375, 0.5 * (0.2 + 0.1 * 0.5 * 0.25 / 2.5)])


@given(st.integers(3, 16), st.integers(0, 2**31))
@settings(max_examples=30)
def test_around_the_hole_the_wall_has_its_extremes_at_the_arms(arms: int, seed: int) -> None:
    radii = np.random.default_rng(seed).uniform(0.1, 0.2, (3, arms))
    first = np.array([0.0, 1.0, -2.0])
    around = wall_around(radii, first, np.linspace(0, 2 * np.pi, 720))
    for k in range(3):
        at = wall_around(radii[k : k + 1], first[k : k + 1], first[k] + 2 * np.pi / arms * np.arange(arms))
        np.testing.assert_allclose(at[0], radii[k], atol=1e-12)
        assert radii[k].min() - 1e-12 <= around[k].min() <= around[k].max() <= radii[k].max() + 1e-12
    just_before = wall_around(radii[:1], first[:1], np.array([-1e-20]))  # a turn less next to nothing is a whole turn
    assert just_before[0, 0] == pytest.approx(radii[0, 0], abs=1e-12)


def test_noise_in_the_stations_of_a_straight_hole_leaves_its_cells_as_they_are() -> None:
    """Its normals are those of rounding, from which the cells around the hole counted."""
    rows = [[md, *(0.5 * BORE + np.array([0.004, 0.008, 0.002]))] for md in np.arange(FIRST, FIRST + 5, 0.5)]
    given = {
        "geometry": "sampled", "intervals": SIZES, "cell": 0.4, "caliper": {"rows": rows, "values": "radius"},
    }  # fmt: skip
    case = make_case([[md, 9.24, 141.0] for md in np.linspace(0, 1000, 24)], [pipe(1000.0, 100)], wellbore=given)
    own = build_wellbore(case).pieces[:, sampled.TABLES :]
    for seed in range(4):
        noisy = build_wellbore(with_noise(case, seed)).pieces[:, sampled.TABLES :]
        np.testing.assert_allclose(noisy, own, atol=1e-9)


@pytest.mark.slow
def test_the_wall_along_a_hole_has_circles_of_the_same_area() -> None:
    """π a b of an oval."""
    hole = build_wellbore(bent_case("sampled", caliper={"rows": [[FIRST, 0.30, 0.24], [LAST, 0.30, 0.24]]}))
    rows = hole.wall_along()
    inside = (rows[:, 0] > FIRST + 1) & (rows[:, 0] < LAST - 1)
    np.testing.assert_allclose(rows[inside, 1], np.sqrt(0.15 * 0.12), rtol=2e-3)
    assert hole.narrowest == pytest.approx(0.5 * BORE)  # above and below the caliper


def test_a_string_that_a_caliper_does_not_let_pass_is_refused() -> None:
    """120 mm at 702 m, which pipe of 127 mm does not pass; an edge on one side alone lets it pass."""
    narrow = [[FIRST, 0.216], [700, 0.216], [701, 0.12], [703, 0.12], [704, 0.216], [LAST, 0.216]]
    case = bent_case("sampled", caliper={"rows": narrow})
    assert build_wellbore(case).narrowest == pytest.approx(0.06, abs=1e-3)
    with pytest.raises(InputError, match=r"that wellbore\.caliper has at 70[123] m"):
        fctd.equilibrium(case, "trip_out", 900.0)
    assert fctd.equilibrium(case, "trip_out", 600.0).answered
    edge = [[md, 0.10795, 0.10795, 0.10795 - 0.02 * (700 < md < 710), 0.10795] for md in np.arange(FIRST, LAST, 2.0)]
    beside = bent_case("sampled", caliper={"rows": edge, "values": "radius"})
    assert fctd.equilibrium(beside, "trip_out", 900.0).answered


def test_a_caliper_that_measured_no_open_hole_leaves_the_hole_round() -> None:
    """In casing, below total depth, or without values."""
    for rows in ([[10, 0.3], [400, 0.3]], [[1100, 0.3], [1200, 0.3]]):
        hole = build_wellbore(bent_case("sampled", caliper={"rows": rows}))
        assert hole.is_round
        assert hole.narrowest == pytest.approx(0.5 * BORE)


@pytest.mark.slow
def test_points_of_any_radius_are_asked() -> None:
    """Radii that no component has get tables of their own."""
    hole = sampled_hole(rough(3))
    assert hole.sampling is not None
    other = hole.with_radii(np.array([0.05, 0.0635]))
    assert other.sampling is not None
    assert set(other.sampling.radii) == {0.0, 0.05, 0.0635}
    assert other.with_radii(np.array([0.05])) is other
    assert bent_hole("arcs").with_radii(np.array([0.05])).sampling is None


@pytest.mark.slow
def test_memory_of_a_kilometre() -> None:
    """Of one radius beside the wall itself, in cells of 0.1 m."""
    hole = sampled_hole(rough(4))
    assert hole.pieces.nbytes / (LAST - FIRST) * 1000 < 30e6
    cells: Array = hole.pieces[:, sampled.AROUND_CELLS]
    assert cells.max() == 36
