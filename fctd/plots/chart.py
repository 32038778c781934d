"""The torque-and-drag chart as a picture: hook load (the broomstick) and surface torque against bit depth."""

from typing import Any, Final

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from fctd.plots import labels
from fctd.plots.curves import BAND, CUT, MEASURED_LOOK, OPEN, RANGE_ALONE, draw_curve, draw_points
from fctd.plots.describe import describe
from fctd.plots.description import DepthAxis, Description, Group, Mark, Panel
from fctd.plots.facts import heading_of_chart
from fctd.plots.limit_lines import WIDTH as LIMIT_WIDTH
from fctd.plots.loads import PLAIN, ChartLook, Compared
from fctd.plots.palette import DARK, LOOKS, QUIET
from fctd.plots.strip import LANE, draw_strip, state_handles
from fctd.plots.style import POINTS, RC, SMALL, Sheet, line_style
from fctd.results.unit_systems import System

ACROSS = 2  # groups side by side
# Sizes [in]: width of the panels of loads and of torques and their height, of one group alone and of one among several.
ALONE, AMONG = (4.2, 2.9, 5.3), (3.5, 2.3, 4.4)
LEFT, BETWEEN, RIGHT, HEADING, ABOVE, BELOW = 0.75, 0.22, 0.2, 0.24, 0.48, 0.16
WIDEST_MARK = 1.7  # room beside the panels for the ends of intervals [in]
MARK_LINE = 10.0  # height of a line beside the panels [pt]
MOST_LEVELS = 4  # of labels in full: shorter ones may need fewer
LANE_NAMES = 2  # levels below a strip
STYLES: Final = ("full", "short", "factors")  # of the names at the ends of curves, the longest first
# Hook loads at which slack-off is spent.
SPENT: dict[str, Any] = {"facecolor": "none", "hatch": "////", "edgecolor": "#cfcfcf", "linewidth": 0, "zorder": 0}
SHOE: dict[str, Any] = {"color": QUIET, "linewidth": 0.9, "linestyle": (0, (1, 2)), "zorder": 1.1}
LEADER: dict[str, Any] = {"color": QUIET, "linewidth": 0.6, "zorder": 1.4, "clip_on": False}


