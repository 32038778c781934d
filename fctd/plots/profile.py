"""Profiles of strings from the top to the bit, side by side on one depth axis."""

from collections.abc import Sequence
from typing import Any, Final

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from fctd.case.operations import KINDS
from fctd.plots.facts import heading_of_profile
from fctd.plots.labels import SIZE, width_of
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, QUIET, SHADE
from fctd.plots.style import LOST, POINTS, RC, SMALL, Sheet
from fctd.plots.tracks import (
    TRACKS,
    SideForce,
    Track,
    depth_ends,
    label_of,
    lengths_of,
    limits_near,
    limits_of_track,
    peaks_of,
    stretches,
    values_of,
)
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import System, shown
from fctd.steady.steady_string import Equilibrium

LIMITS: Final[dict[str, Any]] = dict(zip(BUCKLED, ((0, (4, 2)), (0, (1, 1.2))), strict=True))
LEFT, BETWEEN, RIGHT, HEIGHT, BELOW = 0.72, 0.24, 0.15, 5.6, 0.72
NARROW, WIDE = 0.85, 1.34  # of the first panel and the others [in]
ROOM = 0.5 * BETWEEN - 0.01  # of labels beside their panel [in]
TICK_SIZE = 9.0  # of the labels of ticks [pt]
MARKS = 8  # about as many markers on a line
# Where the axis cuts a value.
PEAK: dict[str, Any] = {"marker": ">", "linestyle": "none", "markersize": 7, "clip_on": False, "zorder": 4}
SHOE: dict[str, Any] = {"color": QUIET, "linewidth": 0.9, "linestyle": (0, (1, 2)), "zorder": 1.1}


def profile_figure(
    points: Sequence[Equilibrium],
    units: System = "si",
    *,
    force: SideForce = "length",
    warnings: Sequence[str] = (),
    sets: int = 1,
) -> Figure:
    """Strings from the top to the bit, each operation a line.

    Inclination; tension, with the buckling limits that come near it; torque; side force per length of string, or per
    joint; bending moment; von Mises stress; and the offset of the string from the axis, within the clearance (shaded).
    Where one string is drawn, grey shows over all depths where it is buckled, else its line of tension does.  A string
    without loads is only named in the legend.  warnings : lines below the title, before the notes.  sets : of friction
    factors that were asked for, of which the strings have the first.
    """
    answers = [point for point in points if point.answered]
    case = points[0].case
    with mpl.rc_context(RC):
        depth = shown("bit_depth_m", units)
        title, lines = heading_of_profile(points, units, warnings, sets)
        near = limits_near(answers, units) if answers else {}
        modes = [mode for mode in BUCKLED if any((point.profile["buckling"] == mode).any() for point in answers)]
        shoes = [shoe * depth.factor for shoe in case.shoes if shoe < points[0].bit_depth]
        width = LEFT + NARROW + (len(TRACKS) - 1) * (WIDE + BETWEEN) + RIGHT
        handles = _handles(points, near, modes, shoes)
        sheet = Sheet(width, HEIGHT + BELOW + 0.05, title, lines, handles)
        panels: list[Axes] = []
        left = LEFT
        for column in TRACKS:
            wide = NARROW if column == TRACKS[0] else WIDE
            panels.append(sheet.axes(left, 0.05, wide, HEIGHT, **({"sharey": panels[0]} if panels else {})))
            left += wide + BETWEEN
        for ax, column in zip(panels, TRACKS, strict=True):
            for point in answers:
                _track(ax, point, column, units, force, alone=len(answers) == 1)
            for shoe in shoes:
                ax.axhline(shoe, **SHOE)
            ax.set_xlabel(",\n".join(label_of(column, units, force)), fontsize=8.5)
            if answers:
                ends = limits_of_track(answers, column, units, force, near)
                ax.set_xlim(ends)
                _peaks(ax, peaks_of(answers, column, units, force, ends), ends[1])
            _ticks(ax, NARROW if column == TRACKS[0] else WIDE)
            ax.tick_params(axis="y", labelleft=ax is panels[0])
        tension = panels[TRACKS.index("effective_tension_N")]
        for mode, (md, limit) in near.items():
            tension.plot(limit, md, color=QUIET, linestyle=LIMITS[mode], linewidth=1.2)
        panels[0].set_ylabel(f"{COLUMNS['md_m'].label}, {shown('md_m', units).label}")
        panels[0].set_ylim(depth_ends(points, units))
        return sheet.figure


