"""Charts of several cases on the screen: loads side by side, and lines for what is not converged or has a note."""

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from fctd.answers.comparison import Comparison
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.case.text import printable
from fctd.cli.chart_table import counts_of, exceptions, explain, spread
from fctd.cli.job import FOLD, WHOLE, headed, print_table, rows_of
from fctd.cli.options import messages, screen
from fctd.plots.loads import LOAD_COLUMNS, NAMES, TORQUE, Load
from fctd.results.columns import DEPTH
from fctd.results.series import FRICTION_LABEL
from fctd.results.shown_tables import Head, Table, of_column, shown_table
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown
from fctd.steady.torque_drag import Row

SCREEN_ROWS: Final = 24  # of a table
# Rows of a case by operation and set of friction factors, "" where each case has one set, and by bit depth [m].
ByDepth = dict[tuple[str, str], dict[float, Row]]


def print_comparison(found: Comparison, units: System, load: Load) -> None:
    """Print a table of loads and one of torques, with a column for each case, and lines for runs of other rows.

    load : that it shows, of the string or with the block.
    """
    rows = {name: rows_of(chart.rows) for name, chart in found.charts.items()}
    fan = any(len({row[FRICTION_LABEL] for row in of}) > 1 for of in rows.values())
    by_depth = {name: _by_depth(of, units, fan=fan) for name, of in rows.items()}
    turning = [
        kind for kind, of in KINDS.items()
        if of.on_bottom or any(kind in chart.rates and chart.rates[kind].spin for chart in found.charts.values())
    ]  # fmt: skip
    series = list(dict.fromkeys(key for of in by_depth.values() for key in of))
    for column in (LOAD_COLUMNS[load], TORQUE):
        drawn = [key for key in series if column != TORQUE or key[0] in turning]
        if drawn:
            screen.print(f"{NAMES[column]}, {shown(column, units).label}", soft_wrap=True)
            looks = {"operation": WHOLE, "bit": WHOLE}
            print_table(_table(by_depth, drawn, column, units, fan=fan), looks, words=FOLD, numbers=FOLD)
    if any(row["status"] != SteadyStatus.CONVERGED for of in rows.values() for row in of):
        screen.print("*: not converged", soft_wrap=True)
    for name, of in rows.items():
        screen.print(f"{printable(name)}: {counts_of(of)}", soft_wrap=True)
    explain(load)
    metre = shown(DEPTH.name, units)
    for name, keys in by_depth.items():
        for (operation, friction), at_depths in keys.items():
            words = f"{printable(name)}, {operation}{f', friction {friction}' if friction else ''}"
            for line in exceptions(list(at_depths.values()), metre.factor, metre.label):
                messages.print(f"{words}: {told(line, units)}", soft_wrap=True)


def _by_depth(rows: Sequence[Row], units: System, *, fan: bool) -> ByDepth:
    found: ByDepth = {}
    for row in rows:
        friction = told(row[FRICTION_LABEL], units) if fan else ""
        found.setdefault((row["operation"], friction), {})[row[DEPTH.name]] = row
    return found


def _table(
    cases: dict[str, ByDepth], series: Sequence[tuple[str, str]], column: str, units: System, *, fan: bool
) -> Table:
    """A column of the charts of all cases, a row for each operation, set of factors and bit depth."""
    found: list[list[Any]] = []
    for key in series:
        rows = [of.get(key, {}) for of in cases.values()]
        for k, depth in enumerate(_depths(rows, max(SCREEN_ROWS // len(series), 1))):
            names = (key if fan else key[:1]) if k == 0 else ("",) * (1 + fan)
            values = [_value(of[depth], column, units) if depth in of else "" for of in rows]
            found.append([*names, of_column(DEPTH.name, depth, units), *values])
    heads = (Head(printable(name), numbers=True) for name in cases)
    return shown_table(["operation", *(["μ"] * fan), *headed({DEPTH.name: "bit"}, units), *heads], found)


def _depths(rows: Sequence[dict[float, Row]], most: int) -> list[float]:
    """Evenly spread bit depths, of those that all cases share where there are any, and the deepest of each case."""
    common = set.intersection(*map(set, rows)) or set().union(*rows)
    deepest = {max(of) for of in rows if of}
    return sorted({*spread(sorted(common), most), *deepest})


def _value(row: Row, column: str, units: System) -> str:
    mark = "" if row["status"] == SteadyStatus.CONVERGED or np.isnan(row[column]) else "*"
    return of_column(column, row[column], units).text + mark