def chart_figure(chart: pd.DataFrame, units: System = "si", case: Compared = None, look: ChartLook = PLAIN) -> Figure:
    """Load and torque against bit depth: a curve for each operation and set of friction factors.

    chart : of ``fctd.torque_drag``, SI.  case : for title, casing shoes, mud, loads at the bit and block weight, with
    which the loads are those of the weight indicator; of a table with a column ``case`` the charts by its names.

    A colour is an operation, or a case where there are several, a dash a set of friction factors; factors that make no
    difference share a curve.  More than ``MOST_CURVES`` series are drawn in groups.  A strip says where strings are
    buckled, and which rows are not ``converged``; a cross marks a row without loads, a band the loads of both shapes of
    a resolved string.  Where a string is locked up, loads at which slack-off is spent are hatched, and larger pushes,
    with which the axis would show nothing else, have triangles at its edge.
    """
    described = describe(chart, units, case, look)
    with mpl.rc_context(RC):
        layout = _Layout(described)
        style, levels = layout.name_curves()
        pairs, across = layout.pairs, min(len(layout.pairs), ACROSS)
        step, height = layout.step, layout.above + layout.height + layout.below(levels)
        total = -(-len(pairs) // across) * height
        handles = _handles(described, style)
        sheet = Sheet(step * across, total, *heading_of_chart(chart, units, case, look), handles)
        for k, pair in enumerate(pairs):
            pair.draw(sheet, k % across * step + LEFT, k // across * height + layout.above)
        return sheet.figure


class _Layout:
    """Sizes [in] and places that all panels of a picture share; point : the depth of 1 pt."""

    def __init__(self, described: Description) -> None:
        groups = described.groups
        sizes = ALONE if len(groups) == 1 else AMONG
        self.widths, self.height = sizes[:2], sizes[2]
        self.depth, self.marks = described.depth, described.marks
        self.above = ABOVE + (HEADING if len(groups) > 1 else 0.0)
        self.point = (self.depth.lower - self.depth.upper) / (self.height * POINTS)
        lanes = max(len(group.lanes) for group in groups)
        words = [line for mark in self.marks for line in mark.lines]
        widest = max((labels.width_of(line) * SMALL / labels.SIZE / POINTS + 0.12 for line in words), default=0.0)
        beside = (lanes * LANE + 0.12 if lanes else 0.0) + max(min(widest, WIDEST_MARK), RIGHT)
        self.step = LEFT + sum(self.widths) + BETWEEN + beside
        self.pairs = [_Pair(self, group) for group in groups]

    def below(self, levels: int) -> float:
        """Height of labels on some levels, or of the names of lanes, below the axes."""
        lanes = any(pair.group.lanes for pair in self.pairs)
        return max(levels, LANE_NAMES if lanes else 0) * labels.LEVEL / POINTS + BELOW

    def name_curves(self) -> tuple[str, int]:
        """Name the ends of the curves; returns the style of the names and their levels, "" and 0 where none fits."""
        for style in STYLES:
            for pair in self.pairs:
                pair.name_curves(style)
            found = [places for pair in self.pairs for places in pair.places]
            if all(places is not None for places in found):
                levels = max((1 + place.level for places in found for place in places or ()), default=0)
                if levels <= MOST_LEVELS or style == STYLES[-1]:
                    return style, levels
        for pair in self.pairs:
            pair.name_curves("")
        return "", 0


class _Pair:
    """The panels of loads and torques of a group."""

    def __init__(self, layout: _Layout, group: Group) -> None:
        self.layout, self.group = layout, group
        self.texts: list[list[str]] = []
        self.places: list[list[labels.Place] | None] = []

    def name_curves(self, style: str) -> None:
        """Set the labels of the panels and their places, None where they do not fit; no labels without a style."""
        self.texts, self.places = [], []
        for panel, width in zip(self.group.panels, self.layout.widths, strict=True):
            curves = [curve for curve in panel.curves if style and np.isfinite(curve.end[0])]
            # The numbers of the lanes.
            texts = [": ".join(filter(None, [str(curve.lane or ""), getattr(curve.name, style)])) for curve in curves]
            low, high, room = panel.limits.low, panel.limits.high, width * POINTS
            ends = [(curve.end[0] - low) / (high - low) * room for curve in curves]
            self.texts.append(texts)
            self.places.append(labels.place(ends, texts, room))

    def draw(self, sheet: Sheet, left: float, top: float) -> None:
        """Draw both panels, their labels, the strip and the ends of the intervals."""
        layout, group, depth = self.layout, self.group, self.layout.depth
        first = sheet.axes(left, top, layout.widths[0], layout.height)
        right = left + layout.widths[0] + BETWEEN
        second = sheet.axes(right, top, layout.widths[1], layout.height, sharey=first)
        for k, ax in enumerate((first, second)):
            _draw_panel(ax, group.panels[k], layout.marks, ticks=6 - 2 * k)
            self._label(ax, k)
        edge, beside = right + layout.widths[1], second
        if group.lanes:
            beside = sheet.axes(edge + 0.12, top, len(group.lanes) * LANE, layout.height, sharey=first)
            draw_strip(beside, group.lanes)
        first.set_ylabel(depth.label)
        second.tick_params(axis="y", labelleft=False)
        if group.name:
            first.set_title(group.name)
        first.set_ylim(depth.lower, depth.upper)
        first.set_yticks(_depth_ticks(depth))
        _name_marks(beside, layout.marks, layout.point)

    def _label(self, ax: Axes, k: int) -> None:
        """Label the ends of the curves of a panel, below the axes."""
        point, bottom, lower = self.layout.point, self.layout.depth.bottom, self.layout.depth.lower
        texts, places = iter(self.texts[k]), iter(self.places[k] or ())
        for curve in self.group.panels[k].curves if self.texts[k] else ():
            (x, depth), (colour, marker) = curve.end, curve.look
            if np.isnan(x):
                continue
            place = next(places)
            down = lower + labels.LEVEL * (place.level + 0.5) * point
            # Below a curve that ends above the deepest row, a solid line would look like loads.
            dash = "-" if depth >= bottom else (0, (1, 3))
            ax.plot([x, x], [depth, down], linestyle=dash, **LEADER)
            ax.plot([x], [down], color=colour, marker=marker, markersize=4.5, linestyle="none", clip_on=False)
            aside = labels.GAP if place.right else -labels.GAP
            ax.annotate(
                next(texts), (x, down), (aside, 0), textcoords="offset points", va="center_baseline",
                fontsize=labels.SIZE, ha="left" if place.right else "right", parse_math=False, annotation_clip=False,
            )  # fmt: skip


def _draw_panel(ax: Axes, panel: Panel, marks: tuple[Mark, ...], ticks: int) -> None:
    for curve in panel.curves:
        draw_curve(ax, curve)
    for points in panel.points:
        draw_points(ax, points)
    for line in panel.lines:
        colour, _ = LOOKS[line.operation]
        ax.plot(line.value, line.depth, linestyle=line_style(line.dash), color=colour, linewidth=LIMIT_WIDTH)
    ax.set_xlim(panel.limits.low, panel.limits.high)
    ax.xaxis.set_major_locator(MaxNLocator(ticks))
    # Above, as the ends of the curves are named below.
    ax.xaxis.set_label_position("top")
    ax.xaxis.tick_top()
    ax.spines["top"].set_visible(True)
    ax.spines["bottom"].set_visible(False)
    ax.set_xlabel(panel.label)
    if panel.spent is not None:
        ax.axvspan(panel.limits.low, panel.spent, **SPENT)
        ax.axvline(panel.spent, color=QUIET, linewidth=1, zorder=1)
        ax.annotate(
            "slack-off is spent", (0, 0), (8, 2), xycoords="axes fraction", textcoords="offset points", va="bottom",
            fontsize=SMALL, color=DARK, bbox={"facecolor": "white", "linewidth": 0, "pad": 1}, zorder=1.2,
        )  # fmt: skip
    for mark in marks:
        if mark.shoe:
            ax.axhline(mark.depth, **SHOE)


def _depth_ticks(depth: DepthAxis) -> list[float]:
    if depth.top == depth.bottom:
        return [depth.top]
    ticks = MaxNLocator(8, steps=[1, 2, 2.5, 5, 10]).tick_values(depth.top, depth.bottom)
    return [float(tick) for tick in ticks if depth.upper <= tick <= depth.lower]


def _name_marks(ax: Axes, marks: tuple[Mark, ...], point: float) -> None:
    """Name the ends of the intervals to the right of axes, below one another."""
    lowest = -np.inf
    for mark in marks:
        lines = [_cut(line) for line in mark.lines]
        half = 0.5 * len(lines) * MARK_LINE * point
        at = max(mark.depth, lowest + half)
        lowest = at + half
        ax.annotate(
            "\n".join(lines), (1.0, at), (4, 0), xycoords=ax.get_yaxis_transform(), textcoords="offset points",
            va="center", fontsize=SMALL, color=DARK, annotation_clip=False, parse_math=False,
        )  # fmt: skip


def _cut(text: str) -> str:
    """A text that fits beside the panels, with an ellipsis where it was longer."""
    room = (WIDEST_MARK - 0.12) * POINTS * labels.SIZE / SMALL
    while labels.width_of(text) > room:
        text = f"{text.removesuffix('…')[:-1]}…"
    return text


def _handles(described: Description, style: str) -> list[Artist]:
    """The legend; style : of the names at the ends of the curves, which stand for themselves where they are whole."""
    curves, lanes = described.curves, [lane for group in described.groups for lane in group.lanes]
    panels = [panel for group in described.groups for panel in group.panels]
    dashed = any(not key.marker for key in described.keys)
    told = style and not described.compared
    keys = [key for key in described.keys if not told or (style == STYLES[-1] and dashed and key.marker)]
    handles: list[Artist] = [
        Line2D([], [], color=key.colour, marker=key.marker, linestyle=line_style(key.dash), markersize=4.5,
               label=key.name)
        for key in keys
    ]  # fmt: skip
    handles += state_handles(lanes)
    if any(side.any() for curve in curves for side in curve.beyond):
        handles.append(Line2D([], [], color=QUIET, label="beyond the axis", **{"marker": "<"} | CUT))
    banded = next((curve for curve in curves if curve.has_band), None)
    if banded is not None:
        # In the colour of a curve: the greys are those of buckling.
        handles.append(Patch(color=banded.look[0], label="hook loads of both shapes", **BAND))
    if any(curve.care.any() for curve in curves):
        handles.append(Line2D([], [], color=QUIET, marker="o", label="not converged: see state", **OPEN))
    dashes = {line.name: line_style(line.dash) for panel in panels for line in panel.lines}
    handles += [
        Line2D([], [], color=QUIET, linestyle=dash, linewidth=LIMIT_WIDTH, label=name) for name, dash in dashes.items()
    ]
    points = [points for panel in panels for points in panel.points]
    names = {of.name: LOOKS[of.operation][1] for of in points}
    handles += [Line2D([], [], marker=marker, label=name, **MEASURED_LOOK) for name, marker in names.items()]
    if any(np.isnan(of.value).any() for of in points):
        handles.append(Line2D([], [], marker="o", label="measured range without a value", **RANGE_ALONE))
    return handles
