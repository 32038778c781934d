"""The energy of the string, for the ledger of a run."""

import math
from typing import NamedTuple

import numpy as np

from fctd.mechanics import state
from fctd.mechanics.derrick import part_immersed
from fctd.mechanics.jit import entry
from fctd.mechanics.joints import strain_energy
from fctd.mechanics.state import (
    ADDED_MASS,
    HOLE,
    J_AXIAL,
    J_TRANSVERSE,
    K_WALL,
    MASS,
    RADIUS,
    WEIGHT,
    Z,
    axis,
    radial,
    spin,
    velocity,
)
from fctd.mechanics.waves import energy_of_waves


class Energy(NamedTuple):
    """Energies of a state [J]; gravity is zero at the rotary table; contact is the energy of the wall's springs.

    The mud that moves sideways with the string has kinetic energy too.
    """

    kinetic: float
    gravity: float
    strain: float
    contact: float


@entry
def _energies(S, n, exponent):
    kinetic = gravity = strain = contact = 0.0
    share = 1 / (exponent + 1)
    for j in range(1, n + 1):
        vx, vy, vz = velocity(S, j)
        wx, wy, wz = spin(S, j)
        ax, ay, az = axis(S, j)
        along = vx * ax + vy * ay + vz * az
        kinetic += 0.5 * S[MASS + j] * (vx * vx + vy * vy + vz * vz)
        kinetic += 0.5 * S[ADDED_MASS + j] * (vx * vx + vy * vy + vz * vz - along * along)
        kinetic += 0.5 * (S[J_TRANSVERSE + j] * (wx * wx + wy * wy) + S[J_AXIAL + j] * wz * wz)
        gravity -= S[WEIGHT + j] * S[Z + j]
        gravity += part_immersed(S, j)
        strain += strain_energy(S, j)
        px, py, pz = radial(S, j)
        pressed = math.sqrt(px * px + py * py + pz * pz) - S[HOLE + j] + S[RADIUS + j]
        if S[HOLE + j] > 0 and pressed > 0:
            contact += share * S[K_WALL + j] * pressed * pressed
    moving, strained = energy_of_waves(S)
    kinetic, strain = kinetic + moving, strain + strained
    return kinetic, gravity, strain, contact


def penetration(S: np.ndarray, n: int) -> np.ndarray:
    """Penetration (n,) of every contact point [m], negative is clearance; −inf where there is no wall."""
    distance = np.sqrt(state.row(S, state.PX, n) ** 2 + state.row(S, state.PY, n) ** 2 + state.row(S, state.PZ, n) ** 2)
    hole = state.row(S, state.HOLE, n)
    return np.where(hole > 0, distance - hole + state.row(S, state.RADIUS, n), -np.inf)


def energy_of(S: np.ndarray, n: int, exponent: float = 1.0) -> Energy:
    """Energy [J] of the n segments of a state, given axes and walls that belong to its positions.

    exponent : of the wall's law, whose spring holds K d²/(p + 1) with the secant stiffness K.
    """
    return Energy(*_energies(S, n, exponent))
