"""The query of free points has fast paths; its walls equal those of the table, point by point."""

import numpy as np
import pytest

from fctd import build_wellbore
from fctd.mechanics.contact import arc_owner, arc_wall, cylinder_owner, cylinder_wall
from fctd.mechanics.jit import entry
from fctd.mechanics.query import TOGETHER, WALL_COLUMNS
from fctd.mechanics.state import ARCS
from fctd.model.wellbore import Wellbore
from tests.cases import make_case

BEND = [[0, 0, 0], [300, 0, 0], [600, 60, 40], [1000, 95, 130]]
SHOE = [
    {"to_md": 500, "diameter": 0.3, "friction": 0.2, "rotational_friction": 0.1},
    {"to_md": 1000, "diameter": 0.2, "friction": 0.3, "rotational_friction": 0.25},
]


@entry
def from_table(C, geometry, points, owner, out):
    """Stages 2 and 3 as they are written, for one point after the other."""
    for j in range(len(points)):
        x, y, z = points[j, 0], points[j, 1], points[j, 2]
        if geometry == ARCS:
            owner[j] = arc_owner(C, owner[j], x, y, z)
            wall = arc_wall(C, owner[j], x, y, z)
        else:
            owner[j] = cylinder_owner(C, owner[j], x, y, z)
            wall = cylinder_wall(C, owner[j], x, y, z)
        for k, value in enumerate(wall):
            out[j, k] = value


def points_by_depth(hole: Wellbore, furthest: float, count: int) -> np.ndarray:
    """Points up to so far off the axis [m], also before the start and past the end of the hole."""
    rng = np.random.default_rng(5)
    md, angle = np.sort(rng.uniform(-30.0, 1030.0, count)), rng.uniform(0, 2 * np.pi, count)
    return hole.off_axis(md, angle, rng.uniform(0, furthest, count))


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("furthest", [0.15, 20.0])
@pytest.mark.parametrize("order", ["by depth", "shuffled"])
def test_short_cuts_answer_as_the_table_does(geometry, furthest, order):
    hole = build_wellbore(make_case(BEND, wellbore={"geometry": geometry, "intervals": SHOE}))
    rng, count = np.random.default_rng(6), 20 * TOGETHER
    points = points_by_depth(hole, furthest, count)
    if order == "shuffled":
        points = rng.permutation(points)
    guess = np.clip(hole.owners(points) + rng.integers(-1, 2, count), 0, len(hole.pieces) - 1)
    expected = np.empty((count, WALL_COLUMNS))
    from_table(hole.pieces, hole.geometry, points, guess.copy(), expected)
    found = np.column_stack(hole.walls(points, guess))
    assert np.ptp(expected[:, 3]) > 0.049  # both sizes of hole are met
    scale = np.array([1, 1, 1, 1, 1e7, 1, 1e3, 1])
    assert np.abs((found - expected) / scale).max() < 1e-13


@pytest.mark.parametrize(("degrees", "within"), [(90, 1e-12), (115, 1e-10), (170, 5e-8)])
def test_depth_along_one_long_arc(degrees, within):
    """Arc length against the arc tangent; the approximant is at its worst at the ends of an arc."""
    hole = build_wellbore(make_case([[0, 0, 0], [600, degrees, 0]], wellbore={"geometry": "arcs"}))
    radius, points = 600 / np.radians(degrees), points_by_depth(hole, 0.1, 500)
    angle = np.arctan2(points[:, 2], radius - points[:, 0])
    inside = (angle > 0) & (angle < np.radians(degrees))
    assert inside.sum() > 100
    assert hole.walls(points).md[inside] == pytest.approx(radius * angle[inside], abs=600 * within)
