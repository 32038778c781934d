"""The direction of the hole beside a point, by the table of arcs."""

import numpy as np

from fctd.mechanics import contact
from tests.cases import hole_of
from tests.compiled import kept

arc_direction = kept(contact.arc_direction)

BEND = [[0, 0, 0], [300, 0, 0], [600, 60, 40], [1000, 95, 130]]
RADIUS = 450 / (np.pi / 2)
QUARTER = [[0, 0, 0], [450, 90, 0]]


def test_the_direction_of_an_arc_is_the_tangent_of_its_circle() -> None:
    """A quarter of a circle in the x–z plane, beside its axis too."""
    hole = hole_of(QUARTER, geometry="arcs")
    for md, x_off, y_off in ((10.0, 0.0, 0.1), (200.0, 0.09, -0.05), (440.0, -0.1, 0.02)):
        angle = md / RADIUS
        x, z = RADIUS - (RADIUS + x_off) * np.cos(angle), (RADIUS + x_off) * np.sin(angle)
        i = int(hole.owners(np.array([[x, y_off, z]]))[0])
        found = arc_direction(hole.pieces, i, x, y_off, z)
        np.testing.assert_allclose(found, [np.sin(angle), 0, np.cos(angle)], atol=1e-12)


def test_the_direction_of_an_arc_is_that_of_the_survey_beside_its_axis_too() -> None:
    """In a hole that builds and turns: all points of a plane across the axis have the direction of the axis there."""
    hole, rng = hole_of(BEND, geometry="arcs"), np.random.default_rng(8)
    md = rng.uniform(0, 1000, 50)
    points, expected = hole.off_axis(md, rng.uniform(0, 2 * np.pi, 50), rng.uniform(0, 0.1, 50)), hole.at(md)[1]
    for i, point, direction in zip(hole.owners(points), points, expected, strict=True):
        np.testing.assert_allclose(arc_direction(hole.pieces, i, *point), direction, atol=1e-10)
