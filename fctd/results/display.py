"""Results as notebooks show them: a small table."""

from __future__ import annotations

from collections.abc import Mapping
from math import isnan
from typing import TYPE_CHECKING

from fctd.results.columns import COLUMNS, LOADS
from fctd.results.unit_systems import shown

if TYPE_CHECKING:
    pass

# Loads that say most: hook load and surface torque.
MAIN = LOADS[:2]


def html_table(title: str, rows: Mapping[str, str]) -> str:
    """A table of names and values below a title, as HTML; texts are escaped."""
    import pandas as pd

    table = pd.DataFrame({title: list(rows.values())}, index=list(rows)).to_html()
    return table.replace(' style="text-align: right;"', ' style="text-align: left;"')


def load_rows(loads: Mapping[str, float]) -> dict[str, str]:
    """Labels of columns and their values with units, "hook load": "957.9 kN"; a dash for NaN."""
    rows = {}
    for name, value in loads.items():
        unit = shown(name, "si")
        rows[COLUMNS[name].label] = (
            "–" if isnan(value) else f"{value * unit.factor:z.{COLUMNS[name].digits}f} {unit.label}"
        )
    return rows
