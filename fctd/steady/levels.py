"""Levels of a refinement: strings of one fineness, the loads that count, and the errors that remain."""

import time
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model import layouts
from fctd.model.drillstring import lay_out
from fctd.model.operations import SteadyRates
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium

# Called before every level with a text that names the level.
Progress = Callable[[str], None]
# Roache's factor of a grid convergence index (1994).
SAFETY = 1.25
# Largest number of segments beside those of a buckled stretch: each level takes seconds.
MOST_BESIDE = 512
# The error of a load near zero is relative to this share of its parts (weight, Σ r μ F_n).
SHARE_OF_WHOLE = 0.1


class Task(NamedTuple):
    """What every level solves: rates by kind of operation, bit depth [m], segments at most."""

    rates: Mapping[str, SteadyRates]
    bit_depth: float
    most: int
    progress: Progress | None


class Level(NamedTuple):
    """The strings of one layout and fineness.

    loads (operations, 2) : hook load [N] and torque [N m], NaN where a string was not solved; scales (operations, 2) :
    the values errors are relative to; seconds (operations,); length : that the layout was asked for [m]; fineness : how
    many times as fine as the first level.
    """

    stage: str
    layout: str
    case: Case
    segments: int
    shortest: float
    loads: Array
    scales: Array
    points: list[Equilibrium]
    seconds: list[float]
    length: float = 0.0
    fineness: float = 1.0

    @property
    def answered(self) -> bool:
        """Whether every operation has its loads."""
        return bool(np.isfinite(self.loads).all())

    @property
    def resolved(self) -> int:
        """Segments of the longest string with a buckled stretch laid out by the solver, 0 without one."""
        return max((len(point.profile) - 1 for point in self.points if point.shape != "none"), default=0)


def cut(case: Case, task: Task, layout: str, length: float, least: int = 1) -> Case:
    """The case with its string in a layout; length, least : of ``Layout``."""
    return layouts.with_components(case, layouts.LAYOUTS[layout](case, task.bit_depth, length, least))


def solve_level(stage: str, layout: str, case: Case, task: Task) -> Level:
    """Solve the strings of all operations."""
    string = lay_out(case, task.bit_depth)
    weight = float(np.abs(string.weight) @ string.length)
    if task.progress is not None:
        task.progress(f"{stage}: {string.segments} segments")
    points, seconds = [], []
    began = time.perf_counter()
    solver = Solver(case)
    for kind, rates in task.rates.items():
        points.append(solver.solve(kind, rates, task.bit_depth))
        seconds.append(time.perf_counter() - began)
        began = time.perf_counter()
    loads = [_loads(p) if counts(p, stage) else (np.nan, np.nan) for p in points]
    scales = [_scales(p, weight, rates.spin) for p, rates in zip(points, task.rates.values(), strict=True)]
    return Level(
        stage, layout, case, string.segments, float(string.length.min()), np.array(loads), np.array(scales), points,
        seconds,
    )  # fmt: skip


def is_judged(case: Case, level: Level) -> bool:
    """Whether a level may end the search: beside bent and short components of the case its segments are short."""
    return level.length <= layouts.BESIDE_SHORT or not layouts.has_short(case)


def counts(point: Equilibrium, stage: str = "string") -> bool:
    """Whether the loads of a string count; those of one that lies too straight count for the hole alone."""
    by_hole = stage == "hole" and point.status == SteadyStatus.UNDER_RESOLVED
    return point.answered and (point.status.acceptable or by_hole)


def relative_difference(point: Equilibrium, other: Equilibrium, spin: float) -> tuple[float, float]:
    """Differences in hook load and torque, relative to the loads of ``other`` as in a refinement.

    spin : rotation of both strings [rad/s].
    """
    string = lay_out(other.case, other.bit_depth)
    scales = _scales(other, float(np.abs(string.weight) @ string.length), spin)
    hookload, torque = np.abs(np.subtract(_loads(point), _loads(other))) / scales
    return float(hookload), float(torque)


def _loads(point: Equilibrium) -> tuple[float, float]:
    return point.hookload, point.surface_torque


def _scales(point: Equilibrium, weight: float, spin: float) -> tuple[float, float]:
    """The values to which errors in hook load and torque are relative; weight : of the string in mud [N]."""
    # Without friction torque is rounding alone.  In a string that only slides, chords cause a small torque of first
    # order, negligible against the torque of rotation.
    friction = max(point.sum_r_mu_fn, 1e-5 * weight) * (SHARE_OF_WHOLE if spin else 1.0)
    return max(abs(point.hookload), SHARE_OF_WHOLE * weight), max(abs(point.surface_torque), friction)


def errors_of(levels: Sequence[Level]) -> tuple[Array, Array]:
    """Relative change since the previous solved level, and estimated error, of the last level: (operations, 2) each.

    At first order the changes of doubled counts form a geometric series, and the remaining error equals the last
    change.  Every earlier change predicts a remaining error in the same way; the largest counts.
    """
    last = levels[-1]
    change, missing = np.full((2, *last.loads.shape), np.nan)
    for k, column in np.ndindex(last.loads.shape):
        answers = [i for i, level in enumerate(levels) if np.isfinite(level.loads[k, column])]
        if len(answers) < 2 or answers[-1] != len(levels) - 1:
            continue
        changes = [abs(levels[j].loads[k, column] - levels[i].loads[k, column]) for i, j in pairwise(answers)]
        left = [
            step / (levels[j].fineness / levels[i].fineness - 1) * levels[j].fineness / last.fineness
            for step, (i, j) in zip(changes, pairwise(answers), strict=True)
        ]
        change[k, column], missing[k, column] = changes[-1], max(left)
    return change / last.scales, SAFETY * missing / last.scales


def largest_error(levels: Sequence[Level]) -> float:
    """The largest estimated error of the last level; infinite while there is no estimate."""
    worst = float(errors_of(levels)[1].max())
    return worst if np.isfinite(worst) else np.inf
