"""The derrick above a hole: a first piece of either geometry along the tangent at the rotary table."""

import numpy as np
import pytest

from fctd import find_contacts
from fctd.mechanics import contact
from fctd.model.derrick import with_derrick
from fctd.model.frames import hole_frame
from tests.cases import hole_of

HEIGHT = 40.0
STATIONS = [[0, 20, 30], [100, 35, 60], [400, 35, 60]]
GEOMETRIES = [{"geometry": "cylinders"}, {"geometry": "arcs"}]


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_the_derrick_continues_the_tangent_without_friction(geometry: dict) -> None:
    bare = hole_of(STATIONS, **geometry)
    hole = with_derrick(bare, HEIGHT)
    md = np.array([-39.0, -12.0, -1e-3, 1e-3, 5.0, 50.0, 399.0])
    axis, tangent = hole.at(md)
    points = axis + 0.05 * hole_frame(tangent)[0]
    start = bare.at(np.zeros(1))
    np.testing.assert_allclose(axis[:3], start[0] + md[:3, None] * start[1], atol=1e-12)
    walls = hole.walls(points)
    np.testing.assert_allclose(walls.md, md, atol=2e-3)  # a chord's projection
    np.testing.assert_allclose(walls.radius, 0.10795, atol=1e-9)
    assert (walls.friction == [0, 0, 0, 0.2, 0.2, 0.2, 0.2]).all()
    np.testing.assert_allclose(np.linalg.norm(walls.offset, axis=1), 0.05, atol=3e-3)
    # Below the table the hole is as it was.
    below = find_contacts(hole, points[3:], 0.06)
    for found, wanted in zip(below, find_contacts(bare, points[3:], 0.06), strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-12)


@pytest.mark.parametrize("geometry", GEOMETRIES)
def test_the_pieces_add_up_and_meet_at_the_table(geometry: dict) -> None:
    hole = with_derrick(hole_of(STATIONS, **geometry), HEIGHT)
    first, second = hole.pieces[:2]
    assert second[contact.START_MD] == 0
    end = first[contact.START_MD] + first[contact.LENGTH]
    assert end == pytest.approx(0, abs=1e-9)
    np.testing.assert_allclose(second[:3], hole.at(np.zeros(1))[0][0], atol=1e-9)
    assert hole.derrick == HEIGHT


def test_a_hole_of_one_cylinder_has_a_derrick_too() -> None:
    hole = with_derrick(hole_of([[0, 0, 0], [25, 0, 0]], cylinder_length=30.0, chord_tolerance=None), HEIGHT)
    assert len(hole.pieces) == 2
    walls = hole.walls(np.array([[0.0, 0.0, -3.0], [0.0, 0.0, 3.0], [0.0, 0.0, 30.0]]))
    assert (walls.friction == [0, 0.2, 0.2]).all()
