"""The hole: its axis, sizes, ends and overlaps; points that are asked about stand in test_wellbore_contacts."""

import time
import tracemalloc
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from fctd import find_contacts
from fctd.case.errors import InputError
from fctd.case.surveys.stations import to_radians
from fctd.mechanics import contact
from fctd.model import survey, wellbore
from fctd.model.frames import hole_frame
from tests.cases import hole_of


def test_angles_count_from_the_high_side_clockwise_looking_downhole() -> None:
    """A level hole to the north: up is the high side, east is on the right."""
    hole = hole_of([[0, 90, 0], [1000, 90, 0]], geometry="arcs")
    points = hole.off_axis(np.full(2, 500.0), np.radians([0.0, 90.0]), np.array([0.1, 0.2]))
    np.testing.assert_allclose(points, [[500, 0, -0.1], [500, 0.2, 0]], atol=1e-9)


def test_the_high_side_of_a_hole_to_the_east() -> None:
    """At 45 degrees it leans back and up; a hole counts as vertical up to a tenth of a degree."""
    tilt = np.radians([45.0, 0.09, 0.11, 0.0])
    direction = np.stack([np.zeros(4), np.sin(tilt), np.cos(tilt)], axis=1)
    high, right = hole_frame(direction)
    back = np.stack([np.zeros(4), np.cos(tilt), -np.sin(tilt)], axis=1)
    north = np.array([1.0, 0.0, 0.0])
    np.testing.assert_allclose(high, [back[0], north, back[2], north], atol=1e-12)
    np.testing.assert_allclose(right, np.cross(direction, high), atol=1e-12)


def test_the_axis_at_one_depth_and_at_a_joint() -> None:
    """The tangent at a joint is that of the cylinder below."""
    stations = [[0, 0, 0], [100, 60, 0]]
    for hole in (hole_of(stations, geometry="arcs"), hole_of(stations, cylinder_length=10.0)):
        for one, many in zip(hole.at(35.0), hole.at(np.array([35.0])), strict=True):
            np.testing.assert_array_equal(one, many)
    np.testing.assert_allclose(hole.at(hole.md)[1], hole.directions)
    np.testing.assert_allclose(hole.at(hole.md)[0], hole.points)


@pytest.mark.parametrize("inclination", [0.0, 180.0])
def test_inclination_of_a_tangent_that_is_too_long_by_rounding(inclination: float) -> None:
    hole = hole_of([[0, inclination, 0], [100, inclination, 0]])
    longer = replace(hole, directions=hole.directions * np.nextafter(1.0, 2.0))
    assert abs(longer.directions[0, 2]) > 1.0
    np.testing.assert_allclose(longer.inclination(np.array([50.0])), np.radians(inclination), atol=1e-12)


def test_the_stiffest_wall_of_several() -> None:
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.1, "stiffness": 2e7},
        {"to_md": 1000, "diameter": 0.22, "friction": 0.3},
    ]
    assert hole_of([[0, 0, 0], [1000, 0, 0]], intervals=intervals).stiffest_wall == 2e7


def test_cylinder_length_follows_the_chord_tolerance() -> None:
    hole = hole_of([[0, 0, 0], [450, 90, 0]], chord_tolerance=0.002)
    length = np.diff(hole.md).max()
    assert length**2 / (8 * 450 / (np.pi / 2)) == pytest.approx(0.002, rel=0.02)


