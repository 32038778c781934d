"""Cost of FCTD alone: largest stable step, cost over segments, the query, the share of contact, a steady depth."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case
from fctd.arena.result import Quartiles
from fctd.mechanics import topdrive
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import steady_rates
from fctd.simulation.run import Run
from fctd.steady.equilibrium import Solver
from references.engines import Stepper
from references.timing.stopwatch import race, units_for
from references.timing.workloads import copy_of, fallen, find_walls, free_query, moving, touching, without_wall
from validation.cases import load, rotation
from validation.cases.wells import drilled_paper_well
from validation.harness.study import ENDS, Check, fitted_exponent, quartiles_of
from validation.parts.recorded_kinds import RECORDED_KINDS

BIT = 2450.0
# FCTD's stepper runs this long [s] before it is timed, so that the first wave has passed the string.
LEAD = 6.0
# Steps tried, over the engine's own choice: from far below it to well past the bound of the stiffest mode, 1.25.
SMALL, LADDER = 0.25, (1.0, 1.1, 1.2, 1.25, 1.3, 1.35, 1.4, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0)
WITHIN = 0.01  # of hook load and torque at the smallest step
CONTACT, BEST = "contact", "FCTD, largest stable step"
LENGTHS = (60, 170, 500, 1000, 2000, 5000, 10_000)


def chain(segments: int, **changes: Any) -> Case:
    """The curved chain with this number of segments, turning off bottom."""
    schedule = rotation(BIT, 2e4 if segments <= 1000 else 60.0, ramp=4.0)
    return load("curved_chain", operations=schedule, string__components__0__segments=segments, **changes)


def run_at(start: Run, motion: Motion, step: float, duration: float) -> dict[str, Any]:
    """Mean loads of a run from one state with one step, and its status."""
    run = copy_of(start, step=step)
    parts = max(int(duration / step / 100), 1)
    row: dict[str, Any] = {"step_ms": 1e3 * step, "status": "valid", "hookload_kN": np.nan, "torque_kN_m": np.nan}
    try:
        for _ in range(parts):
            run.advance(motion, 100 * step)
            run.refresh()
            run.check()
    except UnstableError as error:
        return row | {"status": f"invalid: {error}"}
    elapsed = 1e3 * parts * 100 * step
    hookload, torque = run.top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] / elapsed
    return row | {"hookload_kN": float(hookload), "torque_kN_m": float(torque)}


def ladder(segments: int, duration: float) -> pd.DataFrame:
    """Steps from small to large over the same window: a step holds when its loads agree with those of the smallest."""
    start, motion = moving(chain(segments), 20.0)
    rows: list[dict[str, Any]] = []
    for factor in (SMALL, *LADDER):
        row = run_at(start, motion, factor * start.step, duration)
        truth = rows[0] if rows else row
        off = max(abs(row[load] / truth[load] - 1) for load in ("hookload_kN", "torque_kN_m"))
        holds = row["status"] == "valid" and off <= WITHIN
        rows.append({"segments": segments, "over_default": factor} | row | {"off_percent": 100 * off, "holds": holds})
        if not holds:
            break
    return pd.DataFrame(rows)


def scaling(lengths: tuple[int, ...], rounds: int, aim: float) -> pd.DataFrame:
    """One step against the number of segments, every string fallen onto the wall in the same time and turning."""
    actions: dict[str, Callable[[], object]] = {}
    counts, facts, runs = {}, {}, []
    for segments in lengths:
        run, motion = fallen(chain(segments), 0.5)
        runs.append(run)
        facts[str(segments)] = (segments, 1e3 * run.step, 100 * touching(run))
        count = units_for(partial(step_on, run, motion), aim)
        actions[str(segments)], counts[str(segments)] = partial(step_on, run, motion, count), count * segments
    table = race(actions, counts, rounds, str(lengths[0]))
    for run in runs:  # a time counts only if the string is still valid
        run.refresh()
        run.check()
    table[["segments", "step_ms", "touching_percent"]] = [facts[name] for name in table["name"]]
    return with_growth(table[["segments", "step_ms", "touching_percent", "ns", "ns_low", "ns_high", "ns_least"]])


def with_growth(table: pd.DataFrame) -> pd.DataFrame:
    """The same with the wall time of a simulated second, and its mean growth from the first row for twice the segments.

    Not from row to row: on a busy machine a single row may take twice as long.  Each with its quartiles.
    """
    doublings = np.log2(table["segments"] / table["segments"].iloc[0])
    for end in ENDS:
        table = table.assign(
            **{f"ms_per_simulated_s{end}": table["segments"] * table[f"ns{end}"] / (1e3 * table["step_ms"])}
        )
    for end, start in zip(ENDS, ("", "_high", "_low"), strict=True):
        grown = table[f"ms_per_simulated_s{end}"] / table[f"ms_per_simulated_s{start}"].iloc[0]
        table = table.assign(**{f"growth_when_doubled{end}": (2 ** (np.log2(grown) / doublings)).where(doublings > 0)})
    return table


def exponent(table: pd.DataFrame) -> Quartiles:
    """Growth of the cost of a step with the number of segments; with the quartiles of the fit."""
    return fitted_exponent(table["segments"], table["segments"] * table["ns"])


def kernel(best: float, rounds: int, aim: float) -> pd.DataFrame:
    """A segment-step of 60 segments with and without the wall and at the step ``best`` [s], and the query of a point.

    The query in the step has the 60 points of the string; that of free points has 1000.
    """
    runs = {geometry: moving(chain(60, wellbore__geometry=geometry), LEAD) for geometry in ("cylinders", "arcs")}
    run, motion = runs["cylinders"]
    steppers = {CONTACT: run, "no contact": without_wall(run), BEST: copy_of(run, step=best)}
    work: dict[str, tuple[Callable[[int], object], int]] = {
        name: (partial(step_on, stepper, motion), 60) for name, stepper in steppers.items()
    }
    for geometry, (turning, _) in runs.items():
        work[f"query in the step, {geometry}"] = (partial(find_walls, turning), 60)
        many = fallen(chain(1000, wellbore__geometry=geometry), 0.3)[0]
        work[f"query of free points, {geometry}"] = (free_query(many), 1000)
    units = {name: units_for(task, aim) for name, (task, _) in work.items()}
    actions: dict[str, Callable[[], object]] = {name: partial(task, units[name]) for name, (task, _) in work.items()}
    table = race(actions, {name: units[name] * work[name][1] for name in work}, rounds, CONTACT)
    return table.assign(step_ms=[1e3 * steppers[name].step if name in steppers else np.nan for name in table["name"]])


def step_on(stepper: Run | Stepper, motion: Motion, count: int) -> None:
    """Advance a run or an engine by this number of steps."""
    stepper.advance(motion, count * stepper.step)


def steady(rounds: int) -> pd.DataFrame:
    """Milliseconds per depth of paper-well with 61 and 500 segments, each operation; fastest round."""
    solvers = {segments: Solver(drilled_paper_well(segments)) for segments in (61, 500)}
    actions: dict[str, Callable[[], object]] = {}
    for segments, solver in solvers.items():
        for kind in RECORDED_KINDS:
            actions[f"{segments} {kind}"] = partial(solver.solve, kind, steady_rates(solver.case, kind), BIT)
    table = race(actions, dict.fromkeys(actions, 1), rounds, next(iter(actions))).set_index("name")["ns_least"] / 1e6
    rows = [{"segments": n, **{f"{kind}_ms": table[f"{n} {kind}"] for kind in RECORDED_KINDS}} for n in solvers]
    rows = [row | {"slowest_ms": max(list(row.values())[1:])} for row in rows]
    return pd.DataFrame(rows)


def real_time(kernel: pd.DataFrame, name: str) -> Quartiles:
    """Simulated over wall time of 60 segments in contact."""
    (row,) = kernel[kernel["name"] == name].to_dict("records")
    step = 1e6 * row["step_ms"] / 60
    return Quartiles(median=step, low=step, high=step).over(quartiles_of(row, "ns"))


def table_of(held: list[Check], made: list[Check], kernel: pd.DataFrame) -> pd.DataFrame:
    """Targets and measured values, and the real-time factor at the default step, which has no target.

    made : the checks of this run; the other targets have no verdict.
    """
    rows: list[tuple[str, str, str, str]] = [
        (
            check.name,
            check.requirement(),
            check.found(_digits),
            check.verdict if check in made else "not checked",
        )
        for check in held
    ]
    default = real_time(kernel, CONTACT)
    rows = [*rows, ("real-time factor, 60 segments, default step", "", _digits(default.median), "")]
    return pd.DataFrame(rows, columns=["what", "target", "reached", "verdict"])


def less(one: Quartiles, other: Quartiles) -> Quartiles:
    """A difference of what was not measured in the same rounds."""
    return Quartiles(median=one.median - other.median, low=one.low - other.high, high=one.high - other.low)


def _digits(value: float) -> str:
    """Three digits, and all of a large number."""
    return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
