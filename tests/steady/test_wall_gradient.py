"""The wall beside a point: its values against the stepper's, its gradients against central differences."""

import numpy as np
import pytest

from fctd.mechanics import contact, state, stored_walls
from fctd.mechanics.energy import penetration
from fctd.mechanics.jit import entry
from fctd.mechanics.state import ARCS, CYLINDERS
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.steady.wall_gradient import Beside, wall_beside
from tests.bodies import PLACE, TO_WALL, put
from tests.cases import make_case, pipe
from tests.compiled import kept

arc_wall, cylinder_wall = kept(contact.arc_wall), kept(contact.cylinder_wall)
BEND = [[0, 5, 10], [300, 40, 80], [600, 80, 40]]
# Quantities of ``Beside``: PT, how far beyond the hole's radius, stiffness, friction factors along and around the
# string, direction.
# Radii [m] of a string that is nowhere near the wall, and of one that mostly touches it.
APART, TOUCHING = -1.0, 0.15
PT, BEYOND, STIFFNESS, FACTOR, DIRECTION, AROUND = slice(0, 3), 3, 4, 5, slice(6, 9), 9
QUANTITIES = len(Beside._fields)


@entry
def fill_beside(C, i, geometry, x, y, z, radius, out):
    """Fill out (QUANTITIES, 4) : values and gradients of the quantities."""
    wall = wall_beside(C, i, geometry, x, y, z, radius)
    for k, quantity in enumerate(wall):
        for c in range(4):
            out[k, c] = quantity[c]


def beside(hole: Wellbore, i: int, point: np.ndarray, radius: float = APART) -> np.ndarray:
    out = np.empty((QUANTITIES, 4))
    fill_beside(hole.pieces, i, hole.geometry, *point, radius, out)
    return out


def bent(geometry: str) -> Wellbore:
    """A hole that builds and turns, with two sizes, stiffnesses and friction factors that meet in a long shoe."""
    intervals = [
        {"to_md": 300, "diameter": 0.3, "friction": 0.2, "rotational_friction": 0.1},
        {"to_md": 600, "diameter": 0.2159, "friction": 0.3, "rotational_friction": 0.35},
    ]
    wellbore = {"geometry": geometry, "intervals": intervals, "overlap": 0.5}
    return build_wellbore(make_case(BEND, [pipe(100, 5)], wellbore=wellbore))


