"""Stages 2 and 3 of the contact algorithm (§4.2–4.4): the piece of hole that owns a point, and the wall there.

A hole is a table with one row per piece, cylinder or arc, columns below.  The owner of a point is the first
piece from the top whose lower end lies beyond the point, as in the paper's FOR-loop, but found by walking
from the piece that owned it last.  The walk costs the same for a hundred cylinders as for a hundred
thousand, and it never reaches distant pieces of the well whose infinite slab may also contain the point.
"""

from typing import NamedTuple

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.rotations import arctan_ratio
from fctd.mechanics.state import CYLINDERS, TINY

# Columns of both tables.  Start point A [m], unit axis (arcs: tangent) at A, length including the overlap
# [m], hole radius [m], wall stiffness [N/m or N/m/m], friction factor along the string, measured depth of A [m].
START, DIRECTION, LENGTH = 0, 3, 6
HOLE_RADIUS, STIFFNESS, FACTOR, START_MD = 7, 8, 9, 10
# Cylinders: the length shared with the next one [m], and the distances from A between which the wall depends on
# this cylinder alone [m]; infinite at the ends of the hole.
OVERLAP, ALONE_FROM, ALONE_TO = 11, 12, 13
# Arcs: curvature [1/m], unit vector from A towards the centre of curvature, and the gains of radius,
# stiffness and friction per metre along the piece (a shoe between two sizes of hole) [1/m]; cosine of half the arc's
# angle, and its sine over the curvature [m].
CURVATURE, NORMAL = 11, 12
RADIUS_GAIN, STIFFNESS_GAIN, FACTOR_GAIN = 15, 16, 17
HALF_COS, HALF_SINE = 18, 19
# Both tables: excess of the static over the kinetic friction factor, as a share of it; speed at which half of it is
# left [m/s]; pressure of the mud beyond that of the rock, 0 where the wall lets no mud pass [Pa].
STATIC_EXCESS, DECAY_SPEED, OVERBALANCE = 20, 21, 22
# Both tables: friction factor around the string; arcs: its gain along the piece [1/m].
FACTOR_AROUND, GAIN_AROUND = 23, 24
COLUMNS = 25


@inlined
def distance_along(C, i, x, y, z):
    """λ|AB| of Eqs 5 and 14: distance of T past A along the axis of piece i [m]."""
    return (
        (x - C[i, START]) * C[i, DIRECTION]
        + (y - C[i, START + 1]) * C[i, DIRECTION + 1]
        + (z - C[i, START + 2]) * C[i, DIRECTION + 2]
    )


@inlined
def cylinder_owner(C, i, x, y, z):
    """Stage 2 for cylinders: walk from piece i to the first one whose far end T has not passed."""
    while i > 0 and distance_along(C, i - 1, x, y, z) <= C[i - 1, LENGTH]:
        i -= 1
    while i < C.shape[0] - 1 and distance_along(C, i, x, y, z) > C[i, LENGTH]:
        i += 1
    return i


@inlined
def arc_owner(C, i, x, y, z):
    """Stage 2 for arcs: walk from piece i to the one between whose end planes T lies."""
    while i > 0 and distance_along(C, i, x, y, z) < 0:
        i -= 1
    while i < C.shape[0] - 1 and distance_along(C, i + 1, x, y, z) >= 0:
        i += 1
    return i


@inlined
def owner_of(C, i, geometry, x, y, z):
    """Stage 2: the piece that owns T, by a walk from piece i."""
    if geometry == CYLINDERS:
        return cylinder_owner(C, i, x, y, z)
    return arc_owner(C, i, x, y, z)


@inlined
def axis_offset(C, i, x, y, z):
    """PT (Eqs 13–14): vector from the axis of cylinder i to T, and the distance along it [m]."""
    s = distance_along(C, i, x, y, z)
    return (
        x - C[i, START] - s * C[i, DIRECTION],
        y - C[i, START + 1] - s * C[i, DIRECTION + 1],
        z - C[i, START + 2] - s * C[i, DIRECTION + 2],
        s,
    )


