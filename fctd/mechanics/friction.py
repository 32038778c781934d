"""Stages 3 and 4 at one contact point: the wall's normal impulse, and the parts of a law of friction (§4.3–4.5)."""

from typing import Any, NamedTuple

import numpy as np
from numba import types
from numba.extending import overload

from fctd.mechanics.jit import INLINED, inlined
from fctd.mechanics.joints import cross
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
    RADIUS,
    TINY,
    lateral_inverse_mass,
    quaternion,
    radial,
)

ON_AXIS = 1e-150  # far above the root of the smallest float, far below any offset that matters [m]
# Newton's method for the direction of friction: number of iterations, and how many times smaller than the impulse that
# stops the sliding one may be whose direction it looks for: that of a smaller one is the same.
ITERATIONS, SMALLER = 2, 1e9
# Iterations where the factors along and around the string differ: with a ratio of 10 they leave the direction to
# rounding, with one of 100 within 0.1°.  A limit less than this share of the other is none.
ORTHOTROPIC_ITERATIONS, FLAT = 8, 1e-9


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


@inlined
def lever(S, j, nx, ny, nz):
    """From the centre of body j to its surface at the wall, T + r_ds·normal [m], in the frame of the body."""
    r = S[RADIUS + j]
    return r * nx, r * ny, S[ARM_CONTACT + j] + r * nz


@inlined
def sliding(S, j, u, v, w, a, b, c, nx, ny, nz):
    """Sliding velocity of the string's surface at the wall [m/s] and its moment about the centre: six scalars.

    Velocity, spin, normal and results are in the frame of body j.
    """
    rx, ry, rz = lever(S, j, nx, ny, nz)
    sx = u + b * rz - c * ry
    sy = v + c * rx - a * rz
    sz = w + a * ry - b * rx
    sx, sy, sz = along_wall(sx, sy, sz, nx, ny, nz)
    return sx, sy, sz, ry * sz - rz * sy, rz * sx - rx * sz, rx * sy - ry * sx


@inlined
def response(S, j, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz):
    """Velocity along t that an impulse s at the wall gives the surface of body j there, times |t|.

    m, o : moments of s and of t about the body's centre.  The body's inertia enters friction here and in ``against``.
    """
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    lateral = sx * tx + sy * ty
    return (lateral + sz * tz) * im - lateral * S[HELD_BACK + j] + (mx * ox + my * oy) * it + mz * oz * ia


class Pull(NamedTuple):
    """Friction at a contact point, an impulse −f·s − g·t along the wall, and what it does there.

    s, t : two velocities along the wall [m/s]; m, o : their moments about the centre of the body; all in its frame.
    square : |u|² of the sliding u [m²/s²]; limit : of |(f, g)| |u| [N s]; over : size of the sliding over |u|.
    along, mixed, across : elements of the symmetric matrix A: f and g change u by −A (f, g) along u and across it.

    Where the limit is one for all directions, s and u are the sliding itself, and t = n × s.  Where it is an ellipse,
    u = M s is the sliding in the coordinates in which it is a circle; M has the half axes over the larger one, and the
    vectors are M²s and |M| n × s.
    """

    sx: float
    sy: float
    sz: float
    mx: float
    my: float
    mz: float
    tx: float
    ty: float
    tz: float
    ox: float
    oy: float
    oz: float
    square: float
    limit: float
    over: float
    along: float
    mixed: float
    across: float


@inlined
def stretched(nx, ny, nz, sx, sy, sz, limit, around):
    """The sliding s at a wall of normal n, both in the frame of the body, against friction with the half axes ``limit``
    along the string and ``around`` it: M²s (3), |M|, |M s|² and |s|²; see ``Pull``.

    The axis of the string, laid on the wall, and the normal to both are the axes of the ellipse: sliding along them is
    sz/√(nx² + ny²) and (sx ny − sy nx)/√(nx² + ny²).
    """
    larger = limit if limit > around else around
    a, r = (limit + TINY) / (larger + TINY), (around + TINY) / (larger + TINY)
    a, r = a if a > FLAT else 0.0, r if r > FLAT else 0.0
    share = 1 / (nx * nx + ny * ny + TINY)
    turn = sx * ny - sy * nx
    inwards, across = a * a * share * nz * sz, r * r * share * turn
    square = share * (a * a * sz * sz + r * r * turn * turn)
    return (
        across * ny - inwards * nx, -across * nx - inwards * ny, a * a * sz, a * r, square,
        share * (sz * sz + turn * turn),
    )  # fmt: skip


