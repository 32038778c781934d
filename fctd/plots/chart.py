"""The torque-and-drag chart: hook load (the broomstick) and surface torque against bit depth."""

from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.plots import labels
from fctd.plots.curves import (
    BAND,
    CUT,
    MEASURED_LOOK,
    OPEN,
    RANGE_ALONE,
    Drawn,
    draw_curve,
    draw_measured,
    end_of,
    is_cut,
)
from fctd.plots.facts import heading_of_chart
from fctd.plots.limit_lines import WIDTH as LIMIT_WIDTH
from fctd.plots.limit_lines import limit_lines
from fctd.plots.loads import (
    LOAD_COLUMNS,
    NAMES,
    PLAIN,
    TORQUE,
    ChartLook,
    as_load,
    groups_of,
    limits_of_load,
    limits_of_torque,
    names_of,
    spent_at,
)
from fctd.plots.palette import DARK, LOOKS, QUIET
from fctd.plots.strip import LANE, draw_strip, has_states, state_handles
from fctd.plots.style import DASHES, POINTS, RC, Sheet
from fctd.results.columns import DEPTH
from fctd.results.series import Series, frictions_of, series_of
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown

MOST_GROUPS = 24  # in a picture
ACROSS = 2  # groups side by side
# Sizes [in]: width of the panels of loads and of torques and their height, of one group alone and of one among several.
ALONE, AMONG = (4.2, 2.9, 5.3), (3.5, 2.3, 4.4)
LEFT, BETWEEN, SHOES, RIGHT, ABOVE, BELOW = 0.75, 0.22, 0.9, 0.2, 0.28, 0.56
SHOE_LINE = 10.0  # height of the name of a shoe [pt]
# Hook loads at which slack-off is spent.
SPENT: dict[str, Any] = {"facecolor": "none", "hatch": "////", "edgecolor": "#cfcfcf", "linewidth": 0, "zorder": 0}
SHOE: dict[str, Any] = {"color": QUIET, "linewidth": 0.9, "linestyle": (0, (1, 2)), "zorder": 1.1}
LEADER: dict[str, Any] = {"color": QUIET, "linewidth": 0.6, "zorder": 1.4}


