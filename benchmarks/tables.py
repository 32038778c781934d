"""Tables that the commands print."""

import statistics
from collections.abc import Sequence

from rich.box import SIMPLE_HEAD
from rich.table import Table

from benchmarks.gate import Outcome, name_of
from benchmarks.history import Record
from benchmarks.measure import Costs, judged, shown
from benchmarks.verdict import change_of

STYLES = {"slower": "bold red", "missing": "bold red", "perhaps slower": "yellow", "faster": "green"}


def verdict_table(outcome: Outcome) -> Table:
    """The gate's verdicts, a row per kernel; costs before and now relative to the reference kernel."""
    table = Table(title=outcome.how, title_justify="left")
    table.add_column("kernel")
    for column in ("before", "now", "change", "80 % interval"):
        table.add_column(column, justify="right")
    table.add_column("verdict")
    before, now = judged(outcome.before), judged(outcome.now)
    for verdict in outcome.verdicts:
        numbers = ("–", "–") if verdict.change != verdict.change else (
            f"{verdict.change - 1:+.1%}", f"{verdict.low - 1:+.1%} to {verdict.high - 1:+.1%}"
        )  # fmt: skip
        table.add_row(
            verdict.kernel, _middle(before.get(verdict.kernel)), _middle(now.get(verdict.kernel)), *numbers,
            verdict.status, style=STYLES.get(verdict.status, ""),
        )  # fmt: skip
    return table


def shown_table(outcome: Outcome) -> Table:
    """Ratios between kernels, for information only."""
    table = Table(title="ratios within one run (for information only)", title_justify="left")
    table.add_column("ratio")
    table.add_column("before", justify="right")
    table.add_column("now", justify="right")
    before, now = shown(outcome.before), shown(outcome.now)
    for name, taken in now.items():
        table.add_row(name, _middle(before.get(name)), _middle(taken))
    return table


def comparison(now: Record, last: Record | None, why_not: str) -> Table:
    """A run next to the last release: time, ratio to the reference kernel with its range.

    why_not : why ratios are not comparable, or empty; the change is printed only if it is empty.  A row has two lines,
    so that it fits a screen of 80 columns.
    """
    title = "this run" if last is None else f"this run and release {name_of(last)}"
    table = Table(
        title=title + (f"; ratios are not comparable: {why_not}" if why_not else ""), title_justify="left",
        box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False,
    )  # fmt: skip
    table.add_column("kernel\nsize")
    for column in ("ns per unit", "ratio\nrange", "released", "change\n80 % interval"):
        table.add_column(column, justify="right")
    for name, kernel in now.kernels.items():
        old = None if last is None else last.kernels.get(name)
        released = "–" if old is None else _number(old.ratio)
        change = "–"
        if old is not None and not why_not:
            middle, low, high = change_of(old.samples, kernel.samples)
            change = f"{middle - 1:+.1%}\n{low - 1:+.0%} to {high - 1:+.0%}"
        table.add_row(
            f"{name}, per {kernel.unit}\n{kernel.size}", _number(kernel.ns),
            f"{_number(kernel.ratio)}\n{_range(kernel.spread)}", released, change,
        )  # fmt: skip
    table.add_section()
    for name, taken in shown(now.ratios).items():
        over, under = name.split(" : ")
        table.add_row(
            f"{over} :\n{under}", "", f"{_middle(taken)}\n{_range(taken)}", _middle(_shown_of(last).get(name))
        )
    return table


def _shown_of(record: Record | None) -> Costs:
    return {} if record is None else shown(record.ratios)


def _middle(samples: Sequence[float] | None) -> str:
    return _number(statistics.median(samples) if samples else None)


def _range(samples: Sequence[float]) -> str:
    return f"{_number(min(samples))}–{_number(max(samples))}"


def _number(value: float | None) -> str:
    if value is None:
        return "–"
    return f"{value:.4g}" if abs(value) < 1e4 else f"{value:,.0f}"
