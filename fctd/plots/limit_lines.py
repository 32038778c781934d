"""Limits of a string as lines in its chart: hook loads and surface torques at which each is reached."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.plots.loads import LOAD_COLUMNS, TORQUE, Load, as_load

if TYPE_CHECKING:
    import pandas as pd

# Dashes of the limits, in pictures and on pages; limits of steel that have none here share the first.
DASHES: Final = {
    "yield": ((0, (1, 1)), "1px,2px"), "make_up": ((0, (4, 1, 1, 1)), "6px,2px,1px,2px"),
    "hoist": ((0, (8, 2)), "12px,3px"), "drive": ((0, (8, 2)), "12px,3px"), "slips": ((0, (3, 1)), "5px,2px"),
    "snaking": ((0, (1, 3)), "1px,4px"), "helix": ((0, (2, 3)), "3px,4px"),
    "slack_off": ((0, (5, 3)), "8px,4px"), "lock_up": ((0, (6, 1, 1, 1, 1, 1)), "8px,2px,1px,2px,1px,2px"),
}  # fmt: skip
USUAL: Final = DASHES["yield"]
WIDTH: Final = 1.1  # of the lines [pt]


class LimitLine(NamedTuple):
    """A limit of an operation: bit depths (n,) [m] and the load at the limit (n,), SI."""

    operation: str
    limit: str
    depth: Array
    value: Array

    @property
    def name(self) -> str:
        """The limit in words."""
        return f"limit: {self.limit.replace('_', ' ')}"

    @property
    def dash(self) -> tuple[tuple[int, tuple[int, ...]], str]:
        """Its dash in pictures, and on pages."""
        return DASHES.get(self.limit, USUAL)


def limit_lines(margins: pd.DataFrame | None, case: Case | None, load: Load, column: str) -> list[LimitLine]:
    """The limits in a column of a chart, hook loads or torques; margins : of ``margin_table``, or none.

    Where a limit has no number a line has a gap; one without any number is left out.
    """
    if margins is None:
        return []
    own = TORQUE if column == TORQUE else "hookload_N"
    lines = []
    for (operation, limit), rows in margins.groupby(["operation", "limit"], sort=False):
        value = rows[own].to_numpy(float)
        if column == LOAD_COLUMNS["indicator"]:
            value = as_load(case, str(operation), value, load)
        if np.isfinite(value).any():
            lines.append(LimitLine(str(operation), str(limit), rows["bit_depth_m"].to_numpy(float), value))
    return lines