def chart_figure(
    chart: pd.DataFrame, units: System = "si", case: Case | None = None, look: ChartLook = PLAIN
) -> Figure:
    """Load and torque against bit depth: a curve for each operation and set of friction factors.

    chart : of ``fctd.torque_drag``, SI.  case : for title, casing shoes, mud, loads at the bit and block weight.

    More than ``MOST_CURVES`` curves are drawn in groups.  A strip beside the panels says where the string is buckled,
    and which rows are not ``converged``; a cross marks a row without loads, a band the loads of both shapes of a
    resolved string.  Where a string is locked up, loads at which slack-off is spent are hatched, and larger pushes,
    with which the axis would show nothing else, have triangles at its edge.
    """
    series = series_of(chart, units)
    groups = groups_of(series)
    if len(groups) > MOST_GROUPS:
        raise InputError(f"at most {MOST_GROUPS} groups of curves in a picture", key="friction", value=len(groups))
    title, lines = heading_of_chart(chart, units, case, look.rates, look.warnings)
    with mpl.rc_context(RC):
        view = _View(chart, units, case, look, alone=len(groups) == 1)
        pairs = [_Pair(view, name, group) for name, group in groups]
        levels = _levels(pairs)
        view.scale_depth(levels)
        across = min(len(pairs), ACROSS)
        step, height = view.step(max(len(pair.group) for pair in pairs)), view.above + view.height + BELOW
        handles = _handles(view, series, [] if levels else pairs)
        total = -(-len(pairs) // across) * height
        sheet = Sheet(step * across, total, title, lines, handles)
        for k, pair in enumerate(pairs):
            pair.draw(sheet, k % across * step + LEFT, k // across * height + view.above, labelled=levels > 0)
        return sheet.figure


class _View:
    """What all panels of a chart share: data, units, sizes [in], and the scale of depths.

    drawn : what the panels of a pair show.  shoes [m] : within the depths.  above : room for a heading.
    """

    def __init__(self, chart: pd.DataFrame, units: System, case: Case | None, look: ChartLook, *, alone: bool) -> None:
        self.case, self.units, self.look = case, units, look
        load, measured = look.load, look.measured
        self.states = has_states(series_of(chart))
        self.widths, self.height = (ALONE if alone else AMONG)[:2], (ALONE if alone else AMONG)[2]
        self.depth = shown(DEPTH.name, units)
        column = LOAD_COLUMNS[load]
        self.lines = [limit_lines(look.margins, case, load, name) for name in (column, TORQUE)]
        values = [[line.value for line in lines] for lines in self.lines]
        limits = (
            limits_of_load(chart, case, load, units, measured, values[0]),
            limits_of_torque(chart, units, measured, values[1]),
        )
        self.drawn = [
            Drawn(name, shown(name, units).factor, self.depth.factor, limit)
            for name, limit in zip((column, TORQUE), limits, strict=True)
        ]
        depths = [chart["bit_depth_m"], *([] if measured is None else [measured["bit_depth_m"]])]
        # Headings of groups stand above the name of the hatched part.
        self.named_pushes = limits[0].cut
        self.above = (0.06 if alone else ABOVE) + (0.16 if self.named_pushes else 0.0)
        self.top, self.bottom = (
            float(end) * self.depth.factor for end in (min(d.min() for d in depths), max(d.max() for d in depths))
        )
        shoes = [] if case is None else [shoe * self.depth.factor for shoe in case.shoes]
        self.shoes = [shoe for shoe in shoes if self.top <= shoe <= self.bottom]
        self.ylim, self.point = (self.bottom, self.top), 0.0

    def step(self, lanes: int) -> float:
        """Width of a pair with what stands beside it."""
        beside = lanes * LANE + 0.12 if self.states else 0.0
        return LEFT + sum(self.widths) + BETWEEN + beside + (SHOES if self.shoes else RIGHT)

    @property
    def foot(self) -> float:
        """Height of the deepest row, in shares of the axes."""
        bottom, top = self.ylim
        return (bottom - self.bottom - 4 * self.point) / (bottom - top)

    def shapes(self, one: Series) -> tuple[Array, Array]:
        """Loads [N] of both shapes of each row of a series, NaN where they do not differ."""
        ends = one.rows[["hookload_low_N", "hookload_high_N"]].to_numpy(float).T
        low, high = (as_load(self.case, one.operation, end, self.look.load) for end in ends)
        return low, high

    def has_band(self, one: Series) -> bool:
        """Whether the loads of both shapes of any row of a series reach the axis."""
        drawn = self.drawn[0]
        low, high = (end * drawn.factor for end in self.shapes(one))
        return bool(((high > drawn.limits.low) & (low < drawn.limits.high)).any())

    def scale_depth(self, levels: int) -> None:
        """Set the limits of the axis of depths, with room for labels on some levels; ``point`` is the depth of 1 pt."""
        room = labels.GAP + labels.LEVEL * levels if levels else 0.0
        air = 6.0
        span = (self.bottom - self.top) or max(0.01 * self.bottom, 1.0)
        self.point = span / (self.height * POINTS - room - 2 * air)
        middle = 0.5 * (self.top + self.bottom)
        self.ylim = (middle + 0.5 * span + (room + air) * self.point, middle - 0.5 * span - air * self.point)


class _Pair:
    """The panels of loads and torques of a group of series."""

    def __init__(self, view: _View, name: str, group: list[Series]) -> None:
        self.view, self.name, self.group = view, name, group
        frictions = frictions_of(group)
        self.dashes = [DASHES[frictions.index(one.friction) % len(DASHES)] for one in group]
        self.ends = [[end_of(one.rows, drawn) for one in group] for drawn in view.drawn]
        self.texts: list[str] = []
        self.places: list[list[labels.Place] | None] = []

    def name_curves(self, *, short: bool) -> None:
        """Set the texts of the labels and their places."""
        self.texts = names_of(self.group, short=short)
        if self.view.states:  # the numbers of the lanes
            self.texts = [f"{k}: {text}" for k, text in enumerate(self.texts, start=1)]
        self.places = [self._places(k) for k in range(2)]

    def _places(self, k: int) -> list[labels.Place] | None:
        """Places of the labels in a panel; None where they do not fit."""
        limits, width = self.view.drawn[k].limits, self.view.widths[k] * POINTS
        known = [(x - limits.low) / (limits.high - limits.low) * width for x, _ in self.ends[k] if np.isfinite(x)]
        texts = [text for text, (x, _) in zip(self.texts, self.ends[k], strict=True) if np.isfinite(x)]
        return labels.place(known, texts, width)

    def draw(self, sheet: Sheet, left: float, top: float, *, labelled: bool) -> None:
        """Draw both panels, their labels, the strip and the shoes."""
        view = self.view
        first = sheet.axes(left, top, view.widths[0], view.height)
        right = left + view.widths[0] + BETWEEN
        second = sheet.axes(right, top, view.widths[1], view.height, sharey=first)
        for k, ax in enumerate((first, second)):
            self._panel(ax, k)
            if labelled:
                self._label(ax, k)
        edge, beside = right + view.widths[1], second
        if view.states:
            beside = sheet.axes(edge + 0.12, top, len(self.group) * LANE, view.height, sharey=first)
            draw_strip(beside, self.group, view.depth.factor)
        first.set_ylabel(f"{DEPTH.label}, {view.depth.label}")
        second.tick_params(axis="y", labelleft=False)
        if self.name:
            first.set_title(self.name, pad=16 if view.named_pushes else 6)
        first.set_ylim(view.ylim)
        if view.top == view.bottom:
            first.set_yticks([view.top])
        else:
            ticks = MaxNLocator(8, steps=[1, 2, 2.5, 5, 10]).tick_values(view.top, view.bottom)
            first.set_yticks([tick for tick in ticks if view.ylim[1] <= tick <= view.bottom + 4 * view.point])
        self._name_shoes(beside)

    def _panel(self, ax: Axes, k: int) -> None:
        view, drawn = self.view, self.view.drawn[k]
        for place, (one, dash) in enumerate(zip(self.group, self.dashes, strict=True)):
            low, high = view.shapes(one)
            draw_curve(ax, one, dash, drawn, (low * np.nan, high * np.nan) if k else (low, high), place)
        if view.look.measured is not None:
            for kind in dict.fromkeys(one.operation for one in self.group):
                draw_measured(ax, view.look.measured, kind, drawn)
        kinds = {one.operation for one in self.group}
        for line in view.lines[k]:
            if line.operation in kinds:
                ax.plot(
                    line.value * drawn.factor, line.depth * view.depth.factor, linestyle=line.dash[0],
                    color=LOOKS[line.operation][0], linewidth=LIMIT_WIDTH,
                )  # fmt: skip
        limits = drawn.limits
        ax.set_xlim(limits.low, limits.high)
        ax.xaxis.set_major_locator(MaxNLocator(6 - 2 * k))
        ax.set_xlabel(f"{NAMES[drawn.column]}, {shown(drawn.column, view.units).label}")
        if limits.cut and not k:
            spent = spent_at(view.case, view.look.load) * drawn.factor
            # Down to the deepest row: labels stand below.
            ax.axvspan(limits.low, spent, view.foot, **SPENT)
            ax.axvline(spent, view.foot, color=QUIET, linewidth=1, zorder=1)
            ax.annotate(
                "slack-off is spent", (0, 1), (0, 2), xycoords="axes fraction", textcoords="offset points", va="bottom",
                fontsize=7.5, color=DARK,
            )  # fmt: skip
        for shoe in view.shoes:
            ax.axhline(shoe, **SHOE)

    def _label(self, ax: Axes, k: int) -> None:
        """Label the ends of the curves of a panel."""
        view, places = self.view, iter(self.places[k] or ())
        for one, text, (x, depth) in zip(self.group, self.texts, self.ends[k], strict=True):
            if np.isnan(x):
                continue
            place, (colour, marker) = next(places), LOOKS[one.operation]
            down = view.bottom + (labels.GAP + labels.LEVEL * (place.level + 0.5)) * view.point
            # Below a curve that ends above the deepest row, a solid line would look like loads.
            dash = "-" if depth >= view.bottom else (0, (1, 3))
            ax.plot([x, x], [depth, down], linestyle=dash, **LEADER)
            ax.plot([x], [down], color=colour, marker=marker, markersize=4.5, linestyle="none", clip_on=False)
            aside = labels.GAP if place.right else -labels.GAP
            ax.annotate(
                text, (x, down), (aside, 0), textcoords="offset points", va="center_baseline", fontsize=labels.SIZE,
                ha="left" if place.right else "right", parse_math=False,
            )  # fmt: skip

    def _name_shoes(self, ax: Axes) -> None:
        """Name the casing shoes to the right of axes, below one another."""
        lowest = -np.inf
        for shoe in self.view.shoes:
            at = max(shoe, lowest)
            lowest = at + SHOE_LINE * self.view.point
            ax.annotate(
                f"shoe {shoe:.0f} {self.view.depth.label}", (1.0, at), (4, 0), xycoords=ax.get_yaxis_transform(),
                textcoords="offset points", va="center", fontsize=7.5, color=DARK, annotation_clip=False,
            )  # fmt: skip


def _levels(pairs: list[_Pair]) -> int:
    """Levels that the labels of all panels need, with short names where others do not fit; 0 where these do not."""
    for short in (False, True):
        for pair in pairs:
            pair.name_curves(short=short)
        found = [places for pair in pairs for places in pair.places]
        if all(places is not None for places in found):
            return max((1 + place.level for places in found for place in places or ()), default=0)
    return 0


def _handles(view: _View, series: list[Series], unnamed: list[_Pair]) -> list[Artist]:
    """The legend; unnamed : panels whose curves have no labels at their ends."""
    curves: dict[tuple[str, str], Artist] = {}
    for pair in unnamed:
        pair.name_curves(short=False)
        for one, text, dash in zip(pair.group, pair.texts, pair.dashes, strict=True):
            colour, marker = LOOKS[one.operation]
            look: dict[str, Any] = {"color": colour, "marker": marker, "linestyle": dash, "markersize": 4.5}
            curves.setdefault((one.operation, text), Line2D([], [], label=text, **look))
    handles = list(curves.values())
    handles += state_handles(series) if view.states else []
    locked = [one.rows for one in series if (one.rows["status"] == SteadyStatus.LOCKED_UP).any()]
    if any(is_cut(rows, drawn) for rows in locked for drawn in view.drawn):
        handles.append(Line2D([], [], color=QUIET, label="beyond the axis", **{"marker": "<"} | CUT))
    banded = next((one for one in series if view.has_band(one)), None)
    if banded is not None:
        # In the colour of a curve: the greys are those of buckling.
        handles.append(Patch(color=LOOKS[banded.operation][0], label="hook loads of both shapes", **BAND))
    if any(((one.rows["status"] != "converged") & one.rows["hookload_N"].notna()).any() for one in series):
        handles.append(Line2D([], [], color=QUIET, marker="o", label="not converged: see state", **OPEN))
    dashes = {line.name: line.dash[0] for lines in view.lines for line in lines}
    handles += [
        Line2D([], [], color=QUIET, linestyle=dash, linewidth=LIMIT_WIDTH, label=name) for name, dash in dashes.items()
    ]
    if view.look.measured is not None:
        handles.append(Line2D([], [], marker="o", label=view.look.measured_label, **MEASURED_LOOK))
        if view.look.has_ranges_alone:
            handles.append(Line2D([], [], marker="o", label="measured range without a value", **RANGE_ALONE))
    return handles
