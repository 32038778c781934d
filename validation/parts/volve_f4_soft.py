"""The soft string in place of the stiff one: loads of a row for a calibration."""

from collections.abc import Sequence

import numpy as np

from fctd.arrays import Array
from fctd.calibration.forward import Forward, StringLoads
from fctd.calibration.rows import Row
from fctd.case.load import Case
from fctd.model.operations import rad_per_s
from fctd.steady.equilibrium import Solver
from references.soft_string.integration import soft_string

# Length of an element [m]: 1 m changes the loads of these wells by less than 0.01 %.
ELEMENT = 10.0


class SoftForward(Forward):
    """Readings of rows by Johancsik's recursion; derivatives by differences."""

    def _solve_row(self, row: Row, solvers: Sequence[Solver], steps: Array) -> StringLoads:
        first = solvers[0].case
        at = _loads(row, first)
        # An unknown of another string changes nothing here.
        loads = [at, *(at if _same(first, solver.case) else _loads(row, solver.case) for solver in solvers[1:])]
        slopes = np.zeros((2, len(steps)))
        slopes[:, self._by_string] = (np.array(loads[1:]) - loads[0]).T / steps[self._by_string]
        return StringLoads(loads[0], slopes, "")


def _same(one: Case, other: Case) -> bool:
    """Whether cases of one well have the same string, friction and mud."""
    return (one.string, one.wellbore.intervals, one.mud) == (other.string, other.wellbore.intervals, other.mud)


def _loads(row: Row, case: Case) -> Array:
    """Hook load [N] and torque [N m] of a row's string."""
    found = soft_string(
        case, row.operation, row.bit_depth, speed=abs(row.rates.speed) or None,
        rpm=row.rates.spin / rad_per_s(1.0) or None, element=ELEMENT,
    )  # fmt: skip
    return np.array([found.hookload, found.surface_torque])
