"""The picture of a string in ever more segments: error of each load against their number, for each layout."""

from typing import Any

import matplotlib as mpl
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fctd.case.operations import KINDS
from fctd.plots.palette import CASES, QUIET
from fctd.plots.style import RC, Sheet
from fctd.results.convergence import LOADS, order_in_words

WIDTH, PANEL, LEFT, APART, BELOW = 8.6, 2.7, 0.85, 0.9, 1.1  # [in]
MARKERS = ("o", "s", "*")
SMALLEST = 1e-7  # largest error of a load that has no panel: it is 0 but for rounding


def counts_figure(name: str, steps: pd.DataFrame, orders: pd.DataFrame, tolerance: float) -> Figure:
    """Errors of hook load and torque against the number of segments, a panel for each load of an operation.

    name : of the case.  steps, orders, tolerance : of a ``Refinement`` with a range of counts.
    """
    steps = steps[steps["stage"] == "counts"]
    layouts = list(steps["layout"].unique())
    panels = [
        (kind, load)
        for kind in orders["operation"].unique()
        for load in LOADS
        if steps.loc[steps["operation"] == kind, f"{load}_error"].max() > SMALLEST
    ]
    handles: list[Any] = [
        Line2D([], [], color=CASES[k], marker=MARKERS[k], linestyle="-" if k < 2 else "none", label=layout)
        for k, layout in enumerate(layouts)
    ]
    handles.append(Line2D([], [], color=QUIET, linestyle="--", label=f"tolerance, {100 * tolerance:g} %"))
    lines = ["error: distance from the farther end of the interval of the extrapolated load (95 %)"]
    rows = -(-len(panels) // 2)
    width = (WIDTH - LEFT - APART - 0.2) / 2
    with mpl.rc_context(RC):
        sheet = Sheet(WIDTH, rows * (PANEL + BELOW), f"{name}: number of segments", lines, handles)
        for k, (kind, load) in enumerate(panels):
            at = LEFT + (k % 2) * (width + APART), 0.35 + (k // 2) * (PANEL + BELOW)
            axes = sheet.axes(*at, width, PANEL - 0.1)
            of_kind = orders[orders["operation"] == kind]
            _draw(axes, steps[steps["operation"] == kind], of_kind, load, layouts)
            axes.axhline(100 * tolerance, color=QUIET, linestyle="--", linewidth=1)
            axes.set_title(f"{LOADS[load][0]}, {KINDS[kind].label}")
    return sheet.figure


def _draw(axes: Axes, steps: pd.DataFrame, orders: pd.DataFrame, load: str, layouts: list[str]) -> None:
    """The errors of a load of one operation, a curve for each layout with its observed order."""
    for k, layout in enumerate(layouts):
        of = steps[steps["layout"] == layout]
        axes.plot(
            of["segments"], 100 * of[f"{load}_error"], color=CASES[k], marker=MARKERS[k],
            linestyle="-" if k < 2 else "none", markersize=4 if k < 2 else 11, zorder=2 + k,
        )  # fmt: skip
    told = [f"observed order, {row['layout']}: {order_in_words(row, load)}" for row in orders.to_dict("records")]
    axes.set(xscale="log", yscale="log", xlabel="\n".join(["number of segments", *told]), ylabel="error, %")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
