"""The table and the picture of the gate."""

import math
import statistics
from pathlib import Path

from matplotlib.figure import Figure
from rich.box import SIMPLE_HEAD
from rich.table import Table

from benchmarks.gate import Outcome, with_sum
from benchmarks.history import Record, curves
from benchmarks.verdict import THRESHOLD

RACED, ACCEPTED = "tab:blue", "tab:orange"  # a change, and a slowdown that its record accepts
STYLES = {"slower": "bold red", "missing": "bold red", "no baseline": "bold red", "perhaps slower": "yellow",
          "faster": "green"}  # fmt: skip


def verdict_table(outcome: Outcome) -> Table:
    """The gate's verdicts, a row per kernel; costs are those now, in units of the reference kernel."""
    table = Table(title=outcome.how, title_justify="left", box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    table.add_column("kernel", no_wrap=True)
    for column in ("cost", "change", "80 % interval"):
        table.add_column(column, justify="right", no_wrap=True)
    table.add_column("verdict")
    costs = with_sum(outcome.before, outcome.now) | with_sum(outcome.now, outcome.before)
    for verdict in outcome.verdicts:
        numbers = ("–", "–") if math.isnan(verdict.change) else (
            f"{verdict.change - 1:+.1%}", f"{verdict.low - 1:+.1%} to {verdict.high - 1:+.1%}"
        )  # fmt: skip
        more = "" if verdict.threshold == THRESHOLD else f", fails at {verdict.threshold - 1:+.0%}"
        cost = f"{statistics.median(costs[verdict.kernel]):.3g}" if verdict.kernel in costs else "–"
        table.add_row(verdict.kernel, cost, *numbers, verdict.status + more, style=STYLES.get(verdict.status, ""))
    return table


def history_figure(records: list[tuple[Path, Record]]) -> Figure:
    """Cost of each kernel over the baselines, relative to the first that has it: a panel a kernel."""
    found = curves(records)
    labels = [f"{record.date:%d %b}\n{record.commit[:7]}" for _, record in records]
    rows = -(-len(found) // 3)
    figure = Figure(figsize=(10, 2.1 * rows), layout="constrained")
    axes = figure.subplots(rows, 3, sharey=True, squeeze=False)
    for axis, (kernel, curve) in zip(axes.flat, found.items(), strict=False):
        axis.axhline(1.0, color="0.6", linewidth=0.8, zorder=0)
        axis.plot(range(len(curve)), curve, color="0.6", linewidth=1)
        for k, (_, record) in enumerate(records):
            change = record.changes.get(kernel)
            if change is not None:
                below, above = (abs(end / change.ratio - 1) * curve[k] for end in (change.low, change.high))
                colour = ACCEPTED if kernel in record.accepted else RACED
                axis.errorbar(k, curve[k], [[below], [above]], fmt="o", markersize=4, capsize=3, color=colour)
        axis.set_title(kernel, fontsize=9)
        axis.set_xlim(-0.3, len(labels) - 0.7)
        axis.set_xticks(range(len(labels)), labels, fontsize=6)
    for axis in axes.flat[len(found) :]:
        axis.set_visible(False)
    figure.supylabel("cost over that in the first baseline", fontsize=9)
    return figure
