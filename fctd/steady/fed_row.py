"""The row of a buckled string that slides down: fed from rest, on segments that can bend as it does."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model import layouts
from fctd.results.buckling import MODE, NEITHER, buckling_along
from fctd.results.status import SteadyStatus
from fctd.steady.attempts import of_lower_energy
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.carried_shape import shape_of
from fctd.steady.climb import LOW_FRICTION, START_ITERATIONS, Climb, climb, close, come_to_rest, keep, lock_up
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.feed import End, FedString, Start
from fctd.steady.findings import Findings
from fctd.steady.first_guess import TENSION
from fctd.steady.post_buckling import LAYOUTS, Resolved, are_short, planned_lengths, shorter
from fctd.steady.problem import FULL, Compressed, Problem, Share
from fctd.steady.steady_string import Equilibrium

# Shares of the friction at which a string is fed that has no balance at all of it.
SHARES = (0.7, 0.45, 0.25, LOW_FRICTION)
# Work with which lock-up is looked for beyond the friction of the case, iterations times segments.
WORK_BEYOND = 1e6
OFF_BOTTOM, AT_REST = Share(1.0, 0.0), Share(0.0, 0.0)


class FedRow(NamedTuple):
    """A string that was fed at all of its friction, how that ended, and its path in friction."""

    problem: Problem
    string: FedString
    end: End
    path: Climb


def fed(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A buckled string on fine segments that is fed from rest, off bottom and then onto it."""
    row = feed_row(so_far.case, problem, so_far.lay_finer)
    if row is None:
        so_far.lay_anew()
        return None
    point = of_lower_energy(Resolved(row.problem, row.path, None), so_far)
    so_far.resolved = point = replace(point, fed=tuple(row.string.path))
    if row.end == End.LOCKED:
        so_far.resolved = point = replace(point, message=f"{_locked(row)}; {point.message}")
    lacking = SteadyStatus.UNDER_RESOLVED, SteadyStatus.MAX_ITERATIONS
    return None if point.status in lacking else point


def _locked(row: FedRow) -> str:
    """Where a string that was fed from rest is locked up, in words."""
    weight = row.problem.weight_on_bit
    if weight == 0:
        return "fed from rest, the string is locked up before its bit moves"
    most = max(of.weight for of in row.string.path)
    return f"fed from rest, the string is locked up with {100 * most / weight:.3g} % of the weight on bit"


def feed_row(case: Case, problem: Problem, lay: Callable[[Case], Problem]) -> FedRow | None:
    """The path of a string that is fed from rest, None where it is not found at rest.

    problem : the string on the case's own segments; lay : makes a problem of a case with others.
    """
    starts = {share: _start(problem, share) for share in (OFF_BOTTOM, AT_REST)}
    bit_depth, row, iterations = problem.string.bit_depth, None, 0
    needed = planned_lengths(_soft(problem), problem.weight)
    for _ in range(LAYOUTS):
        finer = layouts.with_components(case, layouts.resolved(case, bit_depth, *needed))
        if layouts.segments_in_hole(finer, bit_depth) > state.MAX_SEGMENTS:
            break
        problem = lay(finer)
        string, end = _feed(problem, starts, 1.0)
        if string.sound is None:
            return None
        iterations += string.iterations
        row = FedRow(problem, string, end, Climb(iterations=iterations))
        here = _compressed(problem, string)
        if are_short(problem, here) and end == End.ARRIVED and _settles(problem, string, row.path, 1.0):
            row.path.pose = row.path.balances[-1].pose
            here = problem.compressed()
        iterations = row.path.iterations
        if are_short(problem, here) or problem.is_spent:
            break
        needed = shorter(needed, planned_lengths(here, problem.weight, pushed=end != End.ARRIVED))
    if row is None:
        return None
    problem, path = row.problem, row.path
    if path.pose is not None:
        _look_beyond(problem, path)
        if path.spent_at <= 1:
            _add_less(problem, starts, path)
        return row
    path.none_at.append(FULL)
    for share in SHARES:
        less, arrived = _feed(problem, starts, share)
        path.iterations += less.iterations
        if arrived == End.ARRIVED and _settles(problem, less, path, share):
            break
        path.none_at.append(Share(share, 1.0))
        if problem.is_spent:
            break
    path.is_cut = problem.is_spent
    if path.balances:
        climb(problem, path=path)
    return row


