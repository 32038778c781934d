"""Continuation of a string from small loads to those of the operation, in steps as long as it can follow.

A buckled string's shape depends on its history.  From less to more load it goes from lying straight to snaking, and
snaking lasts far beyond the limit of the helix (a helix is seeded, post_buckling.py).  First the weight on bit grows
at little friction, then the friction.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from fctd.steady.continuation import CONVERGED
from fctd.steady.problem import Pose, Problem, Share
from fctd.steady.relaxation import Creep

# Share of the friction at which the string is laid and the weight on bit grows.
LOW = 0.1
# Steps of the share: first, smallest and largest; factors after a step of few or many iterations.
FIRST, SMALLEST, LARGEST = 0.1, 3e-3, 0.25
FEW, MANY, LONGER, SHORTER = 70, 150, 1.5, 0.67
SHAKES = 3
START_ITERATIONS, STEP_ITERATIONS = 1500, 400
# A string that rolls round the hole is not worth smaller steps than this.  It rolls where so much of the motion of its
# points in a few iterations goes one way round.
ROLLING_STEP, ROLLING_ITERATIONS, ONE_WAY = 0.01, 20, 0.8
# A push of so many weights of the string is beyond any rig; the climb ends, and the loads that no push overcomes are
# extrapolated from 1/push → 0.
BEYOND = 3.0
# The compression for which segments are cut is that of a push of at most this share of the weight beyond the block's:
# lock-up hangs little on the segments (0.2 % for segments twice as long), and their number grows with the push.
SOUND = 0.05
# A locked string is followed up to this share of its loads.
FARTHEST = 5.0


class Step(NamedTuple):
    """A balance on the way: share of the friction, hook load [N]."""

    friction: float
    hookload: float


class Balance(NamedTuple):
    """A pose in balance with a share of the loads."""

    pose: Pose
    share: Share


@dataclass
class Climb:
    """A path in friction at full weight on bit.

    steps : balances from less to more; pose : at full loads, None where the path ends before; sound : the last balance
    up to there in which the string is hardly pushed (``SOUND``); iterations : all.
    spent_at : share of the friction at which the hook load is −block weight; locked_at : at which no push suffices;
    NaN where the path does not get there.  ends_at, weight_ends_at : share of the friction, or before it of the weight
    on bit, at which a path ends that found no shape, else NaN; rolls : whether the string then goes round the hole.
    """

    steps: list[Step] = field(default_factory=list)
    pose: Pose | None = None
    sound: Balance | None = None
    iterations: int = 0
    spent_at: float = float("nan")
    locked_at: float = float("nan")
    ends_at: float = float("nan")
    weight_ends_at: float = float("nan")
    rolls: bool = False


def creep_of(problem: Problem, iterations: int) -> Creep:
    """Step sizes that follow snaps of the string; with steps twice as long it lands in other shapes."""
    return Creep(iterations, 0.05, 1.15, 0.5, 0.6, 0.04, 0.1, problem.allowed, problem.allowed)


def come_to_rest(problem: Problem, iterations: int, share: Share) -> tuple[int, int]:
    """Relax the string, and shake it where it rests in a balance that it would leave; returns code and iterations.

    A straight string stays straight above its buckling limit until something moves it aside.  A string that comes back
    to rest where it was is taken as it is: its friction holds it in modes that are counted without friction.
    """
    code, done = problem.relax(creep_of(problem, iterations), share)
    for _ in range(SHAKES):
        if code != CONVERGED or problem.unstable_modes(share) == 0:
            break
        problem.shake()
        code, more = problem.relax(creep_of(problem, iterations), share)
        done += more
    return code, done


def climb(problem: Problem, prepare: Callable[[Share], object] | None = None) -> Climb:
    """Follow the string from small loads to those of the operation, and, where it must be pushed, to lock-up.

    prepare : called before each step with the loads of the last balance; may change the pose from which it starts.
    """
    path = Climb()
    weight = 0.0 if problem.weight_on_bit > 0 else 1.0
    problem.lay_guess(Share(LOW, weight))
    code, path.iterations = come_to_rest(problem, START_ITERATIONS, Share(LOW, weight))
    if code != CONVERGED:
        path.ends_at = 0.0
        return path
    if weight == 1:
        _record(problem, path, LOW)
    elif not _rise(problem, path, lambda s: Share(LOW, s), weight, 1.0, prepare):
        path.weight_ends_at = path.sound.share.weight if path.sound is not None else 0.0
        return path
    if not _rise(problem, path, lambda s: Share(s, 1.0), LOW, 1.0, prepare):
        _close(problem, path)
        return path
    path.pose = problem.copy_pose()
    if path.steps[-1].hookload < -problem.case.rig.block_weight:
        _rise(problem, path, lambda s: Share(s, 1.0), 1.0, FARTHEST, prepare)
        problem.put_pose(path.pose)
    _close(problem, path)
    return path


def _rise(
    problem: Problem, path: Climb, loads: Callable[[float], Share], share: float, end: float,
    prepare: Callable[[Share], object] | None,
) -> bool:  # fmt: skip
    """Raise a share of the loads to its end; returns whether the string can follow.

    Balances at full weight are recorded.
    """
    step = FIRST
    while share < end * (1 - 1e-12):
        kept = problem.copy_pose()
        aim = min(share + step, end)
        if prepare is not None:
            prepare(loads(share))
        code, done = come_to_rest(problem, STEP_ITERATIONS, loads(aim))
        path.iterations += done
        if code != CONVERGED:
            step *= 0.5
            path.rolls = step < ROLLING_STEP and _rolls(problem, loads(aim))
            problem.put_pose(kept)
            if path.rolls or step < SMALLEST:
                return False
            continue
        share = aim
        if loads(share).weight < 1.0:
            path.sound = Balance(problem.copy_pose(), loads(share))
        else:
            _record(problem, path, loads(share).friction)
            if -path.steps[-1].hookload > BEYOND * problem.weight:
                return False
        step = min(step * (LONGER if done < FEW else SHORTER if done > MANY else 1.0), LARGEST)
    return True


def _rolls(problem: Problem, share: Share) -> bool:
    """Whether the string in its pose, far from balance, goes round the hole in one direction all along."""
    before = problem.walls(problem.reactions(share).contacts)
    problem.relax(creep_of(problem, ROLLING_ITERATIONS), share)
    after = problem.walls(problem.reactions(share).contacts).offset
    _, along = problem.hole.at(before.md)
    swept = (along * np.cross(before.offset, after)).sum(axis=1)
    return bool(abs(swept.sum()) > ONE_WAY * np.abs(swept).sum())


def _record(problem: Problem, path: Climb, friction: float) -> None:
    share = Share(friction, 1.0)
    path.steps.append(Step(friction, problem.reactions(share).hookload))
    if friction <= 1 and -path.steps[-1].hookload < problem.case.rig.block_weight + SOUND * problem.weight:
        path.sound = Balance(problem.copy_pose(), share)


def _close(problem: Problem, path: Climb) -> None:
    """Find where slack-off is spent and where the path ends."""
    friction = np.array([step.friction for step in path.steps])
    left = np.array([step.hookload for step in path.steps]) + problem.case.rig.block_weight
    if len(left) > 1 and left[0] > 0 > left[-1]:
        roots = PchipInterpolator(friction, left).roots(extrapolate=False)
        path.spent_at = float(roots[0])
    elif len(left) and left[0] <= 0:
        path.spent_at = float(friction[0])
    if path.pose is not None and friction[-1] <= 1.0:
        return
    push = 1 / -left[-3:]
    if len(push) == 3 and (push > 0).all() and -left[-1] > problem.weight and push[1] > push[2]:
        path.locked_at = float(friction[-1] + (friction[-1] - friction[-2]) * push[2] / (push[1] - push[2]))
    elif path.pose is None:
        path.ends_at = float(friction[-1])
