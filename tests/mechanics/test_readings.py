"""Readings of every step since the last record."""

import numpy as np
import pytest

from fctd.mechanics import readings, state, topdrive
from tests.compiled import kept

read_step = kept(readings.read_step)


def test_extremes_angles_and_rest() -> None:
    """Three steps of 10 ms: hook loads 5, 7, 6 kN, torques 30, 10, 20 N m, a bit that rests in the second one.

    A motor turns it with 0.5 rad/s against the string.
    """
    S, top, dt = state.new_state(2), np.zeros(topdrive.TOP_SIZE), 0.01
    readings.clear(top)
    assert not readings.drain(top).known
    for pull, torque, spin in ((5e3, 30.0, 4.0), (7e3, 10.0, -0.01), (6e3, 20.0, 2.0)):
        before = top[topdrive.SUM_HOOKLOAD], top[topdrive.SUM_TOP_TORQUE]
        top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] += dt * pull, dt * torque
        S[state.WZ + 2] = spin - 0.5
        read_step(S, top, 2, *before, 3.0, 0.5, dt)
    read = readings.drain(top)
    assert read.known
    assert read.hookload == pytest.approx((5e3, 7e3))
    assert read.torque == pytest.approx((10.0, 30.0))
    assert (read.top_angle, read.bit_angle) == pytest.approx((0.09, 0.0599))
    assert read.bit_still == pytest.approx(dt)
    assert not readings.drain(top).known
