"""Charts of wells in which strings buckle and lock up: every row has an answer, or says why not.

A real survey and random wells, with the segments of the case and with buckling resolved.  The limit of a locked string
is tried from both sides, and the resolved segments of a horizontal well are halved.
"""

import time
from collections.abc import Iterable, Sequence
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from fctd import Case
from fctd.case.load import with_friction
from fctd.case.operations import KINDS
from fctd.model import layouts
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from references.timing.stopwatch import rounds
from validation.cases.wells import real_well
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows, time_check
from validation.parts import random_wells
from validation.parts.buckled_pipe import OPERATION
from validation.parts.fed_strings import scaled
from validation.parts.recorded_kinds import RECORDED_KINDS
from validation.parts.resolved_rows import DEPTH, WEIGHT, horizontal_well
from validation.parts.slid_strings import slide

FRICTIONS = (0.2, 0.3, 0.4, 0.5)
WEIGHTS = (0.0, 100e3, 200e3, 300e3)  # on bit [N]
STEP, DEEPEST = 500.0, 8000.0  # [m]
WELLS, SHARES = 200, (0.4, 0.7, 1.0)  # of the depths that a string can reach
RESOLVED, RESOLVED_WELLS = 10, 20  # rows, drawn from those that are buckled or locked up
LIMITS, BELOW, ABOVE = 30, 0.97, 1.03
SHORT = 2000.0  # more locked strings for the limits are at most as long [m]
THOUSAND = (800, 1200)  # segments of the rows whose time is judged
SLID = 4  # strings that trip in, at both shares
HALVED = (0.3, 0.6, 0.9)  # of the friction at lock-up
BEYOND_LOCK_UP = 0.34  # friction factor
AMPLE = 8e7  # work for strings of twice the segments, ten times the default
Row = tuple[Case, str, float]  # case, operation, bit depth
# What a row may say.
REASONED = (SteadyStatus.CONVERGED, SteadyStatus.LOCKED_UP, SteadyStatus.UNSTABLE, SteadyStatus.UNDER_RESOLVED)


def solve(case: Case, kind: str, depth: float) -> Equilibrium:
    """A row."""
    return Solver(case).solve(kind, steady_rates(case, kind), depth)


def resolving(case: Case, **more: Any) -> Case:
    """The case with buckling resolved, and more keys of its solver."""
    return case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": "resolve", **more})})


def row_of(well: str, point: Equilibrium, **more: Any) -> dict[str, Any]:
    """A row of the tables."""
    return {
        "well": well, **more, "operation": point.operation, "bit_depth_m": point.bit_depth,
        "weight_on_bit_kN": point.case.bit.weight_on_bit / 1e3, "status": str(point.status),
        "buckling": point.buckling.mode, "shape": point.shape, "hookload_kN": point.hookload / 1e3,
        "slack_off_spent_at": point.slack_off_spent_at, "locked_up_at": point.locked_up_at,
        "iterations": point.iterations, "reason": point.message,
    }  # fmt: skip


def real_rows(context: Context) -> Iterable[tuple[Case, str, float, float]]:
    """Case, operation, depth and friction factor of every row of the real well; weight on bit where it counts."""
    frictions, weights = (FRICTIONS[2:3], WEIGHTS[2:3]) if context.quick else (FRICTIONS, WEIGHTS)
    fine: dict[str, Any] = {"segments": None, "segment_length": "10 m"}
    changes = {f"string__components__0__{key}": value for key, value in fine.items()}
    for weight in weights:
        case = real_well(context, wellbore__geometry="arcs", bit__weight_on_bit=weight, **changes)
        for friction in frictions:
            for kind in RECORDED_KINDS:
                if weight > 0 and not KINDS[kind].on_bottom and weights[0] == 0:
                    continue
                for depth in np.arange(STEP, DEEPEST + 1, 8 * STEP if context.quick else STEP):
                    yield with_friction(case, friction), kind, float(depth), friction


def random_rows(count: int) -> Iterable[tuple[int, Case, str, float]]:
    """Seed, case, operation and depth of every row of the random wells."""
    for seed in range(count):
        case = Case.model_validate(random_wells.well(Random(seed)))
        top, bottom = case.depths
        for kind in RECORDED_KINDS:
            for share in SHARES:
                yield seed, case, kind, round(top + share * (bottom - top), 2)


