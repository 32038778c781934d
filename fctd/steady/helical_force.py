"""The wall force of a helix on a string whose segments are too long to bend into one.

A helix of compression F presses on the wall with r F²/(4EI) a metre in all (Mitchell 1986; r : radial clearance).  A
coarse string lies straighter and presses with less.  What is missing is added as a load: it drags the string along the
hole and about its axis as the friction of the wall does, and leaves its shape alone.  This raises the compression
above it, and so the force: both are found in turn.
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.friction import limit_around
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES
from fctd.mechanics.laws import shares
from fctd.mechanics.query import Walls
from fctd.mechanics.state import TINY
from fctd.results.buckling import HELICAL, MODE, NEEDED, buckling_along
from fctd.steady.climb import LARGEST_PUSH, START_ITERATIONS, creep_of
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.problem import Problem
from fctd.steady.tangent import JOINT_TENSION, NORMAL_FORCE

# The force is found when the hook load changes by less than this share of the string's weight.
SETTLED = 1e-6
ROUNDS = 200


class Added(NamedTuple):
    """How the search for the missing wall force ended; the string is in its last balance.

    settled : whether the force was found; endless : whether the push grew beyond any rig's (climb.py); iterations :
    all.
    """

    settled: bool
    endless: bool
    iterations: int


@entry
def slide(
    law: int,
    speed: float,
    spin: float,
    radius: Array,
    orthotropic: bool | None,
    factor: Array,
    factor_around: Array,
    along: Array,
    around: Array,
) -> None:
    """Fill the friction along the hole and about the axis (n,) of contact points with a wall force of 1.

    radius (n,) [m]; orthotropic : of ``Laws``; factor, factor_around (n,) : along the string and around it.
    """
    for j in range(len(radius)):
        of_turning = limit_around(orthotropic, 1.0, factor_around[j], 1.0)
        along[j], around[j], _ = shares(law, speed, spin * radius[j], factor[j], of_turning)


class Helical:
    """The missing wall force of a string, and its friction.

    wound (n,) : contact points with the wall force of a helix.  A helix stays when the compression falls somewhat below
    its limit, and so do these.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        n, rates, S = problem.n, problem.rates, problem.work.S
        self.radius = problem.string.contact_radius()
        self.law = CODES[problem.case.contact.friction_law]
        self.speed, self.spin = float(rates.speed), float(rates.spin)
        self.wound = np.zeros(n, np.bool_)
        self.force, self.torque = state.row(S, state.GIVEN_FORCE, n), state.row(S, state.GIVEN_TORQUE, n)
        self.other_force, self.other_torque = self.force.copy(), self.torque.copy()

    def add(self) -> None:
        """Add the wall force that is missing at the string's compression."""
        problem, string = self.problem, self.problem.string
        found = problem.reactions()
        walls, tension = problem.walls(found.contacts), found.joints[:, JOINT_TENSION]
        rows, _ = buckling_along(
            problem.hole, problem.laid.pipe, string.top_md, walls.md, walls.radius, tension, problem.bit_tension()
        )
        self.wound |= (rows[1:, MODE] == HELICAL) & (string.length > rows[1:, NEEDED])
        normal = found.contacts[:, NORMAL_FORCE]
        # The tension jumps at a contact point by the friction there: its mean is that of the pipe beside the point.
        below = np.append(tension[1:], problem.bit_tension())
        factor = np.maximum(walls.friction, walls.around)
        along, around = self._shares(walls, factor)
        compression = np.maximum(0.5 * factor * normal * along - below, 0.0)
        helix = (walls.radius - self.radius) * compression**2 / (4 * string.of("EI")) * string.tributary()
        missing = np.where(self.wound, np.maximum(helix - normal + problem.added[:, 0], 0.0), 0.0)
        limit = factor * missing
        turning = self.radius * limit * around
        self.force[:], self.torque[:] = self.other_force - limit * along, self.other_torque - turning
        problem.added = np.column_stack([missing, turning, self.radius * (walls.around * missing)])

    def _shares(self, walls: Walls, factor: Array) -> tuple[Array, Array]:
        """Friction along the hole and about the axis (n,), as shares of that of a friction factor (n,)."""
        along, around = np.empty(len(factor)), np.empty(len(factor))
        over = np.maximum(factor, TINY)
        slide(
            self.law, self.speed, self.spin, self.radius, self.problem.hole.orthotropic, walls.friction / over,
            walls.around / over, along, around,
        )  # fmt: skip
        return along, around


def add_helical_force(problem: Problem, pace: Pace) -> Added:
    """Add the missing wall force of the helix to a string in balance, and follow the string to its balance with it."""
    helical, total = Helical(problem), 0
    hookload = problem.reactions().hookload
    for _ in range(ROUNDS):
        kept = problem.copy_pose(), problem.added
        helical.add()
        code, done = problem.iterate(pace)
        if code != CONVERGED:
            # A string that buckles as its segments allow comes to rest in another shape.
            problem.put_pose(kept[0])
            problem.at_axis = 1
            code, more = problem.relax(creep_of(problem, START_ITERATIONS))
            done += more
        total += done
        if code != CONVERGED:
            problem.put_pose(kept[0])
            problem.added = kept[1]
            break
        before, hookload = hookload, problem.reactions().hookload
        if abs(hookload - before) < SETTLED * problem.weight:
            return Added(True, False, total)
        if -hookload > LARGEST_PUSH * problem.weight:
            return Added(False, True, total)
    return Added(False, False, total)
