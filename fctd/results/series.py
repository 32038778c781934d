"""The series of a chart: the rows of one operation and one set of friction factors."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from fctd.case.systems import told
from fctd.results.unit_systems import System

if TYPE_CHECKING:
    import pandas as pd

# A table of ``fctd.torque_drag``, or its columns.
Chart: TypeAlias = "pd.DataFrame | Mapping[str, NDArray[Any]]"

CASE = "case"  # the column that names the case of a row, where a table has several
FRICTION_LABEL = "friction_label"  # the column that names friction factors which differ along the hole
OWN = "case's"  # factors of the case that differ along the hole, without a label


class Series(NamedTuple):
    """One curve of a chart.

    case : its name in a chart of several cases, else ""; operation : kind; friction : "0.25", or the label of factors
    that differ along the hole; columns : those of the chart, each (n,) by rising depth.
    """

    case: str
    operation: str
    friction: str
    columns: dict[str, NDArray[Any]]


def series_of(chart: Chart, units: System = "si") -> list[Series]:
    """The series of a chart in the order of its rows; ``friction_label`` names the factors where the chart has it.

    units : of depths in the names.
    """
    columns = {name: np.asarray(chart[name]) for name in map(str, chart)}
    if FRICTION_LABEL in columns:
        names = {label: told(label, units) for label in dict.fromkeys(columns[FRICTION_LABEL])}
        frictions = [names[label] for label in columns[FRICTION_LABEL]]
    else:
        frictions = [OWN if isnan(factor) else f"{factor:g}" for factor in columns["friction"]]
    cases = columns.get(CASE, np.full(len(frictions), ""))
    rows: dict[tuple[str, str, str], list[int]] = {}
    for k, key in enumerate(zip(cases, columns["operation"], frictions, strict=True)):
        rows.setdefault(key, []).append(k)
    return [
        Series(str(case), str(operation), friction, {name: values[at] for name, values in columns.items()})
        for (case, operation, friction), at in rows.items()
    ]


def frictions_of(series: list[Series]) -> list[str]:
    """The friction factors of series, each once."""
    return list(dict.fromkeys(one.friction for one in series))


def has_fan(series: list[Series]) -> bool:
    """Whether any case has several sets of friction factors: else the factors are told with the case."""
    found: dict[str, set[str]] = {}
    for one in series:
        found.setdefault(one.case, set()).add(one.friction)
    return max(map(len, found.values())) > 1


def in_words(friction: str) -> str:
    """Friction factors of a series for a heading: "friction factor 0.25"."""
    if friction == OWN:
        return "friction factors of the case"
    return f"friction factor {friction}" if friction.replace(".", "", 1).isdigit() else f"friction factors: {friction}"
