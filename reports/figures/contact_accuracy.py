"""Error against cost, all contact methods together."""

from matplotlib.axes import Axes

from reports import words
from reports.figures import Canvas, Figure, Tables, style

# Zero has no place on a logarithmic axis; exact answers are drawn on a line below it.
FLOOR = 0.3


def error_and_cost(tables: Tables) -> Canvas:
    """A line for each method from its coarse to its fine settings: error of depth and of direction."""
    cost = tables["cost"]
    canvas, (depth, angle) = style.subplots(4.3, 1, 2, sharex=True)
    for index, method in enumerate(cost["method"].unique()):
        chosen = cost[cost["method"] == method]
        look = style.dots(index, filled=index < 6) | {"linestyle": "-", "linewidth": 0.8}
        for ax, column in ((depth, "max_penetration_error_mm"), (angle, "max_angle_error_deg")):
            smallest = cost.loc[cost[column] > 1e-5, column].min()
            ax.plot(
                chosen["ns_per_point"], chosen[column].clip(lower=FLOOR * smallest), **look, label=words.name(method)
            )
    for ax, label in ((depth, "largest error of penetration, mm"), (angle, "largest error of direction, °")):
        ax.set(xscale="log", yscale="log", xlabel="cost per point, ns", ylabel=label)
        style.plain_log_ticks(ax.yaxis)
    for ax, column in ((depth, "max_penetration_error_mm"), (angle, "max_angle_error_deg")):
        exact_line(ax, FLOOR * cost.loc[cost[column] > 1e-5, column].min())
    style.legend_outside(canvas, depth, columns=4)
    return canvas


def exact_line(ax: Axes, height: float) -> None:
    """The line on which exact answers are drawn."""
    ax.axhline(height, color=style.QUIET, linewidth=1, linestyle=(0, (1, 2)))
    ax.annotate("exact", (0.98, height), xycoords=("axes fraction", "data"), ha="right", va="bottom", color=style.QUIET)


FIGURES = [
    Figure(
        "error_and_cost",
        "Largest error of penetration (left) and of the wall's direction (right) over all points in bends, against "
        "the time per point of a query from Python. Lines lead from coarse to fine: cylinders and FOR-loop by "
        "length, meshes by facets and ring spacing. Points on the dotted line are exact.",
        error_and_cost,
    )
]
