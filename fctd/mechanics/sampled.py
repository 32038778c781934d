"""Holes that are no circle: how far the wall lies beyond the round hole, over measured depth and angle.

The table of pieces is that of arcs, cut into short pieces, the cells.  Further columns hold for each of them how far
the wall lies beyond the round hole of its interval at equal angles around it, for each contact radius of the string: a
disc of this radius whose centre has come to the hole's radius and that, less its own radius, touches the wall.  So a
point of a string needs no search around the hole, also where its disc touches at two places, as in a groove that is
narrower than itself.  There the friction of both is that of more than the force that they add up to: ``grip``.  It
drags along the hole and turns the string in full.  Around the hole both add up to what that force alone would have:
each friction is across its own normal, so their sum is across the sum of the normal forces.

Between cells the deviation is a quadratic B-spline in depth and angle, whose slope is continuous.  Angles count from a
direction that goes with the hole without turning about it (Bishop 1975), clockwise looking downhole.
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.contact import COLUMNS, LENGTH, place_on_arc, read_arc, sizes_of_arc
from fctd.mechanics.dual import root
from fctd.mechanics.jit import inlined, kernel
from fctd.mechanics.joints import cross

# Columns beside those of arcs: cosine and sine of the angle from the arc's normal to the direction from which angles
# count; number of cells around the hole, 0 where it is round; and then tables.
TURN_COS, TURN_SIN, AROUND_CELLS = COLUMNS, COLUMNS + 1, COLUMNS + 2
TABLES = COLUMNS + 3
# Columns of a table: the contact radius [m], and of each cell around the hole the deviation [m], and the corner of
# ``disc.roll_disc`` there, two angles [rad].
PER_CELL = 3
# Radii differ by more than this [m].
SAME_RADIUS = 1e-7


class Place(NamedTuple):
    """A point beside its arc.

    PT (3) [m]; s : along the piece [m]; share : by how much s grows with a way along the hole there; a, b : across the
    hole, from the axis along the direction from which angles count and at a right angle to it [m]; the direction (3) of
    the hole, the two directions (3) across it, and that (3) towards the centre of the arc.
    """

    px: float
    py: float
    pz: float
    s: float
    share: float
    a: float
    b: float
    tx: float
    ty: float
    tz: float
    ax: float
    ay: float
    az: float
    bx: float
    by: float
    bz: float
    mx: float
    my: float
    mz: float


@inlined
def place_beside(C, i, arc, x, y, z):
    """The place of a point beside piece i, which is an arc."""
    px, py, pz, s, sine, cosine, rho = place_on_arc(arc, x, y, z)
    share = 1 / rho
    sine, cosine = share * sine, share * cosine
    tx, ty, tz = cosine * arc.tx + sine * arc.nx, cosine * arc.ty + sine * arc.ny, cosine * arc.tz + sine * arc.nz
    mx, my, mz = cosine * arc.nx - sine * arc.tx, cosine * arc.ny - sine * arc.ty, cosine * arc.nz - sine * arc.tz
    ux, uy, uz = cross(arc.tx, arc.ty, arc.tz, arc.nx, arc.ny, arc.nz)
    c, d = C[i, TURN_COS], C[i, TURN_SIN]
    ax, ay, az = c * mx + d * ux, c * my + d * uy, c * mz + d * uz
    bx, by, bz = c * ux - d * mx, c * uy - d * my, c * uz - d * mz
    a, b = px * ax + py * ay + pz * az, px * bx + py * by + pz * bz
    return Place(px, py, pz, s, share, a, b, tx, ty, tz, ax, ay, az, bx, by, bz, mx, my, mz)


class Deviation(NamedTuple):
    """How far the wall lies beyond the round hole [m], with its derivatives by the distance along the hole and by the
    angle [rad], first and second; and the column of the cell's corner, with the weights of the rows above and below and
    their slopes."""

    value: float
    by_s: float
    by_angle: float
    by_ss: float
    by_s_angle: float
    by_angles: float
    column: int
    first: float
    third: float
    falls: float
    rises: float


@inlined
def table_of(C, i, cells, radius):
    """Column of the first deviation for a contact radius [m]: of the smallest table's that is no smaller."""
    at, size = TABLES, 1 + PER_CELL * cells
    while C[i, at] < radius - SAME_RADIUS and at + 2 * size <= C.shape[1]:
        at += size
    return at + 1


@inlined
def wrapped(k, cells):
    """A number of a cell around the hole, of one from −cells to 2 cells − 1."""
    k = k + cells if k < 0 else k
    return k - cells if k >= cells else k


@inlined
def along(upper, own, lower, first, third):
    """A value between cells, of those above and below and this one, by the weights of the first and the third."""
    return own + first * (upper - own) + third * (lower - own)


@inlined
def along_slope(upper, own, lower, first, third):
    """The slope of a value between cells, by the slopes of the weights."""
    return first * (upper - own) + third * (lower - own)


@inlined
def of_row(C, i, columns, weights):
    """A value around the hole, of three cells of row i."""
    return weights[0] * C[i, columns[0]] + weights[1] * C[i, columns[1]] + weights[2] * C[i, columns[2]]


