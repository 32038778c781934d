"""Continuation of a string from small loads to those of the operation, in steps as long as it can follow.

A buckled string's shape depends on its history.  From less to more load it goes from lying straight to snaking, and
snaking lasts far beyond the limit of the helix (a helix is seeded, post_buckling.py).  First the weight on bit grows
at little friction, then the friction.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from fctd.case.text import counted
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS
from fctd.steady.problem import FULL, Pose, Problem, Share
from fctd.steady.relaxation import Creep
from fctd.steady.stability import push_aside

# Share of the friction at which the string is laid, and at which the weight on bit grows.
LOW_FRICTION = 0.1
# Steps of the share of the loads.  A step grows after few iterations of the one before, and shrinks after many.
FIRST_STEP, SMALLEST_STEP, LARGEST_STEP = 0.1, 3e-3, 0.25
LEAST_STEP = 1e-9  # towards lock-up
FEW_ITERATIONS, MANY_ITERATIONS, STEP_GROWTH, STEP_SHRINKAGE = 70, 150, 1.5, 0.67
# A push aside ends one slow mode or several.  A string that still has one after this number of pushes is followed as
# it is.
PUSHES = 8
# The forces of a slow mode are less than the imbalance that a balance is allowed.  After a push the string is relaxed
# until its imbalance is this share of the allowed one.
PUSHED_IMBALANCE = 0.01
# A step of pseudo-time longer than the time in which a slow mode grows would undo the push.  The first step is this
# share of that time.
SLOW_MODE_STEP = 0.3
START_ITERATIONS, STEP_ITERATIONS = 1500, 400
# Steps smaller than ``ROLLING_STEP`` are not tried where the string rolls round the hole.  It rolls where this share
# of the motion of its points, in this number of iterations, goes one way round.
ROLLING_STEP, ROLLING_ITERATIONS, ROLLING_SHARE = 0.01, 20, 0.8
# Lock-up is the share of the loads at which 1/push becomes 0, extrapolated by a line through two balances.  One is the
# last.  The other is the latest whose push is at most ``EARLIER_PUSH`` of the last one's: shapes differ a little from
# balance to balance, and two pushes of nearly the same size would give the line a random slope.
# Lock-up is known where the extrapolations of ``AGREEING_STEPS`` steps differ by less than ``AGREEMENT`` of it.  It is
# also known where the push exceeds ``LARGEST_PUSH`` weights, more than any rig has: while the helix still grows longer,
# two extrapolations agree by chance.
# Where the path ends before, and the push is at least one weight, lock-up is the last extrapolation.  Where no shape
# was found far below that, it is there: the springs of the wall give way under a large push.
EARLIER_PUSH, AGREEMENT, AGREEING_STEPS, LARGEST_PUSH = 0.75, 0.01, 3, 10.0
# A lock-up below this share of the loads lies before them, whatever the error of the extrapolation.  A pushed string
# that has a balance at more than this share of the loads at which none was found is not followed any nearer.
DECIDED_SHARE = 0.97
# A relaxation that has not come to rest after this number of iterations begins again with small steps.
RESTART_ITERATIONS = 100
# From a push of ``PUSHED_WEIGHTS`` weights on, a step goes at most ``LOCK_UP_APPROACH`` of the way to lock-up.
PUSHED_WEIGHTS, LOCK_UP_APPROACH = 0.25, 0.6
# Segments are cut for the compression under a push of at most this share of the weight beyond the block's, since their
# number grows with the push.  post_buckling.py adds what lock-up needs beyond that.
SOUND_PUSH = 0.05
# A locked string is followed up to this share of its loads.
FARTHEST_SHARE = 5.0


class Step(NamedTuple):
    """A balance on the way: share of the friction or of the weight on bit, hook load [N]."""

    share: float
    hookload: float


class Balance(NamedTuple):
    """A pose in balance with a share of the loads."""

    pose: Pose
    share: Share


@dataclass
class Climb:
    """A path in weight on bit at little friction, then in friction.

    balances : from less to more; steps : those of the last part, in friction unless ``of_weight``.  none_at : loads at
    which it found no balance; anew_at : those of them at which the string has one when it is begun anew.
    pose : at full loads, None where the path ends before; sound : the last balance up to there in which the string is
    hardly pushed (``SOUND_PUSH``), or has not all of its weight on bit; iterations : all.
    spent_at : share of the loads at which the hook load is −block weight; locked_at : at which no push suffices; NaN
    where the path does not get there.  fails_at : least share of the friction beyond all balances at which no shape was
    found, else NaN.  ends_at : share at which a path ends before the loads, else NaN; rolls : whether the string then
    goes round the hole; is_cut : whether the row's allowance of work ended the path;
    begins_at : the least share of the friction that was tried.
    """

    balances: list[Balance] = field(default_factory=list)
    none_at: list[Share] = field(default_factory=list)
    anew_at: list[Share] = field(default_factory=list)
    steps: list[Step] = field(default_factory=list)
    of_weight: bool = False
    pose: Pose | None = None
    sound: Balance | None = None
    iterations: int = 0
    spent_at: float = float("nan")
    locked_at: float = float("nan")
    fails_at: float = float("nan")
    ends_at: float = float("nan")
    rolls: bool = False
    is_cut: bool = False
    begins_at: float = LOW_FRICTION

    @property
    def least(self) -> float:
        """The share of the loads at which its last part begins."""
        return 0.0 if self.of_weight else self.begins_at

    def none_beyond(self) -> list[Share]:
        """Loads of its last part, from less to more, that are beyond its last balance and at which it found none."""
        if not self.balances:
            return []
        friction, weight = self.balances[-1].share
        if self.of_weight:
            return sorted(
                share for share in set(self.none_at) if share.friction == LOW_FRICTION and share.weight > weight
            )
        return sorted(share for share in set(self.none_at) if share.weight == 1 and share.friction > friction)


def creep_of(problem: Problem, iterations: int, tightly: float = 1.0) -> Creep:
    """Step sizes that follow snaps of the string; with steps twice as long it lands in other shapes.

    tightly : share of the imbalance that a balance is allowed.
    """
    allowed = tightly * problem.allowed
    return Creep(iterations, 0.05, 1.3, 0.5, 0.6, 0.04, 0.1, allowed, allowed)


def come_to_rest(problem: Problem, iterations: int, share: Share) -> tuple[int, int]:
    """Relax the string to a balance in which it stays, with the wall force of its homogenised waves where it has any.

    Returns code and iterations.
    """
    code, done = _come_to_rest(problem, iterations, share)
    if code != CONVERGED or problem.settle is None:
        return code, done
    code, more = problem.settle(share, RESTART_ITERATIONS)
    return code, done + more


def _come_to_rest(problem: Problem, iterations: int, share: Share) -> tuple[int, int]:
    """Relax the string, and push it aside where it rests in a balance that it would leave; returns code and iterations.

    A straight string stays straight above its buckling limit until something moves it aside.
    """
    code, done = _relax(problem, iterations, share)
    for _ in range(PUSHES):
        if code != CONVERGED or (time := push_aside(problem, share)) is None:
            break
        creep = creep_of(problem, RESTART_ITERATIONS, PUSHED_IMBALANCE)
        _, tightly = problem.relax(creep._replace(tau=min(creep.tau, SLOW_MODE_STEP * time)), share)
        code, more = _relax(problem, iterations, share)
        done += tightly + more
    return code, done


def _relax(problem: Problem, iterations: int, share: Share) -> tuple[int, int]:
    """Relax the string, again and again from small steps; returns code and iterations."""
    code, done = MAX_ITERATIONS, 0
    while code == MAX_ITERATIONS and done < iterations and not problem.is_spent:
        code, more = problem.relax(creep_of(problem, min(RESTART_ITERATIONS, iterations - done)), share)
        done += more
    return code, done


def climb(
    problem: Problem,
    prepare: Callable[[Share], object] | None = None,
    path: Climb | None = None,
    most: float = LARGEST_PUSH,
) -> Climb:
    """Follow the string to the loads of the operation, or as far as it goes.

    prepare : called before each step with the loads of the last balance; may change the pose from which it starts.
    path : a path to go on from its last balance; by default a new one from small loads.  most : weights of the string
    with which it may be pushed beyond the block's.
    """
    path = _begin(problem) if path is None else path
    if path.balances and path.pose is None:
        problem.put_pose(path.balances[-1].pose)
        if _rise(problem, path, 1.0, prepare, most):
            path.pose = path.balances[-1].pose
    close(problem, path)
    return path


def lock_up(problem: Problem, path: Climb, prepare: Callable[[Share], object] | None = None) -> None:
    """Follow a string that is pushed at the loads of the operation to those that no push overcomes."""
    if path.pose is not None and _push(problem, path) > 0:
        problem.put_pose(path.pose)
        _rise(problem, path, FARTHEST_SHARE, prepare, LARGEST_PUSH)
        close(problem, path)


def keep(problem: Problem, path: Climb, share: Share) -> None:
    """Add the string in its pose, in balance with some loads, to a path."""
    balance, of_weight = Balance(problem.copy_pose(), share), share.weight < 1
    if path.of_weight != of_weight:
        path.steps.clear()
    path.of_weight = of_weight
    if share.friction >= path.fails_at:
        path.fails_at = float("nan")
    path.balances.append(balance)
    path.steps.append(Step(share.weight if of_weight else share.friction, problem.reactions(share).hookload))
    if of_weight or (share.friction <= 1 and _push(problem, path) < SOUND_PUSH * problem.weight):
        path.sound = balance


def _begin(problem: Problem) -> Climb:
    """A path with its first balance, at the least loads; without one, where none is found.

    Without friction every shape of balance is one of its loads alone: the path begins, and ends, with those of the
    operation, and small loads are for a string that finds none there.
    """
    path = Climb()
    least = Share(LOW_FRICTION, 0.0 if problem.weight_on_bit > 0 else 1.0)
    for share in (least,) if problem.has_friction else (FULL, least):
        problem.lay_guess(share)
        code, done = come_to_rest(problem, START_ITERATIONS, share)
        path.iterations += done
        if code == CONVERGED:
            keep(problem, path, share)
            break
    path.is_cut = problem.is_spent
    return path


def _rise(problem: Problem, path: Climb, end: float, prepare: Callable[[Share], object] | None, most: float) -> bool:
    """Raise the weight on bit to its end, then the friction to a share of it; returns whether the string gets there."""
    step, share = FIRST_STEP, path.balances[-1].share
    while share.weight < 1 or share.friction < end * (1 - 1e-12):
        if share.weight == 1 and (_push(problem, path) > most * problem.weight or _is_locked(problem, path)):
            return False
        kept = problem.copy_pose()
        aim = _next(problem, path, step, end)
        if prepare is not None:
            prepare(share)
        code, done = come_to_rest(problem, STEP_ITERATIONS, aim)
        path.iterations += done
        if code != CONVERGED:
            step = 0.5 * (aim.weight - share.weight if share.weight < 1 else aim.friction - share.friction)
            path.is_cut = problem.is_spent
            if not path.is_cut:
                path.none_at.append(aim)
            if share.weight == 1 and not path.is_cut:
                path.fails_at = aim.friction
            path.rolls = step < ROLLING_STEP and not path.is_cut and rolls(problem, aim)
            problem.put_pose(kept)
            if path.is_cut or path.rolls or step < SMALLEST_STEP or _is_near_lock_up(problem, path):
                return False
            continue
        share = aim
        keep(problem, path, share)
        step = min(
            step * (STEP_GROWTH if done < FEW_ITERATIONS else STEP_SHRINKAGE if done > MANY_ITERATIONS else 1.0),
            LARGEST_STEP,
        )
    return True


def _next(problem: Problem, path: Climb, step: float, end: float) -> Share:
    """The loads of the next balance."""
    friction, weight = path.balances[-1].share
    if weight < 1:
        return Share(friction, min(weight + step, 1.0))
    if _push(problem, path) > PUSHED_WEIGHTS * problem.weight and len(path.steps) > 1:
        # A push that has grown beyond all bounds leaves no way at all, and a path goes on by more than rounding.
        step = max(min(step, LOCK_UP_APPROACH * (_extrapolated(path.steps) - friction)), LEAST_STEP)
    return Share(min(friction + step, end), 1.0)


def _push(problem: Problem, path: Climb) -> float:
    """Push at the top beyond the block's weight in the last balance [N]."""
    return -path.steps[-1].hookload - problem.case.rig.push


