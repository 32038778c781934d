"""Readings of every step since the last record: extremes of hook load and torque, and the turning of the bit.

Over a longer time: how far and how fast the hook load swings from step to step, whatever else it does more slowly.
"""

import math
from typing import Any, NamedTuple

from numpy.typing import NDArray

from fctd.mechanics.jit import inlined
from fctd.mechanics.state import WZ
from fctd.mechanics.topdrive import (
    BENDS,
    BIT_ANGLE,
    BIT_STILL,
    CHANGES,
    HOOKLOAD_MAX,
    HOOKLOAD_MIN,
    PULL,
    PULL_CHANGE,
    PULL_STEPS,
    PULL_TIME,
    SUM_HOOKLOAD,
    SUM_TOP_TORQUE,
    TOP_ANGLE,
    TORQUE_MAX,
    TORQUE_MIN,
)

# A bit that turns slower than once a minute counts as still [rad/s].
STILL_SPIN = 2 * math.pi / 60


class Readings(NamedTuple):
    """Of the steps since the last record.

    hookload [N] and torque [N m] : smallest and largest of a step; top_angle, bit_angle : turned by [rad];
    bit_still : time during which the bit turned slower than ``STILL_SPIN`` [s].
    """

    hookload: tuple[float, float]
    torque: tuple[float, float]
    top_angle: float
    bit_angle: float
    bit_still: float

    @property
    def known(self) -> bool:
        """Whether the stepper reads its steps; another engine in its place does not."""
        return self.hookload[0] <= self.hookload[1]


def clear(top: NDArray[Any]) -> None:
    """Forget the readings."""
    top[[HOOKLOAD_MIN, TORQUE_MIN]] = math.inf
    top[[HOOKLOAD_MAX, TORQUE_MAX]] = -math.inf
    top[[TOP_ANGLE, BIT_ANGLE, BIT_STILL]] = 0.0


def forget_swing(top: NDArray[Any]) -> None:
    """Forget how the hook load swung; the two steps that follow have no change of a change yet."""
    top[[PULL_TIME, CHANGES, BENDS]] = 0.0
    top[PULL_STEPS] = -2.0


@inlined
def drain_swing(top):
    """Amplitude [N] and frequency [Hz] of the fast part of the hook load since the last call that drained it.

    A swing a sin ωt changes in a step h by 2 a sin(½ωh) and its change by 4 a sin²(½ωh), in the root of the mean square
    each over √2.  What is slow hardly changes in a step: of several swings, the one of the largest a ω is found.  Both
    are 0 where nothing has changed.
    """
    steps, span, changes, bends = top[PULL_STEPS], top[PULL_TIME], top[CHANGES], top[BENDS]
    top[PULL_STEPS : BENDS + 1] = 0.0
    if bends == 0:
        return 0.0, 0.0
    step, ratio = span / steps, math.sqrt(bends / changes)
    return math.sqrt(2 / span) * changes / math.sqrt(bends), math.asin(min(0.5 * ratio, 1.0)) / (math.pi * step)


def drain(top: NDArray[Any]) -> Readings:
    """Return the readings since the last call or ``clear``, and forget them."""
    read = Readings(
        (float(top[HOOKLOAD_MIN]), float(top[HOOKLOAD_MAX])),
        (float(top[TORQUE_MIN]), float(top[TORQUE_MAX])),
        *map(float, top[[TOP_ANGLE, BIT_ANGLE, BIT_STILL]]),
    )
    clear(top)
    return read


@inlined
def read_step(S, top, n, hookload, torque, rate, motor, dt):
    """Update the readings by those of one step.

    hookload [N s], torque [N m s] : sums at the top before this step's were added; rate : of the top drive, motor :
    of the bit against the string [rad/s].
    """
    pull, twist = (top[SUM_HOOKLOAD] - hookload) / dt, (top[SUM_TOP_TORQUE] - torque) / dt
    top[HOOKLOAD_MIN], top[HOOKLOAD_MAX] = min(top[HOOKLOAD_MIN], pull), max(top[HOOKLOAD_MAX], pull)
    top[TORQUE_MIN], top[TORQUE_MAX] = min(top[TORQUE_MIN], twist), max(top[TORQUE_MAX], twist)
    change = pull - top[PULL]
    bend = change - top[PULL_CHANGE]
    top[PULL], top[PULL_CHANGE] = pull, change
    top[PULL_STEPS] += 1
    if top[PULL_STEPS] > 0:
        top[PULL_TIME] += dt
        top[CHANGES] += dt * change * change
        top[BENDS] += dt * bend * bend
    spin = S[WZ + n] + motor
    top[TOP_ANGLE] += dt * rate
    top[BIT_ANGLE] += dt * spin
    if abs(spin) < STILL_SPIN:
        top[BIT_STILL] += dt
