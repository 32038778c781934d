"""Contacts of points with the hole: closed forms, brute force, and points far away."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import find_contacts
from fctd.case.errors import InputError
from fctd.mechanics import contact
from fctd.model.frames import hole_frame
from fctd.model.wellbore import Wellbore
from references.contact.for_loop import for_loop_owners
from tests.cases import hole_of, make_case


def points_near(hole: Wellbore, count: int, seed: int, reach: float = 0.15) -> tuple[np.ndarray, np.ndarray]:
    """Seeded points within ``reach`` of the axis, and the depths they were placed at."""
    rng = np.random.default_rng(seed)
    md = rng.uniform(0.5, hole.total_depth - 0.5, count)
    angle, radius = rng.uniform(0, 2 * np.pi, count), reach * np.sqrt(rng.uniform(0, 1, count))
    return hole.off_axis(md, angle, radius), md


@pytest.mark.parametrize("radius", [50.0, 286.5, 1e4, 1e7, 1e10])
def test_arc_penetration_is_the_torus(radius: float) -> None:
    """Closed form: distance from a circle in the x–z plane, near-straight ones included."""
    length = min(radius * np.pi / 2, 100.0)
    angle = length / radius
    hole = hole_of([[0, 0, 0], [length, np.degrees(angle), 0]], geometry="arcs")
    points, md = points_near(hole, 500, seed=1)
    hits = find_contacts(hole, points, 0.05)
    # Decimal arithmetic of the textbook formula: √((√((R−x)²+z²) − R)² + y²).
    x, y, z = points.T.astype(np.longdouble)
    big = np.longdouble(radius)
    if radius <= 1e7:
        inward = np.hypot(big - x, z) - big
    else:
        inward = (z * z - 2 * big * x + x * x) / (np.hypot(big - x, z) + big)
    expected = np.hypot(inward, y) - (0.10795 - 0.05)
    np.testing.assert_allclose(hits.penetration, expected.astype(float), atol=1e-9)
    np.testing.assert_allclose(hits.md, md, atol=1e-6)


def test_cylinder_error_falls_with_the_square_of_the_length() -> None:
    """A chord of length ℓ misses the arc by ℓ²/8R (a circle's sagitta): that bound, and its order."""
    stations = [[0, 0, 0], [450, 90, 0]]
    exact = hole_of(stations, geometry="arcs")
    points, _ = points_near(exact, 2000, seed=2)
    truth = find_contacts(exact, points, 0.05).penetration
    errors = []
    lengths = [8.0, 4.0, 2.0, 1.0]
    for length in lengths:
        hole = hole_of(stations, cylinder_length=length, overlap=0.1)
        errors.append(np.abs(find_contacts(hole, points, 0.05).penetration - truth).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(orders - 2) < 0.15), orders
    radius = 450 / (np.pi / 2)
    assert np.all(np.array(errors) < 1.05 * np.array(lengths) ** 2 / (8 * radius) + 1e-4)


def drag_through_bend(overlap: float) -> tuple[np.ndarray, np.ndarray]:
    """Penetration and normal of a point carried along the outside of a bend of 2 m cylinders."""
    hole = hole_of([[0, 0, 0], [450, 90, 0]], cylinder_length=2.0, overlap=overlap)
    arcs = hole_of([[0, 0, 0], [450, 90, 0]], geometry="arcs")
    axis, direction = arcs.at(np.arange(190.0, 210.0, 1e-3))
    high, _ = hole_frame(direction)
    hits = find_contacts(hole, axis - 0.09 * high, 0.03)
    return hits.penetration, hits.normal


def test_overlap_removes_the_jump_between_cylinders() -> None:
    """One millimetre along the bend moves the wall by less than a micrometre with overlap, and by far more
    without it (Fig. 8)."""
    penetration, normal = drag_through_bend(0.2)
    assert np.abs(np.diff(penetration)).max() < 5e-5
    assert np.linalg.norm(np.diff(normal, axis=0), axis=1).max() < 1e-3
    _, bare = drag_through_bend(0.0)
    assert np.linalg.norm(np.diff(bare, axis=0), axis=1).max() > 5e-3


def test_the_gap_without_overlap_is_there() -> None:
    """On the outside of a bend a point lies in no cylinder at all, and the paper's FOR-loop finds no owner."""
    stations = [[0, 0, 0], [450, 90, 0]]
    arcs = hole_of(stations, geometry="arcs")
    axis, direction = arcs.at(np.arange(100.0, 300.0, 1e-3))
    outside = axis - 0.1 * hole_frame(direction)[0]
    bare = for_loop_owners(hole_of(stations, cylinder_length=2.0, overlap=0.0).pieces, outside)
    closed = for_loop_owners(hole_of(stations, cylinder_length=2.0, overlap=0.2).pieces, outside)
    assert (bare < 0).any()
    assert (closed >= 0).all()


angle_steps = st.lists(st.tuples(st.floats(-25, 25), st.floats(-60, 60)), min_size=4, max_size=10)


def random_well(turns: list[tuple[float, float]], start: float = 0.0) -> list[list[float]]:
    """A 3D well through north and past 90 degrees, 100 m between stations."""
    rows = [[0.0, 5.0, 350.0 + start]]
    for inclination, azimuth in turns:
        md, inc, azi = rows[-1]
        rows.append([md + 100, min(max(inc + abs(inclination), 0.5), 120.0), (azi + azimuth) % 360])
    return rows


def nearest_by_brute_force(hole: Wellbore, points: np.ndarray) -> np.ndarray:
    """Distance from every point to every cylinder's axis segment, the smallest one."""
    starts, axes = hole.points[:-1], np.diff(hole.points, axis=0)
    square = (axes**2).sum(axis=1)
    best = np.full(len(points), np.inf)
    for a, v, s in zip(starts, axes, square, strict=True):
        t = np.clip(((points - a) @ v) / s, 0, 1)
        best = np.minimum(best, np.linalg.norm(points - a - t[:, None] * v, axis=1))
    return best


@settings(max_examples=20)
@given(angle_steps, st.integers(0, 2**16))
def test_find_contacts_equals_brute_force(turns: list[tuple[float, float]], seed: int) -> None:
    """Random 3D wells: the wall found is that of the nearest cylinder.

    In the overlap the blend differs from the nearest by the angle between neighbours times the overlap.
    """
    hole = hole_of(random_well(turns), cylinder_length=5.0, overlap=0.05)
    points, md = points_near(hole, 500, seed)
    hits = find_contacts(hole, points, 0.03)
    axes = hole.pieces[:, contact.DIRECTION : contact.DIRECTION + 3]
    bend = np.linalg.norm(np.diff(axes, axis=0), axis=1).max()
    expected = nearest_by_brute_force(hole, points) - (0.10795 - 0.03)
    np.testing.assert_allclose(hits.penetration, expected, atol=1e-9 + bend * (0.05 + 0.15 * bend))
    np.testing.assert_allclose(hits.md, md, atol=0.15 * bend + 0.3)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_a_search_starts_at_the_nearest_piece(geometry: str) -> None:
    """Not at one of its neighbours: in a hole that turns back a search from there could end in the wrong leg."""
    hole = hole_of(random_well([(20, 30)] * 6), geometry=geometry)
    rng = np.random.default_rng(5)
    k = rng.integers(0, len(hole.md) - 1, 200)
    share = rng.uniform(0.0, 1.0, 200)
    md = hole.md[k] + 1.0 + share * (hole.md[k + 1] - hole.md[k] - 2.0)  # a metre off the ends of the pieces
    inside = hole.md[k + 1] - hole.md[k] > 4.0
    points = hole.off_axis(md, 2 * np.pi * share, np.full(200, 0.05))[inside]
    first = 0 if geometry == "cylinders" else 1  # arcs have a piece above the surface
    np.testing.assert_array_equal(hole.nearest(points), first + k[inside])
    np.testing.assert_array_equal(hole.owners(points), first + k[inside])


def test_the_nearest_piece_from_samples_half_a_metre_apart() -> None:
    """In cylinders of 0.7 m with a sample at the top and one in the middle, up to 175 mm beyond the middle."""
    hole = hole_of([[0, 5, 350], [100, 30, 20]], cylinder_length=0.7)
    k, share = np.divmod(np.arange(143 * 6), 6)
    np.testing.assert_array_equal(hole.nearest(hole.at(hole.md[k] + 0.02 + 0.09 * share)[0]), k)


def test_the_owner_of_one_point() -> None:
    hole = hole_of(random_well([(20, 30)] * 6))
    points, _ = points_near(hole, 20, seed=9)
    together = hole.owners(points)
    assert [int(hole.owners(point)[0]) for point in points] == together.tolist()


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("far", [1e300, -1e300, 1.001e7, 1e160])
def test_find_contacts_refuses_points_that_are_nowhere(far: float, geometry: str) -> None:
    hole = hole_of([[0, 0, 0], [450, 90, 0]], geometry=geometry)
    with pytest.raises(InputError) as caught:
        find_contacts(hole, [[0.0, 0.0, 10.0], [0.0, far, 0.0]], 0.05)
    expected = f"points[1][1] = {far!r}: expected a point within 1e+07 m of the origin, north, east and down"
    assert str(caught.value) == expected


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_find_contacts_far_from_the_hole(geometry: str) -> None:
    """As far as it answers: beside a vertical hole the distance is the coordinate's."""
    hole = hole_of([[0, 0, 0], [450, 0, 0]], geometry=geometry)
    hits = find_contacts(hole, [[0.0, 1e7, 100.0], [-1e7, 0.0, 200.0]], 0.05)
    np.testing.assert_allclose(hits.penetration, 1e7 - (0.10795 - 0.05), rtol=1e-15)
    np.testing.assert_allclose(hits.normal, [[0, 1, 0], [-1, 0, 0]], atol=1e-12)
    np.testing.assert_allclose(hits.md, [100, 200])


def test_find_contacts_on_ten_thousand_points() -> None:
    rng = np.random.default_rng(7)
    turns = list(zip(rng.uniform(0, 25, 10), rng.uniform(-60, 60, 10), strict=True))
    hole = hole_of(random_well(turns), geometry="arcs")
    points, md = points_near(hole, 10_000, seed=8)
    hits = find_contacts(hole, points, np.full(10_000, 0.03))
    near = np.linalg.norm(points - hole.at(md)[0], axis=1) - (0.10795 - 0.03)
    np.testing.assert_allclose(hits.penetration, near, atol=1e-9)
    np.testing.assert_allclose(hits.md, md, atol=1e-7)


def test_for_loop_agrees_below_ninety_degrees_and_errs_beyond() -> None:
    """The slab of a cylinder is infinite sideways: past 90 degrees the FOR-loop takes the wrong one."""
    for last, wrong in ((85.0, False), (120.0, True)):
        hole = hole_of([[0, 0, 0], [100, 0, 0], [550, last, 0], [1100, last, 0]], cylinder_length=2.0)
        points, _ = points_near(hole, 2000, seed=3)
        assert (for_loop_owners(hole.pieces, points) != hole.owners(points)).any() == wrong


@pytest.mark.parametrize(
    ("points", "radii", "message"),
    [
        ([[0, 0, np.nan]], 0.1, "points[0][2] = nan: expected a point within 1e+07 m"),
        ([[0, 0]], 0.1, "points = (1, 2): expected three numbers a point, (n, 3)"),
        ([[[0, 0, 5]]], 0.1, "points = (1, 1, 3): expected three numbers"),
        ("a point", 0.1, "points = str: expected numbers in metres"),
        ([[0, 0, 5]], np.inf, "radii[0] = inf: expected a contact radius in metres, from 0 to the 0.108 m"),
        ([[0, 0, 5], [0, 0, 6]], [0.1, np.nan], "radii[1] = nan"),
        ([[0, 0, 5]], 84.0, "radii[0] = 84.0: expected a contact radius in metres, from 0 to the 0.108 m of the hole"),
        ([[0, 0, 5]], -0.084, "radii[0] = -0.084"),
        ([[0, 0, 5]], [0.1, 0.2], "radii = (2,): expected one radius, or one for each of 1 points"),
    ],
)
def test_bad_queries_are_refused(points: list, radii: float | list[float], message: str) -> None:
    with pytest.raises(InputError) as caught:
        find_contacts(hole_of([[0, 0, 0], [100, 0, 0]]), points, radii)
    assert message in str(caught.value)


def test_a_case_is_no_hole() -> None:
    case = make_case([[0, 0, 0], [100, 0, 0]])
    for wrong, named in ((case, "Case"), ("my_well.toml", "str")):
        with pytest.raises(InputError, match=f"wellbore = {named}: expected the hole of a case, as build_wellbore"):
            find_contacts(wrong, [[0, 0, 5]], 0.1)
