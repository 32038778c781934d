"""Fronts of contact methods: what accuracy costs, over every method's settings."""

import pandas as pd
from matplotlib.axes import Axes

from reports import words
from reports.figures import Tables, figure, style

# Errors smaller than this are drawn here: the exact ones have no place on a logarithmic axis [mm, %].
LEAST_MM, LEAST_PERCENT = 1e-3, 1e-3
# A second round of markers is empty.
MARKERS = 6
ERROR = "error of penetration, mm (root mean square)"


@figure(
    "contact_fronts",
    name="fronts",
    caption=(
        "Every contact method over its settings: cost of a point in a call with 1000 of them against the root mean "
        "square error of its penetration (left), and against the change of a turning string's torque (right). The wide "
        "grey lines join the settings that no other one beats in both: of all methods, and of those that take any "
        "wall; errors below a thousandth stand at the bottom."
    ),
)
@style.panels(5.2, 1, 2, sharex=True)
def fronts(tables: Tables, distance: Axes, torque: Axes) -> None:
    """Error of penetration and of torque against the cost of a point, a line for each method."""
    table = tables["fronts"].dropna(subset="ns_1000")
    for ax, column, least in (
        (distance, "rms_error_mm", LEAST_MM),
        (torque, "torque_off_percent", LEAST_PERCENT),
    ):
        rows = table.dropna(subset=column)
        rows = rows.assign(error=rows[column].abs().clip(lower=least))
        if ax is distance:
            for of, width, label in (("pareto", 4, "front"), ("pareto_any_wall", 9, "front, any wall")):
                best = rows[rows[of]].sort_values("ns_1000")
                ax.plot(best["ns_1000"], best["error"], color=style.QUIET, linewidth=width, alpha=0.35, label=label)
        for index, series in enumerate(sorted(table["series"].unique())):
            _series(ax, rows[rows["series"] == series].sort_values("error"), index, words.name(str(series)))
        ax.set(xscale="log", yscale="log", xlabel="time of a point, ns")
    distance.set_ylabel(ERROR)
    torque.set_ylabel("change of torque, %")
    style.legend_outside(distance, columns=4)


@figure(
    "rival_contact",
    name="fronts",
    caption=(
        "Rivals and plugins beside three methods of the suite, over their settings: cost of a point in a call with "
        "1000 of them against the root mean square error of its penetration; errors below a thousandth stand at the "
        "bottom."
    ),
)
@style.panels(5.2)
def rivals(tables: Tables, ax: Axes) -> None:
    """Error of penetration against the cost of a point, a line for each method."""
    table = tables["fronts"].dropna(subset="ns_1000")
    table = table.assign(error=table["rms_error_mm"].clip(lower=LEAST_MM))
    for index, series in enumerate(sorted(table["series"].unique())):
        _series(ax, table[table["series"] == series].sort_values("error"), index, words.name(str(series)))
    ax.set(xscale="log", yscale="log", xlabel="time of a point, ns", ylabel=ERROR)
    style.legend_outside(ax, columns=4)


def _series(ax: Axes, rows: pd.DataFrame, index: int, label: str) -> None:
    look = style.marked(index) | {"markerfacecolor": style.colour(index) if index < MARKERS else "white"}
    ax.plot(rows["ns_1000"], rows["error"], **look | {"linewidth": 1.0}, label=label)
