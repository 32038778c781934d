"""Law ``coulomb``: one force against the sliding velocity of the string's surface at the wall.

It is μN, or, where the factors along the string and around it differ, on the ellipse with the half axes μ_a N and μ_r N
where it takes most energy (maximum dissipation): F = −N (μ_a² v_a, μ_r² v_r)/√(μ_a² v_a² + μ_r² v_r²).
"""

import numpy as np

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.friction import FLAT, ON_AXIS, Law, against, along_wall, ellipse, resisting, sliding
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.state import TINY


@inlined
def impulse(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    """The impulse that stops the sliding where μ × normal impulse allows it, else one against what is left of it.

    It acts at T + r_ds·normal, hence gives force and torque; see ``Law``.
    """
    p, shape = sliding(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz), ellipse(limit, around)
    f, g, _ = resisting(p, shape, shape.largest, shape.largest, around)
    return against(S, j, f, g, p, nx, ny, nz)


@inlined
def steady_load(speed, spin, limit, around, radius, ax, ay, az, nx, ny, nz, tx, ty, tz):
    """One force against the sliding velocity of the string's surface, acting there; see ``Law``."""
    cx, cy, cz = cross(ax, ay, az, nx, ny, nz)
    turning = spin * radius
    sx, sy, sz = along_wall(speed * tx + turning * cx, speed * ty + turning * cy, speed * tz + turning * cz, nx, ny, nz)
    fx, fy, fz = opposite(limit, around, sx, sy, sz, cx, cy, cz)
    mx, my, mz = cross(radius * nx, radius * ny, radius * nz, fx, fy, fz)
    return fx, fy, fz, mx, my, mz, mx * ax + my * ay + mz * az


@inlined
def opposite(limit, around, sx, sy, sz, cx, cy, cz):
    """Force (3) against the sliding s along the wall; c : a vector around the string, in the wall."""
    if around is None:
        share = limit * reciprocal(root(sx * sx + sy * sy + sz * sz) + TINY)
        return -share * sx, -share * sy, -share * sz
    turn = (sx * cx + sy * cy + sz * cz) * reciprocal(cx * cx + cy * cy + cz * cz + TINY)
    rx, ry, rz = turn * cx, turn * cy, turn * cz
    lx, ly, lz = sx - rx, sy - ry, sz - rz
    along, across = lx * lx + ly * ly + lz * lz, rx * rx + ry * ry + rz * rz
    # Friction of one direction alone would turn a rounding error of the sliding in it into all of its limit.
    least = FLAT * FLAT * (limit * limit + around * around) * (along + across)
    # Of a point at rest the share is finite still when it is multiplied by the square of a limit.
    share = reciprocal(root(limit * limit * along + around * around * across + least) + ON_AXIS)
    a, r = -share * limit * limit, -share * around * around
    return a * lx + r * rx, a * ly + r * ry, a * lz + r * rz


@inlined
def shares(speed, turning, limit, around):
    """Along and around by the direction of sliding; friction around the hole bears part of the lateral load."""
    if around is None:
        resultant = np.sqrt(speed * speed + turning * turning) + TINY
        return limit * (speed / resultant), limit * (turning / resultant), limit * (turning / resultant)
    speed, turning = limit * speed, around * turning
    resultant = np.sqrt(speed * speed + turning * turning) + TINY
    return limit * (speed / resultant), around * (turning / resultant), around * (turning / resultant)


LAW = Law(impulse, steady_load, shares)
