"""The exact planar bend."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.surveys.stations import to_radians
from fctd.model import survey
from references.beams.planar_hole import PlanarHole

STATIONS = to_radians(np.array([[0, 0, 0], [32, 0, 0], [50, 36, 0], [70, 20, 0], [90, 80, 0]], dtype=float))


@given(st.floats(1.0, 88.0), st.floats(-0.5, 0.5))
def test_coordinates_of_a_point_near_the_axis_are_recovered(md, offset):
    hole = PlanarHole(STATIONS)
    (point,), (tangent,) = survey.along_courses(survey.minimum_curvature(STATIONS), np.array([md]))
    along = np.array([tangent[2], tangent[0]])
    normal = np.array([-along[1], along[0]])
    axis = hole.axis(np.array([point[2], point[0]]) + offset * normal)
    assert axis.offset == pytest.approx(offset, abs=1e-9)
    assert axis.md == pytest.approx(md, abs=1e-8)
    assert axis.tangent == pytest.approx(along, abs=1e-9)
    assert axis.normal == pytest.approx(normal, abs=1e-9)


def test_points_of_the_axis_lie_on_it_at_their_depth():
    hole, md = PlanarHole(STATIONS), np.array([0.0, 20.0, 32.0, 41.0, 50.0, 63.0, 90.0, 95.0])
    points, inclination = hole.at(md)
    axis = hole.axis(points)
    assert axis.offset == pytest.approx(0.0, abs=1e-9)
    assert axis.md == pytest.approx(md, abs=1e-9)
    assert np.stack([np.cos(inclination), np.sin(inclination)]) == pytest.approx(axis.tangent, abs=1e-9)


@given(st.floats(33.0, 49.0), st.floats(-0.3, 0.3))
def test_normal_and_turn_are_derivatives_of_the_offset(md, offset):
    hole, h = PlanarHole(STATIONS), 1e-6
    angle = np.radians(2 * (md - 32))
    radius = 90 / np.pi
    point = np.array([32 + (radius - offset) * np.sin(angle), radius - (radius - offset) * np.cos(angle)])
    here = hole.axis(point)
    steps = h * np.eye(2)
    gradient = [(hole.axis(point + e).offset - hole.axis(point - e).offset) / (2 * h) for e in steps]
    assert gradient == pytest.approx(here.normal, abs=1e-8)
    turned = (hole.axis(point + h * here.tangent).tangent - hole.axis(point - h * here.tangent).tangent) / (2 * h)
    assert turned == pytest.approx(here.turn * here.normal, abs=1e-8)


@pytest.mark.parametrize(
    ("stations", "words"),
    [([[0, 0, 0], [30, 10, 0], [60, 20, 30]], "one azimuth"), ([[0, 0, 0], [100, 95, 0]], "90 deg")],
)
def test_holes_off_one_plane_or_past_90_degrees_are_refused(stations, words):
    with pytest.raises(ValueError, match=words):
        PlanarHole(to_radians(np.array(stations, dtype=float)))


def test_azimuths_0_and_360_are_the_same_plane():
    stations = STATIONS.copy()
    stations[3:, 2] = 2 * np.pi
    point = np.array([60.0, 5.0])
    assert PlanarHole(stations).axis(point).offset == PlanarHole(STATIONS).axis(point).offset
    stations[3:, 2] = np.radians(359.0)
    with pytest.raises(ValueError, match="one azimuth"):
        PlanarHole(stations)
