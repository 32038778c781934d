"""Rotations of axisymmetric bodies: quaternions (scalar first), the body axis, twist between two bodies.

Every helper takes and returns scalars and avoids ``abs``, ``copysign`` and ``atan2``, so that it packs
inside a loop and may be differentiated by a complex step.
"""

import numpy as np

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.jit import inlined

# Replaces 0 in the denominator of a tangent; below rounding, and the eighth power of 1/WHOLE_TURN is still finite.
WHOLE_TURN = 1e-30


@inlined
def rotation_columns(w, x, y, z):
    """Global components of the body's x, y and z unit vectors (nine scalars, column by column)."""
    xx, yy, zz = 2 * x * x, 2 * y * y, 2 * z * z
    xy, xz, yz = 2 * x * y, 2 * x * z, 2 * y * z
    wx, wy, wz = 2 * w * x, 2 * w * y, 2 * w * z
    return (
        1 - yy - zz, xy + wz, xz - wy,
        xy - wz, 1 - xx - zz, yz + wx,
        xz + wy, yz - wx, 1 - xx - yy,
    )  # fmt: skip


@inlined
def turned(w, x, y, z, a, b, c):
    """Quaternion after a further rotation by the body-frame vector (a, b, c) [rad], renormalised.

    Sine and cosine of the half angle by series, exact to 1e-14 for less than 0.2 rad per step, which
    the step limit on spin guarantees.
    """
    h = 0.25 * (a * a + b * b + c * c)
    # The factors are written as powers of h: a division by a constant costs as much as any other.
    s = 0.5 + h * (-1 / 12 + h * (1 / 240 - h * (1 / 10080)))
    p = 1 + h * (-1 / 2 + h * (1 / 24 - h * (1 / 720)))
    a, b, c = s * a, s * b, s * c
    nw = w * p - x * a - y * b - z * c
    nx = w * a + x * p + y * c - z * b
    ny = w * b - x * c + y * p + z * a
    nz = w * c + x * b - y * a + z * p
    # One Newton step towards unit length: the error of a step is of the order of rounding.
    k = 1.5 - 0.5 * (nw * nw + nx * nx + ny * ny + nz * nz)
    return k * nw, k * nx, k * ny, k * nz


@inlined
def arctan_ratio(v):
    """atan(u)/u from v = u²: Padé approximant [9/8], 1e-10 relative for u = tan(½), 2e-7 for u = 1."""
    p = 3828825 + v * (6831825 + v * (3738735 + v * (638055 + v * 16384)))
    q = 3828825 + v * (8108100 + v * (5675670 + v * (1455300 + v * 99225)))
    return p * reciprocal(q)


@inlined
def arctan(y, x):
    """atan(y/x) for x > 0, by ``arctan_ratio`` with one division in place of two."""
    v, one = y * y, x * x
    two, three, four = one * one, one * one * one, one * one * one * one
    p = 3828825 * four + v * (6831825 * three + v * (3738735 * two + v * (638055 * one + v * 16384)))
    q = 3828825 * four + v * (8108100 * three + v * (5675670 * two + v * (1455300 * one + v * 99225)))
    return y * p * reciprocal(x * q)


@inlined
def half_twist(aw, ax, ay, az, bw, bx, by, bz):
    """Cosine and sine of half the twist of body b against body a about their common direction.

    Symmetric swing-twist: the relative rotation is half the twist, a bend without twist, half the twist.
    These are w and z of its quaternion, both cos(bend/2) times too small; past half a turn w is negative.
    """
    return aw * bw + ax * bx + ay * by + az * bz, aw * bz - az * bw - ax * by + ay * bx


@inlined
def twist_angle(aw, ax, ay, az, bw, bx, by, bz):
    """Twist of body b against body a about their common direction [rad], within a whole turn; see ``half_twist``.

    The arc tangent is taken at a quarter of the twist, where its approximant is good to 1e-10 at 2 rad and to
    2e-7 at π.  At a whole turn it is large and meaningless, but finite: the bit reaches it against the inert
    column below, whose stiffness is 0.
    """
    w, z = half_twist(aw, ax, ay, az, bw, bx, by, bz)
    return 4 * arctan(z, w + root(w * w + z * z) + WHOLE_TURN)


@inlined
def angle_over_sine(c):
    """β / sin β from c = cos β: ₂F₁(1, 1; 3/2; p) with p = sin²(β/2), 1e-10 relative at 0.5 rad."""
    p = 0.5 - 0.5 * c
    return 1 + p * (2 / 3 + p * (8 / 15 + p * (16 / 35 + p * (128 / 315 + p * (
        256 / 693 + p * (1024 / 3003 + p * (2048 / 6435 + p * (32768 / 109395))))))))  # fmt: skip


def quaternion_from_axis(axis: np.ndarray) -> np.ndarray:
    """Twist-free quaternions that turn +z into each unit ``axis`` (shape (n, 3) → (n, 4)).

    For an axis that points straight up, where many solutions exist, a half turn about x is returned.
    """
    axis = np.atleast_2d(axis)
    q = np.stack([1 + axis[:, 2], -axis[:, 1], axis[:, 0], np.zeros(len(axis))], axis=1)
    q[q[:, 0] < 1e-12] = (0.0, 1.0, 0.0, 0.0)
    return np.asarray(q / np.linalg.norm(q, axis=1, keepdims=True))
