"""The soft string in place of the stiff one: loads of a row for a calibration."""

from collections.abc import Sequence

import numpy as np

from fctd.calibration.forward import Array, Forward, StringLoads
from fctd.calibration.rows import Row
from fctd.calibration.unknowns import with_values
from fctd.model.operations import rad_per_s
from references.soft_string.integration import soft_string

# Length of an element [m]: 1 m changes the loads of these wells by less than 0.01 %.
ELEMENT = 10.0


class SoftForward(Forward):
    """Readings of rows by Johancsik's recursion; derivatives by differences."""

    def _solve_row(self, row: Row, values: Array, steps: Sequence[float]) -> StringLoads:
        loads, slopes = self._loads(row, values), np.zeros((2, len(values)))
        for k in self._by_string:
            moved = values.copy()
            moved[k] += steps[k]
            slopes[:, k] = (self._loads(row, moved) - loads) / steps[k]
        return StringLoads(loads, slopes, "")

    def _loads(self, row: Row, values: Array) -> Array:
        """Hook load [N] and torque [N m] of the string."""
        case = with_values(self.strings[row.string], dict(zip(self.names, map(float, values), strict=True)))
        found = soft_string(
            case, row.operation, row.bit_depth, speed=abs(row.rates.speed) or None,
            rpm=row.rates.spin / rad_per_s(1.0) or None, element=ELEMENT,
        )  # fmt: skip
        return np.array([found.hookload, found.surface_torque])
