"""Stages 3 and 4 at one contact point: the wall's normal impulse, and the parts of a law of friction (§4.3–4.5)."""

from typing import Any, NamedTuple

import numpy as np
from numba import types
from numba.extending import overload

from fctd.mechanics.jit import INLINED, inlined
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import (
    ARM_CONTACT,
    FRICTION,
    FRICTION_AROUND,
    HELD_BACK,
    HOLE,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    K_WALL,
    NET,
    RADIUS,
    TINY,
    lateral_inverse_mass,
    quaternion,
    radial,
)

ON_AXIS = 1e-150  # far above the root of the smallest float, far below any offset that matters [m]
# Newton's method for the direction of friction: iterations that take a root, and a limit [N s] so much below all others
# that the direction of what is left of the sliding is that of the sliding before.
ROOTS, SMALLEST = 1, 1e-12
# Iterations where the factors along and around the string differ: with a ratio of 10 they leave the direction to
# rounding, with one of 100 within 0.1°.  A limit less than this share of the other is none.
ORTHOTROPIC_ROOTS, FLAT = 7, 1e-9


@inlined
def wall_normal(S, j):
    """Penetration [m] (Eq. 11, settled sign) and the normal towards the wall in the frame of body j."""
    px, py, pz = radial(S, j)
    distance = np.sqrt(px * px + py * py + pz * pz)
    # A point on the hole axis has no direction, and the square of an offset below 1e-162 m is 0.  Such offsets
    # occur: ahead of a wave that enters a long straight chain on the axis they fall off through all powers of ten.
    k = 1 / (distance + ON_AXIS)
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    return (
        distance - S[HOLE + j] + S[RADIUS + j],
        k * (xx * px + xy * py + xz * pz),
        k * (yx * px + yy * py + yz * pz),
        k * (zx * px + zy * py + zz * pz),
    )


@inlined
def approach(S, j, u, v, w, a, b, nx, ny, nz):
    """Speed of contact point j towards the wall [m/s]; velocity, spin and normal in the frame of the body."""
    return u * nx + v * ny + w * nz + S[ARM_CONTACT + j] * (b * nx - a * ny)


@inlined
def normal_impulse(S, j, u, v, w, a, b, nx, ny, nz, penetration, damping, dt):
    """Impulse of the wall's normal force on body j (Eq. 12 with damping) and the damper's share of it [N s].

    The damper is implicit in the velocity it changes.  The wall never pulls.
    """
    arm = S[ARM_CONTACT + j]
    response = (nx * nx + ny * ny + nz * nz) * S[INVERSE_MASS + j] - (nx * nx + ny * ny) * S[HELD_BACK + j]
    response += arm * arm * (nx * nx + ny * ny) * S[INVERSE_JT + j]
    speed = approach(S, j, u, v, w, a, b, nx, ny, nz)
    elastic = dt * S[K_WALL + j] * penetration
    impulse = (elastic + dt * damping * speed) / (1 + dt * damping * response)
    impulse = impulse if penetration > 0 else 0.0
    impulse = impulse if impulse > 0 else 0.0
    elastic = elastic if penetration > 0 else 0.0
    return impulse, impulse - elastic


@inlined
def factor_around(S, j, orthotropic):
    """Friction factor around the string beside point j; orthotropic : of ``Laws``."""
    if orthotropic is None:
        return S[FRICTION + j]
    return S[FRICTION_AROUND + j]


def limit_around(orthotropic, scale, factor, normal):
    """Limit of friction around the string, of a factor and a normal force or impulse; None where it is that along it.

    orthotropic : of ``Laws``, None where the factors are equal.
    """
    return None if orthotropic is None else scale * factor * normal


@overload(limit_around, jit_options=INLINED)
def _limit_around(orthotropic, scale, factor, normal):
    if isinstance(orthotropic, types.NoneType):
        return lambda orthotropic, scale, factor, normal: None
    return lambda orthotropic, scale, factor, normal: scale * factor * normal


