"""Buckled strings with segments short enough for their waves, in both of their shapes.

The string is laid out finely where it is compressed beyond a limit or nearly so, and followed from small loads to
those of the operation (climb.py), once snaking and once with a helix wherever that has the lower energy (helix.py).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model import layouts
from fctd.model.drillstring import lay_out
from fctd.results.buckling import GROWN, IN_HALF_WAVE, MODE, NEEDED, NEITHER, SINUSOIDAL_LIMIT
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.climb import LOW_FRICTION, SOUND_PUSH, Climb, climb, come_to_rest, keep, lock_up
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.helix import Helix
from fctd.steady.problem import FULL, Compressed, Problem, Share

# Segments are planned for more compression than was found, since a string that bends is pushed more: for this factor
# times it, and this share of the string's weight.  With them a half wave has 10 segments, and the amplitude of snaking
# an error below 3 %.
COMPRESSION_GROWTH, COMPRESSION_ADDED = GROWN, 0.02
# Segments are short where the compression exceeds this share of the limit, and this number of half waves beyond.
FINE_SHARE, FINE_HALF_WAVES = 0.75, 2
# A string that is pushed buckles farther before it locks up: there is compression of this number of weights more, for
# this number of segments in a half wave.
LOCKING_WEIGHTS, LOCKING_SEGMENTS = 1.0, 2
# Times that the string is laid out, and the helix laid at full loads.
LAYOUTS, WINDINGS = 3, 4
WINDING_ITERATIONS = 800
# A whole helix that is laid at once rolls far before it rests: in tubing of 10,000 ft at 0.5 degrees through 801 steps.
AT_ONCE_ITERATIONS = 4 * WINDING_ITERATIONS


class Resolved(NamedTuple):
    """A string on its fine segments: the paths of its shapes; helix is None where no part of it has that shape.

    Without friction the loads do not hang on the shape, and both are the path of the helix where there is one.
    """

    problem: Problem
    snaking: Climb
    helix: Climb | None


def resolve(case: Case, coarse: Climb, problem: Problem, lay: Callable[[Case], Problem]) -> Resolved:
    """Both shapes of a string on segments that can bend as it does.

    coarse, problem : path and string of the case's own segments; lay : makes a problem of a case with others.
    """
    needed = np.full(0, np.inf), np.full(0, np.inf)
    path, total, wound = coarse, coarse.iterations, None
    for _ in range(LAYOUTS):
        needed = shorter(needed, needed_lengths(problem, path))
        finer = finer_case(case, problem, needed)
        if finer is None:
            break
        problem = lay(finer)
        wound = None if problem.has_friction else _wind_at_once(problem, FULL)
        path = climb(problem, most=SOUND_PUSH) if wound is None else wound[1]
        total += path.iterations
        if is_resolved(problem, path):
            break
    path.iterations = total
    wound = _wind(problem, path) if wound is None else wound
    if wound is None:
        if problem.is_spent:
            # Whether a helix has the lower energy is not known.
            path.pose, path.is_cut = None, True
            return Resolved(problem, path, None)
        climb(problem, path=path)
        lock_up(problem, path)
        return Resolved(problem, path, None)
    helix, path_of_helix = wound
    is_wound = helix.turns > 0
    lock_up(problem, path_of_helix, helix.prepare)
    if not is_wound:
        return Resolved(problem, path_of_helix, None)
    if path_of_helix.pose is not None:
        # Of the shape that is not the answer only the hook load at the loads of the operation is of use.
        climb(problem, path=path)
    return Resolved(problem, path, path_of_helix)


def finer_case(case: Case, problem: Problem, needed: tuple[Array, Array]) -> Case | None:
    """The case with segments as short as needed, None where a string may not have so many or has no longer ones.

    needed : measured depths [m], and the segment length there.
    """
    bit_depth = problem.string.bit_depth
    finer = layouts.with_components(case, layouts.resolved(case, bit_depth, *needed))
    if layouts.segments_in_hole(finer, bit_depth) > state.MAX_SEGMENTS:
        return None
    return None if np.array_equal(lay_out(finer, bit_depth).length, problem.string.length) else finer


def _wind(problem: Problem, snaking: Climb) -> tuple[Helix, Climb] | None:
    """The helix and its path to the loads of the operation, or None where it does not stand.

    It is laid into the last balance in which the string is hardly pushed, or, where it does not come to rest there,
    wherever it is due on the way from small loads.  Where none is due it has no turns.
    """
    if snaking.sound is None:
        return None
    for start in (snaking.sound, snaking.balances[0]):
        helix, path = Helix(problem), Climb(iterations=snaking.iterations)
        for balance in snaking.balances:
            if balance.share <= start.share:
                problem.put_pose(balance.pose)
                keep(problem, path, balance.share)
        if not lay_helix(problem, helix, path, start.share):
            continue
        climb(problem, helix.prepare, path)
        if path.pose is None and path.of_weight and not path.rolls and not path.is_cut:
            at_once = _wind_at_once(problem, Share(LOW_FRICTION, 1.0))
            if at_once is not None:
                helix, path = at_once
                path.iterations += snaking.iterations
                climb(problem, helix.prepare, path)
        if helix.turns == 0 or path.pose is None or helix.stands():
            return helix, path
    return None


def _wind_at_once(problem: Problem, share: Share) -> tuple[Helix, Climb] | None:
    """The helix laid into the straight string of some loads, and a path of this balance; None where it does not stand.

    On the way from small loads each turn that the helix gains goes round all of the others: in slightly inclined hole
    against their weight, until the path ends.
    """
    problem.lay_guess(share)
    allowed = problem.allowed
    _, done = problem.iterate(Pace(*ATTEMPTS[0], LARGEST_TURN, allowed, allowed), share)
    helix, path = Helix(problem), Climb(iterations=done)
    if not lay_helix(problem, helix, path, share, AT_ONCE_ITERATIONS) or helix.turns == 0:
        return None
    return helix, path


def lay_helix(problem: Problem, helix: Helix, path: Climb, share: Share, most: int = WINDING_ITERATIONS) -> bool:
    """Lay the helix at the end of a path, at loads of these shares; returns whether the string comes to rest."""
    for _ in range(WINDINGS):
        if not helix.prepare(share):
            break
        code, done = come_to_rest(problem, most, share)
        path.iterations += done
        if code != CONVERGED:
            return False
    if helix.turns > 0:
        if path.balances:
            path.balances.pop()
            path.steps.pop()
        keep(problem, path, share)
    if share == FULL and path.balances:
        path.pose = path.balances[-1].pose
    return helix.turns == 0 or helix.stands()


def is_resolved(problem: Problem, path: Climb) -> bool:
    """Whether the segments are short enough at the end of a path."""
    return are_short(problem, _end_of(problem, path))


def are_short(problem: Problem, here: Compressed) -> bool:
    """Whether the segments are short enough for a string of these compressions."""
    needed = here.rows[:, NEEDED]
    return bool((problem.string.length <= np.minimum(needed[:-1], needed[1:]) * (1 + 1e-9)).all())


def needed_lengths(problem: Problem, path: Climb) -> tuple[Array, Array]:
    """Measured depths of top and contact points (n + 1,) [m], and the segment length to plan there (n + 1,)."""
    return planned_lengths(_end_of(problem, path), problem.weight, pushed=path.spent_at <= 1)


def planned_lengths(here: Compressed, weight: float, *, pushed: bool = False) -> tuple[Array, Array]:
    """``needed_lengths`` of a string against its limits; weight : of the string and on the bit [N]; pushed : at its
    top."""
    fine = (here.rows[:, MODE] != NEITHER) | (here.compression > FINE_SHARE * here.rows[:, SINUSOIDAL_LIMIT])
    half_wave = _half_wave(here.EI, COMPRESSION_GROWTH * here.compression + COMPRESSION_ADDED * weight)
    length = np.where(fine, half_wave / IN_HALF_WAVE, np.inf)
    if pushed:
        length = np.minimum(length, _half_wave(here.EI, here.compression + LOCKING_WEIGHTS * weight) / LOCKING_SEGMENTS)
    for k in np.flatnonzero(np.diff(fine, prepend=False, append=False)):
        at = min(int(k), len(fine) - 1)
        beside = np.abs(here.md - here.md[at]) < FINE_HALF_WAVES * half_wave[at]
        length[beside] = np.minimum(length[beside], length[max(at - 1, 0) : at + 1].min())
    return here.md, length


def _end_of(problem: Problem, path: Climb) -> Compressed:
    """The string at the end of a path, or at its last balance that needs no push beyond the string's weight."""
    if path.sound is None:
        return problem.compressed(Share(LOW_FRICTION, LOW_FRICTION))
    problem.put_pose(path.sound.pose)
    return problem.compressed(path.sound.share)


def _half_wave(EI: Array, compression: Array) -> Array:
    """Half wave of snaking π√(2EI/F) [m], half a turn of the helix."""
    return np.asarray(np.pi * np.sqrt(2 * EI / np.maximum(compression, 1e-3)))


def shorter(before: tuple[Array, Array], now: tuple[Array, Array]) -> tuple[Array, Array]:
    """The lesser of two lengths, each a function of measured depth, at the depths of both."""
    md = np.union1d(before[0], now[0])
    return md, np.minimum.reduce([_at(md, *given) for given in (before, now) if len(given[0])])


def _at(md: Array, of_md: Array, length: Array) -> Array:
    """A length at other depths: the lesser of those at the two depths beside each."""
    right = np.clip(np.searchsorted(of_md, md), 0, len(of_md) - 1)
    return np.asarray(np.minimum(length[right], length[np.maximum(right - 1, 0)]))
