"""The attempts of the ladder's rungs (ladder.py): each finds the string of a row with its loads, or leaves it to the
next."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fctd.case.message import within
from fctd.mechanics import state
from fctd.model import layouts
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.status import SteadyStatus
from fctd.steady import post_buckling
from fctd.steady.balance import ATTEMPTS, IN_THE_OPEN, LARGEST_TURN, PATIENT, attempts_of, balance
from fctd.steady.bisection import bisect
from fctd.steady.carried_shape import begin, carry
from fctd.steady.climb import LARGEST_PUSH, SOUND_PUSH, Climb, climb, lock_up
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.findings import Findings
from fctd.steady.helix import Helix
from fctd.steady.post_buckling import Resolved, is_resolved
from fctd.steady.problem import Allowance, Problem
from fctd.steady.steady_string import Equilibrium
from fctd.steady.wave_force import WaveForce

# Segments up to so many times as long as advised still follow the shape: 6.7 in a half wave, where 8 are asked for.
NEARLY = 1.5
# Work with which a homogenised string is followed, iterations times segments: two to four seconds.
WORK_OF_WAVES = 2e6
TOO_FINE = f"resolving takes more than the {state.MAX_SEGMENTS} segments that a string may have: use smaller loads"
TOO_MUCH = "resolving takes more work than solver.resolve_work allows a row"
HOMOGENISED = "so the wall force of its waves is that of the closed forms"
# Homogenised waves lock up earlier than feed does: study fed_limits.
EARLY = "feed was not brought to its end, and may get the string farther: a larger solver.resolve_work lets it"
# Shapes of a buckled string whose hook loads differ by more than this share of its weight are both stated.
APART = 0.01


def in_the_open(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A string that no wall holds, by Newton's method with long lateral steps."""
    return so_far.answer(problem, *balance(problem, IN_THE_OPEN))


