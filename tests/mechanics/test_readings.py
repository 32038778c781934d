"""Readings of every step since the last record."""

from collections.abc import Callable

import numpy as np
import pytest

from fctd.arrays import Array
from fctd.mechanics import readings, state, topdrive
from tests.compiled import kept

read_step, drain_swing = kept(readings.read_step), kept(readings.drain_swing)


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


def swing(dt: float, load: Callable[[Array], Array], span: float = 4.0) -> tuple[float, float]:
    """Amplitude and frequency that are read of a hook load over time."""
    S, top = state.new_state(1), np.zeros(topdrive.TOP_SIZE)
    readings.forget_swing(top)
    for pull in load(dt * np.arange(int(span / dt))):
        before = top[topdrive.SUM_HOOKLOAD]
        top[topdrive.SUM_HOOKLOAD] += dt * pull
        read_step(S, top, 1, before, 0.0, 0.0, 0.0, dt)
    assert top[topdrive.PULL_TIME] == pytest.approx(span - 2 * dt)
    found = drain_swing(top)
    assert top[topdrive.PULL_TIME] == 0
    return found


@pytest.mark.parametrize("dt", [0.5e-3, 4e-3])
@pytest.mark.parametrize("frequency", [3.0, 15.0, 50.0])
def test_a_fast_swing_is_read_beside_a_slow_one(dt: float, frequency: float) -> None:
    """20 kN fast; 100 kN at 0.3 Hz, whose changes from step to step are half as large at 3 Hz, and no share at 50."""
    omega = 2 * np.pi * frequency
    assert swing(dt, lambda t: 400e3 + 20e3 * np.sin(omega * t)) == pytest.approx((20e3, frequency), rel=0.02)
    slow = 100e3 * 0.3 / (20e3 * frequency)
    amplitude, found = swing(dt, lambda t: 20e3 * np.sin(omega * t) + 100e3 * np.sin(0.6 * np.pi * t))
    assert found == pytest.approx(frequency / np.sqrt(1 + slow**2), rel=0.02)
    assert amplitude == pytest.approx(20e3 * (1 + slow**2), rel=0.02)


def test_a_hook_load_at_rest_and_a_jump_have_no_fast_swing() -> None:
    """A jump of 20 kN counts for its share of the time: 20/√1000 of it at a thousand steps."""
    assert swing(4e-3, lambda t: np.full(len(t), 3e5)) == (0.0, 0.0)
    amplitude, _ = swing(4e-3, lambda t: 3e5 + 20e3 * (t > 2.0))
    assert amplitude == pytest.approx(20e3 / np.sqrt(1000), rel=0.01)