@inlined
def pull(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, limit, around):
    """``Pull`` of body j that slides by s at a wall of normal n, given the moment m of s about its centre.

    limit, around : limits of the impulse along the string and around it [N s], the latter None where both are equal.
    """
    tx, ty, tz = cross(nx, ny, nz, sx, sy, sz)
    if around is None:
        square = sx * sx + sy * sy + sz * sz
        ox, oy, oz, along, mixed, across = yielding(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, tx, ty, tz, square)
        return Pull(sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz, square, limit, 1.0, along, mixed, across)
    sx, sy, sz, both, square, whole = stretched(nx, ny, nz, sx, sy, sz, limit, around)
    mx, my, mz = cross(*lever(S, j, nx, ny, nz), sx, sy, sz)
    tx, ty, tz = both * tx, both * ty, both * tz
    ox, oy, oz, along, mixed, across = yielding(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, tx, ty, tz, square)
    over = np.sqrt(whole) / (np.sqrt(square) + TINY)
    return Pull(
        sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz, square,
        limit if limit > around else around, over if over < SMALLER else SMALLER,
        # Across an ellipse without breadth friction does nothing, and any number above 0 will do.
        along, mixed, across if both > 0 else along,
    )  # fmt: skip


@inlined
def yielding(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, tx, ty, tz, square):
    """Moment of t about the centre of body j, and how the sliding yields there: along, mixed and across of ``Pull``."""
    ox, oy, oz = cross(*lever(S, j, nx, ny, nz), tx, ty, tz)
    share = 1 / (square + TINY)
    along = share * response(S, j, sx, sy, sz, mx, my, mz, sx, sy, sz, mx, my, mz)
    mixed = share * response(S, j, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz)
    across = share * response(S, j, tx, ty, tz, ox, oy, oz, tx, ty, tz, ox, oy, oz)
    return ox, oy, oz, along, mixed, across


@inlined
def opposing(along, mixed, across, inverse, around):
    """The sliding that an impulse −f·s − g·t of the size 1/``inverse`` leaves, opposite to it, over the impulse.

    along, mixed, across : see ``Pull``.  With this ratio ν the impulse solves (A + ν)(f, g) = (1, 0), so that it is
    parallel to (across + ν, −mixed) (Moré & Sorensen 1983).  Newton's method for 1/|(f, g)| begins at a lower bound of
    ν and stays below it.  The narrower the ellipse, the more iterations it takes; around : None where it is a circle.
    """
    shift = inverse - along - across
    shift = shift if shift > 0 else 0.0
    for _ in range(ITERATIONS if around is None else ORTHOTROPIC_ITERATIONS):
        first, second, square = along + shift, across + shift, mixed * mixed
        size = second * second + square
        slope = size / (second * size + square * (first + second) + TINY)
        shift += slope * (inverse * np.sqrt(size) - first * second + square)
    return shift


@inlined
def resisting(along, mixed, across, square, holding, moving, around):
    """Friction by Coulomb's law, implicit in the sliding that it leaves: multiples (f, g) of s and t, and if it sticks.

    along, mixed, across, square : see ``Pull``; holding, moving : limits of the impulse of a point that may stick and
    of one that slides [N s]; around : None where they are those of all directions.  A body yields more in one direction
    than in another: the impulse −f·s − g·t that stops its point solves A (f, g) = (1, 0), is parallel to
    (across, −mixed), and 1/det A times as large.  Within the limit it is applied in full, so that the point rests and
    does not creep.  Beyond it friction opposes the sliding that it leaves, not the one before it: a point that swings
    across the string's axis would lose its friction along it by overshooting from step to step.
    """
    determinant = along * across - mixed * mixed
    sticks = (across * across + mixed * mixed) * square <= holding * holding * determinant * determinant
    speed = np.sqrt(square)
    inverse = speed / (moving + TINY)
    inverse = inverse if inverse < SMALLER * along else SMALLER * along
    f = across + (0.0 if sticks else opposing(along, mixed, across, inverse, around))
    size = speed * np.sqrt(f * f + mixed * mixed)
    share = (1.0 if sticks else moving) / ((determinant if sticks else size) + TINY)
    return share * f, -share * mixed, sticks


@inlined
def against(S, j, f, g, p):
    """Change of velocity and spin (6) of body j by an impulse −f·s − g·t at the wall; p : its ``Pull``."""
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    il = lateral_inverse_mass(S, j)
    return (
        -il * (f * p.sx + g * p.tx), -il * (f * p.sy + g * p.ty), -im * (f * p.sz + g * p.tz),
        -it * (f * p.mx + g * p.ox), -it * (f * p.my + g * p.oy), -ia * (f * p.mz + g * p.oz),
    )  # fmt: skip


class Law(NamedTuple):
    """A law of friction: three functions that are compiled into their callers.

    limit, around : limits of friction along the string and around it, friction factor × normal force or impulse; the
    latter is None where both are equal, and numba then compiles the branches ``around is None`` alone.

    impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit, around) : change of velocity and spin (6) of body j, both in its
    own frame, by an impulse that may stop the sliding but not reverse it; n : the wall's normal; limits [N s].
    steady_load(speed, spin, limit, around, radius, ax, ay, az, nx, ny, nz, tx, ty, tz) : force [N] and moment [N m] (6,
    global) and torque about the axis [N m] on a body that slides at ``speed`` [m/s] along the hole t and spins about
    its axis a [rad/s]; limits [N].  It is differentiated by a complex step.
    shares(speed, turning, limit, around) : friction along the string (downwards) and around it, and that by which a
    turning string climbs the wall; limits as shares of the normal force.  Used by the first guess of the steady solver.
    """

    impulse: Any
    steady_load: Any
    shares: Any
