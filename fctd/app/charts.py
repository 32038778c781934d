"""The chart of the page: the traces and axes of ``fctd chart`` as changes of a figure that stays."""

import base64
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fctd.case.load import Case
from fctd.plots.describe import describe
from fctd.plots.loads import ChartLook
from fctd.plots.traces import layout_of, traces_of
from fctd.results.unit_systems import System

# A part of a figure that changes: the way to it, and its new value.
Change = tuple[list[str | int], Any]
FONT: Final = 'system-ui, "Segoe UI", "Noto Sans", "Liberation Sans", sans-serif'
EMPTY: Final[dict[str, Any]] = {"data": [], "layout": {"xaxis": {"visible": False}, "yaxis": {"visible": False}}}
LAYOUT: Final[dict[str, Any]] = {
    "margin": {"l": 64, "r": 12, "t": 58, "b": 24}, "uirevision": "fixed", "plot_bgcolor": "#ffffff",
    "paper_bgcolor": "#ffffff", "font": {"family": FONT, "size": 11},
    "legend": {"orientation": "h", "y": 0, "yref": "container", "yanchor": "bottom"},
}  # fmt: skip


def packed(values: ArrayLike) -> dict[str, str]:
    """Numbers as plotly reads them fastest: base64 of float32; what is not finite is a gap."""
    array: NDArray[np.float32] = np.ascontiguousarray(values, "<f4")
    return {"dtype": "f4", "bdata": base64.b64encode(array.tobytes()).decode("ascii")}


def changes_of(rows: Sequence[Mapping[str, Any]], case: Case, units: System, look: ChartLook) -> list[Change]:
    """New data and axes for the rows of a chart."""
    # A data frame of the rows would take longer than the rest of the chart.
    columns = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    described = describe(columns, units, case, look)
    layout = LAYOUT | layout_of(described)
    for name, axis in layout.items():
        if name.startswith(("xaxis", "yaxis")):
            axis["gridcolor"] = "#e8e8e8"
        if name.startswith("xaxis"):  # in two lines, as the panels are narrow
            text = axis["title"]["text"]
            axis["title"]["text"] = text.replace(" (", "<br>(") if "(" in text else text.replace(", ", ",<br>")
    return [(["data"], [_packed(trace) for trace in traces_of(described)]), (["layout"], layout)]


def _packed(part: Any) -> Any:
    """A trace, or a part of it, whose arrays are packed."""
    if isinstance(part, dict):
        return {name: _packed(value) for name, value in part.items()}
    return packed(part) if isinstance(part, np.ndarray) else part