@pytest.mark.parametrize(("geometry", "station"), [("cylinders", 505.0), ("arcs", 505.0), ("arcs", 500.1)])
def test_the_wall_leads_from_one_size_of_hole_to_the_next(geometry: str, station: float) -> None:
    """At a shoe nothing jumps: radius, stiffness and friction change over the length of the overlap."""
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.1, "stiffness": 2e7},
        {"to_md": 1000, "diameter": 0.22, "friction": 0.3},
    ]
    stations = [[0, 0, 0], [station, 5, 0], [1000, 40, 0]]
    hole = hole_of(stations, intervals=intervals, geometry=geometry, overlap=0.2, chord_tolerance=1e-5)
    md = np.linspace(499.9, 500.3, 401)
    axis, direction = hole.at(md)
    walls = hole.walls(axis + 0.05 * hole_frame(direction)[1])
    share = np.clip((md - 500) / 0.2, 0, 1)
    np.testing.assert_allclose(walls.radius, 0.16 - 0.05 * share, atol=1e-4)
    np.testing.assert_allclose(walls.stiffness, 2e7 - 1e7 * share, rtol=1e-3)
    np.testing.assert_allclose(walls.friction, 0.1 + 0.2 * share, atol=1e-3)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_the_hole_runs_on_beyond_both_ends(geometry: str) -> None:
    hole = hole_of([[0, 0, 0], [500, 0, 0], [800, 45, 30]], geometry=geometry)
    md = np.array([-200.0, -25.0, -5.0, 805.0, 825.0, 900.0])
    hits = find_contacts(hole, hole.at(md)[0], 0.02)
    np.testing.assert_allclose(hits.penetration, 0.02 - 0.10795, atol=1e-9)
    np.testing.assert_allclose(hits.md, md, atol=1e-6)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_the_hole_runs_on_straight_from_bent_ends(geometry: str) -> None:
    """Beyond surface and total depth there is no more bend: 9 m of it would be 70 mm off."""
    hole = hole_of([[0, 10, 30], [300, 40, 30], [600, 40, 120]], geometry=geometry, chord_tolerance=1e-5, overlap=0.05)
    beyond = np.array([-9.0, -2.0, 2.0, 9.0])
    ends = hole.at(np.array([0.0, 0.0, 600.0, 600.0]))[0]
    tangent = survey.tangents(np.radians([[0, 10, 30], [0, 10, 30], [0, 40, 120], [0, 40, 120]]))
    hits = find_contacts(hole, ends + beyond[:, None] * tangent, 0.02)
    slack = 1e-9 if geometry == "arcs" else 3e-3  # a cylinder's axis leads off by half of its own turn
    np.testing.assert_allclose(hits.penetration, 0.02 - 0.10795, atol=slack)
    np.testing.assert_allclose(hits.md, beyond + np.array([0, 0, 600, 600]), atol=1e-3)


def test_the_axis_within_the_first_and_the_last_cylinder() -> None:
    hole = hole_of([[0, 0, 0], [100, 60, 0]], cylinder_length=10.0)
    points, directions = hole.at(np.array([0.0, 5.0, 95.0, 100.0]))
    np.testing.assert_allclose(points[[0, 3]], hole.points[[0, -1]], atol=1e-2)
    for k, i in ((1, 0), (2, -2)):
        chord = hole.points[i + 1] - hole.points[i]
        np.testing.assert_allclose(directions[k], chord / np.linalg.norm(chord), atol=1e-12)
        np.testing.assert_allclose(points[k], hole.points[i] + 5.0 * directions[k], atol=1e-9)


def test_stations_a_hair_apart_have_a_cylinder_between_them() -> None:
    hole = hole_of(
        [[0, 0, 0], [100, 0, 0]],
        intervals=[
            {"to_md": 50, "diameter": 0.3, "friction": 0.1},
            {"to_md": 50 + 1e-8, "diameter": 0.25, "friction": 0.1},
            {"to_md": 100, "diameter": 0.2, "friction": 0.3},
        ],
    )
    np.testing.assert_allclose(hole.md, [0, 25, 50, 50 + 1e-8, 75 + 5e-9, 100], rtol=1e-12)


@pytest.mark.parametrize("end", [np.nextafter(891.0, 0.0), 891.0 - 1e-9])
def test_an_interval_that_ends_at_a_station_but_for_rounding_has_no_cylinder_of_its_own(end: float) -> None:
    """Feet for metres are such an end: between it and the station lies no length that has a direction."""
    stations = [[0, 0, 0], [528, 46.3, 102.0], [891.0, 39.4, 105.6]]
    interval = {"diameter": 0.1524, "friction": 0.0}
    rounded, exact = (hole_of(stations, intervals=[{"to_md": md, **interval}]) for md in (end, 891.0))
    np.testing.assert_allclose(rounded.directions, exact.directions, atol=1e-9)
    assert np.degrees(rounded.inclination(np.array([895.0]))[0]) == pytest.approx(39.4, abs=0.1)


