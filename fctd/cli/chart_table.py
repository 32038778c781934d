"""A chart on the screen: a table that fits it, and lines for what is not converged or has a note."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any, TypeVar

import numpy as np

from fctd.case.message import Message, within
from fctd.case.systems import told
from fctd.case.text import counted
from fctd.cli.job import FOLD, WHOLE, Looks, headed, print_table
from fctd.cli.options import messages, screen
from fctd.plots.loads import LOAD_COLUMNS, Load
from fctd.results.columns import BUCKLED, COLUMNS, DEPTH, IN_CHART
from fctd.results.notes import MEANINGS
from fctd.results.series import FRICTION_LABEL, in_words
from fctd.results.shown_tables import Head, of_column, shown_table
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown
from fctd.steady.torque_drag import Row

T = TypeVar("T")
SCREEN_ROWS = 36
# Columns of a chart on the screen; the weight indicator stands in place of the hook load where it is shown.
SHOWN = [column for column in (DEPTH, *IN_CHART) if column.heading]


def title_of(rows: Sequence[Row], name: str, units: System) -> str:
    """The title of a chart: one set of factors, which may be a long text, stands above the table."""
    frictions = _frictions(rows, units)
    return name if len(frictions) > 1 else f"{name}; {in_words(frictions[0])}"


def _frictions(rows: Sequence[Row], units: System) -> list[str]:
    return list(dict.fromkeys(told(row[FRICTION_LABEL], units) for row in rows))


def print_chart(rows: list[Row], units: System, load: Load) -> None:
    """Print a table that fits the screen, and a line for each run of rows with another status or a note.

    load : that it shows, of the string or with the block.
    """
    columns = [COLUMNS[LOAD_COLUMNS[load]] if column.name == LOAD_COLUMNS["string"] else column for column in SHOWN]
    units_of = {column.name: shown(column.name, units) for column in columns}
    series: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        series.setdefault((row["operation"], told(row[FRICTION_LABEL], units)), []).append(row)
    fan = len(_frictions(rows, units)) > 1
    buckled = not all(np.isnan(row["buckled_from_md_m"]) for row in rows)
    heads = headed({column.name: column.heading or load for column in columns}, units)
    heads += [Head("buckled", units_of[DEPTH.name].label, numbers=False)] * buckled
    each, shown_rows = max(SCREEN_ROWS // len(series), 1), list[list[Any]]()
    for (operation, friction), of in series.items():
        for k, row in enumerate(spread(of, each)):
            shown_rows.append([
                *([""] * (1 + fan) if k else [operation, friction][: 1 + fan]),
                *(of_column(column.name, row[column.name], units) for column in columns),
                *([_buckled(row, units_of[DEPTH.name].factor)] * buckled), row["status"].replace("_", " "),
            ])  # fmt: skip
    table = shown_table(["operation", *(["μ"] * fan), *heads, "status"], shown_rows)
    looks: Looks = {"operation": WHOLE, "status": {"min_width": len(SteadyStatus.CONVERGED)}}
    print_table(table, looks, words=FOLD, numbers=FOLD)
    printed = f"; {len(shown_rows)} of them above, all of them in a file by --out"
    screen.print(f"{counts_of(rows)}{printed if len(shown_rows) < len(rows) else ''}", soft_wrap=True)
    explain(load)
    depth = units_of["bit_depth_m"]
    for (operation, friction), of in series.items():
        name = f"{operation}, friction {friction}" if fan else operation
        for line in exceptions(of, depth.factor, depth.label):
            messages.print(f"{name}: {told(line, units)}", soft_wrap=True)


def spread(items: Sequence[T], most: int) -> list[T]:
    """At most so many items, evenly spread, always with the last one."""
    picked = np.unique(np.linspace(len(items) - 1, 0, min(most, len(items))).round().astype(int))
    return [items[k] for k in picked]


def counts_of(rows: Sequence[Row]) -> str:
    """How many rows there are of each status."""
    counts = Counter(row["status"] for row in rows).most_common()
    return f"{counted(len(rows), 'row')}: {', '.join(f'{count} {status}' for status, count in counts)}"


def explain(load: Load) -> None:
    """Say what the weight indicator reads, where it is shown."""
    if load == "indicator":
        screen.print("indicator: as the rig reads it, block included; --load string leaves it out", soft_wrap=True)


def _buckled(row: Row, factor: float) -> str:
    """Mode and depths of the buckled part of a string, "helical 540–1500"."""
    first, last = (row[column.name] * factor for column in BUCKLED)
    return "–" if np.isnan(first) else f"{row['buckling']} {first:.0f}–{last:.0f}"


def exceptions(rows: list[Row], factor: float, label: str) -> list[Message]:
    """The runs of rows of one series that are not converged, and those with the same note, a line each."""
    depths = [row["bit_depth_m"] * factor for row in rows]
    reasons = {row["status"]: row["reason"] for row in rows}  # the last, at the greatest depth, of each status
    lines = [
        Message(f"{status} at {where}: {within(reasons[status])}")
        for status, where in _runs([row["status"] for row in rows], depths, label)
        if status != SteadyStatus.CONVERGED
    ]
    return [*lines, *noted(rows, factor, label)]


def noted(rows: list[Row], factor: float, label: str) -> list[Message]:
    """The runs of rows of one series that have the same note, a line each."""
    depths = [row["bit_depth_m"] * factor for row in rows]
    return [
        Message(f"note {code} at {where}: {meaning.headline}: {meaning.remedy}")
        for code, meaning in MEANINGS.items()
        for has, where in _runs([code in row["notes"].split(", ") for row in rows], depths, label)
        if has
    ]


def _runs(values: Sequence[Any], depths: Sequence[float], label: str) -> Iterator[tuple[Any, str]]:
    """Every run of equal values, with its depths as text."""
    for value, run in groupby(zip(values, depths, strict=True), key=lambda row: row[0]):
        at = [depth for _, depth in run]
        span = f"{at[0]:g}" if len(at) == 1 else f"{at[0]:g} to {at[-1]:g}"
        yield value, f"{span} {label} ({len(at)} of {len(depths)})"
