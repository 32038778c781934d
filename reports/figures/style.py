"""One style for all figures: fonts, lines that differ in grey and for the colour-blind, axes with units."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator
from matplotlib.typing import RcKeyType
from numpy.typing import NDArray

from fctd import plots
from fctd.plots import palette
from fctd.plots import style as plot_style
from reports.figures import Canvas, Draw, Tables

WIDTH_IN = 7.2  # the page's column

# The style of the engine's own plots, larger and greyer for the page.
RC: dict[RcKeyType, Any] = plots.RC | {
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.5,
    "axes.labelcolor": "#222222",
    "axes.edgecolor": "#666666",
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "legend.fontsize": 9,
    "lines.linewidth": 1.7,
    "lines.markersize": 4.5,
    "lines.markeredgewidth": 0.8,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "savefig.dpi": 160,
}

# The engine's palette and dashes; a dash and a marker for each colour.
COLOURS, DASHES = list(palette.PALETTE.values()), plot_style.LINE_STYLES
QUIET, SHADE = palette.QUIET, palette.SHADE
MARKERS = ["o", "s", "^", "D", "v", "P"]
# Colours of further series, where there are more than six; the same dashes and markers come again with them.
MORE_COLOURS = [
    "#E69F00", "#7A5195", "#8C564B", "#9A9D00", "#7F7F7F", "#A7D129", "#F2A58E", "#00B5BD", "#5B1A1A", "#B5A0E0",
    "#2E5E2E", "#E8D800",
]  # fmt: skip
# A friction law looks the same in every figure.
LAWS = {"paper": 0, "coulomb": 1, "karnopp": 2}

# Grey lines: zero difference, and bounds.
ZERO: dict[str, Any] = {"color": QUIET, "linewidth": 1}
BOUND: dict[str, Any] = ZERO | {"linestyle": (0, (4, 2))}
# What is struck through: a dash over each mark.
STRUCK: dict[str, Any] = {"color": "#222222", "linestyle": "none", "marker": "_", "markersize": 15}
# Dashes of the lines of first and second order.
ORDERS: dict[int, Any] = {1: (0, (1, 1.5)), 2: (0, (6, 2, 1, 2))}

# Contact angles run from -90° to 270°, so that neither the high nor the low side is at the ends of the axis.
SIDES = [-90, 0, 90, 180, 270]
SIDE_LABELS = ["left", "0°\nhigh", "90°\nright", "180°\nlow", "left"]


def colour(index: int) -> str:
    """The colour of series number ``index``."""
    every = [*COLOURS, *MORE_COLOURS]
    return every[index % len(every)]


def line(index: int) -> dict[str, Any]:
    """The style of series number ``index`` drawn as a line."""
    return {"color": colour(index), "linestyle": DASHES[index % 6]}


def marked(index: int) -> dict[str, Any]:
    """The same with a marker at every point."""
    return line(index) | {"marker": MARKERS[index % 6]}


def dots(index: int, *, filled: bool = True) -> dict[str, Any]:
    """The style of series number ``index`` drawn as separate points."""
    return {
        "color": colour(index),
        "linestyle": "none",
        "marker": MARKERS[index % 6],
        "markerfacecolor": colour(index) if filled else "white",
    }


def figure(height_in: float) -> Figure:
    """An empty figure as wide as the page's column."""
    return Figure(figsize=(WIDTH_IN, height_in), layout="constrained")


def subplots(height_in: float, rows: int = 1, columns: int = 1, **layout: Any) -> tuple[Figure, Any]:
    """A figure as wide as the page's column, and its axes as ``Figure.subplots`` gives them."""
    canvas = figure(height_in)
    return canvas, canvas.subplots(rows, columns, **layout)


def panels(height_in: float, rows: int = 1, columns: int = 1, **layout: Any) -> Callable[[Callable[..., None]], Draw]:
    """A function that draws tables on axes, given row by row, as one that returns their figure; see ``subplots``."""

    def with_axes(draw: Callable[..., None]) -> Draw:
        def drawn(tables: Tables) -> Canvas:
            canvas, axes = subplots(height_in, rows, columns, **layout)
            draw(tables, *np.ravel(axes))
            return canvas

        return drawn

    return with_axes


def depth_downwards(ax: Axes, label: str = "measured depth, m") -> None:
    """Depth on the vertical axis, growing downwards as in the well."""
    ax.set_ylabel(label)
    ax.invert_yaxis()


def legend_above(ax: Axes, columns: int = 2) -> None:
    """A legend over the axes, where it hides no data."""
    ax.legend(loc="lower left", bbox_to_anchor=(-0.01, 1.0), ncols=columns, borderaxespad=0.3)


def legend_outside(ax: Axes, columns: int = 2) -> None:
    """The legend of one axes over the whole figure."""
    ax.figure.legend(*ax.get_legend_handles_labels(), loc="outside upper left", ncols=columns)


def rows_downwards(ax: Axes, labels: Sequence[str]) -> None:
    """A row for each label, the first on top."""
    ax.set_yticks(range(len(labels)), labels)
    ax.set_ylim(len(labels) - 0.5, -0.5)


def around_zero(values: "pd.DataFrame | pd.Series[float]") -> tuple[float, float]:
    """Limits of an axis of differences, with room on either side."""
    largest = 1.5 * float(np.nanmax(np.abs(values.to_numpy(float))))
    return -largest, largest


def chart(table: pd.DataFrame) -> Figure:
    """A torque-and-drag chart as ``fctd chart --plot`` draws it; the page scales it to its column."""
    return plots.chart_figure(table, "si")


def plain_log_ticks(*axes: Axis) -> None:
    """Ticks of logarithmic axes as 1, 2, 5, 10 and not as powers, where they span little."""
    for axis in axes:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_locator(NullLocator())


def slopes(ax: Axes, x: NDArray[np.float64], y: NDArray[np.float64]) -> None:
    """Grey lines of first and second order, from above the largest value of a log-log plot."""
    at = np.array([x.min(), x.max()])
    bottom = ax.get_ylim()[0]
    for order, label in ((1, "first order"), (2, "second order")):
        ax.plot(at, 2 * y.max() * (at / x.max()) ** order, **ZERO | {"linestyle": ORDERS[order]}, label=label)
    ax.set_ylim(bottom=bottom)


def unrolled(angle_deg: "pd.Series[float]") -> "pd.Series[float]":
    """Contact angles between the first and the last of ``SIDES``."""
    return (angle_deg + 90) % 360 - 90


def build_intervals(
    md_m: NDArray[np.float64], inclination_deg: NDArray[np.float64], least_deg_per_m: float = 0.01
) -> list[tuple[float, float]]:
    """The stretches of hole, top and bottom in m, over which the inclination changes."""
    md, first = np.unique(md_m, return_index=True)
    inclination = inclination_deg[first]
    bends = np.abs(np.diff(inclination)) > least_deg_per_m * np.diff(md)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], bends.astype(int), [0]))))
    return [(float(md[top]), float(md[bottom])) for top, bottom in zip(edges[::2], edges[1::2], strict=True)]


def shade_builds(ax: Axes, md_m: NDArray[np.float64], inclination_deg: NDArray[np.float64]) -> None:
    """Shade the bent stretches of hole on an axis of measured depth."""
    for top, bottom in build_intervals(md_m, inclination_deg):
        ax.axvspan(top, bottom, color=SHADE, zorder=0, linewidth=0)