def statuses(context: Context) -> tuple[pd.DataFrame, list[Row], list[Row]]:
    """Every row with the segments of its case, those that are to be resolved, and locked ones for their limits."""
    rows, hard, locked = [], [], []
    real, drawn = list(real_rows(context)), list(random_rows(1 if context.quick else WELLS))
    for case, kind, depth, friction in context.progress(real, "rows of a real well"):
        point = solve(case, kind, depth)
        rows.append(row_of("K05-ENC-05-S1", point, friction=friction))
        if point.status != SteadyStatus.CONVERGED:
            hard.append((case, kind, depth))
    rng = np.random.default_rng(1)
    picked = [hard[k] for k in rng.permutation(len(hard))[:RESOLVED]]
    hard = []
    for seed, case, kind, depth in context.progress(drawn, "rows of random wells"):
        point = solve(case, kind, depth)
        rows.append(row_of(f"random {seed}", point, friction=np.nan))
        if point.status != SteadyStatus.CONVERGED:
            hard.append((case, kind, depth))
        if point.status == SteadyStatus.LOCKED_UP and depth <= SHORT:
            locked.append((case, kind, depth))
    picked += [hard[k] for k in rng.permutation(len(hard))[:RESOLVED_WELLS]]
    more = [locked[k] for k in rng.permutation(len(locked))]
    return pd.DataFrame(rows), picked[:1] if context.quick else picked, [] if context.quick else more


class Locked(NamedTuple):
    """A resolved row without a balance at its loads: its case, and the share of the friction at which it locks up."""

    case: Case
    point: Equilibrium
    at: float


def resolved_rows(
    context: Context, picked: list[Row], more: list[Row]
) -> tuple[pd.DataFrame, pd.DataFrame, list[Locked]]:
    """Rows with their buckling resolved, and those that lock up on both sides of their limit.

    more : rows that are resolved until there are ``LIMITS`` of the second kind.
    """
    rows: list[dict[str, Any]] = []
    limits: list[dict[str, Any]] = []
    locked: list[Locked] = []
    for k, (case, kind, depth) in enumerate(context.progress(picked + more, "resolved rows")):
        if k >= len(picked) and len(limits) >= LIMITS:
            break
        fine = resolving(case)
        began = time.process_time()
        point = solve(fine, kind, depth)
        seconds = time.process_time() - began
        rows.append(row_of(case.name, point, segments=len(point.profile) - 1, seconds=seconds))
        at = point.locked_up_at
        if point.status != SteadyStatus.LOCKED_UP or point.shape == "none" or not np.isfinite(at):
            continue
        locked.append(Locked(fine, point, at))
        if len(limits) >= LIMITS:
            continue
        below, above = (solve(scaled(fine, share * at), kind, depth) for share in (BELOW, ABOVE))
        limits.append(
            {
                "well": case.name, "operation": kind, "bit_depth_m": depth, "locked_up_at": at,
                "status_below": str(below.status), "hookload_below_kN": below.hookload / 1e3,
                "imbalance_below_N": below.imbalance if below.answered else np.nan,
                "status_above": str(above.status), "hookload_above_kN": above.hookload / 1e3,
            }
        )  # fmt: skip
    return pd.DataFrame(rows), pd.DataFrame(limits), locked


def slowest(resolved: pd.DataFrame, tried: Sequence[Row]) -> pd.DataFrame:
    """Processor times [s] of the row of some 1,000 segments that took longest, solved three times more; empty without.

    tried : the rows of ``resolved``, and others after them.
    """
    timed = resolved[resolved["segments"].between(*THOUSAND) & (resolved["shape"] != "none")]
    if timed.empty:
        return pd.DataFrame()
    case, kind, depth = tried[int(timed.index.to_numpy()[timed["seconds"].argmax()])]
    return pd.DataFrame({"seconds": rounds(lambda: solve(resolving(case), kind, depth), 3)})


@table_of_rows
def slid(context: Context, locked: list[Locked]) -> Rows:
    """Locked strings in time, on both sides of their limit and with their resolved segments.

    The stepper has no bit on bottom: those of the locked strings that trip in, with the fewest segments.
    """
    tripped = [row for row in locked if row.point.operation == "trip_in"]
    for case, point, at in context.progress(sorted(tripped, key=lambda row: len(row.point.profile))[:SLID], "stepper"):
        md = point.profile["md_m"].to_numpy()
        lengths = np.diff(md, prepend=2 * md[0] - md[1])
        cut = layouts.with_components(case, layouts.resolved(case, point.bit_depth, md, lengths))
        for share in (BELOW, ABOVE):
            found = slide(scaled(cut, share * at), point.operation, point.bit_depth)
            yield {
                "well": case.name, "bit_depth_m": point.bit_depth, "segments": len(md) - 1,
                "share_of_limit_percent": 100 * share, "status": found.status,
                "bit_follows_percent": 100 * found.share, "push_weights": found.push,
                "ends": "slides" if found.slides else "stalls",
            }  # fmt: skip


@table_of_rows
def halved() -> Rows:
    """The horizontal well at shares of its friction at lock-up, with the resolved segments and with their halves."""
    beyond = resolving(horizontal_well(20.0, "resolve", BEYOND_LOCK_UP), resolve_work=AMPLE)
    first = solve(beyond, OPERATION, DEPTH)
    locked = first.locked_up_at * BEYOND_LOCK_UP
    for friction in (*(share * locked for share in HALVED), BEYOND_LOCK_UP):
        case = with_friction(beyond, friction)
        point = solve(case, OPERATION, DEPTH)
        md = point.profile["md_m"].to_numpy()
        half = 0.5 * np.diff(md, prepend=2 * md[0] - md[1])
        other = solve(layouts.with_components(case, layouts.resolved(case, DEPTH, md, half)), OPERATION, DEPTH)
        yield {
            "friction": friction, "share_of_lock_up_percent": 100 * friction / locked,
            "segments": len(md) - 1, "halved_segments": len(other.profile) - 1,
            "shape": point.shape, "halved_shape": other.shape,
            "hookload_kN": point.hookload / 1e3, "halved_hookload_kN": other.hookload / 1e3,
            "off_percent_of_weight": 100 * (other.hookload - point.hookload) / WEIGHT,
            "locked_up_friction": friction * point.locked_up_at,
            "halved_locked_up_friction": friction * other.locked_up_at,
        }  # fmt: skip


