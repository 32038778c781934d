"""The wall stored beside every body by the stepper, against the geometry of the hole."""

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics import state, stored_walls
from fctd.mechanics.energy import penetration
from fctd.model.wellbore import Wellbore
from tests.bodies import AXIS, PLACE, TO_WALL, put
from tests.cases import hole_of

BEND = [[0, 0, 0], [300, 0, 0], [600, 60, 40], [1000, 95, 130]]
SHOE = [
    {"to_md": 500, "diameter": 0.3, "friction": 0.2, "stiffness": 2e7},
    {"to_md": 1000, "diameter": 0.2, "friction": 0.3},
]


def put_points(S: Array, points: Array, rng: np.random.Generator) -> None:
    """Bodies whose contact points are these, each with an axis and an arm of its own."""
    for j, point in enumerate(points, start=1):
        axis = rng.normal(size=3)
        axis /= np.linalg.norm(axis)
        arm = S[state.ARM_CONTACT + j] = rng.uniform(-3, 3)
        put(S, j, AXIS, axis)
        put(S, j, PLACE, point - arm * axis)


def pressed(hole: Wellbore, at: Array, radius: float) -> tuple[Array, Array]:
    """Force (n, 3) and energy (n,) of the walls beside points of a string, of a look-up in the table."""
    n, rng = len(at), np.random.default_rng(9)
    S, owner = state.new_state(n), np.zeros(n + 2, np.int64)
    state.row(S, state.RADIUS, n)[:], state.row(S, state.TRIBUTARY, n)[:] = radius, 2.0
    owner[1 : n + 1] = hole.owners(at)
    put_points(S, at, rng)
    stored_walls.update_walls(S, owner, n, (n + 7) // 8 * 8, hole.pieces, hole.geometry)
    depth, stiffness = np.maximum(penetration(S, n), 0.0), state.row(S, state.K_WALL, n)
    normal = np.stack([state.row(S, of, n) for of in TO_WALL], axis=1)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    return -(stiffness * depth)[:, None] * normal, 0.5 * stiffness * depth**2


def slopes_of_energy(hole: Wellbore, points: Array, radius: float, h: float = 1e-6) -> Array:
    """Central differences (n, 3) of the energy of the walls [N]."""
    ends = [(pressed(hole, points + d, radius)[1], pressed(hole, points - d, radius)[1]) for d in h * np.eye(3)]
    return np.column_stack([(ahead - behind) / (2 * h) for ahead, behind in ends])


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
@pytest.mark.parametrize("direction", [1, -1])
def test_bodies_carried_along_see_the_walls_that_free_points_see(geometry: str, direction: int) -> None:
    """Down or up through bends and a shoe, past both ends of the hole: in their pieces, overlaps and at the ends."""
    hole, n, rng = hole_of(BEND, geometry=geometry, intervals=SHOE), 11, np.random.default_rng(3)
    S, packed = state.new_state(n), 16
    share = rng.uniform(0.5, 3, n)
    state.row(S, state.TRIBUTARY, n)[:] = share
    angle, off = rng.uniform(0, 2 * np.pi, n), rng.uniform(0, 0.09, n)  # a wall that presses leans
    owner, followed = np.zeros(n + 2, np.int64), 0
    for k, travel in enumerate(np.arange(0.0, 110.0, 0.37)):
        md = np.linspace(-10.0, 920.0, n) + (travel if direction > 0 else 110 - travel)
        points = hole.off_axis(md, angle + 0.01 * k, off)
        put_points(S, points, rng)
        if k == 0:
            owner[1 : n + 1] = hole.owners(points)
        stored_walls.update_walls(S, owner, n, packed, hole.pieces, hole.geometry)
        expected = hole.walls(points, owner[1 : n + 1])
        found = np.stack([state.row(S, row, n) for row in (*TO_WALL, state.HOLE)], axis=1)
        np.testing.assert_allclose(found, np.column_stack(expected[:2]), atol=1e-11)
        np.testing.assert_allclose(state.row(S, state.K_WALL, n), expected.stiffness * share, rtol=1e-12)
        np.testing.assert_allclose(state.row(S, state.FRICTION, n), expected.friction, rtol=1e-12)
        np.testing.assert_allclose(expected.md, md, atol=0.02)
        followed += int((state.row(S, state.SLACK, n) > 0).sum())
    assert followed > 0.4 * n * (k + 1)  # most need no search


def test_the_force_of_a_wall_is_the_gradient_of_its_energy_at_seams() -> None:
    """Also along the hole, where two cylinders blend: −K d n of the stored wall against differences of ½ K d²."""
    hole, rng = hole_of(BEND, intervals=SHOE, overlap=0.4, chord_tolerance="5 mm"), np.random.default_rng(6)
    # Within every overlap, and in that of the shoe, where radius and stiffness change as well.
    md = np.concatenate([ends + share * 0.4 for ends in hole.md[1:-1] for share in rng.uniform(0.05, 0.95, (2, 1))])
    md = md[md < 990]
    hole_radius = np.where(md < 500, 0.15, np.where(md > 500.4, 0.1, 0.13))
    points = hole.off_axis(md, rng.uniform(0, 2 * np.pi, len(md)), hole_radius - 0.05 + rng.uniform(0.025, 0.04))
    force, energy = pressed(hole, points, 0.05)
    slopes = slopes_of_energy(hole, points, 0.05)
    assert (energy > 0).mean() > 0.9
    np.testing.assert_allclose(force, -slopes, atol=1e-5 * np.abs(force).max())
    along = np.abs(np.sum(force * hole.at(md)[1], axis=1)) / np.linalg.norm(force, axis=1)
    assert along.max() > 0.05  # at the shoe, 5 cm narrower in 40 and less stiff


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_the_distance_inside_a_piece_is_to_its_nearer_end(geometry: str) -> None:
    """On a straight piece in the middle of the hole, less the part that the piece above shares with it."""
    hole = hole_of([[0, 20, 0], [100, 20, 0], [110, 20, 0], [200, 20, 0]], geometry=geometry, overlap=0.2)
    shared = 0.2 if geometry == "cylinders" else 0.0  # with the piece above, which reaches so far into this one
    inside = hole.off_axis(np.array([105.0]), np.array([1.0]), np.array([0.05]))
    (middle,), (start, end) = hole.owners(inside), (100.0, 110.0)
    assert {start, end} <= set(hole.md)
    rng, S, owner = np.random.default_rng(4), state.new_state(1), np.array([0, middle, 0])
    for md in (105.0, 100.7, 109.6):
        for _ in range(2):  # the first puts the piece into the buffer
            put_points(S, hole.off_axis(np.array([md]), np.array([1.0]), np.array([0.05])), rng)
            stored_walls.update_walls(S, owner, 1, state.LANES, hole.pieces, hole.geometry)
        assert owner[1] == middle
        assert S[state.SLACK + 1] == pytest.approx(min(md - start - shared, end - md), abs=1e-6)