@inlined
def deviation_at(C, i, s, a, b, radius):
    """The deviation for a contact radius [m] beside piece i, a distance s [m] along it and at the direction (a, b)."""
    cells, length = int(C[i, AROUND_CELLS]), C[i, LENGTH]
    at = table_of(C, i, cells, radius)
    above, below = max(i - 1, 0), min(i + 1, C.shape[0] - 1)
    # Weights of the cells above and below, of pieces that may differ in length; then their slopes.
    u = min(max(s / length, 0.0), 1.0)
    p, q = length / (C[above, LENGTH] + length), length / (length + C[below, LENGTH])
    first, third = p * (1 - u) * (1 - u), q * u * u
    falls, rises = -2 * p * (1 - u) / length, 2 * q * u / length
    per_angle = cells / (2 * np.pi)
    around = np.arctan2(b, a) * per_angle + 0.5
    k = int(np.floor(around))
    t = around - k
    own = at + PER_CELL * wrapped(k, cells)
    columns = at + PER_CELL * wrapped(k - 1, cells), own, at + PER_CELL * wrapped(k + 1, cells)
    weights = 0.5 * (1 - t) * (1 - t), 0.5 + t - t * t, 0.5 * t * t
    slopes = per_angle * (t - 1), per_angle * (1 - 2 * t), per_angle * t
    bends = per_angle * per_angle, -2 * per_angle * per_angle, per_angle * per_angle
    values = of_row(C, above, columns, weights), of_row(C, i, columns, weights), of_row(C, below, columns, weights)
    turned = of_row(C, above, columns, slopes), of_row(C, i, columns, slopes), of_row(C, below, columns, slopes)
    bent = of_row(C, above, columns, bends), of_row(C, i, columns, bends), of_row(C, below, columns, bends)
    return Deviation(
        value=along(*values, first, third),
        by_s=along_slope(*values, falls, rises),
        by_angle=along(*turned, first, third),
        by_ss=along_slope(*values, 2 * p / (length * length), 2 * q / (length * length)),
        by_s_angle=along_slope(*turned, falls, rises),
        by_angles=along(*bent, first, third),
        column=own + 1,
        first=first,
        third=third,
        falls=falls,
        rises=rises,
    )


@inlined
def grip_at(C, i, column, angle):
    """The grip of a corner in row i for a force at an angle [rad], less 1, and its derivative by the angle.

    A disc that touches two places is pressed onto each by more than the force that holds it there: with the two normals
    at β to either side of their middle, and the force at δ from it, both are cos δ/cos β times as large together.  The
    force is the sum of the two, without the friction.
    """
    half = C[i, column + 1]
    if half == 0:
        return 0.0, 0.0
    off = angle - C[i, column]
    off -= 2 * np.pi * np.floor(off / (2 * np.pi) + 0.5)
    if abs(off) >= half:
        return 0.0, 0.0
    return np.cos(off) / np.cos(half) - 1, -np.sin(off) / np.cos(half)


@inlined
def grip_of(C, i, found, ga, gb):
    """By which factor the friction of a disc exceeds that of the force (ga, gb) that holds it.

    Returns it with its derivatives by the force's angle [rad] and by the distance along the hole [m].
    """
    column = found.column
    above, below = max(i - 1, 0), min(i + 1, C.shape[0] - 1)
    if C[above, column + 1] == 0 and C[i, column + 1] == 0 and C[below, column + 1] == 0:
        return 1.0, 0.0, 0.0
    angle = np.arctan2(gb, ga)
    upper, upper_turned = grip_at(C, above, column, angle)
    own, own_turned = grip_at(C, i, column, angle)
    lower, lower_turned = grip_at(C, below, column, angle)
    return (
        1 + along(upper, own, lower, found.first, found.third),
        along(upper_turned, own_turned, lower_turned, found.first, found.third),
        along_slope(upper, own, lower, found.falls, found.rises),
    )  # fmt: skip


class SampledWall(NamedTuple):
    """The wall beside a point: PT (3) [m], hole radius [m], stiffness, friction factors along and around the string,
    measured depth [m]; gradient (3) of the penetration, where that is not along PT; ``friction.Sliding.net``."""

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
    net: float


@kernel
def sampled_wall(C, i, x, y, z, radius):
    """Stage 3 in a sampled hole: the wall of piece i beside a point of a string with a contact radius [m]."""
    arc = read_arc(C, i)
    of = place_beside(C, i, arc, x, y, z)
    px, py, pz, md = of.px, of.py, of.pz, arc.md + of.s
    hole, stiffness, friction, around = sizes_of_arc(arc, of.s)
    if C[i, AROUND_CELLS] == 0:
        return SampledWall(px, py, pz, hole, stiffness, friction, around, md, px, py, pz, 1.0)
    found = deviation_at(C, i, of.s, of.a, of.b, radius)
    gx, gy, gz, grip = px, py, pz, 1.0
    square = of.a * of.a + of.b * of.b
    if square > 0:
        # ∇d = e_ρ − (∂δ/∂φ) e_φ/ρ − (∂δ/∂s) t, of a penetration d = ρ − R − δ(s, φ) + r.
        k, turn, rise = 1 / root(square), found.by_angle / square, found.by_s * of.share
        ga, gb = k * of.a + turn * of.b, k * of.b - turn * of.a
        grip, _, _ = grip_of(C, i, found, ga, gb)
        gx = ga * of.ax + gb * of.bx - rise * of.tx
        gy = ga * of.ay + gb * of.by - rise * of.ty
        gz = ga * of.az + gb * of.bz - rise * of.tz
    return SampledWall(
        px, py, pz, hole + found.value, stiffness, grip * friction, grip * around, md, gx, gy, gz, 1 / grip
    )
