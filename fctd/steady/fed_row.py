"""The row of a buckled string that slides down: fed from rest, on segments that can bend as it does."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model import layouts
from fctd.results.buckling import MODE, NEITHER, buckling_along
from fctd.results.status import SteadyStatus
from fctd.steady.attempts import APART, of_lower_energy
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.carried_shape import shape_of
from fctd.steady.climb import LOW_FRICTION, START_ITERATIONS, Climb, climb, close, come_to_rest, keep, lock_up
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.feed import End, FedString, Start
from fctd.steady.findings import Findings
from fctd.steady.first_guess import TENSION
from fctd.steady.helix import Helix
from fctd.steady.post_buckling import LAYOUTS, Resolved, are_short, lay_helix, planned_lengths, shorter
from fctd.steady.problem import FULL, Compressed, Problem, Share
from fctd.steady.steady_string import Equilibrium

# Shares of the friction at which a string is fed that has no balance at all of it.
SHARES = (0.7, 0.45, 0.25, LOW_FRICTION)
# Work with which a helix is laid, and lock-up looked for beyond the friction of the case, iterations times segments.
WORK_BESIDE = 1e6
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
    low, high = _both(row, point)
    so_far.resolved = point = replace(point, fed=tuple(row.string.path), hookload_low=low, hookload_high=high)
    if row.path.pose is None:
        status = SteadyStatus.LOCKED_UP if row.end == End.LOCKED else point.status
        message = (
            f"{_end_in_words(row)}; {point.message}" if point.message != point.status.message else _end_in_words(row)
        )
        so_far.resolved = point = replace(point, status=status, message=message)
    lacking = SteadyStatus.UNDER_RESOLVED, SteadyStatus.MAX_ITERATIONS
    return None if point.status in lacking else point


def _both(row: FedRow, point: Equilibrium) -> tuple[float, float]:
    """The hook loads of a fed string that snakes and of a helix, where that is another balance; else NaN."""
    problem, path, none = row.problem, row.path, (float("nan"), float("nan"))
    if path.pose is None or point.shape == "helix":
        return none
    problem.put_pose(path.pose)
    helix, wound = Helix(problem), Climb()
    with _limited(problem, WORK_BESIDE):
        stands = helix.is_due(FULL) and lay_helix(problem, helix, wound, FULL)
    if not stands or not wound.steps:
        return none
    low, high = sorted((point.hookload, wound.steps[-1].hookload))
    return (low, high) if high - low > APART * problem.weight else none


@contextmanager
def _limited(problem: Problem, work: float) -> Iterator[None]:
    """Let a problem take only a part of its allowance."""
    left = problem.allowance.left
    problem.allowance.left = given = min(left, work)
    try:
        yield
    finally:
        problem.allowance.left += left - given


def _end_in_words(row: FedRow) -> str:
    """How feeding ended, of a string that has no loads at all of its friction."""
    weight, path = row.problem.weight_on_bit, row.string.path
    most = max(of.weight for of in path)
    reached = f"with {100 * most / weight:.3g} % of the weight on bit" if most > 0 else "off bottom"
    if row.end == End.ARRIVED:
        arrives = "the weight on bit arrives" if weight else "the bit follows"
        return f"fed from rest, {arrives}, but no steady shape was found that slides on"
    what = "the string is locked up" if row.end == End.LOCKED else "the string finds no rest"
    return f"fed from rest, {what} {reached}"


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
        if row is not None and end == End.LOST:
            # That of longer segments has an end, and its reason says what they lack.
            problem = lay(row.problem.case)
            row.path.is_cut = problem.is_spent
            return row._replace(problem=problem)
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
        _add_less(problem, starts, path, 1.0)
        return row
    path.none_at.append(FULL)
    for share in SHARES:
        less, arrived = _feed(problem, starts, share)
        path.iterations += less.iterations
        if arrived == End.ARRIVED and _settles(problem, less, path, share):
            _add_less(problem, starts, path, share)
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
    with _limited(problem, WORK_BESIDE):
        lock_up(problem, path)


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


def _add_less(problem: Problem, starts: dict[Share, Start | None], path: Climb, first: float) -> None:
    """Add balances below the first one of a path, down to one at which slack-off is not spent; the pose stays."""
    pose, push = problem.copy_pose(), problem.case.rig.push
    for share in SHARES:
        if share >= first:
            continue
        if path.steps[0].hookload + push > 0 or problem.is_spent:
            break
        less = Climb()
        string, end = _feed(problem, starts, share)
        path.iterations += string.iterations
        if end == End.ARRIVED and _settles(problem, string, less, share):
            path.steps, path.balances = less.steps + path.steps, less.balances + path.balances
    problem.put_pose(pose)
    path.begins_at = path.steps[0].share
    close(problem, path)