def points(hole: Wellbore) -> list[tuple[int, np.ndarray]]:
    """Points along the hole with their pieces, many near its shoe and in overlaps."""
    rng = np.random.default_rng(5)
    md = np.concatenate([rng.uniform(5, 595, 60), 300 + np.linspace(-0.6, 0.6, 41)])
    found = hole.off_axis(md, rng.uniform(0, 2 * np.pi, len(md)), rng.uniform(0.02, 0.2, len(md)))
    return list(zip((int(i) for i in hole.owners(found)), found, strict=True))


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_it_is_the_wall_of_the_stepper(geometry: str) -> None:
    hole = bent(geometry)
    assert hole.geometry == {"cylinders": CYLINDERS, "arcs": ARCS}[geometry]
    wall = cylinder_wall if geometry == "cylinders" else arc_wall
    for i, point in points(hole):
        x, y, z, radius, stiffness, factor, _, around = wall(hole.pieces, i, *point)
        found = beside(hole, i, point)[:, 0]
        np.testing.assert_allclose(found[PT], [x, y, z], atol=1e-12)
        assert found[BEYOND] == pytest.approx(np.linalg.norm([x, y, z]) - radius, abs=1e-12)
        assert (found[STIFFNESS], found[FACTOR]) == pytest.approx((stiffness, factor), rel=1e-12)
        assert found[AROUND] == pytest.approx(around, rel=1e-12)


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_it_presses_as_the_wall_of_the_stepper(geometry: str) -> None:
    """A string that touches, also in overlaps and in the shoe, where the wall leans along the hole."""
    hole, leaning = bent(geometry), 0
    for i, point in points(hole):
        S, owner = state.new_state(1), np.array([0, i, 0])
        S[state.RADIUS + 1], S[state.TRIBUTARY + 1] = TOUCHING, 1.0
        put(S, 1, PLACE, point)
        stored_walls.update_walls(S, owner, 1, state.LANES, hole.pieces, hole.geometry)
        to_wall = np.array([S[row + 1] for row in TO_WALL])
        found = beside(hole, i, point, TOUCHING)[:, 0]
        np.testing.assert_allclose(found[PT] / np.linalg.norm(found[PT]), to_wall / np.linalg.norm(to_wall), atol=1e-9)
        assert found[BEYOND] + TOUCHING == pytest.approx(penetration(S, 1)[0], abs=1e-12)
        assert found[STIFFNESS] == pytest.approx(S[state.K_WALL + 1], rel=1e-12)
        leaning += int(
            penetration(S, 1)[0] > 0 and abs(found[PT] @ found[DIRECTION]) > 0.01 * np.linalg.norm(found[PT])
        )
    assert (leaning > 10) == (geometry == "cylinders")


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("radius", [APART, TOUCHING])
def test_gradients_are_those_of_central_differences(geometry: str, radius: float) -> None:
    hole, h, blended = bent(geometry), 1e-6, 0
    for i, point in points(hole):
        found = beside(hole, i, point, radius)
        scale = np.maximum(np.abs(found[:, :1]), 1.0)  # stiffnesses have some 1e7 N/m
        blended += int(np.abs(found[FACTOR, 1:]).max() > 0)
        for k, step in enumerate(h * np.eye(3)):
            ahead, behind = beside(hole, i, point + step, radius), beside(hole, i, point - step, radius)
            slope = (ahead[:, 0] - behind[:, 0]) / (2 * h)
            np.testing.assert_allclose(found[:, 1 + k] / scale[:, 0], slope / scale[:, 0], atol=3e-8)
    assert blended > 10


def test_beyond_the_ends_of_an_arc_its_sizes_no_longer_change() -> None:
    """The hole keeps the sizes of that end, as the stepper has it: without gains beyond, with gains within."""
    hole = bent("arcs")
    (i,) = np.flatnonzero(hole.pieces[:, contact.RADIUS_GAIN])
    md, length = hole.pieces[i, contact.START_MD], hole.pieces[i, contact.LENGTH]
    for depth, changes in ((md - 0.1, False), (md + 0.5 * length, True), (md + length + 0.1, False)):
        point = hole.off_axis(np.array([depth]), np.array([0.7]), np.array([0.08]))[0]
        found = beside(hole, i, point)
        assert found[FACTOR, 1:].any() == changes
        h = 1e-6
        for k, step in enumerate(h * np.eye(3)):
            slope = (beside(hole, i, point + step)[BEYOND, 0] - beside(hole, i, point - step)[BEYOND, 0]) / (2 * h)
            assert found[BEYOND, 1 + k] == pytest.approx(slope, abs=1e-8)


def test_the_direction_of_cylinders_turns_evenly_in_their_overlap() -> None:
    """Along a cylinder its own; in the overlap from its own to the next one's, a unit vector throughout."""
    hole, i = bent("cylinders"), 20
    here, following = hole.pieces[i : i + 2, contact.DIRECTION : contact.DIRECTION + 3]
    start, length = hole.pieces[i, contact.START : contact.START + 3], hole.pieces[i, contact.LENGTH]
    shared = hole.pieces[i, contact.OVERLAP]
    assert shared == pytest.approx(0.5)
    for share in (-5.0, -1e-6, 0.25, 0.5, 1.0):
        blend = here + max(share, 0.0) * (following - here)
        found = beside(hole, i, start + (length - shared * (1 - share)) * here)[DIRECTION, 0]
        np.testing.assert_allclose(found, blend / np.linalg.norm(blend), atol=1e-12)