def _is_locked(problem: Problem, path: Climb) -> bool:
    """Whether lock-up is known, and the string is followed far enough for it."""
    locked = _locked_at(problem, path)
    return locked < 1 or (np.isfinite(locked) and path.steps[-1].share >= 1)


def _is_near_lock_up(problem: Problem, path: Climb) -> bool:
    """Whether the last balance is so near lock-up that smaller steps would hardly change its share of the loads."""
    if len(path.steps) < 2 or _push(problem, path) < problem.weight:
        return False
    last = path.steps[-1].share
    is_near = last > DECIDED_SHARE * path.fails_at and (last >= 1 or path.fails_at < DECIDED_SHARE)
    return is_near or _extrapolated(path.steps) < DECIDED_SHARE


def _locked_at(problem: Problem, path: Climb) -> float:
    """Share of the loads at which no push suffices, NaN where it is not known."""
    steps = path.steps
    if len(steps) < 3 or _push(problem, path) < PUSHED_WEIGHTS * problem.weight:
        return float("nan")
    locks = [_extrapolated(steps[: len(steps) - k]) for k in range(min(AGREEING_STEPS, len(steps) - 1))]
    now = locks[0]
    if not np.isfinite(now):
        return float("nan")
    agree = len(locks) == AGREEING_STEPS and max(locks) - min(locks) < AGREEMENT * now
    return now if agree or _push(problem, path) > LARGEST_PUSH * problem.weight else float("nan")


