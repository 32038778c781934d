"""Errors against the exact contacts, and what a geometry allows beside a shoe."""

import numpy as np
import pytest

from fctd.arena.contract import SHOE, SIZES, STATIONS
from fctd.arena.errors import errors_of
from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import case_of, frame
from tests.arena.test_contract import Exact


def test_a_shift_is_the_error_of_all_points_and_its_contacts_are_false() -> None:
    case = case_of("errors", STATIONS, SIZES)
    near = frame(ExactHole(case.wellbore), 300, md=(65.0, 95.0))
    method = Exact(case, Exact.Options())
    exact = method.query(near.places, near.radii)
    same, off = (
        errors_of(method, near, exact),
        errors_of(method, near, exact._replace(penetration=exact.penetration + 3e-3)),
    )
    assert not same.missed.any()
    assert not same.false.any()
    assert np.abs(same.depth).max() < 1e-9
    np.testing.assert_allclose(off.depth, 3e-3, atol=1e-9)
    assert off.false.sum() == ((exact.penetration < -off.bound) & (exact.penetration > -3e-3)).sum() > 10
    assert not off.missed.any()


def test_a_point_without_an_answer_has_no_error() -> None:
    case = case_of("errors", STATIONS, SIZES)
    near = frame(ExactHole(case.wellbore), 50, md=(65.0, 95.0))
    method = Exact(case, Exact.Options())
    hits = method.query(near.places, near.radii)
    silent = hits._replace(penetration=np.where(hits.penetration > 0, hits.penetration, -np.inf))
    off = errors_of(method, near, silent)
    assert np.isnan(off.depth[hits.penetration <= 0]).all()
    assert not off.missed.any()
    assert not off.false.any()


@pytest.mark.parametrize(("md", "slope"), [((SHOE, SHOE + 0.2), True), ((70.0, 90.0), False)])
def test_the_wall_of_a_shoe_may_lean(md: tuple[float, float], slope: bool) -> None:
    case = case_of("errors", STATIONS, SIZES)
    near = frame(ExactHole(case.wellbore), 50, md=md)
    method = Exact(case, Exact.Options())
    off = errors_of(method, near, method.query(near.places, near.radii))
    # The radius falls by 47.65 mm over 0.2 m.
    assert (off.turn.min() >= np.arctan(0.04765 / 0.2)) == slope
