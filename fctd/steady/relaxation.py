"""Relaxation of a buckled string into a shape in which it stays.

A buckled string has many shapes, and far from all of them Newton's method (continuation.py) finds none.  Here the
pseudo-time τ follows the distance moved: it shrinks where a step must be shortened and grows otherwise.  The string
creeps the way that an overdamped string would move, through snaps into another number of waves, and the damping fades
as it comes to rest, so that the last steps are Newton's.

A point on the wall moves round the hole on an arc.  A straight step of d would press it into the wall by
d²/2r, and the wall's spring would answer with a force far larger than all others.

The bending moment of friction that acts at the string's surface, r μ F_n, turns a helix about the hole's axis, although
it is only some 2 % of what friction could hold: a helix on a wall with friction has no standing shape by its balance
alone.  ``at_axis`` leaves this moment out; measured with it, the hook load swings by 0.4 % about the value without.
So does a torque at the bit that follows the bit's axis: it works M π(rθ′)² in a roll, some newton metres of the
thousands that friction could hold.  A semi-tangential torque does no work in it.
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.contact import arc_wall, cylinder_wall
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.rotations import rotation_columns, turned
from fctd.mechanics.state import ARCS, ARM_BOTTOM, ARM_CONTACT, ARM_TOP, OPEN, RADIUS, TINY
from fctd.steady.block_thomas import eliminate
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS, NOT_FINITE, add_pseudo_mass, imbalance
from fctd.steady.held_friction import remember
from fctd.steady.pose import SPIN, quaternion
from fctd.steady.tangent import assemble

# Columns of the contact points: offset from the hole's axis [m], global, and radius of the hole less the string's.
CLEARANCE, PLACES = 3, 4
# Points this close to the wall, as a share of the clearance, move round it.
NEAR_WALL = 0.9
# Largest pseudo-time; beyond it the iteration alternates between shapes without coming closer, and begins again.
LONGEST = 1e5


class Creep(NamedTuple):
    """Step sizes and stopping criteria of a relaxation.

    iterations : largest number.  tau : first pseudo-time [s]; growth : its factor after a step that was not shortened;
    shrink : its smallest factor after one that was.  share : a point's largest lateral step as a share of its
    clearance; shift [m] : and of any point; turn [rad] : a body's largest rotation.
    force [N], moment [N m] : largest imbalance of a body when converged.  slips : whether the friction of a string that
    is fed (held_friction.py) follows every step, as in a snap, or remembers the last increment.
    """

    iterations: int
    tau: float
    growth: float
    shrink: float
    share: float
    shift: float
    turn: float
    force: float
    moment: float
    slips: bool = False


@inlined
def slip(held, S, n, P, C, owner, laws):
    """Let the friction of a string that is fed follow its motion."""
    if held is not None:
        remember(S, n, P, C, owner, laws)


@kernel
def find_places(S, n, P, C, owner, geometry, places):
    """Fill ``places`` (n + 1, PLACES) with offset and clearance of the contact points; without a wall offset 0."""
    for j in range(1, n + 1):
        places[j, 0] = places[j, 1] = places[j, 2] = 0.0
        places[j, CLEARANCE] = np.inf
        if geometry == OPEN:
            continue
        _, _, _, _, _, _, zx, zy, zz = rotation_columns(*quaternion(P, j))
        arm = S[ARM_CONTACT + j]
        x, y, z = P[j, 0] + arm * zx, P[j, 1] + arm * zy, P[j, 2] + arm * zz
        if geometry == ARCS:
            rx, ry, rz, hole, _, _, _, _ = arc_wall(C, owner[j], x, y, z)
        else:
            rx, ry, rz, hole, _, _, _, _ = cylinder_wall(C, owner[j], x, y, z)
        places[j, 0], places[j, 1], places[j, 2], places[j, CLEARANCE] = rx, ry, rz, hole - S[RADIUS + j]


@kernel
def sideways(S, P, X, j):
    """Lateral shift of the contact point of body j by the step X [m], global, and the size of the body's tilt [rad]."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(P, j))
    arm, a, b = S[ARM_CONTACT + j], X[j, 3], X[j, 4]
    ux = X[j, 0] + arm * (b * xx - a * yx)
    uy = X[j, 1] + arm * (b * xy - a * yy)
    uz = X[j, 2] + arm * (b * xz - a * yz)
    along = ux * zx + uy * zy + uz * zz
    return ux - along * zx, uy - along * zy, uz - along * zz, np.sqrt(a * a + b * b)


