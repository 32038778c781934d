"""The energy of the string, for the ledger of a run."""

from typing import NamedTuple

import numpy as np
from numba import njit

from fctd import state
from fctd.joints import strain_energy


class Energy(NamedTuple):
    """Energies of a state [J]; gravity is zero at the rotary table, contact is in the wall's springs."""

    kinetic: float
    gravity: float
    strain: float
    contact: float


@njit(error_model="numpy", cache=True)
def _strain(S, n):
    total = 0.0
    for j in range(1, n + 1):
        total += strain_energy(S, j)
    return total


def penetration(S: np.ndarray, n: int) -> np.ndarray:
    """Penetration of every contact point [m], negative is clearance; −inf where there is no wall."""
    distance = np.sqrt(state.row(S, state.PX, n) ** 2 + state.row(S, state.PY, n) ** 2 + state.row(S, state.PZ, n) ** 2)
    hole = state.row(S, state.HOLE, n)
    return np.where(hole > 0, distance - hole + state.row(S, state.RADIUS, n), -np.inf)


def energy_of(S: np.ndarray, n: int) -> Energy:
    """Energy of the state, given axes and walls that belong to its positions."""

    def row(offset: int) -> np.ndarray:
        return state.row(S, offset, n)

    speed = row(state.VX) ** 2 + row(state.VY) ** 2 + row(state.VZ) ** 2
    swing = row(state.WX) ** 2 + row(state.WY) ** 2
    kinetic = row(state.MASS) * speed + row(state.J_TRANSVERSE) * swing + row(state.J_AXIAL) * row(state.WZ) ** 2
    pressed = np.maximum(penetration(S, n), 0.0)
    return Energy(
        kinetic=0.5 * float(kinetic.sum()),
        gravity=-float((row(state.WEIGHT) * row(state.Z)).sum()),
        strain=float(_strain(S, n)),
        contact=0.5 * float((row(state.K_WALL) * pressed**2).sum()),
    )
