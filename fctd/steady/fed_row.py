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
from fctd.steady.attempts import APART, Followed, follow_waves, is_lacking, of_lower_energy
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.carried_shape import shape_of
from fctd.steady.climb import START_ITERATIONS, Climb, come_to_rest, end_of, keep
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.feed import End, FedString, Start
from fctd.steady.findings import Findings
from fctd.steady.first_guess import TENSION
from fctd.steady.helix import Helix
from fctd.steady.post_buckling import LAYOUTS, Resolved, are_short, lay_helix, planned_lengths, shorter
from fctd.steady.problem import FULL, Compressed, Problem, Share
from fctd.steady.steady_string import Equilibrium

# Work with which a helix is laid into a fed string, iterations times segments.
WORK_OF_HELIX = 1e6
OFF_BOTTOM, AT_REST = Share(1.0, 0.0), Share(0.0, 0.0)


class FedRow(NamedTuple):
    """A string that was fed, how that ended, and its balance in which it slides on, if any."""

    problem: Problem
    string: FedString
    end: End
    path: Climb


def fed(problem: Problem, so_far: Findings) -> Equilibrium | None:
    """A buckled string on fine segments that is fed from rest, off bottom and then onto it."""
    waves = follow_waves(problem, so_far)
    here = None if waves is None else _compressed_by(waves)
    row = feed_row(so_far.case, so_far.lay_anew(), so_far.lay_finer, here)
    if row is None:
        so_far.is_fed_in_part = problem.is_spent
        so_far.lay_anew()
        return None
    point = of_lower_energy(Resolved(row.problem, row.path, None), so_far)
    low, high = _both(row, point)
    so_far.resolved = point = replace(point, fed=tuple(row.string.path), hookload_low=low, hookload_high=high)
    if is_lacking(point):
        so_far.is_fed_in_part = row.path.is_cut
        return None
    if row.path.pose is None and row.end != End.LOCKED and waves is not None and waves.path.pose is not None:
        so_far.why_homogenised = _end_in_words(row)
        return None
    return _with_shares(row, point, waves)


def _with_shares(row: FedRow, point: Equilibrium, waves: Followed | None) -> Equilibrium:
    """The answer with the shares of the friction at which slack-off is spent and the string locks up.

    They are those of the string with homogenised waves, whose path in friction is smooth and takes a second.  A lock-up
    on the other side of the friction of the case than feeding found it is none.
    """
    arrives, is_found = row.end == End.ARRIVED, row.path.pose is not None
    spent = locked = float("nan")
    words = ""
    if waves is not None:
        path = waves.path
        if (path.locked_at > 1) != arrives:
            path.locked_at = float("nan")
        path.ends_at = float("nan")
        spent, locked = path.spent_at if path.spent_at > path.least else float("nan"), path.locked_at
        words = end_of(waves.problem, path)
        if not is_found and (not arrives or path.spent_at < 1):
            point = replace(point, status=SteadyStatus.LOCKED_UP)
    if not is_found:
        words = "; ".join(filter(None, (_end_in_words(row), words)))
    message = words if words and point.status != SteadyStatus.CONVERGED else point.message
    return replace(point, message=message, slack_off_spent_at=spent, locked_up_at=locked)


def _both(row: FedRow, point: Equilibrium) -> tuple[float, float]:
    """The hook loads of a fed string that snakes and of a helix, where that is another balance; else NaN."""
    problem, path, none = row.problem, row.path, (float("nan"), float("nan"))
    if path.pose is None or point.shape == "helix":
        return none
    problem.put_pose(path.pose)
    helix, wound = Helix(problem), Climb()
    with _limited(problem, WORK_OF_HELIX):
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


def feed_row(
    case: Case, problem: Problem, lay: Callable[[Case], Problem], here: Compressed | None = None
) -> FedRow | None:
    """The path of a string that is fed from rest, None where it is not found at rest.

    problem : the string on the case's own segments; lay : makes a problem of a case with others; here : compression for
    which the first segments are planned, by default that of a soft string.
    """
    starts = {share: _start(problem, share) for share in (OFF_BOTTOM, AT_REST)}
    bit_depth, row, iterations = problem.string.bit_depth, None, 0
    needed = planned_lengths(_soft(problem) if here is None else here, problem.weight)
    for _ in range(LAYOUTS):
        finer = layouts.with_components(case, layouts.resolved(case, bit_depth, *needed))
        if layouts.segments_in_hole(finer, bit_depth) > state.MAX_SEGMENTS:
            break
        problem = lay(finer)
        string, end = _feed(problem, starts)
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
        if are_short(problem, here) and end == End.ARRIVED and _settles(problem, string, row.path):
            row.path.pose = row.path.balances[-1].pose
            here = problem.compressed()
        iterations = row.path.iterations
        if are_short(problem, here) or problem.is_spent:
            break
        needed = shorter(needed, planned_lengths(here, problem.weight, pushed=end != End.ARRIVED))
    if row is None:
        return None
    row.path.is_cut = row.problem.is_spent and row.path.pose is None and row.end != End.LOCKED
    return row


def _feed(problem: Problem, starts: dict[Share, Start | None]) -> tuple[FedString, End]:
    """Feed the string from rest, onto bottom where it has weight on bit."""
    string, slides, rests = FedString(problem), starts[OFF_BOTTOM], starts[AT_REST]
    follows = slides is not None and string.begin(slides)
    if not follows and (rests is None or not string.begin(rests)):
        return string, End.LOST
    end = End.ARRIVED if follows else string.trip()
    if end == End.ARRIVED and problem.weight_on_bit > 0:
        end = string.press(problem.weight_on_bit)
    return string, end


def _start(problem: Problem, share: Share) -> Start | None:
    """The string off bottom on the case's own segments, which slides or is at rest, where it is stable and straight."""
    torque, problem.bit_torque = problem.bit_torque, 0.0
    start = None
    for attempt in ATTEMPTS:
        problem.lay_guess(share)
        pace = Pace(*attempt, LARGEST_TURN, problem.allowed, problem.allowed)
        if problem.iterate(pace, share)[0] == CONVERGED:
            straight = problem.unstable_modes(share) == 0 and (problem.compressed(share).rows[:, MODE] == NEITHER).all()
            if straight or share == AT_REST:
                start = Start(shape_of(problem, share), share == OFF_BOTTOM)
            break
    problem.bit_torque = torque
    return start


def _compressed_by(waves: Followed) -> Compressed | None:
    """Compression of a string with homogenised waves that slides, or of one that is hardly pushed where none does."""
    problem, path = waves.problem, waves.path
    if path.pose is not None:
        problem.put_pose(path.pose)
        return problem.compressed()
    if path.sound is None:
        return None
    problem.put_pose(path.sound.pose)
    return problem.compressed(path.sound.share)


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


def _settles(problem: Problem, string: FedString, path: Climb) -> bool:
    """Whether the string that has arrived slides on at its rates; its balance is added to the path."""
    string.let_go()
    code, done = come_to_rest(problem, START_ITERATIONS, FULL)
    path.iterations += done
    if code == CONVERGED:
        keep(problem, path, FULL)
    return code == CONVERGED