def newton(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """The string in which Newton's method ends from the guess of a soft string, if it would stay there."""
    attempts = attempts_of(problem)
    so_far.code, iterations, negative = balance(problem, (*attempts, *PATIENT) if so_far.is_analytic else attempts)
    so_far.first = so_far.answer(problem, so_far.code, iterations, negative)
    so_far.is_stable = so_far.code == CONVERGED and negative == 0
    return so_far.first if so_far.is_stable and not so_far.is_to_be_resolved else None


def carried(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A buckled string on fine segments that comes to rest in the shapes of the row above."""
    assert so_far.above is not None  # the rung is due
    begun = begin(so_far.case, so_far.above, problem.string.bit_depth, so_far.lay_finer)
    point = None if begun is None else of_lower_energy(begun, so_far)
    if point is not None and point.status == SteadyStatus.CONVERGED:
        return point
    so_far.lay_anew()
    return None


def resolved(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A buckled string on segments that can bend as it does, followed from small loads."""
    problem.at_axis = 1
    coarse = climb(problem, most=SOUND_PUSH)
    found = post_buckling.resolve(so_far.case, coarse, problem, so_far.lay_finer)
    so_far.resolved = of_lower_energy(found, so_far)
    return None if is_lacking(so_far.resolved) else so_far.resolved


def is_lacking(point: Equilibrium) -> bool:
    """Whether a string that was resolved has run out of work, or has segments that are far too long for its waves."""
    lacks = point.buckling.longest > NEARLY * point.buckling.segment_length
    return point.status == SteadyStatus.MAX_ITERATIONS or (point.status == SteadyStatus.UNDER_RESOLVED and lacks)


def of_lower_energy(resolved: Resolved, so_far: Findings) -> Equilibrium:
    """The answer of a resolved string: its helix, where it has one, with the hook loads of both shapes."""
    problem, snaking, helix = resolved
    point = so_far.end_of(problem, snaking)
    if helix is None:
        is_helix = so_far.is_to_be_fed and point.answered and Helix(problem).is_wound()
        chosen = replace(point, shape="helix" if is_helix else "snaking")
    else:
        wound = point if helix is snaking else so_far.end_of(problem, helix)
        chosen = replace(wound, shape="helix")
        loads = [p.hookload for p in (point, wound) if p.answered]
        if len(loads) == 2 and abs(loads[1] - loads[0]) > APART * problem.weight:
            chosen = replace(chosen, hookload_low=min(loads), hookload_high=max(loads))
    is_begun = chosen.status == SteadyStatus.CONVERGED and not so_far.is_to_be_fed
    shapes = carry(resolved) if is_begun else None
    return replace(chosen, iterations=chosen.iterations + so_far.first.iterations, carried=shapes)


class Followed(NamedTuple):
    """A string with homogenised waves, whether one of them is a helix at its loads, and its path from small loads."""

    problem: Problem
    is_wound: bool
    path: Climb


def follow_waves(problem: Problem, so_far: Findings) -> Followed | None:
    """A buckled string on segments that do not bend into its waves, which press on the wall and rub as the closed forms
    say, followed from small loads to lock-up; None where such segments are too many.

    problem : of the same string, on whatever segments.
    """
    coarse = layouts.with_components(so_far.case, layouts.by_default(so_far.case))
    if layouts.segments_in_hole(coarse, problem.string.bit_depth) > state.MAX_SEGMENTS:
        return None
    problem = so_far.lay_finer(coarse)
    waves = WaveForce(problem)
    problem.at_axis, problem.settle, problem.allowance = 1, waves.settle, Allowance(WORK_OF_WAVES)
    path = climb(problem)
    is_wound = bool(waves.wound.any())
    lock_up(problem, path)
    if np.isnan(path.locked_at):
        path.locked_at = waves.endless_from
    return Followed(problem, is_wound, path)


def homogenised(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A string that takes too many segments or too much work, or was not found to slide on, with homogenised waves.

    None where it has no balance for another reason than lock-up.
    """
    found = follow_waves(problem, so_far)
    if found is None:
        return None
    found.path.iterations += so_far.first.iterations
    point = so_far.end_of(found.problem, found.path)
    if point.status not in (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP):
        return None
    why = so_far.why_homogenised or (TOO_FINE if so_far.lacks_segments else TOO_MUCH)
    message = f"{within(point.message)}; {why}, {HOMOGENISED}" if point.message else ""
    if so_far.is_fed_in_part and point.status == SteadyStatus.LOCKED_UP:
        message += f"; {EARLY}"
    return replace(point, message=message, shape="helix" if found.is_wound else "snaking")


def as_resolved(_: Problem, so_far: Findings) -> Equilibrium | None:
    """The string on the finest segments that it may have."""
    return so_far.resolved


def as_cut(_: Problem, so_far: Findings) -> Equilibrium | None:
    """Newton's string on the segments of the case; without one they are laid out for the rungs that follow."""
    so_far.lay_anew()
    return so_far.first if so_far.is_stable else None


def bisected(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """The string at its loads, or at the end of a few balances at less, if its segments are too long for more steps."""
    problem.at_axis = 1
    so_far.path = path = bisect(problem)
    path.iterations += so_far.first.iterations
    if path.pose is None:
        so_far.is_coarse = bool(path.balances) and not so_far.is_analytic and not is_resolved(problem, path)
        if not so_far.is_coarse:
            return None
        problem.put_pose(path.balances[-1].pose)
    so_far.ended = at_surface(problem, so_far)
    return so_far.ended if so_far.ended.answered else None


def at_surface(problem: Problem, so_far: Findings) -> Equilibrium:
    """The string at the end of the path, with friction at its surface, as Newton's method has it, unless it is buckled.

    At the axis friction is that of a buckled string, whose shape it must not turn.
    """
    path = so_far.path
    point = so_far.end_of(problem, path)
    if path.pose is None or point.buckling.mode != NOT_BUCKLED.mode:
        return point
    problem.at_axis = 0
    code, iterations = problem.iterate(Pace(*ATTEMPTS[0], LARGEST_TURN, problem.allowed, problem.allowed))
    path.iterations += iterations
    if code == CONVERGED and problem.unstable_modes() == 0:
        path.pose = problem.copy_pose()
        return so_far.end_of(problem, path)
    problem.at_axis = 1
    problem.put_pose(path.pose)
    return point


def patient(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A string without a balance under any share of its loads, by Newton's method in small steps."""
    problem.at_axis = 0
    code, iterations, negative = balance(problem, PATIENT)
    so_far.path.iterations += iterations
    if code == CONVERGED and negative == 0:
        return so_far.answer(problem, code, so_far.path.iterations, negative)
    problem.at_axis = 1
    return None


def climbed(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """The string followed in small steps from the last balance at less than its loads, or else from the least loads."""
    so_far.path = climb(problem, path=so_far.path if so_far.path.balances else None)
    lock_up(problem, so_far.path)
    so_far.ended = at_surface(problem, so_far)
    return so_far.ended if so_far.ended.answered else None


def as_first_found(_: Problem, so_far: Findings) -> Equilibrium | None:
    """Newton's string."""
    return so_far.first


def as_unstable(_: Problem, so_far: Findings) -> Equilibrium | None:
    """Newton's string, in a balance that it would leave; the message says how its path ends."""
    point, ended = so_far.first, so_far.ended
    assert ended is not None  # a rung before has followed the string
    return replace(point, status=SteadyStatus.UNSTABLE, message=ended.message, iterations=so_far.path.iterations)


def as_under_resolved(_: Problem, so_far: Findings) -> Equilibrium | None:
    """The string without loads of a path on segments that cannot bend; the message says which could."""
    ended = so_far.ended
    assert ended is not None  # a rung before has followed the string
    message = f"{within(ended.message)}; {within(ended._shape.buckling.shortfall(so_far.case.solver.buckling))}"
    return replace(ended, status=SteadyStatus.UNDER_RESOLVED, message=message)


def as_ended(_: Problem, so_far: Findings) -> Equilibrium | None:
    """The string without loads at the end of its path."""
    return so_far.ended


def with_helix(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """The string that was found, with the wall force of a helix where its segments cannot bend into one."""
    point, waves = so_far.found, WaveForce(problem)
    code, iterations = waves.settle()
    wound = so_far.answer(problem, CONVERGED, point.iterations + iterations, problem.unstable_modes())
    is_added = bool(problem.given.share.any())
    if code == CONVERGED and not is_added:
        so_far.found = replace(wound, method=point.method)
        return None
    if code == CONVERGED:
        return wound
    is_endless = np.isfinite(waves.endless_from)
    pushed = -wound.hookload > so_far.case.rig.push
    status = SteadyStatus.LOCKED_UP if pushed or is_endless else SteadyStatus.UNSTABLE
    end = f"the push exceeds {LARGEST_PUSH:g} times the string's weight" if is_endless else "no steady shape was found"
    spent = "slack-off is spent, and " if pushed else ""
    return replace(wound.without_loads(), status=status, message=f"{spent}{end}")
