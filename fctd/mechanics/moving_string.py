"""The bare loop: advances a string of segments by a number of steps, with a wall around it and given damping.

Schedule and records are added by a run (``fctd.simulation``); relaxing a string needs neither.
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, ceiling
from fctd.mechanics import dynamics, readings, state, topdrive
from fctd.mechanics.derrick import put_immersed
from fctd.mechanics.drive import STIFF, Drive
from fctd.mechanics.energy import Energy, energy_of
from fctd.mechanics.faults import Worst, check
from fctd.mechanics.state import Laws
from fctd.mechanics.stored_walls import update_walls
from fctd.mechanics.topdrive import Motion, PerMetre
from fctd.mechanics.wall_law import put_stiffness

# The top drive at rest.
STILL = Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
# Ctrl-C does not interrupt compiled code, so a call takes at most so many segment steps, a fraction of a second.
AT_ONCE = 2_000_000


class Sums(NamedTuple):
    """Loads summed over time, of every segment (n,) and at the top drive.

    normal [N s], friction_torque, r_mu_normal, mud_torque [N m s], tension [N s], torque [N m s];
    hookload [N s], top_torque [N m s]; of the bit weight [N s], torque [N m s].
    """

    normal: Array
    friction_torque: Array
    r_mu_normal: Array
    mud_torque: Array
    tension: Array
    torque: Array
    hookload: float
    top_torque: float
    bit_weight: float
    bit_torque: float

    def over(self, span: float) -> "Sums":
        """The means over a time span [s]: N and N m."""
        return Sums._make(part / span for part in self)


# Rows of the state in the order of ``Sums``.
SUM_ROWS = (
    state.SUM_NORMAL, state.SUM_FRICTION_TORQUE, state.SUM_R_MU_N,
    state.SUM_MUD_TORQUE, state.SUM_TENSION, state.SUM_TORQUE,
)  # fmt: skip
# Numbers of the top drive's array in the order of ``Sums``.
SUMS_AT_THE_ENDS = [
    topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE, topdrive.SUM_BIT_WEIGHT, topdrive.SUM_BIT_TORQUE,
]  # fmt: skip


@dataclass(kw_only=True)
class MovingString:
    """A string in motion: the buffers that a step changes, and the pipe, laws, wall and step length that it uses.

    S, top, owner : state buffers (state.py, topdrive.py, contact.py); pipe : fed in at the top; step : the
    longest step [s]; drive : of the rig; steps : number of steps taken; at_once : most segment steps in one call.
    """

    S: Array
    top: Array
    owner: NDArray[np.int64]
    segments: int
    pipe: PerMetre
    laws: Laws
    wall: "Wall"
    step: float
    drive: Drive = STIFF
    steps: int = 0
    at_once: int = AT_ONCE

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return float(self.top[topdrive.TOP_TIME])

    def advance(self, motion: Motion, duration: float, laws: Laws | None = None) -> None:
        """Advance by ``duration`` [s] in equal steps no longer than ``step``; Ctrl-C stops it between two calls.

        laws : used in place of the string's own, for example with artificial damping.
        """
        steps = max(int(ceiling(duration / self.step)), 1)
        laws, dt = laws or self.laws, duration / steps
        most = max(self.at_once // self.segments, 1)
        for done in range(0, steps, most):
            count = min(most, steps - done)
            self.wall.advance(self, motion, laws, dt, count)
            self.steps += count

    def refresh(self) -> None:
        """Update axes and walls to the present positions."""
        dynamics.update_axes(self.S, self.segments)
        if self.top[topdrive.IN_DERRICK] > 0:
            put_immersed(self.S, self.segments)
        self.wall.refresh(self)
        if self.laws.wall_exponent != 1:
            put_stiffness(self.S, self.top, self.segments, self.laws)

    def check(self) -> Worst:
        """Raise UnstableError when the state is not finite or outside the model's range; see ``faults.check``."""
        return check(self.S, self.segments)

    def energy(self) -> Energy:
        """Energy of the string and of the drive's inertia [J], after ``refresh``."""
        energy = energy_of(self.S, self.segments, self.laws.wall_exponent)
        return energy._replace(
            kinetic=energy.kinetic + 0.5 * self.drive.inertia * float(self.top[topdrive.TOP_RATE]) ** 2
        )

    def drain(self) -> Sums:
        """Return the sums of loads since the last call or ``clear``, and set them to zero."""
        rows = [state.row(self.S, offset, self.segments) for offset in SUM_ROWS]
        sums = Sums._make([*(row.copy() for row in rows), *map(float, self.top[SUMS_AT_THE_ENDS])])
        for row in rows:
            row[:] = 0.0
        self.top[SUMS_AT_THE_ENDS] = 0.0
        return sums

    def clear(self) -> None:
        """Set sums, losses, the top drive's work, the energy of fed pipe and the count of steps to zero."""
        state.columns(self.S)[state.SUM_NORMAL // state.STRIDE : state.LOST_JOINT // state.STRIDE + 1] = 0.0
        top = topdrive
        self.top[
            [*SUMS_AT_THE_ENDS, top.TOP_WORK, top.FED_ENERGY, top.GIVEN_WORK, top.LOST_BIT, top.TOP_PENETRATION]
        ] = 0.0
        readings.clear(self.top)
        readings.forget_swing(self.top)
        self.steps = 0


class Wall(Protocol):
    """The wall around a string.  It also advances the string, since every step needs the wall between loads and motion.

    name : of the contact method, for the result.  jumps : whether the contact of a point at rest may jump between
    steps, so that forces balance on average only.  seams : whether the wall has seams between cylinders, which can
    set a sliding string ringing.
    """

    name: str
    jumps: bool
    seams: bool

    def advance(self, string: MovingString, motion: Motion, laws: Laws, dt: float, steps: int) -> None:
        """Advance a string by ``steps`` steps of ``dt`` [s]."""

    def refresh(self, string: MovingString) -> None:
        """Update the walls for the present positions, given axes."""


class HoleWall:
    """The wall of the hole's own pieces, compiled.

    pieces : table of the pieces of a Wellbore; geometry : ``cylinders`` or ``arcs``.
    """

    jumps = False

    def __init__(self, pieces: Array, geometry: str) -> None:
        self.name, self.seams = geometry, geometry == "cylinders"
        self._pieces = pieces

    def advance(self, string: MovingString, motion: Motion, laws: Laws, dt: float, steps: int) -> None:
        """See ``Wall.advance``."""
        dynamics.advance(
            string.S, string.top, string.owner, string.segments, self._pieces, laws, motion, string.pipe, dt, steps
        )

    def refresh(self, string: MovingString) -> None:
        """See ``Wall.refresh``."""
        n = string.segments
        update_walls(string.S, string.owner, n, n, self._pieces, string.laws.geometry)
