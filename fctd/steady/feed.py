"""A string that the block feeds into its hole: feed is the path's parameter, and hook load and weight on bit follow.

As at the rig the string begins off bottom.  In increments of feed each contact point sticks until its limit and then
slides against its own displacement (held_friction.py), and carries its friction on.  The string comes to rest after
each increment (relaxation.py).  Where a small increment has no balance nearby the string snaps: friction then follows
every step of the relaxation, and takes up the energy that the snap releases.

Lock-up is where further feed no longer arrives: on bottom the weight on bit, off bottom the bit's way.
"""

from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.rotations import rotation_columns
from fctd.steady.carried_shape import CarriedShape
from fctd.steady.climb import SLOW_MODE_STEP, SOUND_PUSH, creep_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.held_friction import ALONG_THEN, MEMORY, PLACE_THEN, Held, end_increment
from fctd.steady.pose import PLACE, QUATERNION
from fctd.steady.problem import Pose, Problem, Share
from fctd.steady.relaxation import Creep
from fctd.steady.stability import push_aside

# The top begins so far above the rotary table [m], since feeding moves it down.
ABOVE = 2.0
# Increments of feed [m]: the first, the smallest and the largest.  One grows after few iterations of the one before,
# and shrinks after many.
FIRST, SMALLEST, LARGEST = 0.1, 0.02, 1.0
FEW, MANY, GROWTH, SHRINKAGE, CUT = 30, 60, 1.5, 0.67, 0.4
ITERATIONS, FIRST_TIME = 100, 0.2
# A string that leaves its balance: iterations, and growth of the pseudo-time.
LEAVING, LEAVING_GROWTH = 200, 1.1
# A snap: so many times the friction follows some steps of the relaxation, and then holds.
SNAPS, SLIPPING, SNAP_TIME = 12, 20, 0.05
# On the way a balance may be out by this multiple of what a balance is allowed: the last one is exact.
IMBALANCE = 30.0
# The bit follows the block where it moves by this share of an increment.
FOLLOWING = 0.98
# A string is locked up where less than this share of the feed (off bottom) or of the push (on bottom) arrives at the
# bit, over the last ``OVER`` of the string's weight in push or ``OVER_FEED`` of feed [m], whichever comes first.
ARRIVING, OVER, OVER_FEED = 0.01, 0.01, 10.0
MOVED = 0.01  # [m]
# No rig pushes with more than so many weights; no string takes up more feed [m].
LARGEST_PUSH, MOST_FEED = 10.0, 60.0
# The rock gives way by a millimetre under the force that stretches a metre of the string by a millimetre.
ROCK_LENGTH = 1.0
# It has to be so in as many balances, one after the other.
STALLS = 2
# The weight on bit is reached within this share of it, and exceeded by less than another one; for that an increment
# may be as short as this [m].
REACHED, OVERSHOT, SHORTEST = 1e-3, 0.01, 1e-5


class End(StrEnum):
    """How feeding ended."""

    ARRIVED = "arrived"
    LOCKED = "locked"
    LOST = "lost"


class Fed(NamedTuple):
    """A balance on the path: feed [m], push at the top [N], place of the bit along the hole [m], weight on bit [N],
    whether the string snapped."""

    feed: float
    push: float
    bit: float
    weight: float
    snapped: bool


class _Kept(NamedTuple):
    pose: Pose
    memory: Array
    feed: float


class Start(NamedTuple):
    """A shape off bottom, and whether the string slides in it; else it is at rest without friction."""

    shape: CarriedShape
    slides: bool


