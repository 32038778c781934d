"""The series of a chart: the rows of one operation and one set of friction factors."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING, NamedTuple

from fctd.results.unit_systems import System, reworded

if TYPE_CHECKING:
    import pandas as pd

FRICTION_LABEL = "friction_label"  # the column that names friction factors which differ along the hole
OWN = "case's"  # factors of the case that differ along the hole, without a label


class Series(NamedTuple):
    """One curve of a chart.

    operation : kind; friction : "0.25", or the label of factors that differ along the hole; rows : by rising depth.
    """

    operation: str
    friction: str
    rows: pd.DataFrame


def series_of(chart: pd.DataFrame, units: System = "si") -> list[Series]:
    """The series of a chart in the order of its rows; ``friction_label`` names the factors where the chart has it.

    units : of depths in the names.
    """
    if FRICTION_LABEL in chart.columns:
        names = chart[FRICTION_LABEL].map(lambda label: reworded(str(label), units))
    else:
        names = chart["friction"].map(lambda factor: OWN if isnan(factor) else f"{factor:g}")
    groups = chart.groupby([chart["operation"], names], sort=False)
    return [Series(str(operation), str(friction), rows) for (operation, friction), rows in groups]


def frictions_of(series: list[Series]) -> list[str]:
    """The friction factors of series, each once."""
    return list(dict.fromkeys(one.friction for one in series))


def in_words(friction: str) -> str:
    """Friction factors of a series for a heading: "friction factor 0.25"."""
    if friction == OWN:
        return "friction factors of the case"
    return f"friction factor {friction}" if friction.replace(".", "", 1).isdigit() else f"friction factors: {friction}"
