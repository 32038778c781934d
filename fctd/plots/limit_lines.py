"""Limits of a string as lines in its chart: hook loads and surface torques at which each is reached."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.plots.loads import LOAD_COLUMNS, TORQUE, Load, as_load
from fctd.plots.palette import Dash

if TYPE_CHECKING:
    import pandas as pd

# Dashes of the limits; limits of steel that have none here share the first.
DASHES: Final[dict[str, Dash]] = {
    "yield": (1, 1), "make_up": (4, 1, 1, 1), "hoist": (8, 2), "drive": (8, 2), "slips": (3, 1), "snaking": (1, 3),
    "helix": (2, 3), "slack_off": (5, 3), "lock_up": (6, 1, 1, 1, 1, 1),
}  # fmt: skip
USUAL: Final = DASHES["yield"]
WIDTH: Final = 1.1  # of the lines [pt]


class LimitLine(NamedTuple):
    """A limit of an operation: bit depths (n,) and the load at the limit (n,), SI, or in the units of a panel."""

    operation: str
    limit: str
    depth: Array
    value: Array

    @property
    def name(self) -> str:
        """The limit in words."""
        return f"limit: {self.limit.replace('_', ' ')}"

    @property
    def dash(self) -> Dash:
        """Its dash."""
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
