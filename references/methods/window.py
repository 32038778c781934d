"""The window in which the loads of all methods and engines are compared: one start, and whole periods of the string."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from fctd.arena.result import WindowOf
from fctd.arrays import Array
from fctd.case.errors import InputError, nearest
from fctd.case.hole import WellboreSpec
from fctd.case.load import Case, make_case
from fctd.case.operations import KINDS, Operation, Stay
from fctd.case.raw_case import checked
from fctd.mechanics.faults import UnstableError
from fctd.model.drillstring import lay_out
from fctd.model.torsion import axial_period_of, period_of
from fctd.results.swings import AS_PLANNED
from references.engines import EngineRun, StepOptions, Window
from references.engines.own import Fctd
from references.engines.run import hann_means, run_window

WHOLE = 2  # periods of the slowest vibration in a window, at least: a Hann window over them keeps none of its swing
RAMP, REST = 3, 2  # periods over which the operation begins, and those after it before the window, at least
# The string also swings across the hole, by the second whatever its length: the least time of each [s].
LEAST_RAMP, LEAST_REST, LEAST_WINDOW = 10.0, 5.0, 2.0
RECORDS = 60  # of a window
TRIES = 5  # of a later start, where the bit does not turn yet
SPARE = 1e-3  # [s] of the operation after the window
USUAL: dict[str, Any] = {"kind": "rotate_off_bottom", "rpm": 60.0, "duration": 1.0}


class Plan(NamedTuple):
    """case : with the operation alone, long enough, in arcs where the hole is round.  window : of it.

    own, own_radii : the engine's own run in it, and contact radii of the string (n,) [m].  notes : what a reader has
    to know of it.
    """

    case: Case
    window: Window
    described: WindowOf
    own: EngineRun
    own_radii: Array
    notes: tuple[str, ...]


def in_arcs(case: Case) -> Case:
    """The case with its hole as arcs, the geometry that is exact; one with a caliper keeps its sampled wall.

    Raises InputError for a survey that has no arcs.
    """
    if case.wellbore.geometry == "sampled":
        return case
    hole = checked(WellboreSpec, case.wellbore.model_dump(exclude_none=True) | {"geometry": "arcs"})
    return case.model_copy(update={"wellbore": hole})


def chosen(case: Case, which: str | None) -> Operation:
    """The operation of a case that has this number, from 1, or is of this kind; the first by default.

    A case without operations rotates off bottom at its deepest.  Raises InputError for one that it has not.
    """
    operations = case.operations
    if not operations and which in (None, "1", USUAL["kind"]):
        return checked(KINDS[USUAL["kind"]], USUAL | {"at_md": case.deepest})
    if which is None:
        return operations[0]
    if which.isdecimal() and 1 <= int(which) <= len(operations):
        return operations[int(which) - 1]
    for operation in operations:
        if operation.kind == which:
            return operation
    kinds = list(dict.fromkeys(operation.kind for operation in operations))
    expected = f"a number from 1 to {len(operations)}, or {nearest(which, kinds, 'operation')}"
    raise InputError(expected, key="--operation", value=which)


def plan_of(case: Case, which: str | None = None, periods: int = WHOLE) -> Plan:
    """The window of an operation of a case, and the engine's own run in it.

    It lies at the deepest end of the operation, and begins once the string moves: the start is ramped over RAMP periods
    of the slowest vibration, torsional where the string turns, else axial, so that it excites little of it.  Over a
    single of these periods a mean keeps half of the swing, and differences of methods from one start stand.  Raises
    InputError for a case that cannot be simulated, and for one whose string does not settle.
    """
    case, operation = in_arcs(case), chosen(case, which)
    deepest = max(operation.start_md, operation.end_md)
    string = lay_out(case, deepest)
    turning = operation.rpm > 0
    period = period_of(string) if turning else axial_period_of(string)
    ramp = max(operation.ramp_time, RAMP * period, LEAST_RAMP)
    whole = max(periods, int(np.ceil(LEAST_WINDOW / period)))
    begins, lasts = ramp + max(REST * period, LEAST_REST), whole * period
    notes: tuple[str, ...] = ()
    for later in range(TRIES):
        window = Window(begins + later * lasts, lasts)
        planned, run = _run(case, operation, ramp, window)
        # The mean over a single period has half of the swing.
        if not turning or periods < WHOLE or _turns(run, operation.rpm):
            break
    else:
        notes = ("the bit does not turn as planned in the window: loads swing with it",)
    if run.status != "valid":
        notes += (f"the engine's own run is {run.status}, and no other is held to that check: {run.message}",)
    moved = planned.operations[0]
    described = WindowOf(
        operation=KINDS[moved.kind].label, from_md_m=moved.start_md, to_md_m=moved.end_md, start_s=window.start,
        duration_s=window.duration, vibration="torsional" if turning else "axial", period_s=period, whole=whole,
        segments=len(run.profile) - 1, step_s=run.step,
    )  # fmt: skip
    return Plan(planned, window, described, run, string.contact_radius(), notes)


def _run(case: Case, operation: Operation, ramp: float, window: Window) -> tuple[Case, EngineRun]:
    """The case with the operation alone, long enough for a window, and the engine's own run in it."""
    lasts = window.start + window.duration + SPARE
    changes: Mapping[str, Any]
    if isinstance(operation, Stay):
        changes = {"duration": lasts}
    else:
        travel = operation.speed * (lasts - 0.5 * ramp)
        down = operation.direction > 0
        changes = {"from_md": operation.end_md - travel} if down else {"to_md": operation.start_md - travel}
    alone = checked(type(operation), operation.model_dump() | {"ramp_time": ramp} | changes)
    record = case.record.model_copy(update={"interval": window.duration / RECORDS, "profile_at": ()})
    planned = case.model_copy(update={"operations": (alone,), "record": record})
    planned = make_case(planned.model_dump(exclude_none=True, exclude={"file"}), None, like=case)
    try:
        return planned, run_window(planned, window, Fctd(StepOptions()))
    except UnstableError as error:
        raise InputError(f"a case whose string settles ({error})", key="CASE", value=case.name) from error


def _turns(run: EngineRun, rpm: float) -> bool:
    """Whether the bit turns as planned, on average over a run."""
    return bool(hann_means(run.history)["bit_rpm"] >= AS_PLANNED * rpm)
