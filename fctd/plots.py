"""Pictures of steady strings: the torque-and-drag chart, and the profile of a string from top to bit.

Needs matplotlib, which the package installs as its extra ``plot``; nothing else of the package imports this
module.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Annotation
from matplotlib.ticker import MaxNLocator
from matplotlib.typing import RcKeyType
from numpy.typing import NDArray

from fctd.case.operations import KINDS
from fctd.case.text import printable
from fctd.results.columns import COLUMNS, DEPTH
from fctd.results.notes import meanings_of, worst
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, reworded, shown
from fctd.results.whole_file import whole_file
from fctd.steady.equilibrium import Equilibrium
from fctd.steady.torque_drag import own_friction

RC: dict[RcKeyType, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "lines.markersize": 5,
    "savefig.dpi": 150,
    # The same numbers give the same file, byte for byte.
    "svg.hashsalt": "fctd",
}
# Okabe and Ito's palette, which colour-blind readers can distinguish; neighbours also differ in lightness.
PALETTE = {
    "blue": "#0072B2",
    "vermilion": "#D55E00",
    "black": "#000000",
    "sky": "#56B4E9",
    "green": "#009E73",
    "purple": "#CC79A7",
}
QUIET, SHADE = "#777777", "#e4e4e4"
# An operation has a colour and, for print in grey, a marker.
LOOKS = {
    "trip_out": (PALETTE["vermilion"], "^"),
    "rotate_off_bottom": (PALETTE["black"], "o"),
    "trip_in": (PALETTE["blue"], "v"),
    "back_ream": (PALETTE["purple"], "D"),
    "drill_rotating": (PALETTE["green"], "s"),
    "drill_sliding": (PALETTE["sky"], "P"),
}
# A friction factor has a dash; with more factors the dashes repeat.
DASHES: list[Any] = ["-", (0, (5, 2)), (0, (1, 1.3)), (0, (7, 2, 1.5, 2)), (0, (3, 1.5)), (0, (9, 3))]
# Loads with a status other than converged have an open marker; a row without loads has a cross.
FLAGS: dict[str, dict[str, Any]] = {
    "locked_up": {"marker": "s", "linestyle": "none", "markerfacecolor": "none", "markersize": 8},
    "unstable": {"marker": "o", "linestyle": "none", "markerfacecolor": "none", "markersize": 8},
    "under_resolved": {"marker": "d", "linestyle": "none", "markerfacecolor": "none", "markersize": 9},
}
# At the left edge of hook loads: a row that is pushed with more than the axis shows, and one that no push moves.
STUCK: dict[str, Any] = {"marker": "<", "linestyle": "none", "markersize": 8, "clip_on": False}
CUT: dict[str, Any] = STUCK | {"markerfacecolor": "white"}
# Hook loads at which slack-off is spent, and those between both shapes of a string.
SPENT: dict[str, Any] = {"facecolor": "none", "hatch": "////", "edgecolor": "#dddddd", "linewidth": 0, "zorder": 0}
BAND: dict[str, Any] = {"alpha": 0.3, "linewidth": 0.8}
BESIDE = 0.25  # the axis shows pushes up to this share of the span of the other hook loads
LOST: dict[str, Any] = {"marker": "x", "linestyle": "none", "markersize": 7, "markeredgewidth": 2, "color": QUIET}
# The panels of a profile.
TRACKS = (
    "inclination_deg",
    "effective_tension_N",
    "torque_N_m",
    "contact_force_N",
    "bending_moment_N_m",
    "von_mises_Pa",
    "offset_high_m",
    "offset_right_m",
)
LIMITS: dict[str, Any] = {"sinusoidal": (0, (4, 2)), "helical": (0, (1, 1.2))}
BUCKLED: dict[str, dict[str, Any]] = {
    "sinusoidal": {"marker": "o", "linestyle": "none", "color": "#E69F00", "markersize": 4},
    "helical": {"marker": "X", "linestyle": "none", "color": "#A00000", "markersize": 5},
}
# Rows of a chart with a buckled string have a grey disc below their line.
DISCS: dict[str, dict[str, Any]] = {
    "sinusoidal": {"marker": "o", "linestyle": "none", "color": "#dcdcdc", "markersize": 12, "zorder": 1.2},
    "helical": {"marker": "o", "linestyle": "none", "color": "#b0b0b0", "markersize": 12, "zorder": 1.3},
}
NOISE = 1e-6  # an axis that spans less shows zeros
NOTE_LINE = 0.14  # height of a line of small type [in]
MARKS = 8  # about as many markers on a line


def save(figure: Figure, path: Path) -> list[Path]:
    """Write a figure in the format of its suffix; returns the file.  Raises InputError where it cannot be written."""
    with mpl.rc_context(RC), whole_file(path) as scratch:
        figure.savefig(scratch, metadata={"Date": None} if path.suffix.lower() == ".svg" else None)
    return [path]


def chart_figure(
    chart: pd.DataFrame, units: System = "si", title: str = "", block_weight: float = 0.0, warnings: Sequence[str] = ()
) -> Figure:
    """Hook load (the broomstick) and torque against bit depth: a line per operation and friction factor.

    chart : of ``fctd.torque_drag``, SI.  A cross marks each row without loads in the gap of its line, a grey disc each
    row with a buckled string; a band spans the hook loads of both shapes of a resolved one; notes are printed below the
    title.  Where a string is locked up, hook loads below −``block_weight`` [N] are hatched, and larger pushes, with
    which the axis would show nothing else, have triangles at its edge.
    """
    if "friction_label" not in chart:  # a table of another origin
        labels = [f"{factor:g}" if np.isfinite(factor) else "" for factor in chart["friction"].astype(float)]
        chart = chart.assign(friction_label=labels)
    factors = [reworded(label, units) for label in chart["friction_label"].unique()]
    with mpl.rc_context(RC):
        figure = Figure(figsize=(8.5, 6.8), layout="constrained")
        panels = figure.subplots(1, 2, sharey=True)
        limits = _limits_of_pushes(chart, block_weight, units)
        for ax, column, edge in zip(panels, ("hookload_N", "surface_torque_N_m"), (limits[0], np.nan), strict=True):
            for k, (_, same_factor) in enumerate(chart.groupby("friction_label", sort=False)):
                for place, (kind, rows) in enumerate(same_factor.groupby("operation", sort=False)):
                    _series(ax, rows, column, str(kind), DASHES[k % len(DASHES)], units, place, edge)
            _label(ax, column, units)
        if np.isfinite(limits).all():
            panels[0].set_xlim(*limits)
            spent = -block_weight * shown("hookload_N", units).factor
            panels[0].axvspan(limits[0], spent, **SPENT)
            panels[0].axvline(spent, color=QUIET, linewidth=1, zorder=1)
        panels[0].set_ylabel(f"{DEPTH.label}, {shown(DEPTH.name, units).label}")
        panels[0].invert_yaxis()
        kinds = [_handle(kind) for kind in LOOKS if kind in set(chart["operation"])]
        figure.legend(handles=kinds, loc="outside lower left", ncols=2)
        handles: list[Line2D | Patch] = [
            Line2D([], [], color=QUIET, linestyle=DASHES[k % len(DASHES)], label=f"friction factor {factor}")
            for k, factor in enumerate(factors if len(factors) > 1 else [])
        ]
        handles += _flag_handles(chart, limits[0] / shown("hookload_N", units).factor)
        modes = set(chart["buckling"])
        handles += [Line2D([], [], **disc, label=f"{mode} buckling") for mode, disc in DISCS.items() if mode in modes]
        figure.legend(handles=handles, loc="outside lower right", ncols=2)
        words = [title] if title else []
        _title(
            figure,
            ", ".join([*words, f"friction factor {factors[0]}"] if len(factors) == 1 and factors[0] else words),
            [f"{code}: {meaning['headline']}" for code, meaning in meanings_of(chart.get("notes", ())).items()],
            warnings,
        )
        return figure


def profile_figure(points: Sequence[Equilibrium], units: System = "si", warnings: Sequence[str] = ()) -> Figure:
    """Strings from the top to the bit, side by side on one depth axis, each operation a line.

    Inclination; tension, with buckling limits and where they are exceeded; torque; side force at the contact
    points; bending moment; von Mises stress; and the offset of the string from the axis to the high side and to
    the right, within the clearance (shaded).  A string without loads is only named in the legend.
    """
    answers = [point for point in points if point.answered]
    with mpl.rc_context(RC):
        figure = Figure(figsize=(13.5, 7.2), layout="constrained")
        widths = [0.6, *([1] * (len(TRACKS) - 1))]
        panels = figure.subplots(1, len(TRACKS), sharey=True, width_ratios=widths)
        modes: set[str] = set()
        for ax, column in zip(panels, TRACKS, strict=True):
            for point in answers:
                modes |= _track(ax, point, column, units, alone=len(answers) == 1)
            _label(ax, column, units)
        if answers:
            _limits(panels[TRACKS.index("effective_tension_N")], [point.profile for point in answers], units)
        panels[0].set_ylabel(f"{COLUMNS['md_m'].label}, {shown('md_m', units).label}")
        panels[0].invert_yaxis()
        handles = [_handle(point.operation, point.status, answered=point.answered) for point in points]
        handles += [
            Line2D([], [], color=QUIET, linestyle=dash, label=f"{mode} buckling limit") for mode, dash in LIMITS.items()
        ]
        handles += [Line2D([], [], **BUCKLED[mode], label=f"beyond the {mode} limit") for mode in sorted(modes)]
        figure.legend(handles=handles, loc="outside lower left", ncols=5)
        depth = shown("bit_depth_m", units)
        friction = own_friction(points[0].case)
        suffix = "" if np.isnan(friction) else f", friction factor {friction:g}"
        _title(
            figure,
            f"{points[0].case.name}, bit at {points[0].bit_depth * depth.factor:.0f} {depth.label}{suffix}",
            [f"{note.code}: {note.text}" for note in worst(note for point in answers for note in point.notes)],
            warnings,
        )
        return figure


def _limits_of_pushes(chart: pd.DataFrame, block_weight: float, units: System) -> tuple[float, float]:
    """Limits of the axis of hook loads, which the pushes of locked strings do not set; NaN where none is locked."""
    locked = chart["status"] == SteadyStatus.LOCKED_UP
    if not locked.any():
        return np.nan, np.nan
    others = chart.loc[~locked, ["hookload_N", "hookload_low_N", "hookload_high_N"]].to_numpy(float)
    visible = np.append(others[np.isfinite(others)], -block_weight)
    if np.ptp(visible) == 0 and chart["hookload_N"].notna().any():
        visible = np.append(visible, chart["hookload_N"].max())
    factor = shown("hookload_N", units).factor
    low, high = factor * visible.min(), factor * visible.max()
    span = max(high - low, 1.0)
    return low - BESIDE * span, high + 0.05 * span


def _series(
    ax: Axes, rows: pd.DataFrame, column: str, kind: str, dash: Any, units: System, place: int, edge: float
) -> None:
    """Draw one line of a chart.

    place : separates the crosses of operations that have no loads at any depth.  edge : of the axis, where rows are
    marked that are pushed harder or that no push moves, else NaN.
    """
    colour, marker = LOOKS[kind]
    depth = rows["bit_depth_m"].to_numpy(float) * shown("bit_depth_m", units).factor
    factor = shown(column, units).factor
    value = rows[column].to_numpy(float) * factor
    locked = (rows["status"] == SteadyStatus.LOCKED_UP).to_numpy()
    stuck = np.isnan(value) & locked
    if column == "hookload_N":
        low, high = (rows[f"hookload_{end}_N"].to_numpy(float) * factor for end in ("low", "high"))
        apart = np.isfinite(low)
        if apart.any():
            ax.fill_betweenx(depth, np.where(apart, low, value), np.where(apart, high, value), color=colour, **BAND)
            ax.hlines(depth[apart], low[apart], high[apart], color=colour, linewidth=1)
    line = np.where(stuck, edge, value)
    ax.plot(line, depth, color=colour, linestyle=dash, marker=marker, markevery=_marked(value), markersize=4.5)
    for mode, disc in DISCS.items():
        at = (rows["buckling"] == mode).to_numpy()
        if at.any():
            ax.plot(value[at], depth[at], **disc)
    status = rows["status"].to_numpy(str)
    for name in np.unique(status[np.isfinite(value)]):
        if name != "converged":
            at = status == name
            ax.plot(value[at], depth[at], color=colour, **FLAGS[name])
    for look, at in ((CUT, locked & (value < edge)), (STUCK, stuck & np.isfinite(edge))):
        if at.any():
            ax.plot(np.full(at.sum(), edge), depth[at], color=colour, **look)
    lost, found = np.isnan(line) & ~stuck, np.isfinite(line)
    if found.any():
        ax.plot(
            np.interp(depth[lost], depth[found], np.fmax(line[found], edge)),
            depth[lost],
            **LOST | {"markeredgecolor": colour},
        )
    else:
        across = ax.get_yaxis_transform()
        ax.plot(np.full(len(depth), 0.15 + 0.14 * place), depth, transform=across, **LOST | {"markeredgecolor": colour})


def _marked(value: NDArray[np.float64]) -> list[int]:
    """Points of a line that carry its marker: some, and every one without a neighbour to draw a line to."""
    found = np.concatenate(([False], np.isfinite(value), [False]))
    alone = found[1:-1] & ~found[:-2] & ~found[2:]
    spread = np.arange(len(value)) % max(len(value) // MARKS, 1) == 0
    return [int(k) for k in np.flatnonzero(alone | spread)]


def _track(ax: Axes, point: Equilibrium, column: str, units: System, *, alone: bool) -> set[str]:
    """Draw one quantity of one string; returns the modes in which it is marked as buckled."""
    profile, (colour, marker) = point.profile, LOOKS[point.operation]
    factor = shown(column, units).factor
    md = profile["md_m"].to_numpy(float) * shown("md_m", units).factor
    value = profile[column].to_numpy(float) * factor
    if column == "contact_force_N" and alone:
        ax.hlines(md, 0, value, color=colour, linewidth=1)
        touching = value > 0
        ax.plot(value[touching], md[touching], color=colour, marker=marker, linestyle="none", markersize=3)
        return set()
    if COLUMNS[column].across:
        clearance = profile["clearance_m"].to_numpy(float) * factor
        ax.fill_betweenx(md, -clearance, clearance, color=SHADE, linewidth=0, zorder=0)
    ax.plot(value, md, color=colour, marker=marker, markevery=max(len(md) // MARKS, 1), markersize=4, linewidth=1.2)
    modes = set()
    if column == "effective_tension_N":
        for mode, look in BUCKLED.items():
            at = (profile["buckling"] == mode).to_numpy()
            if at.any():
                modes.add(mode)
                ax.plot(value[at], md[at], **look)
    return modes


def _limits(ax: Axes, profiles: Sequence[pd.DataFrame], units: System) -> None:
    """The buckling limits of the first string, compression to the left, as far as they come near the loads."""
    factor = shown("effective_tension_N", units).factor
    md = profiles[0]["md_m"] * shown("md_m", units).factor
    nearest = []
    for mode, dash in LIMITS.items():
        limit = -profiles[0][f"{mode}_limit_N"].replace(np.inf, np.nan) * factor
        ax.plot(limit, md, color=QUIET, linestyle=dash, linewidth=1.2)
        nearest.append(limit.max())
    tension = pd.concat([profile["effective_tension_N"] for profile in profiles]) * factor
    left, right = np.nanmin([tension.min(), *nearest]), max(tension.max(), 0.0)
    margin = 0.06 * (right - left)
    ax.set_xlim(left - margin, right + margin)


def _label(ax: Axes, column: str, units: System) -> None:
    """Write name and unit below an axis, with few ticks so that labels of neighbouring axes do not touch."""
    unit = shown(column, units).label
    label = COLUMNS[column].label
    ax.set_xlabel(f"{label},\n{unit}" if column in TRACKS else f"{label}, {unit}")
    left, right = ax.get_xlim()
    if right - left < NOISE:
        ax.set_xlim(-1, 1)
    ax.xaxis.set_major_locator(MaxNLocator(3 if column in TRACKS else 6))


def _title(figure: Figure, text: str, notes: Sequence[str], warnings: Sequence[str] = ()) -> None:
    """Write a heading, with warnings and notes in small type below it; a case's name is not parsed as a formula."""
    said = [f"warning {text}" for text in warnings] + [f"note {text}" for text in notes]
    heading = figure.suptitle(printable(text), parse_math=False, x=0.01, ha="left", fontsize=10.5, fontweight="bold")
    layout = figure.get_layout_engine()
    if said and isinstance(layout, ConstrainedLayoutEngine):
        # The layout makes room for the heading only.
        layout.set(rect=(0, 0, 1, 1 - len(said) * NOTE_LINE / figure.get_figheight()))
        lines = "\n".join(map(printable, said))
        small = Annotation(lines, (0, 0), xycoords=heading, va="top", fontsize=7.5, color=QUIET, parse_math=False)
        small.set_in_layout(False)
        figure.add_artist(small)


