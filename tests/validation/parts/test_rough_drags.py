"""Drags through rough holes notice a wall that is elsewhere and a normal that jumps; the engine's have neither."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics import contact, sampled
from validation.parts.rough_drags import ALLOWED, BEYOND, Drag, Rough, drag, judged, rough_case, sharpest_turn


@cache
def rough(seed: int) -> Rough:
    return judged(rough_case(np.random.default_rng([23, seed])))


def dragged(made: Rough) -> Drag:
    return drag(made, 200, np.random.default_rng(1))


def changed(made: Rough, rows: slice, columns: slice | int, change: float) -> Rough:
    """A hole whose table differs from what judges it."""
    pieces: Array = made.hole.pieces.copy()
    pieces[rows, columns] += change
    return made._replace(hole=replace(made.hole, pieces=pieces))


@pytest.mark.slow
def test_no_point_leaves_a_rough_hole_or_jumps() -> None:
    found = dragged(rough(7))
    assert found.wrong_wall.max() < ALLOWED
    assert found.beyond.max() < BEYOND
    assert np.mean(np.abs(found.beyond) < 1e-3) > 0.8  # pressed against the wall
    assert sharpest_turn(rough(7), np.random.default_rng(2)) < 0.05


def test_a_wider_hole_and_another_wall_are_noticed() -> None:
    made = rough(7)
    half = slice(len(made.hole.pieces) // 2, None)
    assert dragged(changed(made, half, contact.HOLE_RADIUS, 0.01)).wrong_wall.max() > ALLOWED
    own = sampled.TABLES + 1 + sampled.PER_CELL * int(made.hole.pieces[:, sampled.AROUND_CELLS].max()) + 1
    assert (dragged(changed(made, half, slice(own, None, sampled.PER_CELL), 0.02)).wrong_wall > ALLOWED).sum() > 10


def test_a_jump_at_the_border_of_cells_is_noticed() -> None:
    """Cells that lie 5° farther around than those above them."""
    made = rough(7)
    pieces, angle = made.hole.pieces.copy(), np.radians(5.0)
    half = slice(len(pieces) // 2, None)
    cosine, sine = pieces[half, sampled.TURN_COS].copy(), pieces[half, sampled.TURN_SIN].copy()
    pieces[half, sampled.TURN_COS] = cosine * np.cos(angle) - sine * np.sin(angle)
    pieces[half, sampled.TURN_SIN] = sine * np.cos(angle) + cosine * np.sin(angle)
    turned = made._replace(hole=replace(made.hole, pieces=pieces))
    assert sharpest_turn(turned, np.random.default_rng(2)) > 1.0
