"""What a range of counts of segments says, in words and in a table: observed orders, extrapolated loads, counts."""

from collections.abc import Hashable, Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.results.shown_tables import NONE, Cell, Head, Table, of_column, shown_table
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    import pandas as pd

# Words of a load, the column that has it, its unit in names of columns, and its digits after the point.
LOADS: Final = {"hookload": ("hook load", "hookload_N", "N", 2), "torque": ("torque", "surface_torque_N_m", "N_m", 4)}


def order_in_words(row: Mapping[Hashable, Any], load: str) -> str:
    """The observed order of a load with its interval, of a row of ``Refinement.orders``."""
    order, low, high = (row[f"{load}_{name}"] for name in ("order", "order_low", "order_high"))
    return f"{order:.2f} ({low:.2f}–{high:.2f})" if np.isfinite(order) else "none"


def orders_table(orders: "pd.DataFrame", tolerance: float, units: System) -> Table:
    """Observed order, extrapolated load with its interval, and the count that a tolerance needs.

    A row for each load of a row of ``Refinement.orders``, of one operation.
    """
    told: list[list[object]] = []
    for row in orders.to_dict("records"):
        layout = row["layout"]
        for load, (words, column, unit, digits) in LOADS.items():
            value, low, high = (row[f"{load}_{name}_{unit}"] for name in ("limit", "limit_low", "limit_high"))
            off = of_column(column, max(high - value, value - low), units, digits).text
            known = f"{of_column(column, value, units, digits).text} ± {off}" if np.isfinite(value) else NONE
            count = row[f"{load}_segments"]
            enough = Cell(f"{count:.0f}", count) if np.isfinite(count) else Cell("more")
            told.append([layout, f"{words}, {shown(column, units).label}", order_in_words(row, load), known, enough])
            layout = ""
    heads = ["layout", "load", "observed order", "extrapolated"]
    return shown_table([*heads, Head("segments", f"for {100 * tolerance:.3g} %", numbers=True)], told)


def counts_in_words(steps: "pd.DataFrame", orders: "pd.DataFrame", tolerance: float) -> list[str]:
    """The counts that all loads need for a tolerance, by layout, and the error of the default layout.

    steps, orders : of a ``Refinement`` with a range of counts.
    """
    lines = []
    for layout, rows in orders.groupby("layout", sort=False):
        counts = rows[[f"{load}_segments" for load in LOADS]].to_numpy(float)
        enough = f"{counts.max():.0f} {layout} segments or more"
        if not np.isfinite(counts).all():
            enough = f"more {layout} segments than were tried"
        lines.append(f"{100 * tolerance:.3g} % takes {enough}.")
    default = steps[steps["layout"] == "default"]
    error = default[[f"{load}_error" for load in LOADS]].to_numpy(float).max()
    left = f"an error of {100 * error:.2g} %" if np.isfinite(error) else "no answer, or no known error"
    return [*lines, f"The default layout has {default['segments'].iloc[0]} segments, and {left}."]
