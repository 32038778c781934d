"""Holes that are no circle: how far the wall lies beyond the round hole, over measured depth and angle.

The table of pieces is that of arcs, cut into short pieces, the cells.  Further columns hold for each of them how far
the wall lies beyond the round hole of its interval at equal angles around it, for each contact radius of the string: a
disc of this radius whose centre has come to the hole's radius and that, less its own radius, touches the wall.  So a
point of a string needs no search around the hole, also where its disc touches at two places, as in a groove that is
narrower than itself.  There the friction of both is that of more than the force that they add up to: ``grip``.

Between cells the deviation is a quadratic B-spline in depth and angle, whose slope is continuous.  Angles count from a
direction that goes with the hole without turning about it (Bishop 1975), clockwise looking downhole.
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.contact import COLUMNS, CURVATURE, DIRECTION, LENGTH, NORMAL, START_MD, arc_direction, arc_wall
from fctd.mechanics.dual import root
from fctd.mechanics.jit import inlined, kernel
from fctd.mechanics.joints import cross

# Columns beside those of arcs: cosine and sine of the angle from the arc's normal to the direction from which angles
# count; number of cells around the hole, 0 where it is round; and then tables.
TURN_COS, TURN_SIN, AROUND_CELLS = COLUMNS, COLUMNS + 1, COLUMNS + 2
TABLES = COLUMNS + 3
# Columns of a table, beside a column for each cell around the hole: the contact radius [m], deviations [m], grips.
# Radii differ by more than this [m].
SAME_RADIUS = 1e-7


class Place(NamedTuple):
    """A point beside its arc.

    a, b : across the hole, from the axis along the direction from which angles count and at a right angle to it [m];
    s : along the piece [m]; share : by how much s grows with a way along the hole there; the direction (3) of the hole,
    and the two directions (3) across it.
    """

    a: float
    b: float
    s: float
    share: float
    tx: float
    ty: float
    tz: float
    ax: float
    ay: float
    az: float
    bx: float
    by: float
    bz: float


@inlined
def place_beside(C, i, x, y, z, px, py, pz, md):
    """The place beside piece i of a point at (x, y, z), given PT (3) [m] and its measured depth [m]."""
    tx, ty, tz = arc_direction(C, i, x, y, z)
    # The binormal is that of the whole arc.
    ux, uy, uz = cross(
        C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2], C[i, NORMAL], C[i, NORMAL + 1], C[i, NORMAL + 2]
    )
    mx, my, mz = cross(ux, uy, uz, tx, ty, tz)
    c, d = C[i, TURN_COS], C[i, TURN_SIN]
    ax, ay, az = c * mx + d * ux, c * my + d * uy, c * mz + d * uz
    bx, by, bz = c * ux - d * mx, c * uy - d * my, c * uz - d * mz
    share = 1 / (1 - C[i, CURVATURE] * (px * mx + py * my + pz * mz))
    return Place(
        px * ax + py * ay + pz * az, px * bx + py * by + pz * bz, md - C[i, START_MD], share,
        tx, ty, tz, ax, ay, az, bx, by, bz,
    )  # fmt: skip


class Deviation(NamedTuple):
    """How far the wall lies beyond the round hole [m], with its derivatives by the distance along the hole and by the
    angle [rad], first and second; and the grip with its first ones."""

    value: float
    by_s: float
    by_angle: float
    by_ss: float
    by_s_angle: float
    by_angles: float
    grip: float
    grip_by_s: float
    grip_by_angle: float


@inlined
def table_of(C, i, cells, radius):
    """Column of the first deviation for a contact radius [m]: of the smallest table's that is no smaller."""
    at, size = TABLES, 1 + 2 * cells
    while C[i, at] < radius - SAME_RADIUS and at + 2 * size <= C.shape[1]:
        at += size
    return at + 1