def test_cylinders_of_straight_hole_are_no_longer_than_thirty_metres() -> None:
    np.testing.assert_allclose(np.diff(hole_of([[0, 0, 0], [1000, 0, 0]]).md), 1000 / 34)


def test_the_wall_along_the_hole_by_hand() -> None:
    """A row at each interval's end and one at the end of the shoe that leads into the next."""
    intervals = [
        {"to_md": 500, "diameter": 0.32, "friction": 0.1, "stiffness": 2e7},
        {"to_md": 500.1, "diameter": 0.3, "friction": 0.2},
        {"to_md": 1000, "diameter": 0.22, "friction": 0.3},
    ]
    hole = hole_of([[0, 0, 0], [1000, 0, 0]], intervals=intervals, overlap=0.2)
    expected = [
        [500, 0.16, 2e7, 0.1],
        [500.1, 0.15, 1e7, 0.2],  # the second interval is shorter than its shoe
        [500.1, 0.15, 1e7, 0.2],
        [500.3, 0.11, 1e7, 0.3],
    ]
    np.testing.assert_allclose(hole.wall_along()[:, :4], expected)
    intervals[1]["to_md"] = 700
    hole = hole_of([[0, 0, 0], [1000, 0, 0]], intervals=intervals, overlap=0.2)
    np.testing.assert_allclose(hole.wall_along()[:, 0], [500, 500.2, 700, 700.2])
    np.testing.assert_allclose(hole.wall_along()[:, 1], [0.16, 0.15, 0.15, 0.11])
    alone = hole_of([[0, 0, 0], [1000, 0, 0]])
    np.testing.assert_allclose(alone.wall_along(), [[1000, 0.10795, 1e7, 0.2, 0, 0, 0, 0.2]])
    alone.wall_along()[:] = 0.0
    np.testing.assert_allclose(alone.intervals, [[1000, 0.10795, 1e7, 0.2, 0, 0, 0, 0.2]])


@pytest.mark.parametrize(("length", "overlap"), [(0.999, 0.0), (1.0, 0.1), (np.nan, 0.0)])
def test_pieces_that_do_not_cover_the_hole_are_a_defect(length: float, overlap: float) -> None:
    hole = hole_of([[0, 0, 0], [100, 0, 0], [200, 30, 0]], cylinder_length=5.0)
    pieces = hole.pieces.copy()
    pieces[:, contact.LENGTH] *= length
    pieces[:, contact.OVERLAP] += overlap
    with pytest.raises(AssertionError, match=r"the pieces of the hole cover (19|nan).* m of an axis of 199\.99"):
        replace(hole, pieces=pieces)
    moved = hole.md.copy()
    moved[3] += 1.0  # the next chord alone is too long
    for md in (0.999 * hole.md, moved):
        with pytest.raises(AssertionError, match="the axis of the hole is longer than its measured depth"):
            replace(hole, md=md)


def test_overlap_longer_than_a_cylinder_is_refused() -> None:
    """The shortest cylinder counts, here that of the bend: √(8 × 10 µm / (40°/100 m)) = 0.107 m."""
    with pytest.raises(InputError, match=r"wellbore\.overlap.*0\.2 m.*at most the length of a cylinder, here 0\.107 m"):
        hole_of([[0, 0, 0], [100, 0, 0], [200, 40, 0]], chord_tolerance=1e-5, overlap=0.2)
    assert len(hole_of([[0, 0, 0], [100, 5, 0]], cylinder_length=2.0, overlap=2.0).pieces) == 50
    with pytest.raises(InputError, match=r"wellbore\.overlap.*3 m.*at most the length of a cylinder"):
        hole_of([[0, 0, 0], [100, 5, 0]], cylinder_length=2.0, overlap=3.0)


