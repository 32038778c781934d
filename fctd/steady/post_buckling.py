"""Buckled strings with segments short enough for their waves, in both of their shapes.

The string is laid out finely where it is compressed beyond a limit or nearly so, and followed from small loads to
those of the operation (climb.py), once snaking and once with a helix wherever that has the lower energy (helix.py).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model import layouts
from fctd.model.drillstring import lay_out
from fctd.results.buckling import IN_HALF_WAVE, MODE, NEITHER, SINUSOIDAL_LIMIT
from fctd.steady.climb import LOW, Climb, climb, creep_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.helix import Helix
from fctd.steady.problem import FULL, Problem, Share

Array = NDArray[np.float64]

# Segments are short where the compression exceeds this share of the limit, and so many half waves beyond; shorter by
# this factor than it needs there, as the compression grows when the string can bend.
NEARLY, BEYOND, MARGIN = 0.75, 2, 0.8
# Half waves of a lightly compressed string count as this long [m].
LONGEST_WAVE = 30.0
# Times that the string is laid out, and the helix laid at full loads.
LAYOUTS, WINDINGS = 3, 4
WINDING_ITERATIONS = 800


class Resolved(NamedTuple):
    """A string on its fine segments: the paths of its shapes; helix is None where no part of it has that shape."""

    problem: Problem
    snaking: Climb
    helix: Climb | None


def resolve(case: Case, coarse: Climb, problem: Problem, lay: Callable[[Case], Problem]) -> Resolved:
    """Both shapes of a string on segments that can bend as it does.

    coarse, problem : path and string of the case's own segments; lay : makes a problem of a case with others.
    """
    bit_depth, needed = problem.string.bit_depth, (np.full(0, np.inf), np.full(0, np.inf))
    path, total = coarse, coarse.iterations
    for _ in range(LAYOUTS):
        needed = _shorter(needed, _needed(problem, path))
        finer = layouts.with_components(case, layouts.resolved(case, bit_depth, *needed))
        if layouts.segments_in_hole(finer, bit_depth) > state.MAX_SEGMENTS:
            break
        if np.array_equal(lay_out(finer, bit_depth).length, problem.string.length):
            break
        problem = lay(finer)
        path = climb(problem)
        total += path.iterations
        if _is_resolved(problem, path):
            break
    path.iterations = total
    return Resolved(problem, path, _wind(problem, path))


def _wind(problem: Problem, snaking: Climb) -> Climb | None:
    """The path of the helix, or None without one."""
    helix = Helix(problem)
    if snaking.pose is not None and not snaking.spent_at <= 1:
        problem.put_pose(snaking.pose)
        path = Climb(iterations=snaking.iterations)
        for _ in range(WINDINGS):
            if not helix.prepare(FULL):
                if path.pose is not None and helix.stands():
                    return path
                break
            code, done = problem.relax(creep_of(problem, WINDING_ITERATIONS))
            path.iterations += done
            if code != CONVERGED:
                break
            path.pose = problem.copy_pose()
        if helix.turns == 0:
            return None
        helix = Helix(problem)
    path = climb(problem, helix.prepare)
    path.iterations += snaking.iterations
    if helix.turns == 0 or (path.pose is not None and not helix.stands()):
        return None
    return path


def _is_resolved(problem: Problem, path: Climb) -> bool:
    """Whether the segments are short enough at the end of a path."""
    _, needed = _needed(problem, path, nearly=np.inf, margin=1.0)
    return bool((problem.string.length <= np.minimum(needed[:-1], needed[1:])).all())


def _needed(problem: Problem, path: Climb, nearly: float = NEARLY, margin: float = MARGIN) -> tuple[Array, Array]:
    """Measured depths of top and contact points (n + 1,) [m], and the segment length that is needed there (n + 1,)."""
    if path.sound is not None:
        problem.put_pose(path.sound.pose)
    here = problem.compressed(Share(LOW, LOW) if path.sound is None else path.sound.share)
    half_wave = np.pi * np.sqrt(2 * here.EI / np.maximum(here.compression, 1e-3))
    fine = (here.rows[:, MODE] != NEITHER) | (here.compression > nearly * here.rows[:, SINUSOIDAL_LIMIT])
    length = np.where(fine, margin * half_wave / IN_HALF_WAVE, np.inf)
    if nearly < np.inf:
        # The stretch grows when the string can bend.
        for k in np.flatnonzero(np.diff(fine, prepend=False, append=False)):
            at = min(int(k), len(fine) - 1)
            beside = np.abs(here.md - here.md[at]) < BEYOND * min(half_wave[at], LONGEST_WAVE)
            length[beside] = np.minimum(length[beside], length[max(at - 1, 0) : at + 1].min())
    return here.md, length


def _shorter(before: tuple[Array, Array], now: tuple[Array, Array]) -> tuple[Array, Array]:
    """The lesser of two lengths, each a function of measured depth, at the depths of both."""
    md = np.union1d(before[0], now[0])
    return md, np.minimum.reduce([_at(md, *given) for given in (before, now) if len(given[0])])


def _at(md: Array, of_md: Array, length: Array) -> Array:
    """A length at other depths: the lesser of those at the two depths beside each."""
    right = np.clip(np.searchsorted(of_md, md), 0, len(of_md) - 1)
    return np.asarray(np.minimum(length[right], length[np.maximum(right - 1, 0)]))
