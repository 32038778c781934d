"""The curves of a picture: lines with what is buckled, cut, flagged and lost, and measured points."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from fctd.plots.description import Curve, Points
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, MEASURED
from fctd.plots.style import LOST, RC, line_style

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


def draw_curve(ax: Axes, curve: Curve) -> None:
    """Draw a curve."""
    colour, marker = curve.look
    depth, line, limits = curve.depth, curve.line, curve.limits
    apart = np.isfinite(curve.low)
    if apart.any():
        low, high = (np.where(apart, end, curve.value) for end in (curve.low, curve.high))
        ax.fill_betweenx(depth, low, high, color=colour, **BAND)
        ax.hlines(depth[apart], curve.low[apart], curve.high[apart], color=colour, linewidth=1)
    for mode, grey in BUCKLED.items():
        at = curve.modes == mode
        if at.any():
            for width, below, order in zip(BELOW_WIDTHS, (EDGE, grey, "white"), (1.2, 1.3, 1.35), strict=True):
                look = BELOW | {"linewidth": width, "markersize": width, "color": below, "zorder": order}
                ax.plot(np.where(at, line, np.nan), depth, **look)
    spread = np.flatnonzero(curve.marks).tolist()
    ax.plot(
        line, depth, color=colour, linestyle=line_style(curve.dash), marker=marker, markevery=spread, markersize=4.5,
        linewidth=curve.width * RC["lines.linewidth"],
    )  # fmt: skip
    care = curve.care
    if care.any():
        ax.plot(line[care], depth[care], color=colour, marker=marker, **OPEN)
    low, high = curve.beyond
    edges = ((limits.low, {"marker": "<"} | CUT, low), (limits.high, {"marker": ">"} | CUT, high),
             (limits.low, STUCK, curve.stuck))  # fmt: skip
    for edge, marks, at in edges:
        if at.any():
            ax.plot(np.full(at.sum(), edge), depth[at], color=colour, **marks)
    lost, place = curve.lost
    if lost.any():
        ax.plot(place[lost], depth[lost], **LOST | {"markeredgecolor": colour})


def draw_points(ax: Axes, points: Points) -> None:
    """Draw the measured points of an operation with their ranges; a range without a value has an empty marker."""
    _, marker = LOOKS[points.operation]
    middle, known = points.middle, np.isfinite(points.value)
    ax.errorbar(middle, points.depth, xerr=np.array(points.bars), **RANGE)
    for at, look in ((known, MEASURED_LOOK), (~known, RANGE_ALONE)):
        if at.any():
            ax.plot(middle[at], points.depth[at], marker=marker, **look)
