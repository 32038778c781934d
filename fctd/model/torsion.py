"""Vibration of a string: its slowest torsional and axial periods, over which surface torque and hook load are read.

Coulomb friction against a turning string is a constant torque.  Nothing damps the torsion of a string that only
rotates, and after its start the surface torque swings about its mean for minutes.
"""

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import ceiling
from fctd.model.drillstring import String

PIECE = 20.0  # longest piece of the chain of masses and springs [m]; 200 of them give the period to 1e-5
# The error falls ninefold in each iteration: the second frequency of a uniform string is three times the first.
ITERATIONS = 12


def torsional_period(length: ArrayLike, inertia: ArrayLike, stiffness: ArrayLike) -> float:
    """The slowest period [s] of a string that is held at the top and free at the bit.

    length [m], polar inertia [kg m] and torsional stiffness GJ [N m^2] per metre of its parts (n,), from the top down.
    With mass [kg/m] and EA [N] in their places it is the slowest axial period.
    """
    length, inertia, stiffness = (np.atleast_1d(np.asarray(part, float)) for part in (length, inertia, stiffness))
    count = ceiling(length / PIECE).astype(int)
    piece, mass, spring = (np.repeat(part, count) for part in (length / count, inertia, stiffness))
    middle = piece / (2 * spring)  # twist from an end of a piece to its middle, for each N m
    compliance = middle + np.append(0.0, middle[:-1])
    shape, square = np.ones(len(piece)), 0.0
    for _ in range(ITERATIONS):
        torque = np.cumsum((mass * piece * shape)[::-1])[::-1]
        twist = np.cumsum(compliance * torque)
        square = twist[-1] / shape[-1]  # 1/ω²
        shape = twist / twist[-1]
    return float(2 * np.pi * np.sqrt(square))


def period_of(string: String) -> float:
    """The slowest torsional period [s] of a laid-out string."""
    return torsional_period(string.length, string.of("axial_inertia"), string.of("GJ"))


def axial_period_of(string: String) -> float:
    """The slowest axial period [s] of a laid-out string."""
    return torsional_period(string.length, string.of("mass"), string.of("EA"))
