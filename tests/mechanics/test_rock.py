"""The law of a drag bit against Detournay & Defournay 1992 by hand."""

import math

import numpy as np
import pytest

from fctd.mechanics import rock
from fctd.mechanics.rock import DRAG_BIT, GIVEN_LOADS, Rock
from tests.compiled import kept

bit_loads = kept(rock.bit_loads)
A, EPS, ZETA, MU, GAMMA, FLAT, SIGMA = 0.108, 60e6, 0.6, 0.5, 1.2, 1.2e-3, 40e6
DRAG = Rock(
    DRAG_BIT,
    stiffness=1e8,
    worn=SIGMA * A * FLAT,
    advance=1 / (ZETA * EPS * A),
    cutting=0.5 * A / ZETA,
    rubbing=0.5 * MU * GAMMA * A,
)


def test_the_rock_is_a_spring_that_does_not_pull() -> None:
    assert bit_loads(DRAG, 1e-3, 0.0, 10.0)[0] == pytest.approx(1e5)
    assert bit_loads(DRAG, -1e-3, 1.0, 10.0) == (0.0, 0.0)


@pytest.mark.parametrize("pressed", [6e-5, 3e-4, 1e-3])
def test_specific_energy_is_a_line_over_drilling_strength(pressed: float) -> None:
    """E = (1 − μγζ)ε + μγS with E = 2T/a²d and S = W/ad (their Eq. 21), whatever the bit wears."""
    weight, torque = bit_loads(DRAG, pressed, 0.0, 10.0)
    depth = (weight - DRAG.worn) * DRAG.advance
    energy, strength = 2 * torque / (A * A * depth), weight / (A * depth)
    assert energy == pytest.approx((1 - MU * GAMMA * ZETA) * EPS + MU * GAMMA * strength)


def test_a_bit_on_its_flats_rubs() -> None:
    weight, torque = bit_loads(DRAG, 2e-5, 0.0, 10.0)
    assert weight == pytest.approx(2e3)
    assert torque == pytest.approx(0.5 * MU * GAMMA * A * 2e3)


def test_given_loads_act_by_their_share() -> None:
    given = Rock(GIVEN_LOADS, weight=8e4, torque=3e3)
    assert bit_loads(given, -5.0, 0.25, 1.0) == pytest.approx((2e4, 750.0))


def test_a_slow_bit_has_more_torque() -> None:
    given = Rock(GIVEN_LOADS, weight=8e4, torque=3e3, weakening=0.5, weakening_spin=4.0)
    spins = np.array([0.0, 4.0, -4.0, 400.0])
    found = [bit_loads(given, 0.0, 1.0, spin)[1] for spin in spins]
    assert found == pytest.approx([4500.0, 3000 * (1 + 0.5 / math.e), 3000 * (1 + 0.5 / math.e), 3000.0])
