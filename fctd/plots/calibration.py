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

from fctd.calibration.predict import BANDS, coverage, predict_rows
from fctd.calibration.result import Calibration
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.plots.palette import DARK, LOOKS, MEASURED, QUIET, SHADE
from fctd.plots.style import RC, Sheet
from fctd.results.unit_systems import System, shown_unit

WIDTH, PANEL, LABELS = 10.0, 2.4, 1.15  # of the sheet, and height of a panel and of the names below it [in]
LEFT, APART = 0.75, 0.9
LOADS = {"hookload": ("weight indicator", "N"), "torque": ("drive torque", "N*m")}
_NO_LOOKS = (DARK, "X")  # of rows without a string
_NO_KINDS = {"in_slips": "in slips", "tare": "free drive"}
_MOST_NAMES = 40  # rows that are named below a panel


def calibration_figure(found: Calibration, units: System = "si") -> Figure:
    """Readings of the fitted rows with the bands of both sizes, residuals over the noise, and correlations."""
    table = predict_rows(found.posterior, found.forward.rows, found.forward.strings)
    values = ", ".join(_in_words(row, units) for row in found.table.to_dict("records"))
    scatter = "" if found.scattered is None else "scatter from day to day, "
    bands = f"Bands of 50 and 95 %: unknowns, {scatter}noise and ranges of the source, declared error of the model."
    lines = [values, bands]
    title = f"{found.base.name}: calibrated on {counted(len(found.fit.used), 'row')}"
    with mpl.rc_context(RC):
        sheet = Sheet(WIDTH, 2 * (PANEL + LABELS) + 0.3, title, lines, _handles(table))
        half = (WIDTH - 2 * LEFT - APART) / 2
        for k, load in enumerate(LOADS):
            axes = sheet.axes(LEFT + k * (half + APART), 0.25, half, PANEL)
            _readings(axes, table[table["load"] == load], load, units)
        _residuals(sheet.axes(LEFT, 0.55 + PANEL + LABELS, half, PANEL), found)
        side = min(half - 1.2, PANEL)
        _correlations(sheet.axes(LEFT + half + APART + 1.1, 0.55 + PANEL + LABELS, side, side), found)
    return sheet.figure


def prediction_figure(table: pd.DataFrame, title: str, units: System = "si") -> Figure:
    """Predicted readings with bands, and the measured ones; table : of ``predict_rows``."""
    table = table[table["reason"] == "none"]
    inside = coverage(table)
    lines = ["Bands of 50 and 95 %: unknowns, noise and ranges of the source, declared error of the model."]
    if inside["inside95"][1]:
        lines.append(
            ", ".join(f"{got} of {of} measured in the band of {name[-2:]} %" for name, (got, of) in inside.items())
        )
    with mpl.rc_context(RC):
        sheet = Sheet(WIDTH, PANEL + LABELS + 0.3, title, lines, _handles(table))
        half = (WIDTH - 2 * LEFT - APART) / 2
        for k, load in enumerate(LOADS):
            axes = sheet.axes(LEFT + k * (half + APART), 0.25, half, PANEL)
            _readings(axes, table[table["load"] == load], load, units)
    return sheet.figure


def _in_words(row: Mapping[Any, Any], units: System) -> str:
    """An unknown with its interval."""
    factor, label = shown_unit(row["unit"], units)
    value, low, high = (f"{row[key] * factor:.4g}".replace("-", "−") for key in ("value", "low", "high"))
    return f"{row['name']} {value} ({low} to {high}) {label}".rstrip()


def _readings(axes: Axes, table: pd.DataFrame, load: str, units: System) -> None:
    """Bands, predicted and measured readings, a column for each row."""
    name, unit = LOADS[load]
    factor, label = shown_unit(unit, units)
    rows = table.to_dict("records")
    for x, row in enumerate(rows):
        low95, low50, _, high50, high95 = (row[band] * factor for band in BANDS)
        axes.bar(x, high95 - low95, 0.7, low95, color=SHADE, zorder=1)
        axes.bar(x, high50 - low50, 0.7, low50, color="#bdbdbd", zorder=2)
        colour, marker = LOOKS.get(str(row["operation"]), _NO_LOOKS)
        axes.plot(x, row["predicted"] * factor, marker, color=colour, markersize=4, zorder=4)
        if not np.isnan(row["low"]):
            low, high = row["low"] * factor, row["high"] * factor
            axes.plot([x, x], [low, high], color="black", linewidth=1.2, zorder=3)
            middle = 0.5 * (low + high)
            axes.plot(x, middle, "o", markerfacecolor=MEASURED, markeredgecolor="black", markersize=6, zorder=3)
    axes.set_ylabel(f"{name}, {label}")
    axes.use_sticky_edges = False  # of the bars, which would end the axis at the lowest band
    axes.margins(y=0.08)
    _name_rows(axes, [str(row["id"]) for row in rows])


def _residuals(axes: Axes, found: Calibration) -> None:
    """Distances from the recorded ranges in standard deviations of the noise."""
    table = found.residuals
    names = list(dict.fromkeys(table["id"]))
    for load, shift in (("hookload", -0.15), ("torque", 0.15)):
        for row in table[table["load"] == load].to_dict("records"):
            colour, marker = LOOKS.get(str(row["operation"]), _NO_LOOKS)
            face: Any = colour if load == "hookload" else "white"
            if not row["used"]:
                colour, face = QUIET, QUIET if load == "hookload" else "white"
            x = names.index(str(row["id"])) + shift
            axes.plot([x, x], [0, row["in_noise"]], color=colour, linewidth=0.8)
            axes.plot(x, row["in_noise"], marker, markerfacecolor=face, markeredgecolor=colour, markersize=4)
    axes.axhline(0, color=DARK, linewidth=0.8)
    for level in (-2, 2):
        axes.axhline(level, color=QUIET, linewidth=0.8, linestyle=":")
    axes.set_ylabel("fitted − measured, over noise")
    axes.set_title("Residuals: hook load filled, torque open, not fitted grey")
    _name_rows(axes, names)


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


def _name_rows(axes: Axes, names: Sequence[str]) -> None:
    step = -(-len(names) // _MOST_NAMES)
    axes.set_xticks(range(0, len(names), step), names[::step], rotation=90, fontsize=6.5, parse_math=False)
    axes.set_xlim(-0.7, len(names) - 0.3)
    axes.grid(axis="x", visible=False)


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
