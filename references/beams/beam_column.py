"""A straight beam-column by Hermite elements: bending, tension that changes along it, a load across it, supports.

EI y'''' − (N y')' = q, N > 0 in tension.  Cubic elements are exact for a beam without tension under point loads, and of
fourth order else.  Degrees of freedom are y [m] and y' [rad] of every node.
"""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from fctd.arrays import Array


def grid(points: Array, elements: int) -> Array:
    """Nodes [m] with so many elements between each two points [m]."""
    parts = [np.linspace(a, b, elements + 1)[:-1] for a, b in pairwise(points)]
    return np.append(np.concatenate(parts), points[-1])


def bending(x: Array, EI: float) -> Array:
    """Stiffness of bending (2n, 2n) for nodes (n,) [m]."""

    def element(h: float) -> Array:
        return np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) * EI / h**3  # fmt: skip

    return _assembled(x, [element(float(h)) for h in np.diff(x)])


def stretching(x: Array, tension: Array) -> Array:
    """Stiffness of tension (2n, 2n), linear between its values (n,) [N] at the nodes."""
    at, weights = np.polynomial.legendre.leggauss(4)
    s = 0.5 * (at + 1)
    matrices = []
    for h, here, there in zip(np.diff(x), tension[:-1], tension[1:], strict=True):
        slopes = np.array([-6 * s + 6 * s**2, h * (1 - 4 * s + 3 * s**2), 6 * s - 6 * s**2, h * (3 * s**2 - 2 * s)]) / h
        along = 0.5 * h * weights * (here + (there - here) * s)
        matrices.append((slopes * along) @ slopes.T)
    return _assembled(x, matrices)


def load(x: Array, q: float) -> Array:
    """Forces and moments (2n,) of a uniform load [N/m]."""
    found = np.zeros(2 * len(x))
    for k, h in enumerate(np.diff(x)):
        found[2 * k : 2 * k + 4] += q * h * np.array([0.5, h / 12, 0.5, -h / 12])
    return found


def deflect(stiffness: Array, forces: Array, held: Mapping[int, float]) -> tuple[Array, Array]:
    """Displacements (2n,), and reactions (2n,) where some of them are ``held`` (index -> value)."""
    at = np.array(list(held), int)
    y = np.zeros(len(forces))
    y[at] = list(held.values())
    free = np.setdiff1d(np.arange(len(forces)), at)
    y[free] = np.linalg.solve(stiffness[np.ix_(free, free)], (forces - stiffness @ y)[free])
    return y, stiffness @ y - forces


def lowest_loads(stiffness: Array, softening: Array, held: list[int], count: int = 1) -> Array:
    """Lowest factors p (count,) at which stiffness − p softening is singular with some displacements held at zero."""
    free = np.setdiff1d(np.arange(len(stiffness)), held)
    inner = np.ix_(free, free)
    inverse = eigh(softening[inner], stiffness[inner], eigvals_only=True)
    return np.asarray(np.sort(1 / inverse[inverse > 0])[:count])


def side_force(
    EI: float,
    q: float,
    supports: Mapping[float, float],
    below: float,
    tension: float = 0.0,
    gradient: float = 0.0,
    elements: int = 10,
) -> float:
    """Force of the hole on the lower end [N] of a beam that lies on the low side beyond where it touches it.

    The lower end is held at y = 0 without a moment; ``supports`` : distance from it [m] -> y [m] there; the beam lies
    flat at y = below [m] (< 0) from its tangent point on, where it has no moment.  tension : at the lower end [N], with
    its gradient [N/m] upwards; q : load towards the low side [N/m].
    """
    last = max(supports, default=0.0)

    def solved(end: float) -> tuple[Array, Array]:
        points = np.array([0.0, *sorted(supports), end])
        x = grid(points, elements)
        stiffness = bending(x, EI) + stretching(x, tension + gradient * x)
        held = {0: 0.0, 2 * len(x) - 2: below, 2 * len(x) - 1: 0.0}
        held |= {2 * int(np.abs(x - at).argmin()): y for at, y in supports.items()}
        _, reactions = deflect(stiffness, -load(x, q), held)
        return reactions, x

    def moment(span: float) -> float:
        return float(solved(last + span)[0][-1])

    reach = (72 * EI * max(abs(below), 1e-4) / q) ** 0.25
    trial = np.linspace(0.15, 2.5, 48) * reach
    signs = np.sign([moment(span) for span in trial])
    k = int(np.flatnonzero(np.diff(signs))[0])
    reactions, _ = solved(last + float(brentq(moment, trial[k], trial[k + 1], xtol=1e-10)))
    return float(reactions[0])


def _assembled(x: Array, elements: list[Array]) -> Array:
    found = np.zeros((2 * len(x), 2 * len(x)))
    for k, element in enumerate(elements):
        found[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += element
    return found
