"""The curves of a chart: one series in one panel, with what is buckled, cut, flagged, lost and measured."""

from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.plots.loads import TORQUE, Limits, marked, measured_columns
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, MEASURED
from fctd.plots.style import LOST
from fctd.results.series import Series
from fctd.results.status import SteadyStatus

Flags = NDArray[np.bool_]

# Rows that are answers with care, or locked up, have an open marker.
OPEN: dict[str, Any] = {"linestyle": "none", "markerfacecolor": "white", "markersize": 5.5, "markeredgewidth": 1.2}
# At the edge of an axis: loads beyond it, and at its left edge rows that no push moves.
CUT: dict[str, Any] = {"linestyle": "none", "markersize": 8, "clip_on": False, "markerfacecolor": "white", "zorder": 4}
STUCK: dict[str, Any] = {"marker": "<", "linestyle": "none", "markersize": 8, "clip_on": False, "zorder": 4}
BAND: dict[str, Any] = {"alpha": 0.3, "linewidth": 0.8}
# Below the line of a buckled string: a band with edges and a white core, on which a light curve is seen in grey.
BELOW: dict[str, Any] = {"marker": "o", "markeredgewidth": 0, "solid_capstyle": "round"}
BELOW_WIDTHS = (10.0, 8.4, 3.6)
# Measured points and their ranges.
MEASURED_LOOK: dict[str, Any] = {
    "linestyle": "none", "markersize": 7.5, "markerfacecolor": MEASURED, "markeredgecolor": "black",
    "markeredgewidth": 1.2, "zorder": 5,
}  # fmt: skip
RANGE_ALONE: dict[str, Any] = MEASURED_LOOK | {"markerfacecolor": "white", "markersize": 5}
RANGE: dict[str, Any] = {"fmt": "none", "ecolor": "black", "elinewidth": 1.6, "capsize": 3.5, "zorder": 4.8}


class Drawn(NamedTuple):
    """What is drawn in a panel.

    column : of the chart; factor, depth : from SI to the units of the axes; limits : of the axis of loads.
    """

    column: str
    factor: float
    depth: float
    limits: Limits


class _Line(NamedTuple):
    """A curve in the units of its axes (n,): depths, values, and the line, cut at the edges of the axis.

    locked : rows that are locked up; stuck : those that no push moves, on the left edge of the axis of loads.
    """

    depth: Array
    value: Array
    line: Array
    locked: Flags
    stuck: Flags


def _line_of(rows: pd.DataFrame, drawn: Drawn) -> _Line:
    limits = drawn.limits
    value = rows[drawn.column].to_numpy(float) * drawn.factor
    locked = (rows["status"] == SteadyStatus.LOCKED_UP).to_numpy(bool)
    stuck = np.isnan(value) & locked & (drawn.column != TORQUE)
    line = np.where(stuck, limits.low, np.clip(value, limits.low, limits.high))
    # The line goes to the edge, and not along it.
    gone = stuck | (value < limits.low) | (value > limits.high)
    line[gone & np.append(True, gone[:-1]) & np.append(gone[1:], True)] = np.nan
    return _Line(rows["bit_depth_m"].to_numpy(float) * drawn.depth, value, line, locked, stuck)


def end_of(rows: pd.DataFrame, drawn: Drawn) -> tuple[float, float]:
    """Load and depth at the end of a curve, in the units of the axes; NaN for a series without loads."""
    curve = _line_of(rows, drawn)
    found = np.flatnonzero(np.isfinite(curve.line))
    return (float(curve.line[found[-1]]), float(curve.depth[found[-1]])) if len(found) else (np.nan, np.nan)


def is_cut(rows: pd.DataFrame, drawn: Drawn) -> bool:
    """Whether any load of a series lies beyond the axis."""
    curve = _line_of(rows, drawn)
    return bool((curve.value != curve.line)[np.isfinite(curve.value)].any())


def draw_curve(ax: Axes, series: Series, dash: Any, drawn: Drawn, shapes: tuple[Array, Array], place: int) -> None:
    """Draw one series.

    shapes : loads [SI] of both shapes of each row; place : separates the crosses of series without any loads.
    """
    rows, (colour, marker), limits = series.rows, LOOKS[series.operation], drawn.limits
    depth, value, line, locked, stuck = _line_of(rows, drawn)
    low, high = (end * drawn.factor for end in shapes)
    apart = np.isfinite(low)
    if apart.any():
        ax.fill_betweenx(depth, np.where(apart, low, value), np.where(apart, high, value), color=colour, **BAND)
        ax.hlines(depth[apart], low[apart], high[apart], color=colour, linewidth=1)
    cut_low, cut_high = locked & (value < limits.low), locked & (value > limits.high)
    for mode, grey in BUCKLED.items():
        at = (rows["buckling"] == mode).to_numpy()
        if at.any():
            for width, colour_below, order in zip(BELOW_WIDTHS, (EDGE, grey, "white"), (1.2, 1.3, 1.35), strict=True):
                look = BELOW | {"linewidth": width, "markersize": width, "color": colour_below, "zorder": order}
                ax.plot(np.where(at, line, np.nan), depth, **look)
    spread = np.flatnonzero(marked(value)).tolist()
    ax.plot(line, depth, color=colour, linestyle=dash, marker=marker, markevery=spread, markersize=4.5)
    status = rows["status"].to_numpy(str)
    care = np.isfinite(value) & (status != SteadyStatus.CONVERGED) & ~cut_low & ~cut_high
    if care.any():
        ax.plot(line[care], depth[care], color=colour, marker=marker, **OPEN)
    for marks, at in (({"marker": "<"} | CUT, cut_low), ({"marker": ">"} | CUT, cut_high), (STUCK, stuck)):
        if at.any():
            edge = np.full(at.sum(), limits.high if at is cut_high else limits.low)
            ax.plot(edge, depth[at], color=colour, **marks)
    lost, found = np.isnan(value) & ~locked, np.isfinite(line)
    crosses: dict[str, Any] = LOST | {"markeredgecolor": colour}
    if found.any():
        # Beyond the first and the last answer any place would look like a load; the strip has the crosses there.
        gap = lost & (depth > depth[found].min()) & (depth < depth[found].max())
        ax.plot(np.interp(depth[gap], depth[found], line[found]), depth[gap], **crosses)
    elif lost.any():
        across = ax.get_yaxis_transform()  # x in shares of the axes
        ax.plot(np.full(lost.sum(), 0.15 + 0.14 * place), depth[lost], transform=across, **crosses)


def draw_measured(ax: Axes, measured: pd.DataFrame, kind: str, drawn: Drawn) -> None:
    """Draw the measured points of an operation with their ranges; a range without a value has an empty marker."""
    _, marker = LOOKS[kind]
    rows = measured[measured["operation"] == kind]
    value, low, high = (rows[name].to_numpy(float) * drawn.factor for name in measured_columns(drawn.column))
    depth = rows["bit_depth_m"].to_numpy(float) * drawn.depth
    ranged = np.isfinite(low)
    middle = np.where(np.isfinite(value), value, 0.5 * (low + high))
    # Without a range the bar has no length.
    bars = np.array([np.where(ranged, middle - low, 0.0), np.where(ranged, high - middle, 0.0)])
    shown = np.isfinite(middle)
    if shown.any():
        ax.errorbar(middle[shown], depth[shown], xerr=bars[:, shown], **RANGE)
    known = np.isfinite(value)
    for at, look in ((known, MEASURED_LOOK), (shown & ~known, RANGE_ALONE)):
        if at.any():
            ax.plot(middle[at], depth[at], marker=marker, **look)