def _extrapolated(steps: list[Step]) -> float:
    """Share at which 1/push, by a line through two balances, is 0; infinite where the push does not grow."""
    now, pulled = steps[-1]
    before, pull = next((step for step in reversed(steps) if step.hookload > EARLIER_PUSH * pulled), steps[0])
    if not pulled < pull < 0:
        return float("inf")
    return now + (now - before) * pull / (pulled - pull)


def rolls(problem: Problem, share: Share) -> bool:
    """Whether the string in its pose, far from balance, is driven round the hole in one direction all along."""
    if not problem.is_driven:
        return False
    before = problem.walls(problem.reactions(share).contacts)
    problem.relax(creep_of(problem, ROLLING_ITERATIONS), share)
    after = problem.walls(problem.reactions(share).contacts).offset
    _, along = problem.hole.at(before.md)
    swept = (along * np.cross(before.offset, after)).sum(axis=1)
    return bool(abs(swept.sum()) > ROLLING_SHARE * np.abs(swept).sum())


def close(problem: Problem, path: Climb) -> None:
    """Find where slack-off is spent and where the path ends."""
    share = np.array([step.share for step in path.steps])
    left = np.array([step.hookload for step in path.steps]) + problem.case.rig.push
    if len(left) > 1 and left[0] > 0 > left[-1]:
        from scipy.interpolate import PchipInterpolator  # seldom needed, and slow to import

        path.spent_at = float(PchipInterpolator(share, left).roots(extrapolate=False)[0])
    elif len(left) and left[0] <= 0:
        path.spent_at = float(share[0])
    path.locked_at = _locked_at(problem, path) if len(share) else float("nan")
    path.ends_at = float("nan")
    if np.isnan(path.locked_at) and len(share) > 1 and _push(problem, path) > problem.weight:
        path.locked_at = _extrapolated(path.steps)
        if path.fails_at < DECIDED_SHARE * path.locked_at and not path.rolls:
            path.locked_at = path.fails_at
    # A lock-up beyond the loads of the operation does not say why the string has no loads there.
    known = path.locked_at <= 1 if path.pose is None else np.isfinite(path.locked_at) or not path.is_cut
    if not known:
        path.ends_at = float(share[-1]) if len(share) else 0.0


