"""Positions from stations, against exact curves and published survey calculations."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.surveys.reading import read_survey
from fctd.case.surveys.stations import to_radians
from fctd.model import survey
from validation.harness.study import data_folder


def test_average_angle_is_the_paper_eqs_21_to_23() -> None:
    stations = to_radians(np.array([[0, 0, 0], [100, 10, 30], [200, 30, 60.0]]))
    a1, a2 = np.radians(5), np.radians(20)
    e1, e2 = np.radians(15), np.radians(45)
    first = 100 * np.array([np.sin(a1) * np.cos(e1), np.sin(a1) * np.sin(e1), np.cos(a1)])
    second = 100 * np.array([np.sin(a2) * np.cos(e2), np.sin(a2) * np.sin(e2), np.cos(a2)])
    expected = [np.zeros(3), first, first + second]
    np.testing.assert_allclose(survey.average_angle(stations), expected, rtol=1e-14)


def test_angles_between_stations_by_hand() -> None:
    stations = np.array([[0, 0.1, 6.0], [100, 0.3, 6.4], [300, 0.2, 6.8]])
    found = survey.interpolate_angles(stations, np.array([0.0, 25.0, 100.0, 250.0]))
    expected = [[0, 0.1, 6.0], [25, 0.15, 6.1], [100, 0.3, 6.4], [250, 0.225, 6.7]]
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_minimum_curvature_is_exact_on_a_circle() -> None:
    radius = 286.479
    md = np.linspace(0, radius * np.pi / 2, 7)
    stations = np.stack([md, md / radius, np.full(7, 0.6)], axis=1)
    courses = survey.minimum_curvature(stations)
    at = np.linspace(0, md[-1], 41)
    points, tangents = survey.along_courses(courses, at)
    angle = at / radius
    across = radius * (1 - np.cos(angle))
    expected = np.stack([across * np.cos(0.6), across * np.sin(0.6), radius * np.sin(angle)], axis=1)
    np.testing.assert_allclose(points, expected, atol=1e-9)
    np.testing.assert_allclose(tangents[:, 2], np.cos(angle), atol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0, 3.0])
def test_a_bend_of_any_size_ends_where_its_circle_does(angle: float) -> None:
    """A bend in a vertical plane: L (1 − cos α)/α aside and L sin α/α ahead, as series where α² is lost."""
    stations = np.array([[0, 0.02, 0.0], [100, 0.02 + angle, 0.0], [200, 0.02 + angle, 0.0]])
    aside, ahead = (0.5 * angle, 1.0) if angle < 1e-8 else (np.sin(0.5 * angle) ** 2 * 2 / angle, np.sin(angle) / angle)
    expected = 100 * np.array(
        [ahead * np.sin(0.02) + aside * np.cos(0.02), 0, ahead * np.cos(0.02) - aside * np.sin(0.02)]
    )
    courses = survey.minimum_curvature(stations)
    np.testing.assert_allclose(courses.start[1], expected, rtol=1e-13, atol=1e-12)
    np.testing.assert_allclose(survey.along_courses(courses, np.array([100.0]))[0][0], expected, rtol=1e-13, atol=1e-12)


def test_straight_courses_each_have_a_normal_of_their_own() -> None:
    stations = to_radians(np.array([[0, 0, 0], [100, 0, 0], [200, 45, 60], [300, 45, 60], [400, 45, 60.0]]))
    courses = survey.minimum_curvature(stations)
    np.testing.assert_allclose(np.linalg.norm(courses.normal, axis=1), 1.0, rtol=1e-14)
    np.testing.assert_allclose((courses.normal * courses.tangent).sum(axis=1), 0.0, atol=1e-12)
    # A straight course is as long as its stations are apart, exactly.
    assert courses.start[1].tolist() == [0.0, 0.0, 100.0]


def test_above_its_first_station_a_hole_is_straight() -> None:
    courses = survey.minimum_curvature(to_radians(np.array([[0, 10, 30], [100, 30, 30], [200, 50, 90.0]])))
    md = np.array([-20.0, -0.5, 0.0])
    points, directions = survey.along_courses(courses, md)
    np.testing.assert_allclose(points, np.outer(md, courses.tangent[0]), atol=1e-12)
    np.testing.assert_allclose(directions, np.tile(courses.tangent[0], (3, 1)), rtol=1e-14)


def test_both_methods_converge_to_each_other() -> None:
    """On a smooth 3D curve the two methods differ by the square of the station spacing."""

    def end(spacing: float) -> np.ndarray:
        md = np.arange(0, 1000 + 1e-9, spacing)
        stations = np.stack([md, 0.2 + md / 1000, 2.0 + md / 500], axis=1)
        curved = survey.along_courses(survey.minimum_curvature(stations), md[-1:])[0][0]
        return np.linalg.norm(survey.average_angle(stations)[-1] - curved)

    assert np.log2(end(50) / end(25)) == pytest.approx(2, abs=0.1)


def test_azimuth_runs_through_north_the_short_way() -> None:
    stations = to_radians(np.array([[0, 60, 350], [100, 60, 10.0]]))
    assert np.degrees(stations[1, 2]) == pytest.approx(370)
    assert survey.average_angle(stations)[-1, 1] == pytest.approx(0, abs=1e-12)


@given(st.floats(0, 3.1), st.floats(-3, 3), st.floats(1e-12, 3))
def test_dogleg_keeps_its_precision_at_small_angles(inclination: float, azimuth: float, change: float) -> None:
    stations = np.array([[0, inclination, azimuth], [10, abs(inclination - change), azimuth]])
    expected = abs(stations[1, 1] - inclination)
    assert survey.dogleg(stations)[0] == pytest.approx(expected, rel=1e-6, abs=1e-15)


@pytest.mark.parametrize("azimuth", [0.0, 45.0, 90.0, 180.0, 270.0])
@pytest.mark.parametrize("inclination", [0.0, 45.0, 90.0, 180.0])
def test_a_straight_course_has_a_normal_too(inclination: float, azimuth: float) -> None:
    stations = to_radians(np.array([[0, inclination, azimuth], [100, inclination, azimuth]]))
    courses = survey.minimum_curvature(stations)
    assert np.linalg.norm(courses.normal[0]) == pytest.approx(1.0, abs=1e-12)
    assert courses.normal[0] @ courses.tangent[0] == pytest.approx(0.0, abs=1e-12)
    points, tangents = survey.along_courses(courses, np.array([-5.0, 0.0, 60.0, 100.0, 120.0]))
    np.testing.assert_allclose(tangents, np.tile(survey.tangents(stations)[0], (5, 1)), atol=1e-12)
    np.testing.assert_allclose(points, np.outer([-5, 0, 60, 100, 120], tangents[0]), atol=1e-10)


@pytest.mark.parametrize(("inclination", "azimuth"), [(90, 0), (82, 145)])
def test_opposite_directions_have_no_arc(inclination: float, azimuth: float) -> None:
    """In the second pair half the difference of the tangents is longer than one, by rounding."""
    back = [100, 180 - inclination, azimuth + 180]
    stations = np.radians(np.array([[-10, inclination, azimuth], [0, inclination, azimuth], back]))
    assert survey.dogleg(stations)[1] == pytest.approx(np.pi)
    with pytest.raises(ValueError, match="opposite directions at station 2"):
        survey.minimum_curvature(stations)
    stations[2, 2] -= 1e-3
    assert np.isfinite(survey.minimum_curvature(stations).start).all()


needs_data = pytest.mark.skipif(data_folder() is None, reason="public data folder is missing (see docs/claims.md)")


@needs_data
def test_published_reference_well() -> None:
    """North, east and vertical depth as the ISCWSA publishes them."""
    points, table = computed("iscwsa_reference_well.csv")
    np.testing.assert_allclose(points, table[["tvd_m", "north_m", "east_m"]].to_numpy()[:, [1, 2, 0]], atol=0.01)


@needs_data
def test_published_horizontal_well() -> None:
    """Vertical depth as published; north and east are map coordinates, all true distances times one scale."""
    points, table = computed("wellpathpy_well9_horizontal_reference.csv")
    np.testing.assert_allclose(points[:, 2], 0.3048 * table["TVD ( ft )"], atol=0.01)
    grid = table[["Northing ( m )", "Easting ( m )"]].to_numpy()
    grid = grid - grid[0]
    scale = (grid * points[:, :2]).sum() / (points[:, :2] ** 2).sum()
    assert 0.9996 <= scale < 1  # the range of a transverse Mercator grid
    np.testing.assert_allclose(scale * points[:, :2], grid, atol=0.01)


def computed(name: str) -> tuple[np.ndarray, pd.DataFrame]:
    """Positions by minimum curvature, and the published table."""
    folder = data_folder()
    assert folder is not None
    stations = read_survey(folder / "surveys" / name).stations
    points, _ = survey.along_courses(survey.minimum_curvature(stations), stations[:, 0])
    return points, pd.read_csv(folder / "surveys" / name)
