"""Refinement: a string is cut into shorter segments until its loads no longer change (§5.6), with the estimated error.

First the hole's cylinders are halved until their error is small, then the segments.  The error is estimated from the
changes so far by Richardson's method, at first order, which is safe: the ends of contact move by whole segments, so
torque converges irregularly, at first order or a little better, and one small change may be chance.

The stretch where a string is buckled is laid out by the solver (post_buckling.py), in segments that its waves need, so
that the loads depend on the length of the other segments alone; the case's ``solver.buckling`` can turn that off.

Every level halves all segments, down to half a metre those of components shorter than the others' segments too: bent
housings, motors, stabilisers.  With such components no string is judged that has segments of more than 10 m.

Before a graded string a uniform one is found.  Since a graded string is valid for one bit depth only, it has to need
at least a tenth fewer segments.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, check_bit_depth, naming_file, with_friction
from fctd.case.message import Message, quantity, within
from fctd.case.operation_names import kinds_of
from fctd.case.units import bare
from fctd.mechanics.state import MAX_SEGMENTS
from fctd.model import layouts
from fctd.model.chords import largest_chord, shorter_cylinders
from fctd.model.depths import depth_of
from fctd.model.operations import rates_of_all
from fctd.results.notes import Note, worst
from fctd.results.status import RefineStatus
from fctd.steady.counts import ends_of, judged, solve_counts
from fctd.steady.levels import (
    MOST_BESIDE,
    Level,
    Progress,
    Task,
    counts,
    cut,
    errors_of,
    is_judged,
    largest_error,
    solve_level,
)

if TYPE_CHECKING:
    import pandas as pd


# Segments of the first string, and of the strings with which the hole is refined.
FIRST, IN_HOLE = 16, (128, 512)
# Largest number of halvings of the cylinders.
HALVINGS = 6
# Share of the tolerance for the error of the cylinders.
SHARE_OF_HOLE = 0.25
# Solved levels that an estimate needs, and unsolved finer levels after which the refinement stops.
ANSWERS, UNANSWERED = 3, 2
# Segments of a graded string over those of a uniform one, at most.
WORTH = 0.9


@dataclass(frozen=True, repr=False)
class Refinement:
    """The result of a refinement: the last case that was solved, with its estimated error.

    status : how the search ended; message : details.  case : with the last string that was solved, else as given.
    tolerance, error : allowed and estimated relative error of hook load and torque, the largest over the
    operations.  layout : ``uniform`` or ``graded``.  segments : of the string in the hole.  shortest : of them [m].
    steps : a row per stage, layout, level and operation; columns stage ("hole", "string", or "counts" of a range),
    layout, level, operation, segments, shortest_m, chord_m (largest distance of a cylinder from the hole), hookload_N,
    surface_torque_N_m, hookload_change, torque_change, hookload_error, torque_error (all relative; NaN while there is
    none), status, time_s.
    notes : of the last strings that were solved, each code once.  resolved : largest number of their segments where
    the solver laid out a buckled stretch (such loads need ``solver.buckling = "resolve"``), else 0.  orders : of a
    range of counts, the columns of ``counts.judged``; else None.
    """

    status: RefineStatus
    message: str
    case: Case
    operations: tuple[str, ...]
    bit_depth: float
    tolerance: float
    error: float
    layout: str
    segments: int
    shortest: float
    steps: pd.DataFrame
    notes: tuple[Note, ...] = ()
    resolved: int = 0
    orders: pd.DataFrame | None = None


def refine(
    case: Case,
    tolerance: float = 0.01,
    operation: str | Sequence[str] | None = None,
    bit_depth: float | str | None = None,
    graded: bool = False,
    most: int = 5000,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    progress: Progress | None = None,
    *,
    friction: FrictionChoice | None = None,
    segments: str | Sequence[int] | None = None,
) -> Refinement:
    """Cut the string of a case finer until hook load and torque are within ``tolerance`` (0.01 is 1 %).

    operation : kind or kinds, by default that of the case's first operation; bit_depth [m], or a text as of
    ``equilibrium``, by default that operation's end.  graded : short segments in bends and near the bit, long ones
    elsewhere, if that takes at least a tenth fewer segments than one length for all; a graded string is valid for this
    bit depth only.  most : segments at most.  speed [m/s], rpm, flow [m³/s] : see ``torque_drag``.  friction : factors
    as of ``equilibrium``, which the refined case has too.  Errors are relative to the load, or to a tenth of the
    string's weight (hook load) or of Σ r μ F_n (torque) where that is more; without rotation to all of Σ r μ F_n.  The
    solver lays out the buckled stretch of a string, unless the case sets ``solver.buckling``.  segments : a range of
    counts, "10:1000" or a pair, all of which is solved beside the search, uniform, graded and by default: observed
    orders, extrapolated loads, and the counts that the tolerance needs.  Raises InputError for bad input.
    """
    import pandas as pd

    ends = None if segments is None else ends_of(segments)
    with naming_file(case):
        case = with_friction(case, friction)
        kinds = _kinds(case, operation)
        depth = _depth(case, kinds[0], bit_depth)
        _check(case, tolerance, most, depth)
        task = Task(rates_of_all(case, kinds, speed, rpm, flow), depth, most, progress)
        coarse = _with_buckling(case, "detect")
        whole = layouts.divided_length(case, depth)
        solve_level("string", "uniform", cut(coarse, task, "uniform", whole / FIRST), task)  # compile
        resolving = case if "buckling" in case.solver.model_fields_set else _with_buckling(case, "resolve")
        # Chords change the loads of a string that lies too straight where it is buckled as they do those of any other.
        holes = _refine_hole(coarse, task, SHARE_OF_HOLE * tolerance)
        error_of_hole = largest_error(holes) if holes else 0.0
        in_hole = resolving.model_copy(update={"wellbore": holes[-1].case.wellbore}) if holes else resolving
        strings = _refine_string(in_hole, task, "uniform", tolerance - error_of_hole)
        found = _result(case, task, tolerance, error_of_hole, holes, strings)
        if graded:
            fewer = task._replace(most=int(WORTH * found.segments)) if found.status.acceptable else task
            strings = _refine_string(in_hole, fewer, "graded", tolerance - error_of_hole)
            found = _better(found, _result(case, task, tolerance, error_of_hole, holes, strings))
        if ends is None:
            return found
        by_layout = solve_counts(in_hole, task, *ends)
        orders, errors = judged(task, by_layout, tolerance)
        solved = [row for layout, levels in by_layout.items() for row in _rows(task, levels, errors[layout])]
        steps = pd.concat([found.steps, pd.DataFrame(solved)], ignore_index=True)
        return replace(found, steps=steps, orders=pd.DataFrame(orders))


def _refine_hole(case: Case, task: Task, allowed: float) -> list[Level]:
    """Levels of ever shorter cylinders, until their error is allowed; empty for a hole without cylinders."""
    levels: list[Level] = []
    if case.wellbore.geometry != "cylinders" or not case.contact.enabled:
        return levels
    for segments in IN_HOLE:
        of = cut(case, task, "uniform", layouts.divided_length(case, task.bit_depth) / segments)
        levels = [solve_level("hole", "uniform", of, task)]
        if levels[0].answered:
            break
    while len(levels) <= HALVINGS and not (largest_error(levels) <= allowed):
        of = shorter_cylinders(of)
        levels.append(solve_level("hole", "uniform", of, task)._replace(fineness=2.0 ** len(levels)))
    return levels


def _refine_string(case: Case, task: Task, layout: str, allowed: float) -> list[Level]:
    """Levels of ever shorter segments, until their error is allowed or the next level has too many segments."""
    levels: list[Level] = []
    length = layouts.divided_length(case, task.bit_depth) / FIRST
    while True:
        of = cut(case, task, layout, length, 2 ** len(levels))
        most = min(task.most, MOST_BESIDE) if levels and levels[-1].resolved else task.most
        if levels and layouts.segments_in_hole(of, task.bit_depth) > most:
            return levels
        fineness = 2.0 ** len(levels)
        levels.append(solve_level("string", layout, of, task)._replace(length=length, fineness=fineness))
        answered = [k for k, level in enumerate(levels) if level.answered]
        if len(answered) >= ANSWERS and largest_error(levels) <= allowed and is_judged(case, levels[-1]):
            return levels
        if answered and len(levels) - answered[-1] > UNANSWERED:
            return levels
        if len(levels) >= ANSWERS and all(level.resolved and not level.answered for level in levels[-ANSWERS:]):
            return levels  # no balance with segments as short as a buckled string needs
        length /= 2


def _result(
    case: Case, task: Task, tolerance: float, error_of_hole: float, holes: list[Level], strings: list[Level]
) -> Refinement:
    """The refinement that results from the levels."""
    import pandas as pd

    answered = [k for k, level in enumerate(strings) if level.answered]
    steps = pd.DataFrame(_rows(task, holes) + _rows(task, strings))
    notes = worst(note for point in (strings[answered[-1]].points if answered else []) for note in point.notes)

    def finish(
        status: RefineStatus, message: str, of: Case, error: float, segments: int, shortest: float
    ) -> Refinement:
        return Refinement(
            status, Message(message), of, tuple(task.rates), task.bit_depth, tolerance, error, strings[0].layout,
            segments, shortest, steps, notes, strings[answered[-1]].resolved if answered else 0,
        )  # fmt: skip

    if not answered:
        point = next(point for point in strings[-1].points if not counts(point))
        message = f"no string of {strings[0].segments} to {strings[-1].segments} segments has a solution for "
        message += f"{point.operation} ({point.status}: {within(point.message)})"
        return finish(RefineStatus.NO_ANSWER, message, case, np.inf, 0, np.nan)
    found = strings[answered[-1]]
    error = error_of_hole + largest_error(strings[: answered[-1] + 1])
    judged = is_judged(case, found)
    if answered[-1] == len(strings) - 1 and error <= tolerance and len(answered) >= ANSWERS and judged:
        return finish(RefineStatus.WITHIN_TOLERANCE, "", found.case, error, found.segments, found.shortest)
    left = f"an error of {100 * error:.3g} %" if np.isfinite(error) else "an unknown error"
    message = f"{left} remains at {found.segments} segments, the largest number tried"
    if answered[-1] != len(strings) - 1:
        lost = next(point for point in strings[-1].points if not counts(point))
        why = f"{lost.operation}: {lost.status}"
        message = f"strings of more than {found.segments} segments have no solution ({why}); {left} remains"
    if not judged:
        message += f"; bent and short components ask for segments of {quantity(layouts.BESIDE_SHORT, 'm')} beside them"
    if tolerance < error_of_hole < np.inf:
        message += f"; {100 * error_of_hole:.3g} % of it comes from the cylinders"
    return finish(RefineStatus.NOT_REACHED, message, found.case, error, found.segments, found.shortest)


def _better(uniform: Refinement, graded: Refinement) -> Refinement:
    """The one within the tolerance with the fewest segments, else that with the smallest error; steps of both."""
    import pandas as pd

    def merit(found: Refinement) -> tuple[bool, float]:
        within = found.status.acceptable
        return not within, found.segments if within else found.error

    steps = pd.concat([uniform.steps, graded.steps[graded.steps["stage"] == "string"]], ignore_index=True)
    return replace(min(uniform, graded, key=merit), steps=steps)


def _rows(task: Task, levels: list[Level], errors: Array | None = None) -> list[dict[str, Any]]:
    """A row per level and operation; errors (levels, operations, 2) : in place of those at first order."""
    rows = []
    for k, level in enumerate(levels):
        change, error = errors_of(levels[: k + 1])
        error = error if errors is None else errors[k]
        for i, kind in enumerate(task.rates):
            row = {
                "stage": level.stage, "layout": level.layout, "level": k, "operation": kind,
                "segments": level.segments, "shortest_m": level.shortest, "chord_m": largest_chord(level.case),
                "hookload_N": level.loads[i, 0], "surface_torque_N_m": level.loads[i, 1],
                "hookload_change": change[i, 0], "torque_change": change[i, 1],
                "hookload_error": error[i, 0], "torque_error": error[i, 1],
                "status": level.points[i].status.value, "time_s": level.seconds[i],
            }  # fmt: skip
            rows.append(row)
    return rows


def _with_buckling(case: Case, how: str) -> Case:
    return case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": how})})


def _kinds(case: Case, operation: str | Sequence[str] | None) -> list[str]:
    if operation is None:
        if not case.operations:
            raise InputError("a kind of operation, as the case has none", key="operation")
        return [case.operations[0].kind]
    return kinds_of(operation)


def _depth(case: Case, kind: str, bit_depth: float | str | None) -> float:
    """The given bit depth, else the end of the case's first operation of that kind, else of its first operation."""
    if bit_depth is not None:
        return depth_of(bit_depth, case, "bit_depth")
    if not case.operations:
        raise InputError("a bit depth, as the case has no operation", key="bit_depth")
    return next((o for o in case.operations if o.kind == kind), case.operations[0]).end_md


def _check(case: Case, tolerance: float, most: int, depth: float) -> None:
    if not 0 < bare(tolerance, "tolerance", "a share above 0 and below 1, such as 0.01") < 1:
        raise InputError("a share above 0 and below 1, such as 0.01", key="tolerance", value=tolerance)
    if not FIRST <= bare(most, "most", "a number of segments") <= MAX_SEGMENTS:
        raise InputError(f"{FIRST} to {MAX_SEGMENTS} segments", key="most", value=most)
    for k, component in enumerate(case.string.components):
        if component.repeat is not None:
            raise InputError(
                "none in a refinement, which cuts whole components: refine without it, then add it",
                key=f"string.components[{k}].{component.repeat_key}",
                value=component.repeat.segments,
            )
    if case.contact.helical_force != "none":
        raise InputError('"none" in a refinement', key="contact.helical_force", value=case.contact.helical_force)
    check_bit_depth(depth, *case.depths, "bit_depth", quantity(depth, "m"))
