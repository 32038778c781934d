"""Checks of ``fctd refine`` on a set of wells: is the error within the tolerance, and does grading help?"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, equilibrium, refine
from fctd.model.drillstring import lay_out
from fctd.model.layouts import Components, graded, is_long, uniform, with_components
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.levels import relative_difference
from validation.harness.study import Check, Context, Outcome, Rows, table_of_rows

# A case, a bit depth [m] and the length of the shortest segments [m] to components.
Layout = Callable[[Case, float, float], Components]

TOLERANCES = (0.01, 0.003)
OPERATIONS = ("rotate_off_bottom", "trip_out", "trip_in")
FINER = 4
# Shortest segments of the graded strings, as shares of the string: interleaved ladders of half octaves.
LADDERS = 4
SHARES = tuple(40 * 2 ** (k / (2 * LADDERS)) for k in range(9 * LADDERS))
REFERENCE = 4096


def finer(case: Case) -> Case:
    """The same case with segments and cylinders a quarter as long."""
    pieces = []
    for part in case.string.components:
        if is_long(part):
            pieces.append(part)
        elif part.segments is not None:
            pieces.append(part.model_copy(update={"segments": FINER * part.segments}))
        else:
            assert part.segment_length is not None
            pieces.append(part.model_copy(update={"segment_length": part.segment_length / FINER}))
    hole = case.wellbore
    assert hole.chord_tolerance is not None  # of all these cases
    update = {"chord_tolerance": hole.chord_tolerance / FINER**2, "overlap": hole.overlap / FINER}
    return with_components(case, tuple(pieces)).model_copy(update={"wellbore": hole.model_copy(update=update)})


def land(name: str, case: Case, bit: float, tolerance: float, grade: bool) -> Rows:
    """Refine for three operations at once; the difference of each from a run with segments a quarter as long."""
    refined = refine(case, tolerance, OPERATIONS, bit, graded=grade)
    for kind in OPERATIONS:
        point, fine = (equilibrium(c, kind, bit) for c in (refined.case, finer(refined.case)))
        hookload, torque = relative_difference(point, fine, steady_rates(case, kind).spin)
        yield {
            "well": name,
            "asked": "graded" if grade else "uniform",
            "layout": refined.layout,
            "tolerance_percent": 100 * tolerance,
            "operation": kind,
            "status": refined.status if fine.answered else f"finer: {fine.status}",
            "segments": refined.segments,
            "estimate_percent": 100 * refined.error,
            "hookload_off_percent": 100 * hookload if fine.answered else float("nan"),
            "torque_off_percent": 100 * torque if fine.answered else float("nan"),
        }


def in_arcs(case: Case) -> Case:
    """The case in the exact hole."""
    return case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"geometry": "arcs"})})


def compare(name: str, case: Case, bit: float, shares: tuple[float, ...]) -> Rows:
    """Errors of graded and uniform strings of equal counts, turning and picking up, in the exact hole.

    The ladder of a share is its index among ``LADDERS``.
    """
    case = in_arcs(case)
    total = bit - case.string.top_md
    exact = loads(case, uniform, bit, total / REFERENCE)
    for share in shares:
        cut = loads(case, graded, bit, total / share)
        even = loads(case, uniform, bit, total / cut[0])
        for layout, (count, torque, hookload) in (("graded", cut), ("uniform", even)):
            yield {
                "well": name,
                "layout": layout,
                "share": share,
                "ladder": SHARES.index(share) % LADDERS,
                "segments": count,
                "torque_percent": 100 * abs(torque / exact[1] - 1),
                "hookload_percent": 100 * abs(hookload / exact[2] - 1),
            }


def loads(case: Case, layout: Layout, bit: float, length: float) -> tuple[int, float, float]:
    """Number of segments, torque turning and hook load picking up; NaN where no equilibrium was found."""
    cut = with_components(case, layout(case, bit, length))
    solver = Solver(cut)
    turning, lifting = (solver.solve(kind, steady_rates(cut, kind), bit) for kind in OPERATIONS[:2])
    count = lay_out(cut, bit).segments
    if not (turning.answered and lifting.answered):
        return count, float("nan"), float("nan")
    return count, turning.surface_torque, lifting.hookload


@table_of_rows
def gains(strings: pd.DataFrame) -> Rows:
    """Error of the graded string over that of the uniform one of as many segments: geometric mean over the counts.

    Errors pass through zero by chance, so a string counts with the largest error of its own and all longer counts.
    The positions of joints still matter, so each ladder of counts has its ratio: their mean, least and most.
    """
    for name, of_well in strings.groupby("well", sort=False):
        row: dict[str, Any] = {"well": name}
        for quantity in ("torque", "hookload"):
            ratios = np.array([_gain(ladder, f"{quantity}_percent") for _, ladder in of_well.groupby("ladder")])
            row[f"{quantity}_ratio"] = float(np.exp(np.log(ratios).mean()))
            row |= {f"{quantity}_least": ratios.min(), f"{quantity}_most": ratios.max()}
        yield row


def _gain(ladder: pd.DataFrame, column: str) -> float:
    table = ladder.pivot_table(index="share", columns="layout", values=column, dropna=False)
    table = table.sort_index(ascending=False).cummax()
    return float(np.exp(np.log(table["graded"] / table["uniform"]).mean()))


def judge(cases: dict[str, tuple[Case, float]], context: Context, *notes: str) -> Outcome:
    """Every well, tolerance and layout; then both layouts at equal counts."""
    landed: list[dict[str, Any]] = []
    strings: list[dict[str, Any]] = []
    for name, (case, bit) in context.progress(list(cases.items()), "wells"):
        for tolerance in TOLERANCES[:1] if context.quick else TOLERANCES:
            for grade in (False, True):
                landed += land(name, case, bit, tolerance, grade)
        strings += compare(name, case, bit, SHARES[::LADDERS] if context.quick else SHARES)
    table, lengths = pd.DataFrame(landed), pd.DataFrame(strings)
    off = table[["hookload_off_percent", "torque_off_percent"]].max(axis=1) / table["tolerance_percent"]
    gained = gains(lengths)
    return Outcome(
        tables={"landed": table, "layouts": lengths, "gains": gained},
        checks=[
            Check("difference from a run four times as fine over the tolerance, largest", float(off.max(skipna=False)),
                  1.0, "at_most", "", "the requested tolerance"),
            Check("refinements that did not reach their tolerance",
                  float((table["status"] != "within_tolerance").sum()), 0, "at_most", "",
                  "the tolerance must be reached in every well"),
            *(
                Check(f"{load} error of graded over uniform strings of equal counts, most of wells and ladders",
                      float(gained[column].max(skipna=False)), 1.0, "at_most", "", "target: grading reduces the error")
                for load, column in (("torque", "torque_most"), ("hook load", "hookload_most"))
            ),
        ],
        notes=[
            *notes,
            "Tolerances are those of the command: a share of the load, or of a tenth of weight or Σ r μ F_n where "
            "that is more; for the torque of a string that only slides, of the full Σ r μ F_n. The finer run has "
            "segments and cylinders a quarter as long.",
            f"Counts are half an octave apart in each of {LADDERS} ladders. A graded string is used only where it "
            "saves a tenth of the uniform one's segments.",
        ],
        display={
            "landed": "Results of refine, and the difference of a run four times as fine",
            "gains": "Error of graded over uniform strings of equal counts: mean, least and most of the ladders",
        },
    )  # fmt: skip
