"""First guess of a steady string: it lies on the side of the hole that a soft string presses on.

Newton's method converges in a few iterations from a chain that touches the right side of the hole, with nearly the
right tension and torque.  The offsets of a neighbouring depth would save a tenth of the iterations, but every row of a
chart would then depend on the rows before it.
"""

import numpy as np

from fctd.mechanics.contact import (
    CURVATURE,
    DIRECTION,
    FACTOR,
    FACTOR_AROUND,
    HOLE_RADIUS,
    NORMAL,
    START,
    START_MD,
    STIFFNESS,
)
from fctd.mechanics.friction import limit_around
from fctd.mechanics.jit import entry, kernel
from fctd.mechanics.joints import cross
from fctd.mechanics.laws import shares
from fctd.mechanics.sampled import sampled_wall
from fctd.mechanics.state import (
    ARCS,
    ARM_BOTTOM,
    ARM_TOP,
    GIVEN_FORCE,
    GIVEN_TORQUE,
    K_AXIAL,
    K_TWIST,
    MUD_AXIAL,
    MUD_SPIN,
    OPEN,
    OWN_FRICTION,
    RADIUS,
    SAMPLED,
    TRIBUTARY,
    WEIGHT,
)
from fctd.steady.pose import SPIN, quaternion
from fctd.steady.wall_tangent import spin_of, starting

# Columns of a node, the lower end of a body: tension [N], torque [N m] just above it, offset
# from the hole axis (global) [m], measured depth [m].
TENSION, TORQUE, OFFSET, MD = 0, 1, 2, 5
NODE = 6


@kernel
def piece_at(C, i, md):
    """Index of the piece that contains a measured depth, by a walk from piece i."""
    while i > 0 and md < C[i, START_MD]:
        i -= 1
    while i < C.shape[0] - 1 and md >= C[i + 1, START_MD]:
        i += 1
    return i


@kernel
def axis_at(C, geometry, i, md):
    """Point of the hole axis [m] and unit tangent at a measured depth in piece i: six scalars."""
    s = md - C[i, START_MD]
    x, y, z = C[i, START], C[i, START + 1], C[i, START + 2]
    tx, ty, tz = C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2]
    k = C[i, CURVATURE] if geometry in (ARCS, SAMPLED) else 0.0
    angle = k * s
    if angle * angle < 1e-16:
        return x + s * tx, y + s * ty, z + s * tz, tx, ty, tz
    nx, ny, nz = C[i, NORMAL], C[i, NORMAL + 1], C[i, NORMAL + 2]
    sine, cosine = np.sin(angle), np.cos(angle)
    u, v = sine / k, 2 * np.sin(0.5 * angle) ** 2 / k
    return (
        x + u * tx + v * nx, y + u * ty + v * ny, z + u * tz + v * nz,
        cosine * tx + sine * nx, cosine * ty + sine * ny, cosine * tz + sine * nz,
    )  # fmt: skip


@kernel
def soft_string(S, n, C, laws, top_md, bit_tension, radius, G):
    """Fill G (n + 1, NODE) with tension, torque and offset of a soft string, node by node from the bit up.

    radius (n,) : that of the pipe as a whole [m].  Bodies laid on the wall between their tool joints would begin as a
    zigzag, which takes an iteration for each of their segments to straighten.
    """
    md = top_md
    G[0, MD] = md
    for j in range(1, n + 1):
        md += S[ARM_TOP + j] + S[ARM_BOTTOM + j]
        G[j, MD] = md
    i = piece_at(C, C.shape[0] - 1, md)
    bx, by, bz = 0.0, 0.0, 0.0
    tension, torque = bit_tension, laws.bit_torque
    for j in range(n, 0, -1):
        i = piece_at(C, i, G[j, MD])
        x, y, z, tx, ty, tz = axis_at(C, laws.geometry, i, G[j, MD])
        k = piece_at(C, i, G[j - 1, MD])
        x0, y0, z0, _, _, _ = axis_at(C, laws.geometry, k, G[j - 1, MD])
        length = np.sqrt((x - x0) ** 2 + (y - y0) ** 2 + (z - z0) ** 2)
        ax, ay, az = (x - x0) / length, (y - y0) / length, (z - z0) / length
        # Half the weight of both neighbours and the tension in the bend press the node against the wall.
        weight = 0.5 * S[WEIGHT + j] + (0.5 * S[WEIGHT + j + 1] if j < n else 0.0)
        turn = 0.0 if j == n else tension
        qx = turn * (bx - ax) - weight * tz * tx
        qy = turn * (by - ay) - weight * tz * ty
        qz = turn * (bz - az) + weight * (1 - tz * tz)
        inline = qx * tx + qy * ty + qz * tz
        qx, qy, qz = qx - inline * tx, qy - inline * ty, qz - inline * tz
        side = np.sqrt(qx * qx + qy * qy + qz * qz)
        own, spin = S[OWN_FRICTION + j], spin_of(S, j, laws)
        mu = laws.friction_scale * (own if own != 0 else C[i, FACTOR])
        factor_around = own if own != 0 else C[i, FACTOR_AROUND]
        mu_around = limit_around(laws.orthotropic, laws.friction_scale, factor_around, 1.0)
        along, around, climb = shares(laws.friction, laws.speed, S[RADIUS + j] * spin, mu, mu_around)
        if laws.geometry == OPEN or side == 0:
            side, ux, uy, uz = 0.0, 0.0, 0.0, 0.0
        else:
            # With law coulomb a turning string climbs the wall until friction and normal force together
            # carry the lateral load.
            norm = 1 / np.sqrt(1 + climb * climb)
            ux, uy, uz = norm * qx / side, norm * qy / side, norm * qz / side
            cx, cy, cz = cross(tx, ty, tz, ux, uy, uz)
            ux, uy, uz = ux - climb * cx, uy - climb * cy, uz - climb * cz
            side *= norm
        hole = C[i, HOLE_RADIUS]
        if laws.geometry == SAMPLED:
            hole = sampled_wall(C, i, x + hole * ux, y + hole * uy, z + hole * uz, S[RADIUS + j]).hole
        out = hole - radius[j - 1] + side / (C[i, STIFFNESS] * S[TRIBUTARY + j])
        G[j, OFFSET], G[j, OFFSET + 1], G[j, OFFSET + 2] = out * ux, out * uy, out * uz
        held, held_about = starting(S, j, C, i, laws)
        tension -= along * side + held
        torque += around * side * S[RADIUS + j] + S[MUD_SPIN + j] * spin + held_about
        torque -= laws.given * S[GIVEN_TORQUE + j]
        G[j, TENSION], G[j, TORQUE] = tension, torque
        tension += S[WEIGHT + j] * az - S[MUD_AXIAL + j] * laws.speed + laws.given * S[GIVEN_FORCE + j]
        bx, by, bz = ax, ay, az
    G[0, TENSION], G[0, TORQUE] = tension, torque