@inlined
def cylinder_wall(C, i, x, y, z):
    """Stage 3 for cylinders: PT [m], hole radius [m], wall stiffness, friction factor along the string, depth [m] at T,
    friction factor around the string.

    In the overlap the penetrations, each against its own radius, the radial vectors, stiffness and friction
    are blended (Eq. 24 with lengths in place of Q); the radius returned makes |PT| − radius the blend.
    """
    px, py, pz, s = axis_offset(C, i, x, y, z)
    hole, stiffness, friction, around = C[i, HOLE_RADIUS], C[i, STIFFNESS], C[i, FACTOR], C[i, FACTOR_AROUND]
    md = C[i, START_MD] + s
    into = s - C[i, ALONE_TO]
    if into > 0:
        qx, qy, qz, along = axis_offset(C, i + 1, x, y, z)
        v = into / C[i, OVERLAP]
        u = 1 - v
        excess = u * (root(px * px + py * py + pz * pz) - hole)
        excess += v * (root(qx * qx + qy * qy + qz * qz) - C[i + 1, HOLE_RADIUS])
        px, py, pz = u * px + v * qx, u * py + v * qy, u * pz + v * qz
        hole = root(px * px + py * py + pz * pz) - excess
        stiffness = u * stiffness + v * C[i + 1, STIFFNESS]
        friction = u * friction + v * C[i + 1, FACTOR]
        around = u * around + v * C[i + 1, FACTOR_AROUND]
        md = u * md + v * (C[i + 1, START_MD] + along)
    return px, py, pz, hole, stiffness, friction, md, around


@inlined
def rise_in_overlap(C, i, x, y, z, radius):
    """How the wall's energy ½K d² rises with the place of T in the overlap of cylinders i and i + 1, over K d.

    Eq. 24 blends penetration d and stiffness K by the distance along cylinder i, so both change along it too: the
    gradient (3) of d, to which ½ d ∇K/K is added; for a wall of another power the latter is not exact.
    """
    px, py, pz, s = axis_offset(C, i, x, y, z)
    qx, qy, qz, _ = axis_offset(C, i + 1, x, y, z)
    p, q = root(px * px + py * py + pz * pz), root(qx * qx + qy * qy + qz * qz)
    first, second = p - C[i, HOLE_RADIUS], q - C[i + 1, HOLE_RADIUS]
    share = 1 / C[i, OVERLAP]
    v = share * (s - C[i, ALONE_TO])
    u, gain = 1 - v, C[i + 1, STIFFNESS] - C[i, STIFFNESS]
    stiffer = gain * (u * first + v * second + radius) / (2 * (C[i, STIFFNESS] + v * gain))
    along = share * (second - first + stiffer)
    a, b = u / (p + TINY), v / (q + TINY)
    return (
        a * px + b * qx + along * C[i, DIRECTION],
        a * py + b * qy + along * C[i, DIRECTION + 1],
        a * pz + b * qz + along * C[i, DIRECTION + 2],
    )


@inlined
def arc_offset(u, v, w, k, tx, ty, tz, nx, ny, nz, bx, by, bz):
    """PT of a circular arc from its closest point, by one formula that stays exact as κ → 0.

    u, v, w : T − A along the tangent, towards the centre and along the binormal [m]; k : curvature κ [1/m].
    With ρ the distance from the centre over the radius, the offset towards the centre is
    (1 − ρ)/κ = (2v − κ(u² + v²))/(1 + ρ).  Returns PT [m], the sine and cosine (times ρ) of the angle, and ρ.
    """
    cosine, sine = 1 - k * v, k * u
    rho = root(cosine * cosine + sine * sine)
    inward = (2 * v - k * (u * u + v * v)) * reciprocal(rho + rho * rho)
    p, q = -inward * sine, inward * cosine
    return p * tx + q * nx + w * bx, p * ty + q * ny + w * by, p * tz + q * nz + w * bz, sine, cosine, rho