@kernel
def deviation_at(C, i, s, a, b, radius):
    """The deviation for a contact radius [m] beside piece i, a distance s [m] along it and at the direction (a, b)."""
    cells = int(C[i, AROUND_CELLS])
    at = table_of(C, i, cells, radius)
    above, below = max(i - 1, 0), min(i + 1, C.shape[0] - 1)
    length = C[i, LENGTH]
    u = min(max(s / length, 0.0), 1.0)
    p, q = length / (C[above, LENGTH] + length), length / (length + C[below, LENGTH])
    first, third = p * (1 - u) ** 2, q * u * u
    first_slope, third_slope = -2 * p * (1 - u) / length, 2 * q * u / length
    first_bend, third_bend = 2 * p / (length * length), 2 * q / (length * length)
    per_angle = cells / (2 * np.pi)
    around = np.arctan2(b, a) * per_angle + 0.5
    k = int(np.floor(around))
    t = around - k
    before, here, after = 0.5 * (1 - t) ** 2, 0.5 + t - t * t, 0.5 * t * t
    value = by_s = by_angle = by_ss = by_s_angle = by_angles = grip = grip_by_s = grip_by_angle = 0.0
    for step in range(3):
        column = at + (k + step - 1 + cells) % cells
        weight = before if step == 0 else here if step == 1 else after
        slope = per_angle * (t - 1 if step == 0 else 1 - 2 * t if step == 1 else t)
        bend = per_angle * per_angle * (-2.0 if step == 1 else 1.0)
        upper, own, lower = C[above, column], C[i, column], C[below, column]
        along = own + first * (upper - own) + third * (lower - own)
        along_slope = first_slope * (upper - own) + third_slope * (lower - own)
        value += weight * along
        by_s += weight * along_slope
        by_angle += slope * along
        by_ss += weight * (first_bend * (upper - own) + third_bend * (lower - own))
        by_s_angle += slope * along_slope
        by_angles += bend * along
        upper, own, lower = C[above, column + cells], C[i, column + cells], C[below, column + cells]
        along = own + first * (upper - own) + third * (lower - own)
        grip += weight * along
        grip_by_s += weight * (first_slope * (upper - own) + third_slope * (lower - own))
        grip_by_angle += slope * along
    return Deviation(value, by_s, by_angle, by_ss, by_s_angle, by_angles, grip, grip_by_s, grip_by_angle)


class SampledWall(NamedTuple):
    """The wall beside a point: PT (3) [m], hole radius [m], stiffness, friction factors along and around the string,
    measured depth [m]; and the gradient (3) of the penetration, where that is not along PT."""

    px: float
    py: float
    pz: float
    hole: float
    stiffness: float
    friction: float
    around: float
    md: float
    gx: float
    gy: float
    gz: float


@kernel
def sampled_wall(C, i, x, y, z, radius):
    """Stage 3 in a sampled hole: the wall of piece i beside a point of a string with a contact radius [m]."""
    px, py, pz, hole, stiffness, friction, md, around = arc_wall(C, i, x, y, z)
    if C[i, AROUND_CELLS] == 0:
        return SampledWall(px, py, pz, hole, stiffness, friction, around, md, px, py, pz)
    of = place_beside(C, i, x, y, z, px, py, pz, md)
    found = deviation_at(C, i, of.s, of.a, of.b, radius)
    distance = root(of.a * of.a + of.b * of.b)
    grip = 1 + found.grip
    gx, gy, gz = px, py, pz
    if distance > 0:
        # ∇d = e_ρ − (∂δ/∂φ) e_φ/ρ − (∂δ/∂s) t, of a penetration d = ρ − R − δ(s, φ) + r.
        turn = found.by_angle / (distance * distance)
        ga, gb = of.a / distance + turn * of.b, of.b / distance - turn * of.a
        along = found.by_s * of.share
        gx = ga * of.ax + gb * of.bx - along * of.tx
        gy = ga * of.ay + gb * of.by - along * of.ty
        gz = ga * of.az + gb * of.bz - along * of.tz
    return SampledWall(
        px, py, pz, hole + found.value, stiffness, grip * friction, grip * around, md, gx, gy, gz
    )  # fmt: skip