def _track(ax: Axes, point: Equilibrium, column: str, units: System, force: SideForce, *, alone: bool) -> None:
    """Draw one quantity of one string."""
    profile, (colour, marker) = point.profile, LOOKS[point.operation]
    md, value = values_of(point, column, units, force)
    if alone:
        for first, last, mode in stretches(profile):
            ax.axhspan(md[first], md[last], facecolor=(BUCKLED[mode], 0.75), edgecolor=EDGE, linewidth=0.6, zorder=0.3)
    if column == "contact_force_N":
        edges = np.append(md[0], md[0] + np.cumsum(lengths_of(md)))
        bars: dict[str, Any] = {"fill": True, "baseline": 0} if alone else {"baseline": None}
        ax.stairs(value, edges, orientation="horizontal", color=colour, linewidth=1.1, **bars)
        if not alone:
            marks = slice(None, None, max(len(md) // MARKS, 1))
            ax.plot(value[marks], md[marks], color=colour, marker=marker, linestyle="none", markersize=4)
        return
    if COLUMNS[column].across:
        clearance = profile["clearance_m"].to_numpy(float) * shown(column, units).factor
        ax.fill_betweenx(md, -clearance, clearance, color=SHADE, linewidth=0, zorder=0.2)
        for side in (-clearance, clearance):  # the wall, seen also where the string is buckled
            ax.plot(side, md, color=EDGE, linewidth=0.6, zorder=0.4)
    if column == "effective_tension_N" and not alone:
        for mode, grey in BUCKLED.items():
            at = (profile["buckling"] == mode).to_numpy()
            if at.any():
                for thick, tone, order in ((8.0, EDGE, 1.2), (6.8, grey, 1.3), (3.2, "white", 1.35)):
                    band: dict[str, Any] = {"linewidth": thick, "color": tone, "zorder": order}
                    ax.plot(np.where(at, value, np.nan), md, solid_capstyle="round", **band)
    ax.plot(value, md, color=colour, marker=marker, markevery=max(len(md) // MARKS, 1), markersize=4, linewidth=1.2)


def _peaks(ax: Axes, peaks: Sequence[tuple[Equilibrium, float, float]], edge: float) -> None:
    """Mark the peaks that the axis cuts, and name the largest."""
    for point, md, _ in peaks:
        ax.plot(edge, md, color=LOOKS[point.operation][0], **PEAK)
    if peaks:
        _, md, value = max(peaks, key=lambda peak: peak[2])
        ax.annotate(
            f"{value:.3g}", (edge, md), (-7, 0), textcoords="offset points", ha="right", va="center", fontsize=SMALL,
            bbox={"facecolor": "white", "linewidth": 0, "pad": 0.5, "alpha": 0.8},
        )  # fmt: skip


def _ticks(ax: Axes, width: float) -> None:
    """Few ticks, and none whose label would reach those of the next panel; width : of the axes [in]."""
    low, high = ax.get_xlim()
    ticks = [float(tick) for tick in MaxNLocator(3).tick_values(low, high) if low <= tick <= high]
    kept = []
    for tick, text in zip(ticks, ax.xaxis.get_major_formatter().format_ticks(ticks), strict=True):
        place, half = (tick - low) / (high - low) * width, 0.5 * width_of(text) * TICK_SIZE / SIZE / POINTS
        if half - ROOM <= place <= width + ROOM - half:
            kept.append(tick)
    ax.set_xticks(kept)


def _handles(
    points: Sequence[Equilibrium], near: dict[str, Track], modes: list[str], shoes: list[float]
) -> list[Artist]:
    handles: list[Artist] = []
    for point in points:
        name, (colour, marker) = KINDS[point.operation].label, LOOKS[point.operation]
        if not point.answered:
            handles.append(Line2D([], [], **LOST, label=f"{name}: no loads ({_words(point.status)})"))
        else:
            label = name if point.status == "converged" else f"{name} ({_words(point.status)})"
            handles.append(Line2D([], [], color=colour, marker=marker, markersize=4.5, label=label))
    return [
        *handles,
        *(Patch(facecolor=BUCKLED[mode], edgecolor=EDGE, label=f"{mode} buckling") for mode in modes),
        *(Line2D([], [], color=QUIET, linestyle=LIMITS[mode], label=f"{mode} limit") for mode in near),
        Patch(facecolor=SHADE, label="clearance"),
        *([Line2D([], [], **SHOE, label="casing shoe")] if shoes else []),
    ]


def _words(status: str) -> str:
    return status.replace("_", " ")
