"""The wall force of snaking and of a helix on segments that are too long to bend that way.

A wave presses on the wall with more than the string's lateral load: a helix of compression F with r F²/(4EI) a metre in
all (Mitchell 1986; r : radial clearance), snaking with the mean of Mitchell's equation.  A coarse string lies straight,
or in a wave of its segments.  Where it is buckled, its wall keeps its place, and the friction of the closed forms is a
load: along the hole and about the axis as that of the wall, and without any influence of its shape.  Friction raises
the compression above it, and so the force: it is found from the lower end upwards, and again once the string has come
to rest with it.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.friction import limit_around
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES
from fctd.mechanics.laws import shares
from fctd.mechanics.query import Walls
from fctd.mechanics.state import TINY
from fctd.results.buckling import HANGING_SINUSOIDAL, HELICAL, MODE, NEEDED, NEITHER, SINUSOIDAL_LIMIT
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.climb import LARGEST_PUSH, START_ITERATIONS, creep_of
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS, Pace
from fctd.steady.problem import FULL, Given, Problem, Share
from fctd.steady.tangent import NORMAL_FORCE

# The force is found when the hook load changes by less than this share of the string's weight.
SETTLED = 1e-4
ROUNDS = 100
# Turns of a helix: the stiffness of a string bridges shorter stretches beyond the helical limit, and it snakes there.
LEAST_TURNS = 2.0
# Of snaking [rad]; at half of that a string becomes a helix.
LARGEST_AMPLITUDE = 1.8


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


@entry
def press(wave: Array, drag: Array, before: Array, compression: Array, most: float, force: Array) -> bool:
    """Fill the wall force (n,) [N], from the lower end upwards; returns whether it has an end.

    wave (n,) : wall force over the compression squared [1/N], 0 of a point that presses as before; drag (n,) : along
    the hole over the wall force; before (n,) : wall force with which the string had this compression (n,) [N]; most [N]
    : which that may not exceed.
    """
    more = 0.0  # compression than when the string came to rest
    for j in range(len(wave) - 1, -1, -1):
        push = max(compression[j] + more, 0.0)
        if push > most:
            return False
        force[j] = wave[j] * push * push if wave[j] > 0 else before[j]
        more += drag[j] * (force[j] - before[j])
    return True


@cache
def _snaking() -> tuple[Array, Array]:
    """Compression over the onset, rising, and the mean wall force of snaking over the lateral load."""
    from scipy.special import j0, j1  # seldom needed, and slow to import

    amplitude = np.linspace(1e-3, LARGEST_AMPLITUDE, 500)
    stretched = 1 + 0.75 * amplitude**2
    ratio = stretched * np.sqrt(2 * j1(amplitude) / amplitude)
    return ratio, j0(amplitude) + (ratio * amplitude) ** 2 / (2 * stretched)


def snaking_over_helix(ratio: Array) -> Array:
    """Mean wall force of snaking over that of a helix, r F²/4EI, at compressions over the onset (n,).

    Of a sine of least energy in the lateral load q, with amplitude A, β² = 2 J₁(A)/A (1 + ¾A²)² and the mean of
    Mitchell's wall force (1988), q [J₀(A) + β² A²/(2 + 1.5A²)]; that of the helix is q β².
    """
    onset = np.maximum(ratio, 1.0)
    return np.asarray(np.interp(onset, *_snaking()) / onset**2)


class WaveForce:
    """The wall force of the waves of a string, and its friction.

    wound (n,) : contact points with the wall force of a helix.  A helix stays when the compression falls below its
    limit but not below that of snaking, and so do these.
    endless_from : least share of the friction at which the force was found to have no end: the push grew beyond any
    rig's (climb.py); else NaN.
    """

    def __init__(self, problem: Problem) -> None:
        self.problem = problem
        n, rates = problem.n, problem.rates
        self.radius, self.own = problem.string.contact_radius(), problem.string.of("own_friction")
        # Below a swivel nothing turns.
        self.turning = self.radius * (1 - state.row(problem.work.S, state.STILL, n))
        self.law = CODES[problem.case.contact.friction_law]
        self.speed, self.spin = float(rates.speed), float(rates.spin)
        self.wound, self.endless_from = np.zeros(n, np.bool_), float("nan")
        self.other_force, self.other_torque = problem.given.force.copy(), problem.given.torque.copy()

    def add(self, share: Share = FULL) -> bool:
        """Give the string the wall force of its waves at its compression; returns whether it has an end.

        share : of its loads.
        """
        problem, string = self.problem, self.problem.string
        here, found = problem.compressed(share), problem.reactions(share)
        walls, before = self._own_friction(problem.walls(found.contacts)), found.contacts[:, NORMAL_FORCE]
        factor = share.friction * np.maximum(walls.friction, walls.around)
        along, around = self._shares(walls, factor)
        drag = factor * along
        # The compression jumps at a contact point by the friction there: its mean is that of the pipe beside the point.
        compression, force = 0.5 * drag * before + here.compression[1:], np.empty(problem.n)
        over_helix = self._over_helix(here.rows[1:], compression)
        clearance = np.maximum(walls.radius - self.radius, 0.0)  # bows are wider than the hole
        helix = clearance / (4 * string.of("EI")) * self._presses_along()
        if not press(over_helix * helix, drag, before, compression, LARGEST_PUSH * problem.weight, force):
            return False
        is_given = over_helix > 0
        force = np.where(is_given, force, 0.0)
        limit = factor * force
        turning = self.radius * limit * around
        given = problem.given
        given.force[:], given.torque[:] = self.other_force - limit * along, self.other_torque - turning
        given.share[:] = is_given
        given.wall[:] = np.column_stack([force, turning, self.radius * share.friction * walls.around * force])
        return True

    def _own_friction(self, walls: Walls) -> Walls:
        """The walls with the friction factors of fittings that have their own."""
        is_own = self.own > 0
        return walls._replace(
            friction=np.where(is_own, self.own, walls.friction), around=np.where(is_own, self.own, walls.around)
        )

    def _presses_along(self) -> Array:
        """The length of string (n,) [m] whose waves press at each contact point; the first has all of it up to the top.

        Above the uppermost contact point half a segment touches nowhere: of 30 m in a pushed string that is some of the
        drag.  The paper's long segment keeps its own.
        """
        string = self.problem.string
        length = np.array(string.tributary())
        if not string.long_segment:
            length[0] += string.length.sum() - length.sum()
        return length

    def _over_helix(self, rows: Array, compression: Array) -> Array:
        """Wall force of the waves (n,) over that of a helix of the same compression (n,) [N], 0 where there is none.

        rows (n, ROW_COLUMNS) : of ``buckling_along``.
        """
        string = self.problem.string
        coarse = string.length > rows[:, NEEDED]
        buckled = rows[:, MODE] != NEITHER
        self.wound = buckled & (self.wound | (coarse & self._are_long(rows[:, MODE] == HELICAL, compression)))
        snakes = coarse & ~self.wound & buckled
        # Between its two limits a hanging string hardly presses on the wall.
        hanging = HANGING_SINUSOIDAL * np.cbrt(string.of("EI") * string.weight**2)
        snakes &= rows[:, SINUSOIDAL_LIMIT] > hanging
        found = self.wound.astype(float)
        found[snakes] = snaking_over_helix(compression[snakes] / rows[snakes, SINUSOIDAL_LIMIT])
        return found

    def _are_long(self, helical: NDArray[np.bool_], compression: Array) -> NDArray[np.bool_]:
        """The contact points (n,) of those beyond the helical limit whose stretch has ``LEAST_TURNS``."""
        string = self.problem.string
        turns = np.sqrt(np.maximum(compression, 0.0) / (2 * string.of("EI"))) * string.length / (2 * np.pi)
        ends = np.flatnonzero(np.diff(helical, prepend=False, append=False))
        found = np.zeros(len(helical), np.bool_)
        for start, end in zip(ends[::2], ends[1::2], strict=True):
            found[start:end] = turns[start:end].sum() >= LEAST_TURNS
        return found

    def _shares(self, walls: Walls, factor: Array) -> tuple[Array, Array]:
        """Friction along the hole and about the axis (n,), as shares of that of a friction factor (n,)."""
        along, around = np.empty(len(factor)), np.empty(len(factor))
        over = np.maximum(np.maximum(walls.friction, walls.around), TINY)
        slide(
            self.law, self.speed, self.spin, self.turning, self.problem.hole.orthotropic, walls.friction / over,
            walls.around / over, along, around,
        )  # fmt: skip
        return along, around

    def settle(self, share: Share = FULL, iterations: int = START_ITERATIONS) -> tuple[int, int]:
        """Give a string in balance the force until it no longer changes; the string is in its last balance.

        share : of the loads; iterations : with which the string may come to rest with a force.  Returns the code, which
        is that of convergence where the force was found, and all iterations.
        """
        problem, total, wound = self.problem, 0, self.wound.copy()
        hookload = problem.reactions(share).hookload
        for _ in range(ROUNDS):
            kept, given = problem.copy_pose(), [row.copy() for row in problem.given]
            if not self.add(share) or -hookload > LARGEST_PUSH * problem.weight:
                self.endless_from = float(np.fmin(self.endless_from, share.friction))
                break
            code, done = self._rest(share, iterations)
            total += done
            if code != CONVERGED:
                problem.put_pose(kept._replace(given=Given(*given)))
                break
            before, hookload = hookload, problem.reactions(share).hookload
            if abs(hookload - before) < SETTLED * problem.weight:
                return CONVERGED, total
        self.wound = wound
        return MAX_ITERATIONS, total

    def _rest(self, share: Share, iterations: int) -> tuple[int, int]:
        """Follow the string to its balance with the force; returns code and iterations."""
        problem = self.problem
        kept, allowed = problem.copy_pose(), problem.allowed
        code, done = problem.iterate(Pace(*ATTEMPTS[0], LARGEST_TURN, allowed, allowed), share)
        if code == CONVERGED:
            return code, done
        # A string that buckles as its segments allow comes to rest in another shape.
        problem.put_pose(kept)
        problem.at_axis = 1
        code, more = problem.relax(creep_of(problem, iterations), share)
        return code, done + more
