"""Readings of every step since the last record: extremes of hook load and torque, and the turning of the bit."""

import math
from typing import Any, NamedTuple

from numpy.typing import NDArray

from fctd.mechanics.jit import inlined
from fctd.mechanics.state import WZ
from fctd.mechanics.topdrive import (
    BIT_ANGLE,
    BIT_STILL,
    HOOKLOAD_MAX,
    HOOKLOAD_MIN,
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
    spin = S[WZ + n] + motor
    top[TOP_ANGLE] += dt * rate
    top[BIT_ANGLE] += dt * spin
    if abs(spin) < STILL_SPIN:
        top[BIT_STILL] += dt