class Arc(NamedTuple):
    """A row of the table of arcs as scalars, which a packed loop needs; columns above."""

    x: float
    y: float
    z: float
    tx: float
    ty: float
    tz: float
    length: float
    hole: float
    stiffness: float
    friction: float
    md: float
    curvature: float
    nx: float
    ny: float
    nz: float
    hole_gain: float
    stiffness_gain: float
    friction_gain: float
    half_cos: float
    half_sine: float
    around: float
    around_gain: float


@inlined
def read_arc(C, i):
    """Row i of a table of arcs."""
    return Arc(
        C[i, 0], C[i, 1], C[i, 2], C[i, 3], C[i, 4], C[i, 5], C[i, 6], C[i, 7], C[i, 8], C[i, 9],
        C[i, 10], C[i, 11], C[i, 12], C[i, 13], C[i, 14], C[i, 15], C[i, 16], C[i, 17], C[i, 18], C[i, 19],
        C[i, 23], C[i, 24],
    )  # fmt: skip


@inlined
def place_on_arc(arc, x, y, z):
    """PT [m] of an arc, the distance of its closest point along it [m]; sine, cosine and ρ of ``arc_offset``."""
    dx, dy, dz = x - arc.x, y - arc.y, z - arc.z
    tx, ty, tz, nx, ny, nz, k = arc.tx, arc.ty, arc.tz, arc.nx, arc.ny, arc.nz, arc.curvature
    bx, by, bz = cross(tx, ty, tz, nx, ny, nz)
    u = dx * tx + dy * ty + dz * tz
    v = dx * nx + dy * ny + dz * nz
    w = dx * bx + dy * by + dz * bz
    px, py, pz, sine, cosine, rho = arc_offset(u, v, w, k, tx, ty, tz, nx, ny, nz, bx, by, bz)
    # Arc length from the middle of the piece, angle/κ by the tangent of half the angle, so that κ may be 0.
    past_middle = arc.half_cos * u - arc.half_sine * cosine
    along = past_middle * reciprocal(arc.half_cos * cosine + k * arc.half_sine * sine + rho)
    s = 0.5 * arc.length + 2 * along * arctan_ratio(k * along * k * along)
    return px, py, pz, s, sine, cosine, rho


@inlined
def sizes_of_arc(arc, s):
    """Hole radius [m], wall stiffness, friction factors along and around the string, a distance s [m] along an arc."""
    within = 0.0 if s < 0 else s
    within = arc.length if s > arc.length else within
    hole = arc.hole + within * arc.hole_gain
    stiffness = arc.stiffness + within * arc.stiffness_gain
    friction = arc.friction + within * arc.friction_gain
    around = arc.around + within * arc.around_gain
    return hole, stiffness, friction, around


@inlined
def wall_of_arc(arc, x, y, z):
    """Stage 3 for arcs: what ``cylinder_wall`` returns."""
    px, py, pz, s, _, _, _ = place_on_arc(arc, x, y, z)
    hole, stiffness, friction, around = sizes_of_arc(arc, s)
    return px, py, pz, hole, stiffness, friction, arc.md + s, around


@inlined
def arc_wall(C, i, x, y, z):
    """``wall_of_arc`` for row i of the table."""
    return wall_of_arc(read_arc(C, i), x, y, z)


@inlined
def arc_direction(C, i, x, y, z):
    """Unit vector along arc i at its point nearest to (x, y, z)."""
    dx, dy, dz = x - C[i, START], y - C[i, START + 1], z - C[i, START + 2]
    tx, ty, tz = C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2]
    nx, ny, nz = C[i, NORMAL], C[i, NORMAL + 1], C[i, NORMAL + 2]
    sine = C[i, CURVATURE] * (dx * tx + dy * ty + dz * tz)
    cosine = 1 - C[i, CURVATURE] * (dx * nx + dy * ny + dz * nz)
    k = reciprocal(root(cosine * cosine + sine * sine))
    sine, cosine = k * sine, k * cosine
    return cosine * tx + sine * nx, cosine * ty + sine * ny, cosine * tz + sine * nz