def net_of(corners, S, j):
    """``Sliding.net`` of contact point j; corners : of ``Laws``, None where no disc touches two places."""
    return 1.0 if corners is None else S[NET + j]


@overload(net_of, jit_options=INLINED)
def _net_of(corners, S, j):
    if isinstance(corners, types.NoneType):
        return lambda corners, S, j: 1.0
    return lambda corners, S, j: S[NET + j]


@inlined
def turning_limit(limit, around):
    """The limit of friction around the string, given those along and around it (None where both are equal)."""
    if around is None:
        return limit
    return around


@inlined
def along_wall(sx, sy, sz, nx, ny, nz):
    """The part of a velocity that slides along the wall of normal n."""
    into = sx * nx + sy * ny + sz * nz
    return sx - into * nx, sy - into * ny, sz - into * nz


class Sliding(NamedTuple):
    """How a contact point slides along the wall, and how its body yields there, along the string and around it.

    With the axis z of the body and the normal n these directions are p = z − (z·n) n and r = z × n, of length q each.
    A body that is round about z yields to an impulse along p in that direction alone, and so along r: in them its
    response is diagonal.  Impulses act at T + R n, a distance h along the body from its centre.

    A disc that touches two places has the friction of both normal forces as its limits, and turns with it all.  Only a
    share of it, ``net``, is left across the body and about its transverse axes: there the two are added as vectors, and
    their normals add up to less than they press.  The sliding is then the mean of both places.

    along, around : sliding along p and r, times q [m/s]; yields_along, yields_around : velocity by a unit impulse
    [1/kg]; square : q²; arm, lever : net R + h n_z and net (h + R n_z) [m]; radius : R [m]; net : 1 at a single place.
    """

    along: float
    around: float
    yields_along: float
    yields_around: float
    square: float
    arm: float
    lever: float
    radius: float
    net: float


@inlined
def sliding(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz):
    """``Sliding`` of body j that touches at a radius [m]; velocity, spin and normal in the frame of the body.

    The body's inertia enters friction here and in ``against``.
    """
    h, im, it, ia = S[ARM_CONTACT + j], S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    il = lateral_inverse_mass(S, j)
    square = nx * nx + ny * ny
    arm, lever = net * radius + h * nz, net * (h + radius * nz)
    return Sliding(
        square * w - nz * (nx * u + ny * v) - arm * (nx * b - ny * a),
        net * (nx * v - ny * u) + radius * square * c - lever * (nx * a + ny * b),
        nz * nz * il + square * im + arm * arm * it,
        net * net * il + lever * lever * it + radius * radius * square * ia,
        square, arm, lever, radius, net,
    )  # fmt: skip


@inlined
def against(S, j, f, g, p, nx, ny, nz):
    """Change of velocity and spin (6) of body j by an impulse −f·p − g·r at the wall; p : its ``Sliding``."""
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    il, across = lateral_inverse_mass(S, j), g * p.net
    return (
        il * (f * nz * nx + across * ny), il * (f * nz * ny - across * nx), -im * f * p.square,
        it * (g * p.lever * nx - f * p.arm * ny), it * (g * p.lever * ny + f * p.arm * nx),
        -ia * g * p.radius * p.square,
    )  # fmt: skip


class Ellipse(NamedTuple):
    """Limits of friction over the larger one, along the string and around it: one circle's where both are equal.

    largest : the larger limit [N s].
    """

    along: float
    around: float
    largest: float


@inlined
def ellipse(limit, around):
    """``Ellipse`` of limits of the impulse along the string and around it [N s]; around : None where both are equal."""
    if around is None:
        return Ellipse(1.0, 1.0, limit)
    larger = limit if limit > around else around
    a, r = (limit + TINY) / (larger + TINY), (around + TINY) / (larger + TINY)
    return Ellipse(a if a > FLAT else 0.0, r if r > FLAT else 0.0, larger)


