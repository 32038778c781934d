"""A string that is stuck in its hole: pull, weight and torque at the surface, and what of them arrives below.

While its upper end is pulled, set down or turned, every part of the string above the stuck point moves in that
direction by its stretch or twist, so that friction acts in full along all of it: the load is that of a steady string
that ends at the stuck point and creeps.  A load that turns back does not do so at first.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from fctd.arrays import Array
from fctd.case.operations import KINDS
from fctd.model.operations import BitLoads, SteadyRates
from fctd.model.stuck import above_stuck_point
from fctd.steady.equilibrium import Solver
from fctd.steady.margins import Loaded
from fctd.steady.steady_string import Equilibrium

# Speed along the hole [m/s] and around it [rad/s] of a string that creeps: mud does not hold it back.
CREEP: Final = 1e-4
# A load is met within so many N or N m, in so many steps; it jumps where the string winds itself into a longer helix,
# and is then that beside a jump which is known within the last number.
NEAR, STEPS, JUMP = 1.0, 40, 20.0


@dataclass
class StuckString(Loaded):
    """What is above the stuck point of a string, in an operation; the forces of its methods act at the stuck point.

    whole : the free string with its bit, of the same operation.
    """

    stuck: ClassVar[bool] = True
    at: ClassVar[str] = "on the stuck point"
    whole: Equilibrium

    @property
    def free(self) -> Equilibrium:
        """The free string with its bit."""
        return self.whole

    @cached_property
    def own(self) -> BitLoads:
        """One that turns hangs with its free weight; pull and weight set down count from none at the stuck point."""
        if KINDS[self.operation].direction:
            return BitLoads(0.0, 0.0)
        hung = tension_at(self.whole, self.whole.bit_depth - self.laid.string.bit_depth)
        return BitLoads(-hung, 0.0)

    def tensioned(self, force: float) -> Equilibrium:
        """The string with a tension at its stuck point [N], below 0 a push; its waves have their wall force."""
        if KINDS[self.operation].direction < 0:
            return self.pulled(force, helical_force="analytic")
        return self.pressed(-force, 0.0, helical_force="analytic")

    def at_hookload(self, hookload: float) -> tuple[float, Equilibrium] | None:
        """Tension at the stuck point [N] and string of a hook load [N]; None where no steady string has it."""
        return _met(self.tensioned, lambda point: point.hookload, hookload)

    def at_tension(self, above: float, force: float) -> tuple[float, Equilibrium] | None:
        """Tension at the stuck point [N] and string with a tension [N] at a distance above the stuck point [m]."""
        return _met(self.tensioned, lambda point: tension_at(point, above), force)

    def at_torque(self, torque: float) -> tuple[float, Equilibrium] | None:
        """Torque at the stuck point [N m] and string of a surface torque [N m]; None where no steady string has it."""
        return _met(lambda q: self.pressed(0.0, q), lambda point: point.surface_torque, torque)


def stuck_string(
    solver: Solver, operation: str, rates: SteadyRates, bit_depth: float, md: float, whole: Equilibrium | None = None
) -> StuckString:
    """A string that is stuck at a measured depth [m], in mud at rest; operation : pulls, sets down or turns.

    solver : of the case, with its bit at ``bit_depth`` [m]; rates : of the free string; whole : that string, if known.
    Raises InputError where string and hole do not fit, and for a depth that is not on the string.
    """
    rates = rates._replace(flow=0.0)
    above = Solver(above_stuck_point(solver.case, bit_depth, md), solver.hole, solver.work)
    whole = solver.solve(operation, rates, bit_depth) if whole is None else whole
    direction = KINDS[operation].direction
    creeping = SteadyRates(direction * CREEP, 0.0 if direction else CREEP)
    return StuckString(above, operation, creeping, above.lay_out(md).at_rest, whole)


def ends_of(point: Equilibrium) -> tuple[Array, Array, Array]:
    """Tension [N] and torque [N m] at the top of a string and at the lower ends of its segments, (n + 1,) each, and the
    distances of these places from the lower end [m]."""
    loads, string = point._shape.loads, point._shape.laid.string
    return np.append(loads.tension, loads.bit_tension), np.append(loads.torque, loads.bit_torque), string.above_bit


def tension_at(point: Equilibrium, above: float) -> float:
    """Tension of a string at a distance above its lower end [m]; in [N]."""
    tension, _, places = ends_of(point)
    return float(np.interp(above, places[::-1], tension[::-1]))


def _met(
    at: Callable[[float], Equilibrium], load: Callable[[Equilibrium], float], wanted: float
) -> tuple[float, Equilibrium] | None:
    """The force at the stuck point at which a load of a string is the one that is wanted, by secants, and the string.

    The load grows with the force, steeply where a string that is set down is about to lock up: where a secant leads out
    of the interval in which the force lies, or to a load without a steady string, its middle is next.
    """
    low, high = -np.inf, np.inf
    before, here, missing, slope = 0.0, 0.0, 0.0, 1.0
    for step in range(STEPS):
        point = at(here)
        if not point.answered:
            if not step:
                return None
            here = 0.5 * (before + here)
            continue
        left = load(point) - wanted
        low, high = (here, high) if left < 0 else (low, here)
        if abs(left) <= NEAR or high - low <= JUMP:
            return here, point
        slope = (left - missing) / (here - before) if step else slope
        ahead = here - left / slope if slope > 0 else np.nan
        if not low < ahead < high:
            ahead = 0.5 * (low + high)
        if not np.isfinite(ahead):
            return None
        before, here, missing = here, ahead, left
    return None