@dataclass
class FedString:
    """A string of a problem that is fed at a share of its friction.

    path : its balances; iterations : all; sound : the last pose in which it was hardly pushed.
    """

    problem: Problem
    friction: float = 1.0
    arriving: float = ARRIVING
    path: list[Fed] = field(default_factory=list)
    iterations: int = 0
    sound: Pose | None = None

    def __post_init__(self) -> None:
        problem = self.problem
        self._share = Share(self.friction, 0.0)
        self._memory = np.zeros((problem.n + 2, MEMORY))
        self._axis, self._ahead = problem.laid.top_axis, problem.laid.bit_axis
        self._feed, self._stalls = 0.0, 0

    def begin(self, start: Start) -> bool:
        """Hang the string off bottom in a shape of the case's own segments; returns whether it comes to rest.

        A string that slides begins with the friction of sliding, one at rest without any: it is fed until its bit
        follows.
        """
        problem, n = self.problem, self.problem.n
        problem.held, problem.at_axis = None, 1
        start.shape.lay(problem, ABOVE)
        self._hold(0.0, 0.0, 0.0)
        self._remember()
        self._memory[:, ALONG_THEN:] = 0.0
        if start.slides:
            # As if each point had come down by a metre.
            walls = problem.walls(problem.reactions(self._share).contacts)
            self._memory[1 : n + 1, PLACE_THEN] -= problem.hole.at(walls.md)[1]
        if self._rest(ITERATIONS, False)[0] != CONVERGED and not self._snaps():
            return False
        self._remember()
        self._keep(False)
        return True

    def trip(self) -> End:
        """Feed the string off bottom until its bit follows the block."""
        return self.feed_on(None)

    def press(self, weight: float) -> End:
        """Feed the string onto the rock under its bit until that has the weight on bit [N]."""
        stiffness = float(self.problem.string.of("EA")[-1]) / ROCK_LENGTH
        self._hold(stiffness, self._bit(), 0.0)
        self._keep(False)
        return self.feed_on(weight)

    def ease(self, friction: float) -> bool:
        """Let the friction fall to a share while the block stands still; returns whether the string comes to rest.

        Where it is fed on then, it has come from more friction: what it carries is another than of one fed from rest.
        """
        self.friction, self._share = friction, Share(friction, 0.0)
        is_at_rest = self._rest(ITERATIONS, False)[0] == CONVERGED
        if not is_at_rest and not self._snaps():
            return False
        self._remember()
        self._keep(not is_at_rest)
        return True

    def let_go(self) -> None:
        """Take rock and memory away: the problem's string then slides at its rates."""
        self.problem.held = None

    @property
    def push(self) -> float:
        """Push at the top [N]."""
        return self.path[-1].push

    @property
    def snaps(self) -> int:
        """Number of snaps on the path."""
        return sum(of.snapped for of in self.path)

    def feed_on(self, weight: float | None) -> End:
        """Feed the string on: off bottom (None) until its bit follows, on the rock until it has a weight on it [N]."""
        step, start, self._stalls = FIRST, self._feed, 0
        first = len(self.path) - 1
        while self._feed - start < MOST_FEED:
            kept = self._kept()
            self._move(step)
            code, done = self._rest(ITERATIONS, False)
            if code != CONVERGED and step > SMALLEST:
                self._put(kept)
                step = max(CUT * step, SMALLEST)
                continue
            snapped = code != CONVERGED or not self._stays()
            if snapped and not self._snaps():
                self._put(kept)
                return End.LOST
            pressed = self._pressed()
            if weight is not None and pressed > (1 + OVERSHOT) * weight and step > SHORTEST:
                self._put(kept)
                now = self.path[-1].weight
                step = max(step * (weight - now) / (pressed - now), SHORTEST)
                continue
            self._remember()
            self._keep(snapped, weight)
            end = self._end(first, weight)
            if end is not None:
                return end
            step *= 1.0 if snapped else GROWTH if done < FEW else SHRINKAGE if done > MANY else 1.0
            step = self._next(min(max(step, SMALLEST), LARGEST), weight)
        return End.LOCKED

    def _end(self, first: int, weight: float | None) -> End | None:
        """How the path ends at its last balance, None where it goes on."""
        before, now = self.path[-2:]
        if weight is not None and now.weight >= (1 - REACHED) * weight:
            return End.ARRIVED
        if weight is None and now.bit - before.bit > FOLLOWING * (now.feed - before.feed):
            return End.ARRIVED
        if now.push > LARGEST_PUSH * self.problem.weight:
            return End.LOCKED
        least = OVER * self.problem.weight
        for then in reversed(self.path[first:-1]):
            if weight is not None and then.snapped:
                return None  # what a snap releases comes back first
            pushed, fed = now.push - then.push, now.feed - then.feed
            if pushed < least and fed < OVER_FEED:
                continue
            if weight is None:
                # A bit that has not moved yet waits for the friction of the whole string.
                moved = then.bit - self.path[first].bit > MOVED
                stalls = moved and now.bit - then.bit < self.arriving * fed
            else:
                stalls = now.weight - then.weight < self.arriving * abs(pushed)
            self._stalls = self._stalls + 1 if stalls else 0
            return End.LOCKED if self._stalls >= STALLS else None
        return None

    def _next(self, step: float, weight: float | None) -> float:
        """The next increment [m], no longer than to the weight on bit."""
        before, now = self.path[-2:]
        if weight is None or now.weight <= before.weight or now.feed == before.feed:
            return step
        slope = (now.weight - before.weight) / (now.feed - before.feed)
        return max(min(step, (weight - now.weight) / slope), SHORTEST)

    def _hold(self, rock: float, level: float, torque: float) -> None:
        x, y, z = self._ahead.tolist()
        self.problem.held = Held(self._memory, rock, level, x, y, z, torque)

    def _bit(self) -> float:
        """Place of the bit along the direction of the hole there [m]."""
        w, n = self.problem.work, self.problem.n
        axis = np.array(rotation_columns(*w.P[n, QUATERNION])[6:])
        return float((w.P[n, PLACE] + w.S[state.ARM_BOTTOM + n] * axis) @ self._ahead)

    def _pressed(self) -> float:
        """Weight on bit [N]."""
        held = self.problem.held
        return max(held.rock * (self._bit() - held.level), 0.0) if held is not None else 0.0

    def _move(self, step: float) -> None:
        self.problem.work.P[0, PLACE] += step * self._axis
        self._feed += step

    def _rest(self, iterations: int, slips: bool) -> tuple[int, int]:
        """Let the string come to rest; returns code and iterations."""
        creep = creep_of(self.problem, iterations, IMBALANCE)
        return self._relax(creep._replace(tau=SNAP_TIME if slips else FIRST_TIME, slips=slips))

    def _relax(self, creep: Creep) -> tuple[int, int]:
        code, done = self.problem.relax(creep, self._share)
        self.iterations += done
        return code, done

    def _stays(self) -> bool:
        """Push the string aside where it would leave its balance; returns whether it comes to rest beside it.

        A straight string stays straight above its buckling limit until something moves it aside, and friction lets it
        go while it slides along.  It leaves in steps shorter than the time in which its mode grows, which then grow
        slowly: longer ones turn modes round, and rounding decides where it comes to rest.
        """
        time = push_aside(self.problem, self._share, if_driven=True)
        if time is None:
            return True
        creep = creep_of(self.problem, LEAVING, IMBALANCE)
        return self._relax(creep._replace(tau=SLOW_MODE_STEP * time, growth=LEAVING_GROWTH))[0] == CONVERGED

    def _snaps(self) -> bool:
        """Let the string snap into another shape; returns whether it comes to rest."""
        for _ in range(SNAPS):
            self._rest(SLIPPING, True)
            if self._rest(ITERATIONS, False)[0] == CONVERGED:
                return True
        return False

    def _remember(self) -> None:
        problem, w = self.problem, self.problem.work
        end_increment(w.S, problem.n, w.P, problem.hole.pieces, w.owner, problem.laws(self._share))

    def _keep(self, snapped: bool, weight: float | None = None) -> None:
        """Add the balance to the path, and let the torque at the bit follow the weight on it."""
        problem, held = self.problem, self.problem.held
        assert held is not None  # since ``begin``
        bit, pressed = self._bit(), self._pressed()
        self.path.append(Fed(self._feed, -problem.reactions(self._share).hookload, bit, pressed, snapped))
        if weight:
            problem.held = held._replace(torque=min(pressed / weight, 1.0) * problem.bit_torque)
        if self.sound is None or self.push < SOUND_PUSH * problem.weight:
            self.sound = problem.copy_pose()

    def _kept(self) -> _Kept:
        return _Kept(self.problem.copy_pose(), self._memory.copy(), self._feed)

    def _put(self, kept: _Kept) -> None:
        self.problem.put_pose(kept.pose)
        self._memory[:] = kept.memory
        self._feed = kept.feed
