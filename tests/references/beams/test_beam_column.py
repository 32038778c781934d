"""The beam-column against closed forms."""

import numpy as np
import pytest
from scipy.optimize import brentq

from references.beams.beam_column import bending, deflect, grid, load, lowest_loads, side_force, stretching

EI = 3e6


def test_a_cantilever_bends_as_in_the_tables():
    """Exact at the nodes of cubic elements: wL⁴/8EI and wL²/2."""
    x = grid(np.array([0.0, 12.0]), 5)
    y, reactions = deflect(bending(x, EI), load(x, 700.0), {0: 0.0, 1: 0.0})
    assert y[-2] == pytest.approx(700 * 12**4 / (8 * EI))
    assert reactions[0] == pytest.approx(-700 * 12)
    assert reactions[1] == pytest.approx(-700 * 12**2 / 2)


def test_a_tie_rod_is_stiffened_by_its_tension():
    """Two hinges, load w, tension T: y'' at the middle is −w/T (1 − 1/cosh(kL/2)), k² = T/EI."""
    tension, length, w = 5e4, 20.0, 300.0
    x = grid(np.array([0.0, length]), 40)
    y, _ = deflect(bending(x, EI) + stretching(x, np.full(41, tension)), load(x, w), {0: 0.0, 80: 0.0})
    k = np.sqrt(tension / EI)
    exact = w * length**2 / (8 * tension) - w / (tension * k**2) * (1 - 1 / np.cosh(0.5 * k * length))
    assert y[40] == pytest.approx(exact, rel=1e-6)


def test_columns_buckle_at_their_loads():
    """Euler's column between hinges, and 1.0188 of a heavy one with a free end (the first zero of Ai')."""
    x = grid(np.array([0.0, 10.0]), 20)
    (euler,) = lowest_loads(bending(x, EI), stretching(x, np.ones(21)), [0, 40])
    assert euler == pytest.approx(np.pi**2 * EI / 100, rel=1e-5)
    x = grid(np.array([0.0, 14.0]), 60)
    free = lowest_loads(bending(x, 1.0) + stretching(x, x), stretching(x, np.ones(61)), [120, 121])
    assert free[0] == pytest.approx(1.0188, rel=1e-4)


def test_a_beam_that_comes_to_lie_presses_with_half_of_what_hangs():
    """qL/2, L⁴ = 24EIc/q."""
    q, clearance = 900.0, 0.02
    assert side_force(EI, q, {}, -clearance) == pytest.approx(0.5 * q * (24 * EI * clearance / q) ** 0.25, rel=1e-6)


def test_a_stabiliser_lifts_the_bit_off_the_low_side():
    """Ax + Bx³ − qx⁴/24EI below it, and −c + Vt³/6EI − qt⁴/24EI at t below the tangent point, joined at it."""
    q, clearance, at = 900.0, 0.02, 4.0

    def lower(span: float) -> tuple[float, float]:
        """A and B for a tangent point at a distance above the stabiliser, by y = 0 and the moment there."""
        shear = 6 * EI / span**3 * (clearance + q * span**4 / (24 * EI))
        cubic = (shear * span / EI - q * span**2 / (2 * EI) + q * at**2 / (2 * EI)) / (6 * at)
        return q * at**3 / (24 * EI) - cubic * at**2, cubic

    def kink(span: float) -> float:
        slope, cubic = lower(span)
        below = slope + 3 * cubic * at**2 - q * at**3 / (6 * EI)
        shear = 6 * EI / span**3 * (clearance + q * span**4 / (24 * EI))
        return below + shear * span**2 / (2 * EI) - q * span**3 / (6 * EI)

    span = brentq(kink, 5.0, 25.0)
    assert side_force(EI, q, {at: 0.0}, -clearance) == pytest.approx(6 * EI * lower(span)[1], rel=1e-6)
