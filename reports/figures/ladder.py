"""The ladder: error over bound of every rung, worst first."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style

LEAST, MOST = 1e-5, 10.0  # of error over bound that is drawn; beyond them a marker stands at the edge


def rungs(tables: Tables) -> Canvas:
    """A row for each rung, a marker for each solver: the worst of its segmentations."""
    table = tables["rungs"]
    # A rung without a number is as bad as any.
    share = table["error_over_bound"].fillna(np.inf)
    worst = table.assign(share=share).groupby(["rung", "by"], sort=False)["share"].max().reset_index()
    order = worst.groupby("rung")["share"].max().sort_values(ascending=False, kind="stable")
    rows = list(order.index)
    canvas, ax = style.subplots(0.9 + 0.19 * len(rows))
    for index, by in enumerate(("steady", "stepper")):
        part = worst[worst["by"] == by]
        heights = [rows.index(rung) for rung in part["rung"]]
        ax.plot(part["share"].clip(LEAST, MOST), heights, **style.dots(index), label=by)
    ax.axvline(1.0, **style.BOUND, label="bound")
    ax.set(xscale="log", xlim=(0.7 * LEAST, 1.4 * MOST), xlabel="|error| / bound, 1")
    style.rows_downwards(ax, rows)
    ax.tick_params(axis="y", labelsize=7.5)
    style.legend_outside(canvas, ax, columns=3)
    return canvas


FIGURES = [
    Figure(
        "rungs",
        "Error of every rung over its bound, the larger of two segmentations, worst first. Markers at the right edge "
        "are ten times the bound and more, or have no number.",
        rungs,
    )
]
