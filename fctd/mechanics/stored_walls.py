"""The walls beside the contact points of a string in motion, by the stages of contact.py.

Every contact point keeps a copy of its piece in the state buffer.  While the point stays well inside the
piece, stages 2 and 3 are then packed arithmetic and one comparison; only a point near the ends of its
piece, or in an overlap, is looked up in the table again.
"""

import numpy as np

from fctd.mechanics.contact import (
    ALONE_FROM,
    ALONE_TO,
    CURVATURE,
    DECAY_SPEED,
    DIRECTION,
    FACTOR_GAIN,
    GAIN_AROUND,
    LENGTH,
    NORMAL,
    RADIUS_GAIN,
    START,
    STATIC_EXCESS,
    STIFFNESS_GAIN,
    arc_offset,
    arc_owner,
    arc_wall,
    cylinder_owner,
    cylinder_wall,
    distance_along,
    rise_in_overlap,
)
from fctd.mechanics.dual import root
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.joints import cross
from fctd.mechanics.own_contact import has_bows, has_own_contact, store_own_contact
from fctd.mechanics.sampled import AROUND_CELLS, sampled_wall
from fctd.mechanics.state import (
    ARCS,
    CURVE,
    CYLINDERS,
    DECAY,
    END_COS,
    END_SIN,
    EXCESS,
    FRICTION,
    FRICTION_AROUND,
    HOLE,
    K_WALL,
    MARGIN_END,
    MARGIN_TOP,
    NET,
    NX,
    NY,
    NZ,
    OX,
    OY,
    OZ,
    PX,
    PY,
    PZ,
    RADIUS,
    SAMPLED,
    SLACK,
    TRIBUTARY,
    TX,
    TY,
    TZ,
    contact_point,
    radial,
)


@inlined
def store_wall(S, j, px, py, pz, hole, stiffness, friction, around):
    """Write the wall beside contact point j; friction, around : factors along and around the string."""
    S[PX + j], S[PY + j], S[PZ + j], S[HOLE + j] = px, py, pz, hole
    S[K_WALL + j], S[FRICTION + j], S[FRICTION_AROUND + j] = stiffness * S[TRIBUTARY + j], friction, around


@inlined
def store_sticking(S, j, excess, decay):
    """Write what friction that sticks needs beside contact point j."""
    S[EXCESS + j], S[DECAY + j] = excess, decay


@inlined
def lean_wall(S, j, gx, gy, gz):
    """Turn the wall stored beside point j so that its force is −K d g where it presses, and its energy ½K d² still.

    PT keeps its length and takes the direction of g.  The wall is d/|g| deep across itself, with the stiffness K|g|².
    """
    px, py, pz = radial(S, j)
    distance, square = root(px * px + py * py + pz * pz), gx * gx + gy * gy + gz * gz
    depth = distance - S[HOLE + j] + S[RADIUS + j]
    if depth > 0 and square > 0:
        k = 1 / root(square)
        S[PX + j], S[PY + j], S[PZ + j] = k * distance * gx, k * distance * gy, k * distance * gz
        S[HOLE + j] = distance + S[RADIUS + j] - k * depth
        S[K_WALL + j] *= square


@inlined
def store_cylinder(S, j, C, i, x, y, z):
    """Write the wall of cylinder i beside contact point j at T, and whether no other one has a part in it."""
    px, py, pz, hole, stiffness, friction, _, around = cylinder_wall(C, i, x, y, z)
    store_wall(S, j, px, py, pz, hole, stiffness, friction, around)
    alone = distance_along(C, i, x, y, z) <= C[i, ALONE_TO]
    if not alone and not has_bows(S, j):
        lean_wall(S, j, *rise_in_overlap(C, i, x, y, z, S[RADIUS + j]))
    return alone


@inlined
def store_slack(S, j, start, end):
    """Write how far point j is inside its piece, given its distances past the piece's start and along its end [m]."""
    start, end = start - S[MARGIN_TOP + j], S[MARGIN_END + j] - end
    S[SLACK + j] = start if start < end else end


@kernel
def follow_cylinders(S, n):
    """Update PT of every point from its stored cylinder, and how far inside it the point is."""
    for j in range(1, n + 1):
        x, y, z = contact_point(S, j)
        dx, dy, dz = x - S[OX + j], y - S[OY + j], z - S[OZ + j]
        tx, ty, tz = S[TX + j], S[TY + j], S[TZ + j]
        s = dx * tx + dy * ty + dz * tz
        S[PX + j], S[PY + j], S[PZ + j] = dx - s * tx, dy - s * ty, dz - s * tz
        store_slack(S, j, s, s)


@kernel
def refresh_cylinders(S, owner, n, C):
    """Look up in the table every point that is near an end of its cylinder or in an overlap."""
    for j in range(1, n + 1):
        if S[SLACK + j] > 0:
            continue
        x, y, z = contact_point(S, j)
        i = cylinder_owner(C, owner[j], x, y, z)
        owner[j] = i
        alone = store_cylinder(S, j, C, i, x, y, z)
        if has_own_contact(S, j):
            store_own_contact(S, j)
        store_sticking(S, j, C[i, STATIC_EXCESS], C[i, DECAY_SPEED])
        S[OX + j], S[OY + j], S[OZ + j] = C[i, START], C[i, START + 1], C[i, START + 2]
        S[TX + j], S[TY + j], S[TZ + j] = C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2]
        S[MARGIN_TOP + j] = C[i, ALONE_FROM]
        # A blended wall is valid for this step only; an empty interval makes the next step look it up again.
        S[MARGIN_END + j] = C[i, ALONE_TO] if alone else -np.inf


