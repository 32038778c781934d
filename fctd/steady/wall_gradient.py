"""The wall beside a point and its gradient: how it changes as the point moves.

A point that moves by δ moves s = t·δ/ρ along its piece of hole, with t the direction of the hole beside it and ρ its
distance from the centre of an arc over the arc's radius (1 beside a cylinder).  Then PT changes by δ − s t, the
direction by s κ m with m the unit vector towards the centre, and hole radius, stiffness and friction by s times their
gains.  In the overlap of two cylinders all of these are blended, with shares that change along the first one, and the
wall leans as the stepper's does (stored_walls.lean_wall).

A quantity is a tuple of four: its value, and its derivatives by the three components of the point's place.
"""

from typing import Any, NamedTuple

import numpy as np

from fctd.mechanics.contact import (
    ALONE_TO,
    CURVATURE,
    DIRECTION,
    FACTOR,
    FACTOR_AROUND,
    HOLE_RADIUS,
    OVERLAP,
    STIFFNESS,
    arc_direction,
    arc_offset,
    arc_wall,
    axis_offset,
    read_arc,
)
from fctd.mechanics.jit import inlined, kernel
from fctd.mechanics.joints import cross
from fctd.mechanics.own_contact import GAP, has_bows
from fctd.mechanics.sampled import AROUND_CELLS, deviation_at, grip_of, place_beside
from fctd.mechanics.state import ARCS, BOW_STIFFNESS, OWN_FRICTION, RADIUS, SAMPLED, TINY, TRIBUTARY


class Beside(NamedTuple):
    """The wall beside a point, as quantities: PT [m], its length beyond the hole's radius [m], stiffness, friction
    factor along the string, direction of the hole, friction factor around the string, ``friction.Sliding.net``, and the
    distance from the pipe's axis to the place of the wall that bow springs touch [m], which only they read."""

    x: Any
    y: Any
    z: Any
    beyond: Any
    stiffness: Any
    factor: Any
    tx: Any
    ty: Any
    tz: Any
    around: Any
    net: Any
    reach: Any


# Beside one place of the wall, and without bow springs.
WHOLE, NO_REACH = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)


@inlined
def along_hole(value, slope, tx, ty, tz):
    """A quantity with a slope along the hole, t."""
    return value, slope * tx, slope * ty, slope * tz


@inlined
def beside_piece(
    px, py, pz, hole, stiffness, factor, around, tx, ty, tz, share, hole_gain, stiffness_gain, factor_gain, around_gain,
    mx, my, mz,
):  # fmt: skip
    """The wall beside a point of one piece: PT p, direction t and its slope m; share : 1/ρ."""
    distance = np.sqrt(px * px + py * py + pz * pz)
    k, loss = 1 / (distance + TINY), share * hole_gain
    sx, sy, sz = share * tx, share * ty, share * tz
    return Beside(
        (px, 1 - sx * tx, -sx * ty, -sx * tz),
        (py, -sy * tx, 1 - sy * ty, -sy * tz),
        (pz, -sz * tx, -sz * ty, 1 - sz * tz),
        (distance - hole, k * px - loss * tx, k * py - loss * ty, k * pz - loss * tz),
        along_hole(stiffness, share * stiffness_gain, tx, ty, tz),
        along_hole(factor, share * factor_gain, tx, ty, tz),
        along_hole(tx, share * mx, tx, ty, tz),
        along_hole(ty, share * my, tx, ty, tz),
        along_hole(tz, share * mz, tx, ty, tz),
        along_hole(around, share * around_gain, tx, ty, tz),
        WHOLE,
        NO_REACH,
    )


@inlined
def beside_arc(C, i, x, y, z):
    """The wall of arc i beside a point."""
    px, py, pz, hole, stiffness, factor, md, around = arc_wall(C, i, x, y, z)
    arc = read_arc(C, i)
    tx, ty, tz = arc_direction(C, i, x, y, z)
    bx, by, bz = cross(arc.tx, arc.ty, arc.tz, arc.nx, arc.ny, arc.nz)
    mx, my, mz = cross(bx, by, bz, tx, ty, tz)
    dx, dy, dz = x - arc.x, y - arc.y, z - arc.z
    u = dx * arc.tx + dy * arc.ty + dz * arc.tz
    v = dx * arc.nx + dy * arc.ny + dz * arc.nz
    _, _, _, _, _, rho = arc_offset(
        u, v, 0.0, arc.curvature, arc.tx, arc.ty, arc.tz, arc.nx, arc.ny, arc.nz, bx, by, bz
    )
    changes = 1.0 if arc.md <= md <= arc.md + arc.length else 0.0
    k = arc.curvature
    return beside_piece(
        px, py, pz, hole, stiffness, factor, around, tx, ty, tz, 1 / rho,
        changes * arc.hole_gain, changes * arc.stiffness_gain, changes * arc.friction_gain, changes * arc.around_gain,
        k * mx, k * my, k * mz,
    )  # fmt: skip


