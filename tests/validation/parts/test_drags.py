"""Drags through random bends notice a hole with a gap, and find none in the engine's."""

from dataclasses import replace

import numpy as np
import pytest

from fctd.mechanics import contact
from validation.parts.drags import Bend, bend, campaign, drag


def cylinders(seed: int) -> Bend:
    """A random bend of cylinders."""
    return bend(np.random.default_rng(seed), "cylinders")


def test_no_point_leaves_a_hole() -> None:
    rows = list(campaign(800, seed=3, batch=100))
    assert {row["geometry"] for row in rows} == {"cylinders", "arcs"}
    assert sum(row["drags"] for row in rows) == 800
    assert [row["leaks"] + row["wrong_owners"] for row in rows] == [0] * 8
    assert max(row["largest_error_mm"] for row in rows if row["geometry"] == "arcs") < 1e-6


def test_the_points_are_pressed_against_the_wall() -> None:
    """Else nothing could leave: at the end they lie where wall and force balance, or nearly."""
    for seed in range(5):
        found = drag(bend(np.random.default_rng(seed), "arcs"), 200, np.random.default_rng(seed))
        assert np.mean(np.abs(found.beyond) < 2e-3) > 0.8


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_a_piece_without_a_wall_is_noticed(geometry: str) -> None:
    made = bend(np.random.default_rng(4), geometry)
    pieces = made.hole.pieces.copy()
    pieces[len(pieces) // 2, contact.HOLE_RADIUS] += 1.0
    leaky = made._replace(hole=replace(made.hole, pieces=pieces))
    assert (drag(leaky, 300, np.random.default_rng(4)).wrong_wall > made.allowed).any()
    assert not (drag(made, 300, np.random.default_rng(4)).wrong_wall > made.allowed).any()


def test_a_wrong_owner_is_noticed() -> None:
    """A piece that claims to lie elsewhere along the hole."""
    made = cylinders(5)
    pieces = made.hole.pieces.copy()
    pieces[len(pieces) // 2 :, contact.START_MD] += 5.0
    wrong = made._replace(hole=replace(made.hole, pieces=pieces))
    assert (drag(wrong, 300, np.random.default_rng(5)).wrong_depth > made.along).any()
