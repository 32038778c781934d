"""Pictures of a calibration: measured and fitted readings with bands, residuals, correlations; and of a prediction."""

from collections.abc import Mapping, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from fctd.arrays import Array
from fctd.calibration.predict import BANDS, coverage, predict_rows
from fctd.calibration.result import Calibration
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.plots.palette import DARK, LOOKS, MEASURED, QUIET, SHADE
from fctd.plots.style import RC, Sheet
from fctd.results.unit_systems import System, shown_unit

# Sizes [in]: of a panel, of what stands left of it, between two, below them, and of names beside the correlations.
WIDTH, HEIGHT, LEFT, APART, BELOW, NAMES = 3.1, 4.2, 0.75, 0.35, 0.55, 1.5
THICK = 8.0  # of a band [pt]
MOST_NAMED = 5  # readings far off that the heading names
FAR = 2.0  # off, over noise
LOADS = {"hookload": ("weight indicator", "N"), "torque": ("drive torque", "N*m")}
_NO_LOOKS = (DARK, "X")  # of rows without a string
_NO_KINDS = {"in_slips": "in slips", "tare": "free drive"}


def calibration_figure(found: Calibration, units: System = "si") -> Figure:
    """Readings of the fitted rows over depth with the bands of both sizes, residuals over the noise, and correlations.

    A load that was not measured has no panel; one unknown has no correlations.
    """
    table = predict_rows(found.posterior, found.forward.rows, found.forward.strings)
    table = table[table["low"].notna()]
    values = ", ".join(_in_words(row, units) for row in found.table.to_dict("records"))
    scatter = "" if found.scattered is None else "scatter from day to day, "
    bands = f"Bands of 50 and 95 %: unknowns, {scatter}noise and ranges of the source, declared error of the model."
    lines = [line for line in (values, bands, _far(found), _at_top(table)) if line]
    title = f"{found.base.name}: calibrated on {counted(len(found.fit.used), 'row')}"
    loads = [load for load in LOADS if (table["load"] == load).any()]
    several = len(found.forward.names) > 1
    with mpl.rc_context(RC):
        panels, sheet = _panels(len(loads) + 1, title, lines, table, units, more=NAMES + WIDTH if several else 0.0)
        for load, axes in zip(loads, panels, strict=False):
            _readings(axes, table[table["load"] == load], load, units)
        _residuals(panels[-1], found, units)
        if several:
            _correlations(sheet.axes(sheet.width - WIDTH - 0.15, 0.25, WIDTH, WIDTH), found)
    return sheet.figure


def prediction_figure(table: pd.DataFrame, title: str, units: System = "si") -> Figure:
    """Predicted readings over depth with bands, and the measured ones; table : of ``predict_rows``."""
    table = table[table["reason"] == "none"]
    # A string that is tripped without rotation has no torque to show.
    turned = table["operation"].map(lambda kind: kind not in KINDS or KINDS[kind].default_rpm > 0).astype(bool)
    table = table[(table["load"] == "hookload") | table["low"].notna() | turned]
    inside = coverage(table)
    lines = ["Bands of 50 and 95 %: unknowns, noise and ranges of the source, declared error of the model."]
    if inside["inside95"][1]:
        lines.append(
            ", ".join(f"{got} of {of} measured in the band of {name[-2:]} %" for name, (got, of) in inside.items())
        )
    lines += [line for line in (_at_top(table),) if line]
    loads = [load for load in LOADS if (table["load"] == load).any()]
    with mpl.rc_context(RC):
        panels, sheet = _panels(len(loads), title, lines, table, units)
        for load, axes in zip(loads, panels, strict=True):
            _readings(axes, table[table["load"] == load], load, units)
    return sheet.figure


def _panels(
    count: int, title: str, lines: Sequence[str], table: pd.DataFrame, units: System, more: float = 0.0
) -> tuple[list[Axes], Sheet]:
    """Panels side by side with one axis of depths, and the sheet; more : width to the right of them [in]."""
    sheet = Sheet(LEFT + count * (WIDTH + APART) + more, HEIGHT + BELOW, title, lines, _handles(table))
    panels: list[Axes] = []
    for k in range(count):
        shared = {"sharey": panels[0]} if panels else {}
        panels.append(sheet.axes(LEFT + k * (WIDTH + APART), 0.25, WIDTH, HEIGHT - 0.25, **shared))
        panels[k].tick_params(axis="y", labelleft=not k)
    factor, label = shown_unit("m", units)
    depths = _depths(table) * factor
    low, high = (depths.min(), depths.max()) if len(depths) else (0.0, 0.0)
    pad = 0.06 * (high - low) or 100.0
    panels[0].set_ylim(high + pad, low - pad)
    panels[0].set_ylabel(f"bit depth, {label}")
    return panels, sheet


def _depths(table: pd.DataFrame) -> Array:
    """Bit depths [m]; rows without a string stand at 0."""
    return table["bit_depth_m"].fillna(0.0).to_numpy(float)


def _at_top(table: pd.DataFrame) -> str:
    names = [name for kind, name in _NO_KINDS.items() if (table["operation"] == kind).any()]
    return f"Rows without a string ({', '.join(names)}) stand at depth 0." if names else ""


