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
from fctd.steady.limit_search import CLOSE
from fctd.steady.margins import MOST_WEIGHT, Loaded
from fctd.steady.steady_string import Equilibrium

# Speed along the hole [m/s] and around it [rad/s] of a string that creeps: mud does not hold it back.
CREEP: Final = 1e-4
# A load is met within so many N or N m, in so many steps; it jumps where the string winds itself into a longer helix,
# and is then that beside a jump which is known within the last number.
NEAR, STEPS, JUMP = 1.0, 40, 20.0
MOST_UNSOLVED: Final = 5  # loads without a steady string, which take long, on the way to one


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
        return BitLoads(-self._hung, 0.0)

    def tensioned(self, force: float) -> Equilibrium:
        """The string with a tension at its stuck point [N], below 0 a push; its waves have their wall force."""
        if KINDS[self.operation].direction < 0:
            return self.pulled(force, helical_force="analytic")
        return self.pressed(-force, 0.0, helical_force="analytic")

    def at_hookload(self, hookload: float) -> tuple[float, Equilibrium] | None:
        """Tension at the stuck point [N] and string of a hook load [N]; None where no steady string has it."""
        if hookload < -self._most:
            return None
        return _met(self.tensioned, lambda point: point.hookload, hookload, self._hung, self.free.hookload)

    def at_tension(self, above: float, force: float) -> tuple[float, Equilibrium] | None:
        """Tension at the stuck point [N] and string with a tension [N] at a distance above the stuck point [m]."""
        if force < -self._most:
            return None
        known = tension_at(self.whole, self._below + above)
        return _met(self.tensioned, lambda point: tension_at(point, above), force, self._hung, known)

    def at_torque(self, torque: float) -> tuple[float, Equilibrium] | None:
        """Torque at the stuck point [N m] and string of a surface torque [N m]; None where no steady string has it."""
        turned = self.pressed(0.0, 0.0)
        if not turned.answered:
            return None
        return _met(lambda q: self.pressed(0.0, q), lambda at: at.surface_torque, torque, 0.0, turned.surface_torque)

    @property
    def _below(self) -> float:
        """Length of the string below the stuck point [m]."""
        return self.whole.bit_depth - self.laid.string.bit_depth

    @cached_property
    def _most(self) -> float:
        """The largest push that is sought [N]."""
        string = self.laid.string
        return MOST_WEIGHT * float(np.abs(string.weight) @ string.length)

    @property
    def _hung(self) -> float:
        """Tension of the free string at the stuck point [N]."""
        return tension_at(self.whole, self._below)


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
    at: Callable[[float], Equilibrium], load: Callable[[Equilibrium], float], wanted: float, near: float, known: float
) -> tuple[float, Equilibrium] | None:
    """The force at the stuck point at which a load of a string is the one that is wanted, by secants, and the string.

    near : a force at which the load is about ``known``; from there it grows about as the force does.  It grows steeply
    where a string that is set down is about to lock up: where a secant leads out of the interval in which the force
    lies, or to a load without a steady string, the middle is next.  Where some loads have no steady string, the best
    one that has counts if it is within ``CLOSE``.
    """
    low, high = -np.inf, np.inf
    best: tuple[float, float, Equilibrium] | None = None
    before, missing, unsolved = near, known - wanted, 0
    here = before - missing
    for _ in range(STEPS):
        point = at(here)
        if not point.answered:
            unsolved += 1
            if unsolved > MOST_UNSOLVED:
                break
            here = 0.5 * (before + here)
            continue
        left = load(point) - wanted
        low, high = (here, high) if left < 0 else (low, here)
        if best is None or abs(left) < best[0]:
            best = abs(left), here, point
        if abs(left) <= NEAR or high - low <= JUMP:
            return here, point
        slope = (left - missing) / (here - before) if here != before else 1.0
        ahead = here - left / slope if slope > 0 else np.nan
        if not low < ahead < high:
            ahead = 0.5 * (low + high)
        if not np.isfinite(ahead):
            break
        before, here, missing = here, ahead, left
    return best[1:] if best is not None and best[0] <= CLOSE * abs(wanted) else None