@inlined
def beside_cylinder(C, i, x, y, z):
    """The wall of cylinder i beside a point, and the distance along it [m]."""
    px, py, pz, s = axis_offset(C, i, x, y, z)
    tx, ty, tz = C[i, DIRECTION], C[i, DIRECTION + 1], C[i, DIRECTION + 2]
    return beside_piece(
        px, py, pz, C[i, HOLE_RADIUS], C[i, STIFFNESS], C[i, FACTOR], C[i, FACTOR_AROUND], tx, ty, tz,
        1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
    ), s  # fmt: skip


@inlined
def blend(a, b, v, vx, vy, vz):
    """A quantity between a and b at the share v of b, whose gradient is (vx, vy, vz)."""
    u, change = 1 - v, b[0] - a[0]
    return (
        u * a[0] + v * b[0], u * a[1] + v * b[1] + change * vx, u * a[2] + v * b[2] + change * vy,
        u * a[3] + v * b[3] + change * vz,
    )  # fmt: skip


@inlined
def unit(tx, ty, tz):
    """The direction of a vector of three quantities."""
    k = 1 / np.sqrt(tx[0] * tx[0] + ty[0] * ty[0] + tz[0] * tz[0])
    x, y, z = k * tx[0], k * ty[0], k * tz[0]
    ax = x * tx[1] + y * ty[1] + z * tz[1]
    ay = x * tx[2] + y * ty[2] + z * tz[2]
    az = x * tx[3] + y * ty[3] + z * tz[3]
    return (
        (x, k * (tx[1] - x * ax), k * (tx[2] - x * ay), k * (tx[3] - x * az)),
        (y, k * (ty[1] - y * ax), k * (ty[2] - y * ay), k * (ty[3] - y * az)),
        (z, k * (tz[1] - z * ax), k * (tz[2] - z * ay), k * (tz[3] - z * az)),
    )


