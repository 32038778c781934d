"""Newton's method for a steady string, with pseudo-transient continuation.

A step solves (K + M/τ²) Δ = R: with the bodies' masses M and the pseudo-time τ, the term M/τ² limits the step of
a string far from balance.  τ grows with every step that needs no shortening, until the steps are Newton's (Kelley &
Keyes 1998).  Their own rule, growth as the residual falls, often fails at the wall: a point that touches it for the
first time raises the residual by orders of magnitude, and the next step moves it back.
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.jit import entry, kernel
from fctd.mechanics.rotations import rotation_columns, turned
from fctd.mechanics.state import ARM_CONTACT, J_AXIAL, J_TRANSVERSE, K_AXIAL, MASS, TINY, WEIGHT
from fctd.steady.block_thomas import eliminate
from fctd.steady.pose import SPIN, quaternion
from fctd.steady.tangent import assemble

CONVERGED, MAX_ITERATIONS, NOT_FINITE, UNSOUND = range(4)
# Largest force out of balance at a body, over the weight of the string.
TOLERANCE = 1e-7
EPSILON = float(np.finfo(float).eps)
# Of a largest lateral step that has been narrowed: its growth with a step that lowers the imbalance, and its least
# value [m], which is that of a point pressed into the wall by some kilonewtons.
WIDENING, NARROWEST = 1.05, 1e-5


class Pace(NamedTuple):
    """Step sizes and stopping criteria of the iteration.

    iterations : largest number.  tau : first pseudo-time [s]; growth : its factor after a step that was not shortened;
    shrink : its factor after a step that raised the imbalance more than tenfold (1 : unchanged).
    shift [m], turn [rad] : a body's largest lateral step and largest rotation; narrow : factor of the first after one
    that raised the imbalance so (1 : unchanged), from which it grows again.
    force [N], moment [N m] : largest imbalance of a body when converged.
    """

    iterations: int
    tau: float
    growth: float
    shrink: float
    shift: float
    narrow: float
    turn: float
    force: float
    moment: float


@entry
def limits(S, n, bit_depth, weight_on_bit, pipe, top_length):
    """Weight of the string and on the bit, and largest imbalance of a body when converged [N].

    pipe : fed at the top; top_length [m] : of a long segment, half of which hangs on the top drive, else 0.
    """
    weight, stiffest = abs(weight_on_bit) + abs(0.5 * top_length * pipe.weight), 0.0
    for j in range(1, n + 1):
        weight += abs(S[WEIGHT + j])  # pipe that floats weighs less than nothing
        stiffest = max(stiffest, S[K_AXIAL + j])
    # The stiffness of the shortest segments turns the rounding of positions into force.
    return weight, max(TOLERANCE * weight, 16 * EPSILON * bit_depth * stiffest)


@kernel
def imbalance(R, n, pace):
    """Largest ratio of a force or moment out of balance to its allowed value: converged at 1, NaN when not finite."""
    worst = 0.0
    for j in range(1, n + 1):
        force = np.sqrt(R[j, 0] ** 2 + R[j, 1] ** 2 + R[j, 2] ** 2)
        moment = np.sqrt(R[j, 3] ** 2 + R[j, 4] ** 2 + R[j, 5] ** 2)
        if not force + moment < np.inf:
            return np.nan
        worst = max(worst, force / pace.force, moment / pace.moment)
    return worst


@entry
def add_pseudo_mass(S, n, tau, D):
    """Add the masses over τ² to the diagonal blocks."""
    k = 1 / (tau * tau)
    for j in range(1, n + 1):
        for i in range(3):
            D[j, i, i] += k * S[MASS + j]
        D[j, 3, 3] += k * S[J_TRANSVERSE + j]
        D[j, 4, 4] += k * S[J_TRANSVERSE + j]
        D[j, 5, 5] += k * S[J_AXIAL + j]


@kernel
def allowed_share(S, n, P, X, shift, turn):
    """Share of the step X (n + 1, 6) that keeps to the largest lateral step [m] and rotation [rad] of a body."""
    share = 1.0
    for j in range(1, n + 1):
        xx, xy, xz, yx, yy, yz, _, _, _ = rotation_columns(*quaternion(P, j))
        arm, a, b = S[ARM_CONTACT + j], X[j, 3], X[j, 4]
        u = xx * X[j, 0] + xy * X[j, 1] + xz * X[j, 2] + arm * b
        v = yx * X[j, 0] + yy * X[j, 1] + yz * X[j, 2] - arm * a
        sideways, tilt = np.sqrt(u * u + v * v), np.sqrt(a * a + b * b)
        share = min(share, shift / (sideways + TINY), turn / (tilt + TINY))
    return share


@entry
def take_step(P, n, X, share):
    """Move the bodies by a share of the step X (n + 1, 6)."""
    for j in range(1, n + 1):
        for i in range(3):
            P[j, i] += share * X[j, i]
        P[j, 3], P[j, 4], P[j, 5], P[j, 6] = turned(*quaternion(P, j), share * X[j, 3], share * X[j, 4], 0.0)
        P[j, SPIN] += share * X[j, 5]


@entry
def converge(w, n, kinks, C, laws, pace, tau):
    """Iterate from the pose towards balance; returns status, iterations and the last pseudo-time.

    w : the ``Workspace``; its R then contains the forces and moments out of balance and, in row 0, the reactions of the
    top drive.
    ``UNSOUND`` : the elimination met a near singular block; ``assemble`` and ``add_pseudo_mass`` build the system
    again for another solver.
    """
    S, P, _G, R, D, A, U, W, owner = w
    before = np.inf
    share, shift = 0.0, pace.shift
    for k in range(pace.iterations):
        assemble(S, n, P, kinks, C, owner, laws, R, D, A, U)
        error = imbalance(R, n, pace)
        if not error < np.inf:
            return NOT_FINITE, k, tau
        if error <= 1:
            return CONVERGED, k, tau
        if error > 10 * before:
            tau *= pace.shrink
            shift = max(pace.narrow * shift, min(NARROWEST, shift))
        elif error < before:
            shift = min(WIDENING * shift, pace.shift)
        if share == 1 and (error < before or pace.shrink == 1):
            tau *= pace.growth
        before = error
        add_pseudo_mass(S, n, tau, D)
        if not eliminate(D, A, U, R, n, W):
            return UNSOUND, k, tau
        share = allowed_share(S, n, P, R, shift, pace.turn)
        take_step(P, n, R, share)
    return MAX_ITERATIONS, pace.iterations, tau