@kernel
def lay_chain(S, n, C, geometry, G, seed, P):
    """Fill P (n + 1, POSE): each body from the node above to its own, stretched by the tension, twist-free.

    The chain keeps its length in bends and on the wall: the lower node slides along the hole until the length fits.
    seed : lateral imperfection [m], so that a straight string may buckle; smaller where the clearance is small.
    """
    i = piece_at(C, 0, G[0, MD])
    x, y, z, ax, ay, az = axis_at(C, geometry, i, G[0, MD])
    norm = np.sqrt(2 + 2 * az)
    P[0, 0], P[0, 1], P[0, 2] = x, y, z
    if norm > 1e-6:
        P[0, 3], P[0, 4], P[0, 5], P[0, 6] = (1 + az) / norm, -ay / norm, ax / norm, 0.0
    else:
        P[0, 3], P[0, 4], P[0, 5], P[0, 6] = 0.0, 1.0, 0.0, 0.0
    P[0, SPIN] = 0.0
    for j in range(1, n + 1):
        length = S[ARM_TOP + j] + S[ARM_BOTTOM + j]
        stretch = G[j - 1, TENSION] / S[K_AXIAL + j]
        wanted = length + stretch
        md = G[j - 1, MD] + wanted
        nx, ny, nz, bx, by, bz, have = x, y, z, ax, ay, az, wanted
        for _ in range(3):
            i = piece_at(C, i, md)
            nx, ny, nz, tx, ty, tz = axis_at(C, geometry, i, md)
            ox, oy, oz = G[j, OFFSET], G[j, OFFSET + 1], G[j, OFFSET + 2]
            along = ox * tx + oy * ty + oz * tz
            # A spiral of the seed's size with a turn in some twenty bodies prefers no direction.
            room = min(seed, max(0.1 * (C[i, HOLE_RADIUS] - S[RADIUS + j]), 0.001 * seed))
            nx += ox - along * tx + room * np.cos(0.3 * j)
            ny += oy - along * ty + room * np.sin(0.3 * j)
            nz += oz - along * tz
            bx, by, bz = nx - x, ny - y, nz - z
            have = np.sqrt(bx * bx + by * by + bz * bz)
            md += wanted - have
        G[j, MD] = md
        bx, by, bz = bx / have, by / have, bz / have
        arm = S[ARM_BOTTOM + j]
        P[j, 0], P[j, 1], P[j, 2] = nx - arm * bx, ny - arm * by, nz - arm * bz
        # The shortest rotation from the axis above to this one keeps the frame without twist.
        w = 1 + ax * bx + ay * by + az * bz
        cx, cy, cz = cross(ax, ay, az, bx, by, bz)
        pw, px, py, pz = quaternion(P, j - 1)
        qw = w * pw - cx * px - cy * py - cz * pz
        qx = w * px + cx * pw + cy * pz - cz * py
        qy = w * py - cx * pz + cy * pw + cz * px
        qz = w * pz + cx * py - cy * px + cz * pw
        norm = 1 / np.sqrt(qw * qw + qx * qx + qy * qy + qz * qz)
        P[j, 3], P[j, 4], P[j, 5], P[j, 6] = norm * qw, norm * qx, norm * qy, norm * qz
        P[j, SPIN] = P[j - 1, SPIN] - G[j - 1, TORQUE] / S[K_TWIST + j]
        x, y, z, ax, ay, az = nx, ny, nz, bx, by, bz


@entry
def guess(S, n, C, laws, top_md, bit_tension, radius, seed, G, P):
    """Fill nodes G (n + 1, NODE) and pose P (n + 1, POSE) with a first guess of the steady string."""
    soft_string(S, n, C, laws, top_md, bit_tension, radius, G)
    lay_chain(S, n, C, laws.geometry, G, seed, P)


@entry
def lay_guess(S, n, C, geometry, G, P):
    """Fill pose P (n + 1, POSE) from nodes G (n + 1, NODE) as they are, without an imperfection."""
    lay_chain(S, n, C, geometry, G, 0.0, P)


@entry
def find_owners(C, n, G, owner):
    """Fill the pieces of hole (n + 1,) in which the nodes G lie."""
    i = 0
    for j in range(1, n + 1):
        i = piece_at(C, i, G[j, MD])
        owner[j] = i