def test_no_more_cylinders_than_fit_into_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(wellbore, "MOST_CYLINDERS", 50)
    assert len(hole_of([[0, 0, 0], [100, 5, 0]], cylinder_length=2.0).pieces) == 50
    with pytest.raises(InputError, match=r"wellbore\.cylinder_length.*51 cylinders.*at most 50 cylinders"):
        hole_of([[0, 0, 0], [100, 5, 0]], cylinder_length=1.99)


@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_the_deepest_well_takes_little_time_and_memory(geometry: str) -> None:
    """50 km in 200,000 cylinders, the last interval without end; a search from anywhere in a fraction of a second."""
    tracemalloc.start()
    began = time.process_time()
    hole = hole_of(
        [[0, 0, 0], [1000, 0, 0], *([float(md), 60.0, md / 500 % 360] for md in range(2000, 50_001, 500))],
        intervals=[{"to_md": 1e300, "diameter": 0.2, "friction": 0.2}], geometry=geometry,
        **({} if geometry == "arcs" else {"cylinder_length": 0.25}),
    )  # fmt: skip
    points = hole.at(np.linspace(0.0, 50_000.0, 1000))[0]
    md = find_contacts(hole, points, 0.05).md
    seconds, (_, peak) = time.process_time() - began, tracemalloc.get_traced_memory()
    tracemalloc.stop()
    np.testing.assert_allclose(md, np.linspace(0.0, 50_000.0, 1000), atol=0.01)
    assert peak < 300e6
    assert seconds < 10


def test_stations_that_no_arc_joins_are_refused() -> None:
    with pytest.raises(InputError, match=r"wellbore\.stations\[2\] = .*which is the opposite"):
        hole_of([[0, 0, 0], [500, 90, 0], [501, 90, 180]])


def test_average_angle_hole_follows_interpolated_angles() -> None:
    """Two build stations only: the hole is refined between them, where bare Eqs 21–23 err by metres."""
    stations = [[0, 0, 0], [500, 90, 0]]
    radius = 500 / (np.pi / 2)
    fine = hole_of(stations, survey_method="average_angle", cylinder_length=1.0)
    bare = survey.average_angle(to_radians(np.array(stations, dtype=float)))[-1]
    assert fine.points[-1, 2] == pytest.approx(radius, abs=0.01)
    assert abs(bare[2] - radius) > 10


SHOES = [
    {"to_md": 200.0, "diameter": 0.3112, "friction": 0.2},
    {"to_md": 500.05, "diameter": 0.25, "friction": 0.3, "stiffness": 3e7},
    {"to_md": 500.1, "diameter": 0.24, "friction": 0.1},  # shorter than the overlap
    {"to_md": 900.0, "diameter": 0.2159, "friction": 0.25},
]


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("factors", [0.4, [0.1, 0.5, 0.0, 0.3]])
def test_another_friction_is_the_hole_that_a_fresh_build_gives(geometry: str, factors: float | list[float]) -> None:
    stations = [[0, 0, 350], [100, 0, 350], [400, 60, 10], [700, 80, 60], [900, 80, 60]]
    here = hole_of(stations, geometry=geometry, intervals=SHOES)
    before = here.pieces.copy()
    each = np.broadcast_to(factors, len(SHOES)).tolist()
    intervals = [interval | {"friction": factor} for interval, factor in zip(SHOES, each, strict=True)]
    fresh, found = hole_of(stations, geometry=geometry, intervals=intervals), here.with_friction(factors)
    for name in ("pieces", "md", "points", "directions", "intervals"):
        assert getattr(found, name).tobytes() == getattr(fresh, name).tobytes(), name
    assert found.wall_along().tobytes() == fresh.wall_along().tobytes()
    assert found.points is here.points
    with pytest.raises(FrozenInstanceError):
        here.pieces = found.pieces
    assert here.pieces.tobytes() == before.tobytes()
    assert (found.pieces[:, contact.FACTOR] != before[:, contact.FACTOR]).any()
