"""A body whose centre of mass lies beside its axis."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.mechanics import state
from fctd.mechanics.unbalance import swing_unbalance
from tests.bodies import SPIN, VELOCITY, at, place, put, set_body
from tests.compiled import kept

swing = kept(swing_unbalance)


def test_the_force_is_that_of_the_turning_mass_and_keeps_the_energy() -> None:
    """m e ω² dt along the body's own x; what it gives to the lateral motion it takes from the spin."""
    S, dt, unbalance, spin = state.new_state(1), 1e-4, 3.0, 10.0
    set_body(S, 1, 400.0, 3000.0, 1.5)
    S[state.ADDED_MASS + 1], S[state.HELD_BACK + 1] = 100.0, 1 / 400 - 1 / 500
    S[state.UNBALANCE + 1] = unbalance
    turned = Rotation.from_rotvec([0.7, -0.4, 0.5])
    place(S, 1, turned, [0.0, 0.0, 0.0])
    velocity = np.array([0.3, -0.8, 0.2])
    put(S, 1, VELOCITY, velocity)
    put(S, 1, SPIN, [0.0, 0.0, spin])
    before = velocity @ turned.apply([1.0, 0.0, 0.0])
    swing(S, state.LANES, dt)
    gained = at(S, 1, VELOCITY) - velocity
    np.testing.assert_allclose(gained, turned.apply([dt * unbalance * spin**2 / 500, 0, 0]), atol=1e-15)
    after = at(S, 1, VELOCITY) @ turned.apply([1.0, 0.0, 0.0])
    lateral, spun = 0.5 * 500 * (after**2 - before**2), 0.5 * 1.5 * (spin**2 - at(S, 1, SPIN)[2] ** 2)
    assert lateral == pytest.approx(spun, rel=1e-2)  # to the square of the step
    assert not at(S, 2, VELOCITY).any()


def test_a_balanced_body_is_left_as_it_is() -> None:
    S = state.new_state(1)
    set_body(S, 1, 400.0, 3000.0, 1.5)
    put(S, 1, VELOCITY, [0.3, -0.8, 0.2])
    put(S, 1, SPIN, [0.1, 0.2, 10.0])
    before = state.copy_state(S)
    swing(S, state.LANES, 1e-3)
    np.testing.assert_array_equal(state.columns(S), state.columns(before))
