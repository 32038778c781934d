"""Strings at their limit, fed from rest: one answer from every mesh.

Rows of strings that buckle as they slide down, drawn at random, on three meshes each, and the threshold of what counts
as locked up.  ``fed_limits`` looks at both sides of their limit.
"""

from collections.abc import Iterator
from itertools import count, islice
from typing import Any

import numpy as np
import pandas as pd

from fctd import torque_drag
from fctd.results.status import SteadyStatus
from fctd.steady.feed import ARRIVING
from references.timing.stopwatch import rounds
from validation.harness.study import (
    Check,
    Context,
    Outcome,
    Rows,
    Study,
    in_columns,
    quartiles_of,
    ratio_check,
    table_of_rows,
    time_check,
)
from validation.parts.fed_strings import (
    MESHES,
    RAISED,
    SAME_FRICTION,
    SAME_LOAD,
    SEGMENT,
    Drawn,
    Feeding,
    Row,
    again,
    compare,
    drawn,
    meshed,
    solve,
    solved,
    weight_of,
)
from validation.parts.resolved_rows import CASED, DEPTH, horizontal_well

STRINGS, VARIED = 120, 20  # on three meshes, and with other thresholds
QUICK = 9  # index of the one string of the quick run, which takes a second on each mesh
FACTOR = 2.0  # by which the threshold of lock-up is varied either way
CHART, CHART_FRICTION = 10, 0.25  # depths of a chart, and its friction factor
Found = tuple[Drawn, Row]


def strings(context: Context) -> Iterator[tuple[int, Drawn, Row]]:
    """Strings that buckle, without end: index, string, and its row on the segments of the case."""
    for index in count(QUICK if context.quick else 0):
        string = drawn(context, index)
        row = solved(string)
        if row is not None and row.is_buckled:
            yield index, string, row


def meshes(context: Context) -> tuple[pd.DataFrame, pd.DataFrame, list[Found]]:
    """A row per string and mesh, a row per string that compares them, and the strings on their first mesh."""
    rows: list[dict[str, Any]] = []
    alike: list[dict[str, Any]] = []
    kept: list[Found] = []
    buckled = islice(strings(context), 1 if context.quick else STRINGS)
    for index, string, first in context.progress(buckled, "strings on three meshes"):
        well, case, kind, depth, friction = string
        finer = [solve(meshed(case, share), kind, depth) for share in MESHES[1:]]
        of_string = {
            "index": index, "well": well, "operation": kind, "bit_depth_m": depth, "friction": friction,
            "weight_on_bit_kN": case.bit.weight_on_bit / 1e3 if kind == "drill_sliding" else 0.0,
        }  # fmt: skip
        for share, row in zip(MESHES, (first, *finer), strict=True):
            rows.append(of_string | {"mesh": share, "lacks_segments": row.lacks_segments} | row.facts)
            rows[-1]["lacks_work"] = row.lacks_work
        found = compare((first, *finer), weight_of(case, depth))
        alike.append(
            of_string
            | {
                "statuses": ", ".join(row.status for row in (first, *finer)),
                "hookload_apart_percent_of_weight": found.load, "locked_up_apart_percent": found.friction,
                "differs": found.differs, "is_same": found.differs == "",
            }
        )  # fmt: skip
        kept.append((string, first))
    return pd.DataFrame(rows), pd.DataFrame(alike), kept


@table_of_rows
def chart() -> Rows:
    """The time of a chart of the horizontal well, over its rows."""
    case = horizontal_well(SEGMENT, "feed", CHART_FRICTION)
    depths = np.linspace(CASED, DEPTH, CHART).round(1)
    table = torque_drag(case, "drill_sliding", depths.tolist(), threads=1)
    charts = rounds(lambda: torque_drag(case, "drill_sliding", depths.tolist(), threads=1), 3)
    seconds = in_columns({"seconds_a_row": np.array(charts) / len(table)})
    for row in table.itertuples():
        yield {
            "bit_depth_m": row.bit_depth_m, "status": row.status, "shape": row.shape,
            "hookload_kN": float(str(row.hookload_N)) / 1e3,
        } | seconds  # fmt: skip