def _handle(kind: str, status: str = "converged", *, answered: bool = True) -> Line2D:
    """The legend's line for an operation, with its status unless it converged."""
    colour, marker = LOOKS[kind]
    if not answered:
        return Line2D([], [], **LOST, label=f"{KINDS[kind].label}: no answer ({status})")
    label = KINDS[kind].label if status == "converged" else f"{KINDS[kind].label} ({status})"
    return Line2D([], [], color=colour, marker=marker, markersize=4.5, label=label)


def _flag_handles(chart: pd.DataFrame, edge: float) -> list[Line2D | Patch]:
    """The legend's marks of rows that are not converged, or have two hook loads; edge : of the axis, or NaN [N]."""
    load, status = chart["hookload_N"], chart["status"]
    locked = status == SteadyStatus.LOCKED_UP
    found = [str(name) for name in status[load.notna()].unique() if name in FLAGS]
    handles: list[Line2D | Patch] = [Line2D([], [], color=QUIET, label=name, **FLAGS[name]) for name in found]
    if locked.any():
        handles.append(Patch(**SPENT, label="slack-off is spent"))
    if (locked & (load < edge)).any():
        handles.append(Line2D([], [], color=QUIET, label="pushed harder than shown", **CUT))
    if (locked & load.isna()).any():
        handles.append(Line2D([], [], color=QUIET, label="locked up: no push suffices", **STUCK))
    if chart["hookload_low_N"].notna().any():
        handles.append(Patch(color=QUIET, label="hook loads of both shapes", **BAND))
    none = [str(name) for name in status[load.isna() & ~locked].unique()]
    return handles + ([Line2D([], [], **LOST, label=f"no answer: {', '.join(none)}")] if none else [])
