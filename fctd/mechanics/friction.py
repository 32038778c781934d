"""Stages 3 to 5 at one contact point: the wall's normal impulse and the two laws of friction (§4.3–4.5)."""

import numpy as np

from fctd.mechanics.jit import inlined
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import (
    ARM_CONTACT,
    HOLE,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    J_AXIAL,
    K_WALL,
    MASS,
    RADIUS,
    TINY,
    quaternion,
    radial,
)

ON_AXIS = 1e-150  # far above the root of the smallest number, far below any offset that matters [m]


@inlined
def wall_normal(S, j):
    """Penetration [m] (Eq. 11, settled sign) and the normal towards the wall in the frame of body j."""
    px, py, pz = radial(S, j)
    distance = np.sqrt(px * px + py * py + pz * pz)
    # A point on the hole axis has no direction, and the square of an offset below 1e-162 m is 0.  Such offsets
    # occur: the front of a wave enters a long straight chain laid on the axis with every power of ten below it.
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
    """Impulse of the wall's normal force on body j (Eq. 12 with damping) and the damper's part of it [N s].

    The damper is implicit in the velocity it changes.  The wall never pulls.
    """
    arm = S[ARM_CONTACT + j]
    response = (nx * nx + ny * ny + nz * nz) * S[INVERSE_MASS + j]
    response += arm * arm * (nx * nx + ny * ny) * S[INVERSE_JT + j]
    speed = approach(S, j, u, v, w, a, b, nx, ny, nz)
    elastic = dt * S[K_WALL + j] * penetration
    impulse = (elastic + dt * damping * speed) / (1 + dt * damping * response)
    impulse = impulse if penetration > 0 else 0.0
    impulse = impulse if impulse > 0 else 0.0
    elastic = elastic if penetration > 0 else 0.0
    return impulse, impulse - elastic


@inlined
def along_wall(sx, sy, sz, nx, ny, nz):
    """The part of a velocity that slides along the wall of normal n."""
    into = sx * nx + sy * ny + sz * nz
    return sx - into * nx, sy - into * ny, sz - into * nz


@inlined
def coulomb_impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """Law ``coulomb``: one impulse against the sliding velocity at the wall side of the string.

    limit : μ × normal impulse [N s].  It acts at T + r_ds·normal, hence gives force and torque, and at most
    stops the sliding of the free body (implicit clamp).  Returns the change of velocity and spin (6).
    """
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
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
    response = square * im + (mx * mx + my * my) * it + mz * mz * ia
    sliding, stopping = limit * response, speed * square
    f = (sliding if sliding < stopping else stopping) / (speed * response + TINY)
    return (
        -f * im * sx, -f * im * sy, -f * im * sz,
        -f * it * mx, -f * it * my, -f * ia * mz,
    )  # fmt: skip


@inlined
def paper_impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """Law ``paper`` (Eqs 15–16): axial drag μF_n and a couple r μ F_n about the axis, each in full.

    Signature and return as ``coulomb_impulse``.
    """
    m, ja, im, ia = S[MASS + j], S[J_AXIAL + j], S[INVERSE_MASS + j], S[INVERSE_JA + j]
    sliding, spinning = np.sqrt(w * w), np.sqrt(c * c)
    drag = limit if limit < m * sliding else m * sliding
    couple = S[RADIUS + j] * limit
    couple = couple if couple < ja * spinning else ja * spinning
    dw = drag * im if w < 0 else -drag * im
    dc = couple * ia if c < 0 else -couple * ia
    return 0.0 * w, 0.0 * w, dw, 0.0 * w, 0.0 * w, dc