def _far(found: Calibration) -> str:
    """The readings that are farthest off, by name."""
    table = found.residuals
    table = table[table["in_noise"].abs() > FAR].sort_values("in_noise", key=abs, ascending=False, kind="stable")
    if not len(table):
        return ""
    names = [f"{row['id']} ({row['in_noise']:+.1f})" for row in table.head(MOST_NAMED).to_dict("records")]
    more = f" and {len(table) - MOST_NAMED} more" if len(table) > MOST_NAMED else ""
    return f"Off by more than {FAR:g} of the noise: {', '.join(names)}{more}.".replace("-", "−")


def _in_words(row: Mapping[Any, Any], units: System) -> str:
    """An unknown with its interval."""
    factor, label = shown_unit(row["unit"], units)
    value, low, high = (f"{row[key] * factor:.4g}".replace("-", "−") for key in ("value", "low", "high"))
    return f"{row['name']} {value} ({low} to {high}) {label}".rstrip()


def _readings(axes: Axes, table: pd.DataFrame, load: str, units: System) -> None:
    """Bands, predicted and measured readings at their depths."""
    name, unit = LOADS[load]
    factor, label = shown_unit(unit, units)
    depths = _depths(table) * shown_unit("m", units)[0]
    for depth, row in zip(depths, table.to_dict("records"), strict=True):
        low95, low50, _, high50, high95 = (row[band] * factor for band in BANDS)
        for low, high, colour, order in ((low95, high95, SHADE, 1), (low50, high50, "#bdbdbd", 2)):
            axes.plot([low, high], [depth] * 2, color=colour, linewidth=THICK, solid_capstyle="butt", zorder=order)
        if not np.isnan(row["low"]):
            low, high = row["low"] * factor, row["high"] * factor
            axes.plot([low, high], [depth] * 2, color="black", linewidth=1.2, zorder=3)
            axes.plot(
                0.5 * (low + high),
                depth,
                "o",
                markerfacecolor=MEASURED,
                markeredgecolor="black",
                markersize=6,
                zorder=3,
            )
        colour, marker = LOOKS.get(str(row["operation"]), _NO_LOOKS)
        axes.plot(row["predicted"] * factor, depth, marker, color=colour, markersize=4, zorder=4)
    axes.set_xlabel(f"{name}, {label}")


def _residuals(axes: Axes, found: Calibration, units: System) -> None:
    """Distances from the recorded ranges in standard deviations of the noise."""
    table = found.residuals
    depths = _depths(table) * shown_unit("m", units)[0]
    for depth, row in zip(depths, table.to_dict("records"), strict=True):
        colour, marker = LOOKS.get(str(row["operation"]), _NO_LOOKS)
        if not row["used"]:
            colour = QUIET
        face: Any = colour if row["load"] == "hookload" else "white"
        axes.plot(row["in_noise"], depth, marker, markerfacecolor=face, markeredgecolor=colour, markersize=4)
    axes.axvline(0, color=DARK, linewidth=0.8)
    for level in (-FAR, FAR):
        axes.axvline(level, color=QUIET, linewidth=0.8, linestyle=":")
    axes.set_xlabel("fitted − measured, over noise")
    axes.set_title("Hook load filled, torque open, not fitted grey")


def _correlations(axes: Axes, found: Calibration) -> None:
    """The matrix of correlations of the unknowns."""
    names, matrix = list(found.forward.names), found.correlations.to_numpy(float)
    axes.imshow(matrix, cmap="RdBu_r", vmin=-1, vmax=1)
    axes.set_xticks(range(len(names)), names, rotation=90, fontsize=6.5, parse_math=False)
    axes.set_yticks(range(len(names)), names, fontsize=6.5, parse_math=False)
    axes.grid(False)
    if len(names) <= 12:
        for i, j in np.ndindex(matrix.shape):
            colour = "white" if abs(matrix[i, j]) > 0.6 else DARK
            axes.text(
                j, i, f"{matrix[i, j]:z.2f}".replace("-", "−"), ha="center", va="center", fontsize=6, color=colour
            )
    axes.set_title("Correlations")


def _handles(table: pd.DataFrame) -> list[Any]:
    """The legend: bands, measured, and the operations that are there."""
    handles: list[Any] = [
        Patch(color="#bdbdbd", label="50 % band"),
        Patch(color=SHADE, label="95 % band"),
    ]
    if table["low"].notna().any():
        ranged = bool((table["high"] > table["low"]).any())
        label, line = ("measured, with range", "-") if ranged else ("measured", "none")
        look: dict[str, Any] = {"color": "black", "marker": "o", "markerfacecolor": MEASURED, "linestyle": line}
        handles.append(Line2D([], [], label=label, **look))
    for kind in dict.fromkeys(table["operation"]):
        colour, marker = LOOKS.get(str(kind), _NO_LOOKS)
        name = KINDS[kind].label if kind in KINDS else _NO_KINDS[str(kind)]
        handles.append(Line2D([], [], color=colour, marker=marker, linestyle="none", label=f"{name}, computed"))
    return handles