@table_of_rows
def thresholds(context: Context, kept: list[Found]) -> Rows:
    """Strings that are fed at all of their friction, with several thresholds of lock-up."""
    fed = [(string, row.point) for string, row in kept if row.point is not None and len(row.point.fed)]
    for string, point in context.progress(fed[:VARIED], "thresholds of lock-up"):
        feeding = Feeding(string.case, point)
        less, own, more = (str(feeding.at(1.0, share * ARRIVING)) for share in (1 / FACTOR, 1.0, FACTOR))
        yield {
            "well": string.well, "operation": string.operation, "bit_depth_m": string.bit_depth,
            "friction": string.friction, "half": less, "own": own, "twice": more, "changes": len({less, own, more}) > 1,
        }  # fmt: skip


def run(context: Context) -> Outcome:
    """Rows on three meshes; the full run has the other parts as well."""
    again(drawn(context, QUICK))  # compile
    rows, alike, kept = meshes(context)
    order = rows["seconds"].argsort()
    times = {}
    for which, place in (("slowest", -1), ("median", len(rows) // 2)):
        row = rows.iloc[order.iloc[place]]
        string = drawn(context, int(row["index"]))
        times[which] = again(string._replace(case=meshed(string.case, float(row["mesh"]))))
    counts = rows.groupby(["well", "operation", "status"], sort=False).size().rename("rows").reset_index()
    tables = {"rows": rows, "alike": alike, "counts": counts, "times": pd.DataFrame(times)}
    display = {"counts": "Rows by status"}
    if not context.quick:
        tables |= {"chart": chart(), "thresholds": thresholds(context, kept)}
        tables["differ"] = alike[~alike["is_same"]]
        display |= {
            "differ": "Strings whose meshes differ",
            "thresholds": "Strings fed with half and twice the threshold of lock-up",
        }  # fmt: skip
    return Outcome(tables=tables, checks=_checks(tables), notes=_notes(tables), display=display)


def _notes(tables: dict[str, pd.DataFrame]) -> list[str]:
    alike = tables["alike"]
    return [
        f"{len(alike)} strings that buckle, of {int(alike['index'].max()) + 1} drawn, in a horizontal well, random "
        "wells and a real survey; friction 0.1 to 0.5, 20 to 300 kN on bit or trips in. Rows of a string are the same "
        f"where statuses are, hook loads agree within {100 * SAME_LOAD:g} % of the weight, and the friction at lock-up "
        f"within {100 * SAME_FRICTION:g} % where all meshes have it.",
    ]


def _checks(tables: dict[str, pd.DataFrame]) -> list[Check]:
    """The numbers with bounds."""
    rows, alike = tables["rows"], tables["alike"]
    coarse = (rows["status"] == SteadyStatus.UNDER_RESOLVED) & ~rows["lacks_segments"]
    checks = [
        Check("strings with one answer from three meshes", 100 * float(alike["is_same"].mean()), 97.0, "at_least", "%",
              f"status, hook load within {100 * SAME_LOAD:g} % of the weight, friction at lock-up within "
              f"{100 * SAME_FRICTION:g} %"),
        Check("rows that raise", float((rows["status"] == RAISED).sum()), 0, "at_most", "", "an answer or a reason"),
        Check("rows that are under-resolved", float(coarse.sum()), 0, "at_most", "",
              "except where a string needs more segments than it may have"),
        Check("rows whose resolving runs out of its work", float(rows["lacks_work"].sum()), 0, "at_most", "",
              "an answer on segments that follow the waves"),
        *(
            time_check(f"{which} row", tables["times"][which], most, "s", "processor time, solved three times more")
            for which, most in (("slowest", 6.0), ("median", 1.0))
        ),
    ]  # fmt: skip
    if "chart" in tables:
        checks.append(ratio_check("row of a chart", quartiles_of(tables["chart"].iloc[0], "seconds_a_row"), 1.0,
                                  "at_most", f"processor time over the rows of {CHART} depths", "s"))  # fmt: skip
    if len(of := tables.get("thresholds", pd.DataFrame())):
        checks.append(Check("strings that another threshold of lock-up changes", float(of["changes"].sum()), 1.0,
                            "at_most", "", f"of {len(of)}, half and twice {100 * ARRIVING:g} %"))  # fmt: skip
    return checks


STUDY = Study(
    "fed_strings",
    "Do strings at their limit have one answer from every mesh?",
    run,
    needs=("data",),
    timed=True,
)