@inlined
def resisting(p, shape, holding, moving, around):
    """Friction by Coulomb's law, implicit in the sliding that it leaves: the f and g of ``against``, and if it sticks.

    p : ``Sliding``; shape : ``Ellipse``; holding, moving : limits of the impulse of a point that may stick and of one
    that slides [N s]; around : None where they are those of all directions.

    In units of the ellipse's half axes the limit is a circle.  The impulse that stops the point is the sliding over the
    yield, in either direction.  Within the limit it is applied in full, so that the point rests and does not creep.
    Beyond it friction opposes the sliding that it leaves, not the one before it: a point that swings across the
    string's axis would lose its friction along it by overshooting from step to step.  The sliding left is ν times the
    impulse, whose parts are then s/(A + ν), of the size of the limit (Moré & Sorensen 1983).  Newton's method for
    1/|s/(A + ν)| begins at a lower bound of ν and stays below it; the narrower the ellipse, the more iterations it
    takes.  A last one, for the square of that, needs no root.
    """
    s, t = shape.along * p.along, shape.around * p.around
    # Across an ellipse without breadth friction does nothing, and any number above 0 will do.
    first = (shape.along * shape.along if shape.along > 0 else 1.0) * p.yields_along
    second = (shape.around * shape.around if shape.around > 0 else 1.0) * p.yields_around
    # One division in place of two.  Of a point on the axis, and of a body without mass, all is 0.
    square, limit = p.square + ON_AXIS, moving + SMALLEST
    k = 1 / (square * limit)
    inverse, k = k * square, k * limit
    ss, tt, both = k * s * s, k * t * t, first * second
    sticks = ss * second * second + tt * first * first <= holding * holding * both * both
    # Neither part of the impulse is larger than the limit; q is 1 at most.
    shift, other = inverse * abs(s) - first, inverse * abs(t) - second
    shift = shift if shift > other else other
    shift = shift if shift > 0 else 0.0
    for _ in range(ROOTS if around is None else ORTHOTROPIC_ROOTS):
        a, r = first + shift, second + shift
        size = ss * r * r + tt * a * a
        shift += size * (inverse * np.sqrt(size) - a * r) / (ss * r * r * r + tt * a * a * a + TINY)
    a, r = first + shift, second + shift
    size, product = ss * r * r + tt * a * a, a * r
    cubes = 2 * product * (ss * r * r * r + tt * a * a * a)
    shift += size * (inverse * inverse * size - product * product) / (cubes + TINY)
    shift = shift if shift > 0 else 0.0
    shift = 0.0 if sticks else shift
    a, r = first + shift, second + shift
    size = np.sqrt(ss * r * r + tt * a * a)
    share = k * (1.0 if sticks else moving) / ((both if sticks else size) + ON_AXIS)
    return share * r * shape.along * s, share * a * shape.around * t, sticks


class Law(NamedTuple):
    """A law of friction: three functions that are compiled into their callers.

    limit, around : limits of friction along the string and around it, friction factor × normal force or impulse; the
    latter is None where both are equal, and numba then compiles the branches ``around is None`` alone.

    impulse(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around) : change of velocity and spin (6) of body j,
    both in its own frame, by an impulse that may stop the sliding but not reverse it; radius [m] : at which it touches;
    net : of ``Sliding``; n : the wall's normal; limits [N s].
    steady_load(speed, spin, limit, around, radius, ax, ay, az, nx, ny, nz, tx, ty, tz) : force [N] and moment [N m] (6,
    global) and torque about the axis [N m] on a body that slides at ``speed`` [m/s] along the hole t and spins about
    its axis a [rad/s]; limits [N].  It is differentiated by a complex step.
    shares(speed, turning, limit, around) : friction along the string (downwards) and around it, and that by which a
    turning string climbs the wall; limits as shares of the normal force.  Used by the first guess of the steady solver.
    """

    impulse: Any
    steady_load: Any
    shares: Any
