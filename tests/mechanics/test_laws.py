"""Codes of the laws of friction in order, and a chain that calls the law of a code."""

import numpy as np
import pytest

from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES, NAMES, STICKING
from fctd.mechanics.laws import LAWS, coulomb, paper, steady_load, sticking

LIMIT, RADIUS = 10.0, 0.05  # μN [N], contact radius [m]


@entry
def chosen(code, speed, spin):
    """Steady load of a string along z that touches the wall on its x side, in a hole along z."""
    return steady_load(code, speed, spin, LIMIT, None, RADIUS, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def test_a_code_is_the_place_of_its_law() -> None:
    own = {"coulomb": coulomb.LAW, "paper": paper.LAW, "karnopp": sticking.KARNOPP, "stribeck": sticking.STRIBECK}
    assert {name: LAWS[CODES[name]] for name in NAMES} == own
    assert STICKING == ("karnopp", "stribeck")


@pytest.mark.parametrize("name", NAMES)
def test_sliding_alone_gives_the_whole_limit_along(name: str) -> None:
    fx, fy, fz, *_, torque = chosen(CODES[name], 0.3, 0.0)
    assert (fx, fy, fz) == pytest.approx((0.0, 0.0, -LIMIT))
    assert torque == pytest.approx(0.0)


@pytest.mark.parametrize("name", NAMES)
def test_turning_alone_gives_the_limit_times_the_radius(name: str) -> None:
    *_, torque = chosen(CODES[name], 0.0, 6.0)
    assert torque == pytest.approx(-LIMIT * RADIUS)


def test_sliding_and_turning_share_one_force_by_coulomb_and_have_each_their_own_by_the_paper() -> None:
    spin = 0.4 / RADIUS  # the side slides at 0.3 along and 0.4 m/s around: 3 : 4 : 5
    by_coulomb, by_paper = (chosen(CODES[name], 0.3, spin) for name in ("coulomb", "paper"))
    assert by_coulomb[2] == pytest.approx(-0.6 * LIMIT)
    assert by_coulomb[6] == pytest.approx(-0.8 * LIMIT * RADIUS)
    assert np.hypot(by_coulomb[2], by_coulomb[6] / RADIUS) == pytest.approx(LIMIT)
    assert (by_paper[2], by_paper[6]) == pytest.approx((-LIMIT, -LIMIT * RADIUS))
