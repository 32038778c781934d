"""Pictures of a sweep: bands of loads over depth, the influence of parameters, and a map over two of them."""

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.plots import loads
from fctd.plots.keys import in_words, labelled
from fctd.plots.palette import DARK, LOOKS, PALETTE, QUIET
from fctd.plots.style import RC, Sheet
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import Shown, System, shown, shown_if_any
from fctd.sweep.indices import WITH_UNIT
from fctd.sweep.probabilities import DOUBTED
from fctd.sweep.uncertainty import Uncertainty, first_operation

WIDTH, PANEL = 9.0, 5.0  # of the sheet, and height of a panel of bands [in]
BAR, NAMES, LEFT, APART = 0.26, 2.4, 0.9, 0.8  # height of a bar, width of parameters' names, margins [in]
# The measure that a tornado shows, the first that there is.
MEASURES = {
    "ST": "total Sobol index", "mu_star": "mean absolute effect (Morris)", "SRC": "standardised coefficient (SRC)",
}  # fmt: skip


def label_of(column: str, units: System) -> tuple[str, Shown]:
    """Name with unit, and unit, of a column of the results."""
    unit = shown_if_any(column, units)
    name = loads.NAMES.get(column) or (COLUMNS[column].label if column in COLUMNS else _words(column, unit))
    return f"{name}, {unit.label}" if unit.label else name, unit


def _words(column: str, unit: Shown) -> str:
    """A column without its unit, in words."""
    ends = ("_N_m", "_Pa", "_N", "_m") if unit.label else ()
    return (
        next((column.removesuffix(end) for end in ends if column.endswith(end)), column)
        .replace("_", " ")
        .replace("stick slip", "stick-slip")
    )


def bands_figure(found: Uncertainty, units: System = "si") -> Figure:
    """The broomstick with bands: for every operation the outer percentiles and the middle one over depth."""
    table = found.percentiles
    if "bit_depth_m" not in table or table["bit_depth_m"].nunique() < 2:
        expected = "a sweep of charts of several depths, over which bands are drawn"
        raise InputError(expected, key="--plot-bands", value=f"a sweep of kind {found.spec.work.kind}")
    low, high = table["percentile"].min(), table["percentile"].max()
    middle = sorted(table["percentile"].unique(), key=lambda p: abs(p - 50))[0]
    operations = list(dict.fromkeys(table["operation"]))
    handles: list[Any] = [
        Line2D([], [], color=LOOKS[kind][0], marker=LOOKS[kind][1], label=KINDS[kind].label) for kind in operations
    ]
    handles.append(Patch(color=QUIET, alpha=0.3, label=f"{low:g} to {high:g} %"))
    bars = pd.concat([table[table["percentile"] == low]["low"], table[table["percentile"] == high]["high"]])
    if bars.notna().any():  # they are open where they end beyond the samples
        handles.append(Line2D([], [], color=QUIET, linestyle=":", label="its error bars of 95 %"))
    samples, method = counted(int(table["samples"].max()), "sample"), found.spec.method.replace("_", " ")
    samples += f", {method}; line: {middle:g} %"
    status = found.rows["status"]
    for name in DOUBTED:
        if count := int((status == name).sum()):
            samples += f"; {count} of {len(status)} rows {name.replace('_', ' ')}"
    drawn = [name for name in found.columns[:2] if any((kind, name) not in found.noise for kind in operations)]
    columns = drawn or found.columns[:1]
    with mpl.rc_context(RC):
        sheet = Sheet(WIDTH, PANEL + 0.7, found.spec.name, [samples], handles)
        width = (WIDTH - LEFT - 0.2 - APART * (len(columns) - 1)) / len(columns)
        for k, column in enumerate(columns):
            axes = sheet.axes(LEFT + k * (width + APART), 0.45, width, PANEL - 0.2)
            _bands(axes, table[table["column"] == column], column, units, (low, middle, high))
    return sheet.figure


