"""A bit whose torque falls with its rotation: its spin in time, and the rotation from which on its swing decays."""

from collections.abc import Callable

import numpy as np

from fctd import Case
from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import rad_per_s
from fctd.simulation.preparation import prepare

RAMP, SAMPLE = 20.0, 0.05  # of rotation and of bit loads [s]


def stages(rpm: float, hold: float) -> list[Motion]:
    """The string turns up to twice the rotation, is loaded there, where it is stable, slows down, and is held [s]."""
    spin = rad_per_s(rpm)
    return [
        Motion(0.0, RAMP, 0.0, 0.0, 0.0, 2 * spin),
        Motion(RAMP, RAMP, 0.0, 0.0, 2 * spin, 2 * spin, bit_to=1.0),
        Motion(2 * RAMP, 2 * RAMP, 0.0, 0.0, 2 * spin, spin, bit_from=1.0, bit_to=1.0),
        Motion(4 * RAMP, hold, 0.0, 0.0, spin, spin, bit_from=1.0, bit_to=1.0),
    ]


def bit_spin(case: Case, hold: float) -> tuple[Array, Array]:
    """Time [s] and spin of the bit [rad/s] by the engine while its loads are held."""
    run, phases = prepare(case)
    *before, last = (m._replace(drive=phases[0].motion.drive) for m in stages(case.operations[0].rpm, hold))
    for motion in before:
        run.advance(motion, motion.duration)
    found = []
    for _ in range(round(hold / SAMPLE)):
        run.advance(last, SAMPLE)
        found.append((run.time, run.S[state.WZ + run.segments]))
    time, spin = np.array(found).T
    return time, spin


def growth(time: Array, spin: Array, rpm: float) -> float:
    """Growth rate [1/s] of the swing of the bit while it is small; 1 or −1 where it is large or gone at once."""
    about = np.abs(spin / rad_per_s(rpm) - 1)
    peaks = np.flatnonzero((about[1:-1] > about[:-2]) & (about[1:-1] >= about[2:])) + 1
    before, here, after = about[peaks - 1], about[peaks], about[peaks + 1]
    height = here + (before - after) ** 2 / (8 * (2 * here - before - after))
    small = (height < 1 / 3) & (height > 1e-8)
    if small.sum() < 4:
        return 1.0 if about[-20:].max() > 1 / 3 else -1.0
    return float(np.polyfit(time[peaks][small], np.log(height[small]), 1)[0])


def threshold(rate: Callable[[float], float], guess: float) -> float:
    """The rotation [rev/min] at which small swings neither grow nor decay: a straight line through two rates."""
    low, high = 0.96 * guess, 1.04 * guess
    grows, decays = rate(low), rate(high)
    return float(low + (high - low) * grows / (grows - decays))
