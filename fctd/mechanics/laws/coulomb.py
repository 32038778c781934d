"""Law ``coulomb``: one force μN against the sliding velocity of the string's surface at the wall."""

import numpy as np

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.friction import Law, along_wall
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.state import (
    ARM_CONTACT,
    HELD_BACK,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    RADIUS,
    TINY,
    lateral_inverse_mass,
)


@inlined
def impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """One impulse against the sliding velocity of the string's surface at the wall.

    limit : μ × normal impulse [N s].  It acts at T + r_ds·normal, hence gives force and torque, and may stop
    the sliding of the free body but not reverse it (implicit clamp).  Returns the change of velocity and spin (6).
    """
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    il = lateral_inverse_mass(S, j)
    r = S[RADIUS + j]
    rx, ry, rz = r * nx, r * ny, S[ARM_CONTACT + j] + r * nz
    sx = u + b * rz - c * ry
    sy = v + c * rx - a * rz
    sz = w + a * ry - b * rx
    sx, sy, sz = along_wall(sx, sy, sz, nx, ny, nz)
    mx, my, mz = ry * sz - rz * sy, rz * sx - rx * sz, rx * sy - ry * sx
    square = sx * sx + sy * sy + sz * sz
    speed = np.sqrt(square)
    # The body's response to an impulse −f·s, f the smaller of limit/|s| and |s|²/response: one division.
    response = square * im - (sx * sx + sy * sy) * S[HELD_BACK + j] + (mx * mx + my * my) * it + mz * mz * ia
    sliding, stopping = limit * response, speed * square
    f = (sliding if sliding < stopping else stopping) / (speed * response + TINY)
    return (
        -f * il * sx, -f * il * sy, -f * im * sz,
        -f * it * mx, -f * it * my, -f * ia * mz,
    )  # fmt: skip


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
    sliding = np.sqrt(speed * speed + turning * turning) + TINY
    return speed / sliding, turning / sliding, turning / sliding


LAW = Law("coulomb", impulse, steady_load, shares)
