"""Buckled strings of which rounding picks the balance: how many rows, by how much, and whether their note says so."""

from itertools import islice

import pandas as pd

from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.noisy_rows import ABOVE, BEYOND, SEEDS, carried_row, row_of, straight, wells

STRAIGHT, WELLS = 250, 3  # strings
QUICK = 3  # of them
KINDS = "resolve", "feed"
AS_CUT = 3  # each third string is also solved with the segments of its case
CHARTS = 4  # so is each fourth below another row of a chart
# Shares [%]: of fed rows that move, of rows that move and that the rule names, of others that it names.
MOST_MOVED, HIT, FALSE = 10.0, 90.0, 50.0


def rates_of(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows by place, ``solver.buckling`` and method: how many move, by how much, and what the rule says of them."""
    groups = rows.groupby(["family", "buckling", "method"])
    return groups.agg(
        rows=("moves", "size"), move=("moves", "sum"), predicted=("predicted", "sum"), noted=("noted", "sum"),
        largest_spread_percent_of_weight=("hookload_spread_percent_of_weight", "max"),
        seconds=("seconds", "sum"), drawing_seconds=("drawing_seconds", "sum"),
    ).reset_index()  # fmt: skip


def beyond_onset(rows: pd.DataFrame) -> pd.DataFrame:
    """Fed and resolved rows by compression over the sinusoidal limit and inclination: how many move."""
    asked = rows[rows["buckling"] != "detect"]
    excess = pd.cut(asked["over_sinusoidal_limit"], [BEYOND, 1.45, 1.8, 2.2, 1e9], right=False)
    lies = asked["inclination_deg"].ge(3).map({True: "inclined", False: "vertical or nearly so"})
    groups = asked.groupby([asked["buckling"], lies.rename("hole"), excess.astype(str).rename("times_onset")])
    return groups.agg(
        rows=("moves", "size"), move=("moves", "sum"),
        largest_spread_percent_of_weight=("hookload_spread_percent_of_weight", "max"),
    ).reset_index()  # fmt: skip


def share(part: float, whole: float) -> float:
    """A share [%]; all of nothing."""
    return 100 * part / whole if whole else 100.0


def run(context: Context) -> Outcome:
    """Rows of random strings, each with noise, and resolved rows of charts against rows alone."""
    strings = list(islice(straight(), QUICK if context.quick else STRAIGHT))
    if not context.quick:
        strings += islice(wells(context), WELLS)
    found, charts = [], []
    for k, string in enumerate(context.progress(strings, "strings with noise")):
        kinds = (*KINDS, "detect") if k % AS_CUT == 0 else KINDS
        found += [row for kind in kinds if (row := row_of(string, kind)) is not None]
        if k % CHARTS == 0:
            charts.append(carried_row(string))
    rows, carried = pd.DataFrame(found), pd.DataFrame(charts)
    asked = rows[rows["buckling"] != "detect"]
    return Outcome(
        tables={"rows": rows, "rates": rates_of(rows), "beyond_onset": beyond_onset(rows), "charts": carried},
        checks=[
            # Of the quick run's three strings one that moves by another processor's rounding would turn every share.
            *([] if context.quick else _shares(asked)),
            Check("resolved row of a chart against the row alone, largest difference",
                  float(carried["off_percent_of_weight"].max()), 1.0, "at_most", "%", "of the weight"),
        ],
        notes=[
            f"Strings beyond {BEYOND:g} times the sinusoidal limit: pipe of eight sizes that slides down straight "
            "holes, a quarter of them vertical and a quarter nearly so, with 30 to 250 segments, and strings in the "
            "horizontal well and in wells drawn at random, with 300 to 1,300. Each is fed, resolved, and each third "
            f"also as it is cut; {len(SEEDS)} seeds of noise stand beside the plain row.",
            "Noise is 1e-13 of each station and of the length of each segment. A row moves where hook load or torque "
            "changes by more than 1 % of the weight, or where only some draws have loads.",
            f"Each fourth string is also the second row of a chart, below a row at {ABOVE:g} of its depth, from which "
            "it takes its shape.",
        ],
        display={
            "rates": "Rows that noise moves, by place and method",
            "beyond_onset": "Fed and resolved rows that noise moves, by inclination and load",
        },
    )  # fmt: skip


def _shares(asked: pd.DataFrame) -> list[Check]:
    """How many rows move, and what the rule and the note say of them."""
    resolved, fed, moved = asked[asked["buckling"] == "resolve"], asked[asked["buckling"] == "feed"], asked["moves"]
    return [
        Check("resolved rows whose loads move", float(resolved["moves"].sum()), 0, "at_most", "",
              f"of {len(resolved)} rows; by more than 1 % of the weight"),
        Check("fed rows whose loads move", share(float(fed["moves"].sum()), len(fed)), MOST_MOVED, "at_most", "%",
              f"of {len(fed)} rows"),
        Check("rows that move and were drawn again", share(float((moved & asked["predicted"]).sum()),
              float(moved.sum())), HIT, "at_least", "%", f"of {int(moved.sum())} rows: hit rate of the rule"),
        Check("rows that move and have the note", share(float((moved & asked["noted"]).sum()),
              float(moved.sum())), HIT, "at_least", "%", "noise of two other seeds than those of the note"),
        Check("rows that do not move and were drawn again",
              share(float((~moved & asked["predicted"]).sum()), float((~moved).sum())), FALSE, "at_most", "%",
              f"of {int((~moved).sum())} rows: false alarms, which cost time alone"),
        Check("rows with the note that do not move", float((asked["noted"] & ~moved).sum()),
              max(1.0, 0.01 * len(asked)), "at_most", "", f"of {int(asked['noted'].sum())} with the note: they "
              "move with its own seeds alone"),
    ]  # fmt: skip


STUDY = Study(
    "several_balances", "How often does rounding pick the balance of a buckled row, and does the row say so?", run
)
