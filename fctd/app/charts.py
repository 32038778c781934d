"""The chart of the page, hook load and torque over bit depth: traces that stay, and data that follow the sliders."""

import base64
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.plots.limit_lines import LimitLine, limit_lines
from fctd.plots.loads import LOAD_COLUMNS, NAMES, TORQUE, measured_columns, push_of
from fctd.plots.page import SYMBOLS, plain
from fctd.plots.palette import BUCKLED, EDGE, LOOKS, MEASURED, QUIET
from fctd.results.columns import DEPTH
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, reworded, shown

# A part of a figure that changes: the way to it, and its new value.
Change = tuple[list[str | int], Any]
COLUMNS: Final = (LOAD_COLUMNS["string"], TORQUE)
FONT: Final = 'system-ui, "Segoe UI", "Noto Sans", "Liberation Sans", sans-serif'
LONGEST_REASON: Final = 160  # characters under the pointer
ROWS: Final = ("line", "measured", "limit")  # traces of each operation in each panel, after those of all operations
LOST: Final = "no loads"
ALL: Final = ("buckled", LOST)


def packed(values: ArrayLike) -> dict[str, str]:
    """Numbers as plotly reads them fastest: base64 of float32; what is not finite is a gap."""
    array: NDArray[np.float32] = np.ascontiguousarray(values, "<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(array.tobytes()).decode("ascii")}


def place_of(name: str, column: str, kind: str = "") -> int:
    """The index of a trace."""
    panel = COLUMNS.index(column)
    if name in ALL:
        return panel * len(ALL) + ALL.index(name)
    return len(COLUMNS) * len(ALL) + (list(KINDS).index(kind) * len(COLUMNS) + panel) * len(ROWS) + ROWS.index(name)


def skeleton(case: Case, depths: Sequence[float], units: System) -> dict[str, Any]:
    """The figure without data: traces of all kinds of operations; depths [m] : the ends of the axis."""
    data: list[dict[str, Any]] = []
    empty = {"type": "scatter", "x": [], "y": [], "showlegend": False}
    for panel in range(len(COLUMNS)):
        at = {"xaxis": f"x{panel + 1 if panel else ''}", "yaxis": "y"}
        look = {"size": 13, "color": [], "line": {"color": EDGE, "width": 1}}
        data.append({**empty, **at, "name": "buckled", "mode": "markers", "hoverinfo": "skip", "marker": look})
        look = {"symbol": "x-thin", "size": 9, "line": {"width": 2, "color": []}}
        data.append({
            **empty, **at, "name": LOST, "mode": "markers", "marker": look, "text": [],
            "hovertemplate": "%{y:.1f}: %{text}<extra></extra>",
        })  # fmt: skip
    for kind, of in KINDS.items():
        colour, marker = LOOKS[kind]
        for panel, column in enumerate(COLUMNS):
            at = {"xaxis": f"x{panel + 1 if panel else ''}", "yaxis": "y", "legendgroup": kind, "name": of.label}
            unit = shown(column, units).label
            data.append({
                **empty, **at, "mode": "lines+markers", "line": {"color": colour, "width": 2}, "text": [],
                "marker": {"symbol": SYMBOLS[marker], "size": 7, "color": colour, "maxdisplayed": 12},
                "hovertemplate": f"%{{y:.1f}}: %{{x:.4g}} {unit}%{{text}}<extra>{of.label}</extra>",
            })  # fmt: skip
            look = {"symbol": SYMBOLS[marker], "size": 10, "color": MEASURED, "line": {"color": "black", "width": 1.5}}
            data.append({
                **empty, **at, "mode": "markers", "marker": look, "name": f"measured, {of.label}",
                "error_x": {"array": [], "arrayminus": [], "color": "black", "symmetric": False},
                "hovertemplate": f"%{{y:.1f}}: %{{x:.4g}} {unit}<extra>measured, {of.label}</extra>",
            })  # fmt: skip
            data.append({
                **empty, **at, "mode": "lines", "line": {"color": colour, "width": 1.3, "dash": "dash"}, "text": [],
                "hovertemplate": f"%{{y:.1f}}: %{{x:.4g}} {unit}<extra>%{{text}}, {of.label}</extra>",
            })  # fmt: skip
    return {"data": data, "layout": _layout(case, depths, units)}


def changes_of(
    rows: Sequence[dict[str, Any]], kinds: Sequence[str], case: Case, units: System, measured: pd.DataFrame | None,
    margins: pd.DataFrame | None = None,
) -> list[Change]:  # fmt: skip
    """New data for the rows of a chart; kinds : of the operations that are shown; margins : of ``margin_table``."""
    # A data frame of the rows would take longer than the rest of the chart.
    depth = np.array([row["bit_depth_m"] for row in rows]) * shown(DEPTH.name, units).factor
    keys = "status", "operation", "buckling"
    status, operation, modes = (np.array([str(row[key]) for row in rows]) for key in keys)
    colours = np.array([LOOKS[kind][0] for kind in operation])
    texts = np.array([_text(str(row["status"]), row["buckling"], row["reason"], units) for row in rows])
    found: list[Change] = []
    for panel, column in enumerate(COLUMNS):
        value = np.array([row[column] for row in rows], float) * shown(column, units).factor
        lines = limit_lines(margins, case, "string", column)
        factor = shown(column, units).factor
        shown_values = np.concatenate(
            [value[status != SteadyStatus.LOCKED_UP], *(line.value * factor for line in lines)]
        )
        low, high = _limits(column, shown_values, case, units, measured)
        at = np.isin(modes, list(BUCKLED)) & np.isfinite(value)
        k = place_of("buckled", column)
        found += _points(k, value[at], depth[at])
        found.append((["data", k, "marker", "color"], [BUCKLED[mode] for mode in modes[at]]))
        lost, k = np.isnan(value), place_of(LOST, column)
        edge = low + 0.02 * (high - low)
        found += _points(k, np.full(lost.sum(), edge), depth[lost])
        found.append((["data", k, "text"], texts[lost].tolist()))
        found.append((["data", k, "marker", "line", "color"], colours[lost].tolist()))
        for kind in KINDS:
            k, here = place_of("line", column, kind), operation == kind
            found += _points(k, value[here], depth[here])
            found.append((["data", k, "text"], texts[here].tolist()))
            found.append((["data", k, "showlegend"], panel == 0 and kind in kinds))
            found += _measured(place_of("measured", column, kind), measured, kind, kind in kinds, column, units)
            found += _limit_lines(
                place_of("limit", column, kind), [of for of in lines if of.operation == kind], column, units
            )
        found.append((["layout", f"xaxis{panel + 1 if panel else ''}", "range"], [low, high]))
    return found


def _limit_lines(k: int, lines: Sequence[LimitLine], column: str, units: System) -> list[Change]:
    """The limits of an operation in one trace, with gaps between them."""
    gap = np.array([np.nan])
    value = np.concatenate([part for line in lines for part in (line.value, gap)] or [gap])
    depth = np.concatenate([part for line in lines for part in (line.depth, gap)] or [gap])
    texts = [text for line in lines for text in [line.name] * (len(line.value) + 1)]
    factors = shown(column, units).factor, shown(DEPTH.name, units).factor
    return [*_points(k, value * factors[0], depth * factors[1]), (["data", k, "text"], texts)]


def _limits(
    column: str, value: NDArray[np.float64], case: Case, units: System, measured: pd.DataFrame | None
) -> tuple[float, float]:
    """Ends of an axis of loads [shown]; value : of rows that are not locked up, whose pushes do not set it."""
    factor = shown(column, units).factor
    parts = [value]
    if measured is not None:
        parts += [measured[name].to_numpy(float) * factor for name in measured_columns(column)]
    # Without rotation torque is noise; loads that are all the same are a line in the middle.
    parts.append(np.array([0.0, 1e3 * factor] if column == TORQUE else [-push_of(case) * factor] * (not len(value))))
    found = np.concatenate(parts)
    found = found[np.isfinite(found)]
    low, high = (float(found.min()), float(found.max())) if len(found) else (0.0, 1.0)
    lacking = max(0.01 * max(abs(low), abs(high)) - (high - low), 0.0) / 2 or (0.5 if high == low else 0.0)
    air = 0.05 * (high - low + 2 * lacking)
    return low - lacking - air, high + lacking + air


def _points(k: int, x: NDArray[np.float64], y: NDArray[np.float64]) -> list[Change]:
    return [(["data", k, "x"], packed(x)), (["data", k, "y"], packed(y))]


def _measured(
    k: int, measured: pd.DataFrame | None, kind: str, wanted: bool, column: str, units: System
) -> list[Change]:
    if measured is None or not wanted:
        return _points(k, np.empty(0), np.empty(0))
    rows, factor = measured[measured["operation"] == kind], shown(column, units).factor
    value, low, high = (rows[name].to_numpy(float) * factor for name in measured_columns(column))
    middle = np.where(np.isnan(value), 0.5 * (low + high), value)
    depth = rows["bit_depth_m"].to_numpy(float) * shown(DEPTH.name, units).factor
    return [
        *_points(k, middle, depth),
        (["data", k, "error_x", "array"], np.nan_to_num(high - middle).tolist()),
        (["data", k, "error_x", "arrayminus"], np.nan_to_num(middle - low).tolist()),
    ]


def _text(status: str, mode: str, reason: str, units: System) -> str:
    """What the pointer says of a row beside its numbers."""
    if status == SteadyStatus.CONVERGED and mode == "none":
        return ""
    words = f"<br>{status.replace('_', ' ')}" + ("" if mode in ("none", "unknown") else f", buckling {mode}")
    if reason == "none":
        return words
    told = reworded(reason, units)
    cut = told if len(told) <= LONGEST_REASON else f"{told[: LONGEST_REASON - 1]}…"
    lines = [cut[k : k + 60] for k in range(0, len(cut), 60)]
    return words + "".join(f"<br>{plain(line)}" for line in lines)


def _layout(case: Case, depths: Sequence[float], units: System) -> dict[str, Any]:
    factor, unit = shown(DEPTH.name, units)
    low, high = depths[0] * factor, depths[-1] * factor
    air = 0.02 * (high - low)
    shoes = [shoe * factor for shoe in case.shoes if depths[0] <= shoe <= depths[-1]]
    axes = {}
    for k, (column, domain) in enumerate(zip(COLUMNS, ([0.0, 0.56], [0.6, 1.0]), strict=True)):
        title = {"text": f"{NAMES[column]}, {shown(column, units).label}", "font": {"size": 12}}
        axes[f"xaxis{k + 1 if k else ''}"] = {
            "title": title, "domain": domain, "anchor": "y", "nticks": 6, "zeroline": False,
            "gridcolor": "#e8e8e8",
        }  # fmt: skip
    return {
        **axes,
        "yaxis": {
            "title": {"text": f"{DEPTH.label}, {unit}", "font": {"size": 12}}, "range": [high + air, low - air],
            "exponentformat": "none", "gridcolor": "#e8e8e8", "zeroline": False,
        },
        "shapes": [
            {
                "type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": shoe, "y1": shoe,
                "line": {"color": QUIET, "dash": "dot", "width": 1},
            }
            for shoe in shoes
        ],
        "annotations": [
            {
                "text": f"shoe {shoe:.0f} {unit}", "xref": "paper", "x": 1, "xanchor": "right", "y": shoe,
                "yanchor": "bottom", "showarrow": False, "font": {"size": 10, "color": QUIET},
            }
            for shoe in shoes
        ],
        "margin": {"l": 64, "r": 12, "t": 10, "b": 46}, "hovermode": "closest", "uirevision": "fixed",
        "legend": {"orientation": "h", "x": 0, "y": 1.0, "yanchor": "bottom", "font": {"size": 11}},
        "plot_bgcolor": "#ffffff", "paper_bgcolor": "#ffffff", "font": {"family": FONT, "size": 11},
    }  # fmt: skip
