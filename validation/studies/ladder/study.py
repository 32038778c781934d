"""The study of the ladder: every rung by every solver that has it, with two segmentations that nobody tuned."""

import math
from typing import Any

import pandas as pd

from validation.harness.study import Check, Context, Outcome, Rows, Study
from validation.studies.ladder import (
    bends,
    bha,
    capstan,
    fluids,
    grips,
    helix,
    onset,
    statics,
    threshold,
    trips,
    waves,
)
from validation.studies.ladder.mutations import LEAST, MUTATIONS, broken
from validation.studies.ladder.rung import Rung, measure, observed_order, worst_first

FAMILIES: dict[str, list[Rung]] = {
    "helix": helix.RUNGS, "onset": onset.RUNGS, "waves": waves.RUNGS, "threshold": threshold.RUNGS,
    "capstan": capstan.RUNGS, "bends": bends.RUNGS, "bit": bha.RUNGS, "rest": statics.RUNGS,
    "trips": trips.RUNGS, "fluids": fluids.RUNGS, "grips": grips.RUNGS,
}  # fmt: skip
RUNGS = {rung.name: rung for rungs in FAMILIES.values() for rung in rungs}
MEETING = "meet their neighbours'"


def climbed(rung: Rung, family: str, quick: bool) -> Rows:
    """Rows of a rung; the quick way with the segments that meet their neighbours' alone."""
    for by in rung.found:
        for cut in rung.cuts[1:] if quick else rung.cuts:
            row = measure(rung, by, cut)
            ends = MEETING if cut == rung.cuts[1] else "do not"
            yield {"family": family, **row, "segment_ends": ends, "formula": rung.formula, "why": rung.why}


def orders_of(rung: Rung) -> dict[str, Any]:
    """The observed order of a rung by its first solver."""
    assert rung.refined is not None
    assert rung.order is not None
    by = next(iter(rung.found))
    low, high = rung.order
    coarse, _, fine = rung.refined
    return {
        "rung": rung.name, "by": by, "coarsest_m": coarse, "finest_m": fine, "order": observed_order(rung, by),
        "least": low, "most": high,
    }  # fmt: skip


def worst_of(table: pd.DataFrame) -> float:
    """The largest error [%] of rows; NaN where one has no number."""
    return float(table["error_percent"].abs().max(skipna=False))


def run(context: Context) -> Outcome:
    """Rungs, orders, mutations."""
    pairs = [(family, rung) for family, rungs in FAMILIES.items() for rung in rungs]
    taken = [(family, rung) for family, rung in pairs if not (context.quick and rung.long)]
    rows = [row for family, rung in context.progress(taken, "rungs") for row in climbed(rung, family, context.quick)]
    table = worst_first(pd.DataFrame(rows))
    ordered = [rung for _, rung in taken if rung.refined is not None]
    orders = pd.DataFrame([orders_of(rung) for rung in context.progress(ordered, "orders")])
    faults = pd.DataFrame([broken(each, RUNGS[each.rung]) for each in context.progress(MUTATIONS, "mutations")])
    checks = [
        Check(f"{rung.name}, {by}", worst_of(table[(table["rung"] == rung.name) & (table["by"] == by)]), rung.bound,
              "at_most", "%", rung.formula if not rung.why else f"{rung.formula}; above 1 %, since {rung.why}")
        for _, rung in taken
        for by in rung.found
    ]  # fmt: skip
    checks += [
        Check(f"order of convergence, {row['rung']}", row["order"], (row["least"], row["most"]), "within", "",
              "three lengths of segments, each half of the one before")
        for row in orders.to_dict("records")
    ]  # fmt: skip
    checks += [
        Check(f"2 % more {row['parameter']}: error over the bound of {row['rung']!r}", row["error_over_bound"], 1.0,
              "at_least", "", "a fault through the case must break a rung")
        for row in faults.to_dict("records")
    ]  # fmt: skip
    checks += [
        Check("least movement of a rung by a fault of 2 %", float(faults["moved_percent"].min(skipna=False)), LEAST,
              "at_least", "%", "target: a fault of 2 % must show"),
        Check("largest bound over the movement by a fault of 2 %",
              float(faults["bound_over_movement"].max(skipna=False)), 0.5, "at_most", "",
              "target: a bound of half the movement"),
    ]  # fmt: skip
    silent = sum(not math.isfinite(error) for error in table["error_percent"])
    columns = ["rung", "family", "by", "segment_m", "segment_ends", "exact", "found", "unit", "error_percent",
               "bound_percent", "error_over_bound"]  # fmt: skip
    return Outcome(
        tables={"ladder": table, "rungs": table[columns], "orders": orders, "mutations": faults},
        checks=checks,
        notes=[
            f"{len(taken)} rungs; {silent} rows have no number: the table says what the engine said instead.",
            "Every rung runs with segments whose lengths nobody chose to suit it, and with others whose lengths meet "
            "those of their neighbours or the ends of the hole's bends exactly.",
            "A mutation changes the case by 2 %, while the exact number stays that of the unchanged case.",
        ],
        display={
            "rungs": "Rungs, worst first: error over bound",
            "orders": "Observed order of convergence",
            "mutations": "Faults of 2 % through the case, and the rungs that they break",
        },
    )


STUDY = Study("ladder", "Does every number with an exact answer come out right, and does a fault of 2 % show?", run)