def run(context: Context) -> Outcome:
    """Statuses, resolved rows and their limits; the full run halves segments as well."""
    rows, picked, more = statuses(context)
    resolved, limits, locked = resolved_rows(context, picked, more)
    tables = {"rows": rows, "counts": _counts(rows), "resolved": resolved, "resolved_counts": _counts(resolved)}
    display = {"counts": "Rows by status", "resolved_counts": "Rows with buckling resolved, by status"}
    if len(times := slowest(resolved, picked + more)):
        tables["slowest"] = times
    if len(limits):
        tables["limits"] = limits
        display["limits"] = f"Locked strings at {100 * BELOW:g} % and at {100 * ABOVE:g} % of their limit"
    if not context.quick:
        stepped = slid(context, locked)
        if len(stepped):
            tables["slid"] = stepped
            display["slid"] = "Locked strings that trip in, by the stepper"
        tables["halved"] = halved()
        display["halved"] = "A horizontal well that slides, with the resolved segments and with their halves"
    return Outcome(
        tables=tables,
        checks=_checks(tables),
        notes=[
            "Hole, string and friction of the real well are assumed, its survey is real. Random wells are those of the "
            f"seeds 0 to {WELLS - 1}; the full run resolves {RESOLVED} rows of the real well and {RESOLVED_WELLS} of "
            "the random ones, drawn from those that are not converged, and then locked rows of random wells with at "
            f"most {SHORT:g} m of string until {LIMITS} limits have been tried.",
        ],
        display=display,
    )


def _counts(rows: pd.DataFrame) -> pd.DataFrame:
    """Number of rows of each status in the real and in the random wells."""
    wells = rows["well"].str.replace(r"^(random|plausible).*", "random wells", regex=True)
    return rows.groupby([wells, "operation", "status"], sort=False).size().rename("rows").reset_index()


def _checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The numbers with bounds."""
    rows, resolved = tables["rows"], tables["resolved"]
    both = pd.concat([rows, resolved])
    checks = [
        Check("rows with a status that gives no reason", float((~both["status"].isin(REASONED)).sum()), 0, "at_most",
              "", "converged, locked up, unstable or under-resolved"),
        Check("rows other than converged without a reason",
              float(((both["status"] != "converged") & (both["reason"] == "")).sum()), 0, "at_most", "", "a message"),
        Check("resolved rows that are under-resolved", float((resolved["status"] == "under_resolved").sum()), 0,
              "at_most", "", "segments are as short as the waves need"),
    ]  # fmt: skip
    if "slowest" in tables:
        times = tables["slowest"]["seconds"]
        checks.append(time_check("resolved rows of some 1,000 segments, slowest", times, 6.0, "s", "a chart"))
    if "limits" in tables:
        limits = tables["limits"]
        lost = limits["hookload_below_kN"].isna().sum()
        held = limits["hookload_above_kN"].notna().sum()
        checks += [
            Check("locked strings without a balance below their limit", float(lost), 0, "at_most", "", "the limit"),
            Check("locked strings with a balance above their limit", float(held), 0, "at_most", "", "the limit"),
        ]
    if "slid" in tables:
        stepped = tables["slid"]
        slides, is_below = stepped["ends"] == "slides", stepped["share_of_limit_percent"] < 100
        checks += [
            Check("stepper, strings that stall below their limit", float((is_below & ~slides).sum()), 0, "at_most", "",
                  "the limit"),
            Check("stepper, strings that slide above their limit", float((~is_below & slides).sum()), 0, "at_most", "",
                  "the limit"),
        ]  # fmt: skip
    if "halved" in tables:
        table = tables["halved"]
        below = table[table["share_of_lock_up_percent"] <= 100 * max(HALVED) + 1e-6]
        off = float(below["off_percent_of_weight"].abs().max())
        last = table.iloc[-1]
        locked = 100 * abs(last["halved_locked_up_friction"] / last["locked_up_friction"] - 1)
        checks += [
            Check("segments halved, hook load", off, 1.0, "at_most", "%", "of the string's weight"),
            Check("segments halved, friction at lock-up", locked, 1.0, "at_most", "%", "of that friction"),
        ]
    return checks


STUDY = Study(
    "buckled_wells",
    "Does every row of a chart in which strings buckle and lock up have an answer or a reason?",
    run,
    needs=("data",),
)
