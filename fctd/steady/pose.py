"""The pose of a steady string: where its bodies lie and how their frames stand."""

from fctd.mechanics.jit import inlined
from fctd.mechanics.rotations import rotation_columns

# Columns of a pose, one row per body, row 0 the top drive: centre of mass [m], frame without spin
# (quaternion), spin about the own axis [rad].
PLACE, QUATERNION, SPIN, POSE = slice(0, 3), slice(3, 7), 7, 8


@inlined
def place(P, j):
    """Centre of mass of body j [m]."""
    return P[j, 0], P[j, 1], P[j, 2]


@inlined
def quaternion(P, j):
    """Frame of body j, without its spin."""
    return P[j, 3], P[j, 4], P[j, 5], P[j, 6]


@inlined
def stepped(w, x, y, z, a, b):
    """Quaternion after an infinitesimal tilt (a, b) in its own frame.

    To first order, so that its length stays 1: the imaginary part of a complex step.
    """
    return (
        w - 0.5 * (x * a + y * b),
        x + 0.5 * (w * a - z * b),
        y + 0.5 * (w * b + z * a),
        z + 0.5 * (x * b - y * a),
    )


@inlined
def times(aw, ax, ay, az, bw, bx, by, bz):
    """Product of two quaternions."""
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


@inlined
def in_frame(w, x, y, z, gx, gy, gz):
    """A global vector in the frame of a body."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
    return xx * gx + xy * gy + xz * gz, yx * gx + yy * gy + yz * gz, zx * gx + zy * gy + zz * gz