def end_of(problem: Problem, path: Climb) -> str:
    """What ends a path, in words: what was tried, and what was found; empty where nothing ends it."""
    if not path.balances and not path.is_cut:
        tried = f" at {_percent(LOW_FRICTION)} of the friction" if problem.has_friction else ""
        return f"the continuation found no steady shape{tried}{' without weight on bit' * (problem.weight_on_bit > 0)}"
    loads = "weight on bit" if path.of_weight else "friction"
    last = "the row reached `solver.resolve_work` at" if path.is_cut else "the continuation found a steady shape at"
    ends = (
        (f"slack-off is spent {'at' if path.spent_at > path.least else 'below'}", path.spent_at),
        ("the string is locked up at", path.locked_at),
        (last, path.ends_at),
    )
    parts = ", ".join(f"{what} {_percent(share)}" for what, share in ends if np.isfinite(share))
    if not parts:
        return ""
    text = f"{parts} of the {loads}"
    if np.isnan(path.ends_at) or path.is_cut:
        return text
    if path.of_weight:
        text += f" with {_percent(LOW_FRICTION)} of the friction"
    return f"{text}{_none_beyond(problem, path)}"


def _none_beyond(problem: Problem, path: Climb) -> str:
    """At which shares beyond the last balance of a path it found no shape, in words."""

    def percents(of: list[Share]) -> list[str]:
        return list(dict.fromkeys(_percent(share.weight if path.of_weight else share.friction) for share in of))

    none = percents(path.none_beyond())
    if not none:
        return ""
    text = f" and none at {none[0]}"
    if path.rolls:
        cause = "the friction of rotation" if problem.rates.spin else "the torque at the bit"
        text += f", where {cause} rolled the buckled string round the hole"
    if len(none) > 1:
        text += ", nor at " if path.rolls else " or "
        text += none[1] if len(none) == 2 else f"{counted(len(none) - 1, 'more share')} up to {none[-1]}"
    anew = percents(path.anew_at)
    return f"{text}; begun anew the string has one at {' and '.join(anew)}" if anew else text


def _percent(share: float) -> str:
    return f"{100 * share:.3g} %"
