"""Law ``coulomb``: one force μN against the sliding velocity of the string's surface at the wall."""

import numpy as np

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.friction import Law, against, along_wall, resisting, sliding, yielding
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.state import TINY


@inlined
def impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """The impulse that stops the sliding where μ × normal impulse allows it, else one against what is left of it.

    It acts at T + r_ds·normal, hence gives force and torque; see ``Law``.
    """
    sx, sy, sz, mx, my, mz = sliding(S, j, u, v, w, a, b, c, nx, ny, nz)
    square = sx * sx + sy * sy + sz * sz
    tx, ty, tz, ox, oy, oz, along, mixed, across = yielding(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, square)
    f, g, _ = resisting(along, mixed, across, square, limit, limit)
    return against(S, j, f, g, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz)


@inlined
def steady_load(speed, spin, limit, radius, ax, ay, az, nx, ny, nz, tx, ty, tz):
    """One force against the sliding velocity of the string's surface, acting there; see ``Law``."""
    cx, cy, cz = cross(ax, ay, az, nx, ny, nz)
    turning = spin * radius
    sx, sy, sz = along_wall(speed * tx + turning * cx, speed * ty + turning * cy, speed * tz + turning * cz, nx, ny, nz)
    share = limit * reciprocal(root(sx * sx + sy * sy + sz * sz) + TINY)
    fx, fy, fz = -share * sx, -share * sy, -share * sz
    mx, my, mz = cross(radius * nx, radius * ny, radius * nz, fx, fy, fz)
    return fx, fy, fz, mx, my, mz, mx * ax + my * ay + mz * az


@inlined
def shares(speed, turning):
    """Along and around by the direction of sliding; friction around the hole bears part of the lateral load."""
    resultant = np.sqrt(speed * speed + turning * turning) + TINY
    return speed / resultant, turning / resultant, turning / resultant


LAW = Law(impulse, steady_load, shares)