@inlined
def total(a, b):
    """The sum of two quantities."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]


@inlined
def times(k, a):
    """A number times a quantity."""
    return k * a[0], k * a[1], k * a[2], k * a[3]


@inlined
def product(a, b):
    """The product of two quantities."""
    x, y = a[0], b[0]
    return x * y, x * b[1] + y * a[1], x * b[2] + y * a[2], x * b[3] + y * a[3]


@inlined
def to_the_power(a, exponent):
    """A power of a quantity that is above 0."""
    value = a[0] ** exponent
    return value, *times(exponent * value / a[0], a)[1:]


@inlined
def leaning(wall, gx, gy, gz, radius):
    """A wall that presses a point with the force −K d g and the energy ½K d²: ``stored_walls.lean_wall``."""
    square = total(total(product(gx, gx), product(gy, gy)), product(gz, gz))
    less = (radius, 0.0, 0.0, 0.0)
    across = product(total(wall.beyond, less), to_the_power(square, -0.5))
    return Beside(
        gx, gy, gz, total(across, times(-1.0, less)), product(wall.stiffness, square), wall.factor,
        wall.tx, wall.ty, wall.tz, wall.around, wall.net, wall.reach,
    )  # fmt: skip


@inlined
def lean_in_overlap(a, b, wall, share, v, radius):
    """The blend of the walls a and b of two cylinders, as it presses a point: ``contact.rise_in_overlap``.

    share : of b per metre along the first cylinder; v : share of b, a quantity.
    """
    ax, ay, az = unit(a.x, a.y, a.z)
    bx, by, bz = unit(b.x, b.y, b.z)
    depth = total(wall.beyond, (radius, 0.0, 0.0, 0.0))
    gain = b.stiffness[0] - a.stiffness[0]
    stiffer = times(0.5 * gain, product(depth, to_the_power(wall.stiffness, -1)))
    along = times(share, total(total(b.beyond, times(-1.0, a.beyond)), stiffer))
    gx = total(blend(ax, bx, *v), times(a.tx[0], along))
    gy = total(blend(ay, by, *v), times(a.ty[0], along))
    gz = total(blend(az, bz, *v), times(a.tz[0], along))
    return leaning(wall, gx, gy, gz, radius)


@inlined
def beside_cylinders(C, i, x, y, z, radius):
    """The wall of cylinder i beside a point, blended with that of the next one in their overlap."""
    a, s = beside_cylinder(C, i, x, y, z)
    if s <= C[i, ALONE_TO]:
        return a
    b, _ = beside_cylinder(C, i + 1, x, y, z)
    share = 1 / C[i, OVERLAP]
    v = along_hole(share * (s - C[i, ALONE_TO]), share, a.tx[0], a.ty[0], a.tz[0])
    tx, ty, tz = unit(blend(a.tx, b.tx, *v), blend(a.ty, b.ty, *v), blend(a.tz, b.tz, *v))
    wall = Beside(
        blend(a.x, b.x, *v), blend(a.y, b.y, *v), blend(a.z, b.z, *v), blend(a.beyond, b.beyond, *v),
        blend(a.stiffness, b.stiffness, *v), blend(a.factor, b.factor, *v), tx, ty, tz,
        blend(a.around, b.around, *v), WHOLE, NO_REACH,
    )  # fmt: skip
    if wall.beyond[0] + radius > 0:
        return lean_in_overlap(a, b, wall, share, v, radius)
    return wall


@inlined
def in_hole(value, by_s, by_angle, s, f):
    """A quantity with slopes along the hole and by the angle around it, whose gradients are s and f."""
    return value, by_s * s[0] + by_angle * f[0], by_s * s[1] + by_angle * f[1], by_s * s[2] + by_angle * f[2]


@inlined
def leaned(a, b, along, of_a, of_b, t, s):
    """A component of a vector with the parts a, b across the hole and ``along`` it.

    of_a, of_b, t : this component of the three directions, t a quantity, the others with their slopes along the hole,
    whose gradient is s.
    """
    across = total(product(a, in_hole(of_a[0], of_a[1], 0.0, s, s)), product(b, in_hole(of_b[0], of_b[1], 0.0, s, s)))
    return total(across, product(along, t))


@kernel
def beside_sampled(C, i, x, y, z, radius):
    """The wall of cell i of a sampled hole beside a point of a string of ``radius`` [m], as it presses the point.

    Directions that go with the hole change along it by −κ t times their part towards the centre; the angle changes by
    e_φ/ρ.
    """
    wall = beside_arc(C, i, x, y, z)
    if C[i, AROUND_CELLS] == 0:
        return wall
    of = place_beside(C, i, read_arc(C, i), x, y, z)
    px, py, pz, tx, ty, tz, mx, my, mz = of.px, of.py, of.pz, of.tx, of.ty, of.tz, of.mx, of.my, of.mz
    found = deviation_at(C, i, of.s, of.a, of.b, radius)
    distance = np.sqrt(of.a * of.a + of.b * of.b)
    k = 1 / (distance + TINY)
    # ∇a and ∇b are the directions across the hole, ∇s is t times ``share``, ∇φ lies around.
    a, b = (of.a, of.ax, of.ay, of.az), (of.b, of.bx, of.by, of.bz)
    p, q = k * k * of.a, k * k * of.b
    f = p * of.bx - q * of.ax, p * of.by - q * of.ay, p * of.bz - q * of.az
    s = of.share * tx, of.share * ty, of.share * tz
    deviation = in_hole(found.value, found.by_s, found.by_angle, s, f)
    wall = Beside(
        wall.x, wall.y, wall.z, total(wall.beyond, times(-1.0, deviation)), wall.stiffness, wall.factor,
        wall.tx, wall.ty, wall.tz, wall.around, WHOLE, NO_REACH,
    )  # fmt: skip
    if wall.beyond[0] + radius <= 0 or distance == 0:
        return wall
    # d = ρ − R − δ presses along ∇d = e_ρ − (∂δ/∂φ) e_φ/ρ − (∂δ/∂s) ∇s: ``sampled.sampled_wall``.
    inverse = (k, -k * k * k * px, -k * k * k * py, -k * k * k * pz)
    turn = product(product(inverse, inverse), in_hole(found.by_angle, found.by_s_angle, found.by_angles, s, f))
    ga = total(product(inverse, a), product(turn, b))
    gb = total(product(inverse, b), times(-1.0, product(turn, a)))
    curvature = C[i, CURVATURE]
    nearer = curvature * of.share * of.share
    share = (of.share, nearer * mx, nearer * my, nearer * mz)
    along = times(-1.0, product(share, in_hole(found.by_s, found.by_ss, found.by_s_angle, s, f)))
    of_a = -curvature * (mx * of.ax + my * of.ay + mz * of.az)
    of_b = -curvature * (mx * of.bx + my * of.by + mz * of.bz)
    gx = leaned(ga, gb, along, (of.ax, of_a * tx), (of.bx, of_b * tx), wall.tx, s)
    gy = leaned(ga, gb, along, (of.ay, of_a * ty), (of.by, of_b * ty), wall.ty, s)
    gz = leaned(ga, gb, along, (of.az, of_a * tz), (of.bz, of_b * tz), wall.tz, s)
    factor, by_angle, by_s = grip_of(C, i, found, ga[0], gb[0])
    square = ga[0] * ga[0] + gb[0] * gb[0]
    p, q = by_angle * ga[0] / square, by_angle * gb[0] / square  # of the force's angle
    grip = (
        factor, by_s * s[0] + p * gb[1] - q * ga[1], by_s * s[1] + p * gb[2] - q * ga[2],
        by_s * s[2] + p * gb[3] - q * ga[3],
    )  # fmt: skip
    wall = Beside(
        wall.x, wall.y, wall.z, wall.beyond, wall.stiffness, product(grip, wall.factor), wall.tx, wall.ty, wall.tz,
        product(grip, wall.around), to_the_power(grip, -1), NO_REACH,
    )  # fmt: skip
    return leaning(wall, gx, gy, gz, radius)


@inlined
def wall_beside(C, i, geometry, x, y, z, radius):
    """The wall of piece i beside a point of a string of ``radius`` [m], with its gradient."""
    if geometry == ARCS:
        return beside_arc(C, i, x, y, z)
    if geometry == SAMPLED:
        return beside_sampled(C, i, x, y, z, radius)
    return beside_cylinders(C, i, x, y, z, radius)


@kernel
def with_own_contact(S, j, wall):
    """The wall beside contact point j of a fitting, see ``own_contact``."""
    radius, factor, around, beyond, stiffness = S[RADIUS + j], wall.factor, wall.around, wall.beyond, wall.stiffness
    reach = (radius, 0.0, 0.0, 0.0)
    if S[OWN_FRICTION + j] != 0:
        factor = around = (S[OWN_FRICTION + j], 0.0, 0.0, 0.0)
    if has_bows(S, j):
        x, y, z = wall.x, wall.y, wall.z
        distance = np.sqrt(x[0] * x[0] + y[0] * y[0] + z[0] * z[0])
        if distance - beyond[0] < radius + GAP:  # the hole is narrower than the bows
            k = 1 / (distance + TINY)
            beyond = (
                distance - radius - GAP, k * (x[0] * x[1] + y[0] * y[1] + z[0] * z[1]),
                k * (x[0] * x[2] + y[0] * y[2] + z[0] * z[2]), k * (x[0] * x[3] + y[0] * y[3] + z[0] * z[3]),
            )  # fmt: skip
        stiffness = (S[BOW_STIFFNESS + j] / S[TRIBUTARY + j], 0.0, 0.0, 0.0)
        reach = times(-1.0, wall.beyond)
    return Beside(wall.x, wall.y, wall.z, beyond, stiffness, factor, wall.tx, wall.ty, wall.tz, around, wall.net, reach)


@inlined
def wall_of(own, S, j, C, i, geometry, x, y, z):
    """The wall of piece i beside contact point j of a string, which is at a place, with its gradient.

    own : of ``Steady``.
    """
    if own is None:
        return wall_beside(C, i, geometry, x, y, z, S[RADIUS + j])
    radius = -np.inf if has_bows(S, j) else S[RADIUS + j]  # a wall that is not touched does not lean
    return with_own_contact(S, j, wall_beside(C, i, geometry, x, y, z, radius))