def _look_beyond(problem: Problem, path: Climb) -> None:
    """Follow a string that is pushed to the friction that no push overcomes, with a part of the allowance."""
    left = problem.allowance.left
    problem.allowance.left = min(left, WORK_BEYOND)
    lock_up(problem, path)
    problem.allowance.left += left - min(left, WORK_BEYOND)


def _feed(problem: Problem, starts: dict[Share, Start | None], share: float) -> tuple[FedString, End]:
    """Feed the string from rest at a share of its friction, onto bottom where it has weight on bit."""
    string, slides, rests = FedString(problem, share), starts[OFF_BOTTOM], starts[AT_REST]
    begun = share == 1 and slides is not None and string.begin(slides)
    follows = begun
    if not begun and (rests is None or not string.begin(rests)):
        return string, End.LOST
    end = End.ARRIVED if follows else string.trip()
    if end == End.ARRIVED and problem.weight_on_bit > 0:
        end = string.press(problem.weight_on_bit)
    return string, end


def _start(problem: Problem, share: Share) -> Start | None:
    """The string off bottom on the case's own segments, which slides or is at rest, where it is stable and straight."""
    torque, problem.bit_torque = problem.bit_torque, 0.0
    start = None
    for iterations, tau, growth, shrink, shift in ATTEMPTS:
        problem.lay_guess(share)
        pace = Pace(iterations, tau, growth, shrink, shift, LARGEST_TURN, problem.allowed, problem.allowed)
        if problem.iterate(pace, share)[0] == CONVERGED:
            straight = problem.unstable_modes(share) == 0 and (problem.compressed(share).rows[:, MODE] == NEITHER).all()
            if straight or share == AT_REST:
                start = Start(shape_of(problem, share), share == OFF_BOTTOM)
            break
    problem.bit_torque = torque
    return start


def _soft(problem: Problem) -> Compressed:
    """Compression of a soft string, for which the first segments are planned."""
    problem.lay_guess(FULL)
    n, string = problem.n, problem.string
    tension = problem.work.G[: n + 1, TENSION].copy()
    walls = problem.walls(problem.reactions(FULL).contacts)
    rows, _ = buckling_along(
        problem.hole, problem.laid.pipe, string.top_md, walls.md, walls.radius, tension[:-1], float(tension[-1])
    )
    EI = string.of("EI")
    return Compressed(np.append(string.top_md, walls.md), -tension, np.append(EI[0], EI), rows)


def _compressed(problem: Problem, string: FedString) -> Compressed:
    """The last pose of a fed string in which it was hardly pushed, against the buckling limits."""
    kept = problem.copy_pose()
    assert string.sound is not None
    problem.put_pose(string.sound)
    here = problem.compressed(Share(string.friction, 0.0))
    here.compression[-1] = here.compression[-2]  # that of the rock
    problem.put_pose(kept)
    return here


def _settles(problem: Problem, string: FedString, path: Climb, share: float) -> bool:
    """Whether the string that has arrived slides on at its rates; its balance is added to the path."""
    string.let_go()
    code, done = come_to_rest(problem, START_ITERATIONS, Share(share, 1.0))
    path.iterations += done
    if code == CONVERGED:
        keep(problem, path, Share(share, 1.0))
    return code == CONVERGED


def _add_less(problem: Problem, starts: dict[Share, Start | None], path: Climb) -> None:
    """Add balances at less friction, down to one at which slack-off is not spent."""
    pose = problem.copy_pose()
    for share in SHARES:
        less = Climb()
        string, end = _feed(problem, starts, share)
        path.iterations += string.iterations
        if end != End.ARRIVED or not _settles(problem, string, less, share):
            continue
        path.steps, path.balances = less.steps + path.steps, less.balances + path.balances
        if path.steps[0].hookload + problem.case.rig.push > 0:
            break
    problem.put_pose(pose)
    close(problem, path)