@kernel
def largest_move(S, n, P, X, places, creep):
    """Largest ratio of a lateral step or rotation in X (n + 1, 6) to its limit."""
    worst = 0.0
    for j in range(1, n + 1):
        ux, uy, uz, tilt = sideways(S, P, X, j)
        limit = min(creep.shift, max(creep.share * places[j, CLEARANCE], 0.25 * creep.shift))
        worst = max(worst, np.sqrt(ux * ux + uy * uy + uz * uz) / limit, tilt / creep.turn)
    return worst


@kernel
def find_arcs(S, n, P, X, share, places, arcs):
    """Fill ``arcs`` (n + 1, 3) [m]: what leads a point on the wall from the end of its straight step to that of its
    arc."""
    arcs[0, 0] = arcs[0, 1] = arcs[0, 2] = 0.0
    for j in range(1, n + 1):
        arcs[j, 0] = arcs[j, 1] = arcs[j, 2] = 0.0
        rx, ry, rz = places[j, 0], places[j, 1], places[j, 2]
        offset = np.sqrt(rx * rx + ry * ry + rz * rz)
        if offset <= NEAR_WALL * places[j, CLEARANCE]:
            continue
        ux, uy, uz, _ = sideways(S, P, X, j)
        nx, ny, nz = rx / offset, ry / offset, rz / offset
        out = ux * nx + uy * ny + uz * nz
        tx, ty, tz = share * (ux - out * nx), share * (uy - out * ny), share * (uz - out * nz)
        step = np.sqrt(tx * tx + ty * ty + tz * tz) + TINY
        angle = min(step / (offset + TINY), 1.0)
        inwards, round_it = -2 * offset * np.sin(0.5 * angle) ** 2, (offset * np.sin(angle) - step) / step
        arcs[j, 0] = inwards * nx + round_it * tx
        arcs[j, 1] = inwards * ny + round_it * ty
        arcs[j, 2] = inwards * nz + round_it * tz


@kernel
def move(S, n, P, X, share, arcs):
    """Move the bodies by a share of the step X (n + 1, 6), their ends along ``arcs``."""
    for j in range(1, n + 1):
        xx, xy, xz, yx, yy, yz, _, _, _ = rotation_columns(*quaternion(P, j))
        length = S[ARM_TOP + j] + S[ARM_BOTTOM + j]
        ex, ey, ez = arcs[j, 0] - arcs[j - 1, 0], arcs[j, 1] - arcs[j - 1, 1], arcs[j, 2] - arcs[j - 1, 2]
        a = share * X[j, 3] - (ex * yx + ey * yy + ez * yz) / length
        b = share * X[j, 4] + (ex * xx + ey * xy + ez * xz) / length
        for i in range(3):
            P[j, i] += share * X[j, i] + 0.5 * (arcs[j, i] + arcs[j - 1, i])
        P[j, 3], P[j, 4], P[j, 5], P[j, 6] = turned(*quaternion(P, j), a, b, 0.0)
        P[j, SPIN] += share * X[j, 5]


@entry
def move_round(S, n, P, C, owner, geometry, X, share):
    """Move the bodies by a share of the step X (n + 1, 6), points on the wall round the hole."""
    places, arcs = np.zeros((n + 1, PLACES)), np.zeros((n + 1, 3))
    find_places(S, n, P, C, owner, geometry, places)
    find_arcs(S, n, P, X, share, places, arcs)
    move(S, n, P, X, share, arcs)


@entry
def relax(w, n, kinks, C, laws, creep):
    """Let the pose come to rest; returns status and iterations.

    w : the ``Workspace``; its R then contains the forces and moments out of balance and, in row 0, the reactions of the
    top drive.
    """
    S, P, _G, R, D, A, U, W, owner = w
    places, arcs = np.zeros((n + 1, PLACES)), np.zeros((n + 1, 3))
    tau = creep.tau
    for k in range(creep.iterations):
        assemble(S, n, P, kinks, C, owner, laws, R, D, A, U)
        error = imbalance(R, n, creep)
        if not error < np.inf:
            return NOT_FINITE, k
        if error <= 1:
            return CONVERGED, k
        add_pseudo_mass(S, n, tau, D)
        if not eliminate(D, A, U, R, n, W):
            tau *= creep.shrink
            continue
        find_places(S, n, P, C, owner, laws.geometry, places)
        moved = largest_move(S, n, P, R, places, creep)
        share = 1 / max(moved, 1.0)
        tau = creep.tau if tau > LONGEST else tau * (creep.growth if share == 1 else max(creep.shrink, share))
        find_arcs(S, n, P, R, share, places, arcs)
        move(S, n, P, R, share, arcs)
        if creep.slips:
            slip(laws.held, S, n, P, C, owner, laws)
    return MAX_ITERATIONS, creep.iterations