def _bands(axes: Axes, table: pd.DataFrame, column: str, units: System, of: tuple[float, float, float]) -> None:
    text, unit = label_of(column, units)
    metre = shown("bit_depth_m", units)
    for kind, group in table.groupby("operation", sort=False):
        colour, marker = LOOKS[str(kind)]
        by = {p: group[group["percentile"] == p].sort_values("bit_depth_m") for p in of}
        depth = by[of[0]]["bit_depth_m"].to_numpy(float) * metre.factor
        low, high = (by[p]["value"].to_numpy(float) * unit.factor for p in (of[0], of[2]))
        axes.fill_betweenx(depth, low, high, color=colour, alpha=0.25, linewidth=0)
        for p, end in ((of[0], "low"), (of[2], "high")):
            axes.plot(by[p][end] * unit.factor, depth, ":", color=colour, linewidth=0.8)
        every = max(len(depth) // 8, 1)
        axes.plot(by[of[1]]["value"] * unit.factor, depth, color=colour, marker=marker, markevery=every, markersize=4)
    axes.invert_yaxis()
    axes.xaxis.set_label_position("top")
    axes.xaxis.tick_top()
    axes.set_xlabel(text)
    axes.set_ylabel(f"bit depth, {metre.label}")


def tornado_figure(found: Uncertainty, operation: str | None = None, units: System = "si") -> Figure:
    """The influence of every parameter on the loads of one operation, the largest above, with error bars."""
    kind = first_operation(found.rows, operation)
    table = found.indices[found.indices["operation"] == kind]
    measure = next((name for name in MEASURES if name in set(table["measure"])), None)
    if measure is None:
        expected = f"a sweep whose samples have indices ({found.trouble or 'this operation has none'})"
        raise InputError(expected, key="--plot-tornado", value=operation or found.spec.name)
    table = table[table["measure"] == measure]
    columns = list(dict.fromkeys(table["column"]))
    bars = table["parameter"].nunique()
    height = BAR * bars + 0.2
    with mpl.rc_context(RC):
        line = f"{_place(found, kind, units)}; error bars of 95 %"
        sheet = Sheet(WIDTH, len(columns) * (height + 0.75), found.spec.name, [line], [])
        for k, column in enumerate(columns):
            axes = sheet.axes(NAMES, 0.3 + k * (height + 0.75), WIDTH - NAMES - 0.3, height)
            part = table[table["column"] == column]
            name, unit = label_of(column, units)
            factor, ending = (unit.factor, f", {unit.label}") if measure in WITH_UNIT and unit.label else (1.0, "")
            part = part.iloc[np.argsort(part["value"].abs().to_numpy(), kind="stable")]
            places = np.arange(len(part))
            values, errors = part["value"] * factor, part["error"] * factor
            axes.barh(places, values, color=PALETTE["blue"], height=0.7)
            axes.errorbar(values, places, xerr=errors, fmt="none", ecolor=DARK, elinewidth=1, capsize=2)
            axes.set_yticks(places, [in_words(key) for key in part["parameter"]], parse_math=False)
            axes.axvline(0, color=DARK, linewidth=0.8)
            axes.grid(axis="y", visible=False)
            axes.set_title(f"{name.split(',')[0]}: {MEASURES[measure]}{ending}")
    return sheet.figure


def _place(found: Uncertainty, kind: str, units: System) -> str:
    """Operation and bit depth of a picture, in words."""
    metre = shown("bit_depth_m", units)
    at = "" if np.isnan(found.bit_depth) else f", bit at {found.bit_depth * metre.factor:.5g} {metre.label}"
    return f"{KINDS[kind].label if kind in KINDS else kind}{at}"


def map_figure(
    found: Uncertainty, keys: Sequence[str], column: str, operation: str | None = None, units: System = "si"
) -> Figure:
    """A result over two parameters, at the depth of the indices: cells of a grid, or the samples as points."""
    rows = found.rows
    if not np.isnan(found.bit_depth):
        rows = rows[rows["bit_depth_m"] == found.bit_depth]
    kind = first_operation(found.rows, operation)
    rows = rows[rows["operation"] == kind]
    if rows.empty:
        raise InputError("an operation of the sweep", key="--operation", value=kind)
    for key in keys:
        numbers = [p.key for p in found.spec.parameters if rows[p.key].dtype.kind in "if"]
        if key not in numbers or keys[0] == keys[1]:
            raise InputError(f"two parameters with numbers, of {', '.join(numbers)}", key="--map", value=",".join(keys))
    text, unit = label_of(column, units)
    x, y = (rows[key].to_numpy(float) for key in keys)
    values = rows[column].to_numpy(float) * unit.factor
    with mpl.rc_context(RC):
        grid = pd.DataFrame({"x": x, "y": y, "v": values}).pivot_table(index="y", columns="x", values="v", dropna=False)
        whole = grid.size == len(values)
        line = f"{_place(found, kind, units)}{'; grey: no answer' if whole else ''}"
        sheet = Sheet(7.0, 4.6, found.spec.name, [line], [])
        axes = sheet.axes(LEFT, 0.1, 4.6, 3.9)
        axes.grid(visible=False)
        if whole:
            axes.set_facecolor(QUIET)
            drawn: Any = axes.pcolormesh(grid.columns, grid.index, grid.to_numpy(), shading="nearest", cmap="viridis")
        else:
            drawn = axes.scatter(x, y, c=values, cmap="viridis", s=14, linewidths=0)
        bar = sheet.figure.colorbar(drawn, cax=sheet.axes(LEFT + 4.75, 0.1, 0.2, 3.9))
        bar.set_label(text)
        units_of = {parameter.key: parameter.unit for parameter in found.spec.parameters}
        axes.set_xlabel(labelled(keys[0], units_of[keys[0]]), parse_math=False)
        axes.set_ylabel(labelled(keys[1], units_of[keys[1]]), parse_math=False)
    return sheet.figure