@kernel
def follow_arcs(S, n):
    """Update PT of every point from its stored arc, and how far inside it the point is."""
    for j in range(1, n + 1):
        x, y, z = contact_point(S, j)
        dx, dy, dz = x - S[OX + j], y - S[OY + j], z - S[OZ + j]
        tx, ty, tz = S[TX + j], S[TY + j], S[TZ + j]
        nx, ny, nz = S[NX + j], S[NY + j], S[NZ + j]
        bx, by, bz = cross(tx, ty, tz, nx, ny, nz)
        u = dx * tx + dy * ty + dz * tz
        v = dx * nx + dy * ny + dz * nz
        w = dx * bx + dy * by + dz * bz
        px, py, pz, _, _, _ = arc_offset(u, v, w, S[CURVE + j], tx, ty, tz, nx, ny, nz, bx, by, bz)
        S[PX + j], S[PY + j], S[PZ + j] = px, py, pz
        store_slack(S, j, u, u * S[END_COS + j] + v * S[END_SIN + j])


@inlined
def store_arc(S, j, C, i, changes):
    """Write the copy of arc i beside point j; changes : whether the wall is another at every place of the arc."""
    S[OX + j], S[OY + j], S[OZ + j] = C[i, START], C[i, START + 1], C[i, START + 2]
    S[TX + j], S[TY + j], S[TZ + j] = C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2]
    S[NX + j], S[NY + j], S[NZ + j] = C[i, NORMAL], C[i, NORMAL + 1], C[i, NORMAL + 2]
    k, length = C[i, CURVATURE], C[i, LENGTH]
    angle = k * length
    S[CURVE + j], S[END_COS + j], S[END_SIN + j] = k, np.cos(angle), np.sin(angle)
    end = np.sin(angle) / k if angle > 1e-6 else length
    end = end if i < C.shape[0] - 1 else np.inf
    S[MARGIN_TOP + j] = 0.0 if i > 0 else -np.inf
    # A wall that changes along its piece is looked up at every step.
    S[MARGIN_END + j] = -np.inf if changes else end


@inlined
def changes_along(C, i):
    """Whether the wall of arc i changes along it."""
    changes = C[i, RADIUS_GAIN] != 0 or C[i, STIFFNESS_GAIN] != 0 or C[i, FACTOR_GAIN] != 0
    return changes | (C[i, GAIN_AROUND] != 0)


@kernel
def refresh_arcs(S, owner, n, C):
    """Look up in the table every point that has left its arc, or lies in an arc whose wall changes along it."""
    for j in range(1, n + 1):
        if S[SLACK + j] > 0:
            continue
        x, y, z = contact_point(S, j)
        i = arc_owner(C, owner[j], x, y, z)
        owner[j] = i
        px, py, pz, hole, stiffness, friction, _, around = arc_wall(C, i, x, y, z)
        store_wall(S, j, px, py, pz, hole, stiffness, friction, around)
        if has_own_contact(S, j):
            store_own_contact(S, j)
        store_sticking(S, j, C[i, STATIC_EXCESS], C[i, DECAY_SPEED])
        store_arc(S, j, C, i, changes_along(C, i))


@kernel
def refresh_sampled(S, owner, n, C):
    """``refresh_arcs`` where the hole is sampled: a point in a cell that is not round is looked up at every step."""
    for j in range(1, n + 1):
        if S[SLACK + j] > 0:
            continue
        x, y, z = contact_point(S, j)
        i = arc_owner(C, owner[j], x, y, z)
        owner[j] = i
        wall = sampled_wall(C, i, x, y, z, S[RADIUS + j])
        store_wall(S, j, wall.px, wall.py, wall.pz, wall.hole, wall.stiffness, wall.friction, wall.around)
        S[NET + j] = wall.net
        is_round = C[i, AROUND_CELLS] == 0
        if not is_round:
            lean_wall(S, j, wall.gx, wall.gy, wall.gz)
        if has_own_contact(S, j):
            store_own_contact(S, j)
        store_sticking(S, j, C[i, STATIC_EXCESS], C[i, DECAY_SPEED])
        store_arc(S, j, C, i, changes_along(C, i) or not is_round)


@entry
def update_walls(S, owner, n, packed, C, geometry):
    """Update owners and the wall beside every contact point, given positions (stages 2 and 3).

    n, packed : bodies, and columns that fill whole packed operations.
    owner : int64 (n + 2,), the last owner of each point; at the first call a piece near the right one.  In a fresh
    buffer (zeros) every point is looked up in the table.
    """
    if geometry == CYLINDERS:
        follow_cylinders(S, packed)
        refresh_cylinders(S, owner, n, C)
    elif geometry == ARCS:
        follow_arcs(S, packed)
        refresh_arcs(S, owner, n, C)
    elif geometry == SAMPLED:
        follow_arcs(S, packed)
        refresh_sampled(S, owner, n, C)
