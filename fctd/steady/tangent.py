"""Forces out of balance on a steady string and their derivative, by a complex step through the engine's helpers.

A steady string slides along the hole at one speed or turns at one rate while its shape stands still.  The
unknowns of a body are the position of its centre of mass, a rotation of its frame and its spin about its own
axis; the frames themselves do not spin, so a string may be twisted by many turns.  A complex step of 1e-30
differentiates without a difference: the derivative is exact to rounding and needs no second copy of the
equations (Squire & Trapp 1998).
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.contact import arc_direction, arc_owner, arc_wall, cylinder_direction, cylinder_owner, cylinder_wall
from fctd.mechanics.dual import power, reciprocal, root
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.joints import arms_to_gap, cross, gap, joint_loads
from fctd.mechanics.laws import steady_load
from fctd.mechanics.rotations import rotation_columns, twist_angle
from fctd.mechanics.state import (
    ARCS,
    ARM_BOTTOM,
    ARM_CONTACT,
    ARM_TOP,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    MUD_AXIAL,
    MUD_SPIN,
    OPEN,
    RADIUS,
    TINY,
    TRIBUTARY,
    WEIGHT,
)

# Columns of a pose, one row per body, row 0 the top drive: centre of mass [m], frame without spin
# (quaternion), spin about the own axis [rad].
PLACE, QUATERNION, SPIN, POSE = slice(0, 3), slice(3, 7), 7, 8
# Columns of the imbalance: force [N], global; moment [N m] in the frame of the body, the last about its axis.
FORCE, AXIAL_MOMENT = slice(0, 3), 5
# Columns of the loads of joints: tension [N], torque, bending moment [N m].
JOINT_TENSION, JOINT_TORQUE, JOINT_BENDING, JOINT_COLUMNS = 0, 1, 2, 3
# Columns of the loads of contact points, after their place [m], global: normal force [N], r F_t and r μ F_n [N m].
NORMAL_FORCE, R_FT, R_MU_FN, CONTACT_COLUMNS = 3, 4, 5, 6
STEP = 1e-30
UNIT = 1 / STEP
# Imaginary parts that step through the unknowns one by one.
ONE_BY_ONE = STEP * np.eye(8)


class Steady(NamedTuple):
    """Motion of a steady string, and the loads at its bit.

    geometry, friction : as in Laws.  friction_scale : multiplies every friction factor.
    speed : along the hole, downwards [m/s]; spin [rad/s].
    bit_x, bit_y, bit_z : force on the bit [N], global; bit_torque : torque that resists the bit's rotation [N m].
    at_axis : 0, or 1 where the friction force along the hole acts at the string's axis and not at its surface, which
    leaves out its bending moment (relaxation.py).
    wall_exponent, wall_reference : as in Laws.
    """

    geometry: int
    friction: int
    friction_scale: float
    speed: float
    spin: float
    bit_x: float
    bit_y: float
    bit_z: float
    bit_torque: float
    at_axis: int = 0
    wall_exponent: float = 1.0
    wall_reference: float = 1e-3


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
    """Quaternion after an infinitesimal tilt (a, b) in its own frame."""
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


@inlined
def pair_loads(ex, ey, ez, aw, ax, ay, az, bw, bx, by, bz, kw, kx, ky, kz, spin, bottom, top, ka, ks, kb, kt):
    """Loads of a joint on its two bodies.

    e : from the centre of the upper body to that of the lower [m]; a, b : their frames; k : bend of the upper
    body's end (quaternion in its frame); spin : further rotation of the lower body about its axis [rad].
    Returns force on the lower body [N], global, and the moment about the centre of the upper and of the lower
    body, each in its own frame [N m]: nine scalars.
    """
    _, _, _, _, _, _, ux, uy, uz = rotation_columns(aw, ax, ay, az)
    _, _, _, _, _, _, lx, ly, lz = rotation_columns(bw, bx, by, bz)
    dx, dy, dz = gap(ex, ey, ez, ux, uy, uz, lx, ly, lz, bottom, top)
    qw, qx, qy, qz = times(aw, ax, ay, az, kw, kx, ky, kz)
    _, _, _, _, _, _, vx, vy, vz = rotation_columns(qw, qx, qy, qz)
    twist = twist_angle(qw, qx, qy, qz, bw, bx, by, bz) + spin
    fx, fy, fz, cx, cy, cz, _ = joint_loads(vx, vy, vz, lx, ly, lz, dx, dy, dz, twist, ka, ks, kb, kt)
    px, py, pz, qx, qy, qz = arms_to_gap(ux, uy, uz, lx, ly, lz, dx, dy, dz, bottom, top)
    ox, oy, oz = cross(px, py, pz, fx, fy, fz)
    hx, hy, hz = cross(qx, qy, qz, fx, fy, fz)
    pa, pb, pc = in_frame(aw, ax, ay, az, -cx - ox, -cy - oy, -cz - oz)
    ma, mb, mc = in_frame(bw, bx, by, bz, cx + hx, cy + hy, cz + hz)
    return fx, fy, fz, pa, pb, pc, ma, mb, mc


@kernel
def wall_loads(C, i, laws, x, y, z, w, qx, qy, qz, arm, radius, tributary):
    """Loads of the wall on a body with its centre at (x, y, z) and its frame q.

    Returns force [N], global; moment about the centre [N m], in the body's frame; normal force [N] and
    friction torque r F_t about the axis [N m], r μ F_n [N m]: nine scalars.
    """
    _, _, _, _, _, _, ax, ay, az = rotation_columns(w, qx, qy, qz)
    px, py, pz = x + arm * ax, y + arm * ay, z + arm * az
    zero = 0 * px
    if laws.geometry == ARCS:
        rx, ry, rz, hole, stiffness, factor, _ = arc_wall(C, i, px, py, pz)
        tx, ty, tz = arc_direction(C, i, px, py, pz)
    else:
        rx, ry, rz, hole, stiffness, factor, _ = cylinder_wall(C, i, px, py, pz)
        tx, ty, tz = cylinder_direction(C, i, px, py, pz)
    distance = root(rx * rx + ry * ry + rz * rz)
    penetration = distance - hole + radius
    if penetration.real < 0:
        return zero, zero, zero, zero, zero, zero, zero, zero, zero
    k = reciprocal(distance + TINY)
    nx, ny, nz = k * rx, k * ry, k * rz
    normal = stiffness * tributary * penetration
    if laws.wall_exponent != 1:
        pressed = power(penetration / laws.wall_reference, laws.wall_exponent)
        normal = stiffness * tributary * laws.wall_reference * pressed
    limit = laws.friction_scale * factor * normal
    fx, fy, fz, mx, my, mz, torque = steady_load(
        laws.friction, laws.speed, laws.spin, limit, radius, ax, ay, az, nx, ny, nz, tx, ty, tz
    )
    if laws.at_axis:
        about = mx * ax + my * ay + mz * az
        mx, my, mz = about * ax, about * ay, about * az
    fx, fy, fz = fx - normal * nx, fy - normal * ny, fz - normal * nz
    ox, oy, oz = cross(arm * ax, arm * ay, arm * az, fx, fy, fz)
    ma, mb, mc = in_frame(w, qx, qy, qz, mx + ox, my + oy, mz + oz)
    return fx, fy, fz, ma, mb, mc, normal, -torque, radius * limit


@inlined
def move_lower(L, k, column, j, D, U):
    """Add derivative k of a joint's loads as the derivative by an unknown of the lower body."""
    for i in range(3):
        D[j, i, column] -= L[8 * i + k]
        D[j, 3 + i, column] -= L[48 + 8 * i + k]
        U[j, i, column] += L[8 * i + k]
        U[j, 3 + i, column] -= L[24 + 8 * i + k]


@inlined
def move_upper(L, k, column, sign, j, D, A):
    """Add derivative k of a joint's loads, times ``sign``, as the derivative by an unknown of the upper body."""
    for i in range(3):
        D[j - 1, i, column] += sign * L[8 * i + k]
        D[j - 1, 3 + i, column] -= sign * L[24 + 8 * i + k]
        A[j, i, column] -= sign * L[8 * i + k]
        A[j, 3 + i, column] -= sign * L[48 + 8 * i + k]


@kernel
def differentiate_joint(S, j, P, kinks, L):
    """Fill L (18 × 8, flat): the nine loads of joint j differentiated by eight unknowns, then nine rows of loads.

    Unknowns : shift of the lower body, tilt of the upper, tilt and spin of the lower.  The loop over them packs.
    """
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    ka, ks, kb, kt = S[K_AXIAL + j], S[K_SHEAR + j], S[K_BEND + j], S[K_TWIST + j]
    x, y, z = P[j, 0] - P[j - 1, 0], P[j, 1] - P[j - 1, 1], P[j, 2] - P[j - 1, 2]
    aw, ax, ay, az = quaternion(P, j - 1)
    bw, bx, by, bz = quaternion(P, j)
    kw, kx, ky, kz = kinks[j, 0], kinks[j, 1], kinks[j, 2], kinks[j, 3]
    spin = P[j, SPIN] - P[j - 1, SPIN]
    for k in range(8):
        cw, cx, cy, cz = stepped(aw, ax, ay, az, complex(0.0, ONE_BY_ONE[3, k]), complex(0.0, ONE_BY_ONE[4, k]))
        dw, dx, dy, dz = stepped(bw, bx, by, bz, complex(0.0, ONE_BY_ONE[5, k]), complex(0.0, ONE_BY_ONE[6, k]))
        fx, fy, fz, pa, pb, pc, ma, mb, mc = pair_loads(
            complex(x, ONE_BY_ONE[0, k]), complex(y, ONE_BY_ONE[1, k]), complex(z, ONE_BY_ONE[2, k]),
            cw, cx, cy, cz, dw, dx, dy, dz, kw, kx, ky, kz, complex(spin, ONE_BY_ONE[7, k]),
            bottom, top, ka, ks, kb, kt,
        )  # fmt: skip
        L[0 + k], L[8 + k], L[16 + k] = fx.imag * UNIT, fy.imag * UNIT, fz.imag * UNIT
        L[24 + k], L[32 + k], L[40 + k] = pa.imag * UNIT, pb.imag * UNIT, pc.imag * UNIT
        L[48 + k], L[56 + k], L[64 + k] = ma.imag * UNIT, mb.imag * UNIT, mc.imag * UNIT
        L[72 + k], L[80 + k], L[88 + k] = fx.real, fy.real, fz.real
        L[96 + k], L[104 + k], L[112 + k] = pa.real, pb.real, pc.real
        L[120 + k], L[128 + k], L[136 + k] = ma.real, mb.real, mc.real


@kernel
def add_joint(S, j, P, kinks, R, D, A, U, L):
    """Add joint j to the forces out of balance R and to the blocks of the tangent −∂R/∂(unknowns).

    D (n + 1, 6, 6) : bodies on themselves; A : body j against body j − 1; U : body j − 1 against body j.
    """
    differentiate_joint(S, j, P, kinks, L)
    for k in range(3):  # a shift of the lower body acts as the opposite shift of the upper
        move_lower(L, k, k, j, D, U)
        move_upper(L, k, k, -1.0, j, D, A)
    for k in range(2):
        move_upper(L, 3 + k, 3 + k, 1.0, j, D, A)
        move_lower(L, 5 + k, 3 + k, j, D, U)
    move_lower(L, 7, 5, j, D, U)  # and so does its spin
    move_upper(L, 7, 5, -1.0, j, D, A)
    for i in range(3):
        R[j, i] += L[72 + 8 * i]
        R[j, 3 + i] += L[120 + 8 * i]
        R[j - 1, i] -= L[72 + 8 * i]
        R[j - 1, 3 + i] += L[96 + 8 * i]


@kernel
def add_wall(S, j, P, C, owner, laws, R, D):
    """Add the wall beside contact point j to the forces out of balance and to the tangent."""
    x, y, z = place(P, j)
    w, qx, qy, qz = quaternion(P, j)
    arm = S[ARM_CONTACT + j]
    _, _, _, _, _, _, ax, ay, az = rotation_columns(w, qx, qy, qz)
    tx, ty, tz = x + arm * ax, y + arm * ay, z + arm * az
    if laws.geometry == ARCS:
        owner[j] = arc_owner(C, owner[j], tx, ty, tz)
        rx, ry, rz, hole, _, _, _ = arc_wall(C, owner[j], tx, ty, tz)
    else:
        owner[j] = cylinder_owner(C, owner[j], tx, ty, tz)
        rx, ry, rz, hole, _, _, _ = cylinder_wall(C, owner[j], tx, ty, tz)
    if np.sqrt(rx * rx + ry * ry + rz * rz) < hole - S[RADIUS + j]:
        return
    for k in range(5):  # spin about the body's axis does not change them
        cw, cx, cy, cz = stepped(w, qx, qy, qz, complex(0.0, ONE_BY_ONE[3, k]), complex(0.0, ONE_BY_ONE[4, k]))
        loads = wall_loads(
            C, owner[j], laws,
            complex(x, ONE_BY_ONE[0, k]), complex(y, ONE_BY_ONE[1, k]), complex(z, ONE_BY_ONE[2, k]),
            cw, cx, cy, cz, arm, S[RADIUS + j], S[TRIBUTARY + j],
        )  # fmt: skip
        for i in range(6):
            D[j, i, k] -= loads[i].imag * UNIT
            if k == 0:
                R[j, i] += loads[i].real


@entry
def assemble(S, n, P, kinks, C, owner, laws, R, D, A, U):
    """Fill R (n + 1, 6) with forces [N] and moments [N m] out of balance and D, A, U with the tangent −∂R.

    Forces and shifts are global, moments and rotations in the frame of the body.  Row 0 contains the reactions of
    the top drive.  C : table of the hole; kinks (n + 2, 4) : bend above each joint.
    """
    for B in (D[: n + 1], A[: n + 1], U[: n + 1]):
        B[:] = 0.0
    R[: n + 1] = 0.0
    L = np.empty(18 * 8)
    for j in range(1, n + 1):
        add_joint(S, j, P, kinks, R, D, A, U, L)
        R[j, 2] += S[WEIGHT + j]
        # Mud drags a sliding string along its own axis and a turning one about it.
        drag = -S[MUD_AXIAL + j] * laws.speed
        w, x, y, z = quaternion(P, j)
        xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
        R[j, 0] += drag * zx
        R[j, 1] += drag * zy
        R[j, 2] += drag * zz
        R[j, AXIAL_MOMENT] -= S[MUD_SPIN + j] * laws.spin
        # A tilt (a, b) turns the axis by a (−y) + b x.
        for i, dx, dy in ((0, xx, yx), (1, xy, yy), (2, xz, yz)):
            D[j, i, 3] += drag * dy
            D[j, i, 4] -= drag * dx
        if laws.geometry != OPEN:
            add_wall(S, j, P, C, owner, laws, R, D)
    R[n, 0] += laws.bit_x
    R[n, 1] += laws.bit_y
    R[n, 2] += laws.bit_z
    # The force acts at the bit, an arm away from the centre of the last body.
    arm = S[ARM_BOTTOM + n]
    w, x, y, z = quaternion(P, n)
    fa, fb, fc = in_frame(w, x, y, z, laws.bit_x, laws.bit_y, laws.bit_z)
    R[n, 3] -= arm * fb
    R[n, 4] += arm * fa
    R[n, AXIAL_MOMENT] -= laws.bit_torque
    D[n, 3, 3] += arm * fc
    D[n, 4, 4] += arm * fc


@entry
def frictionless_tangent(S, n, P, kinks, C, owner, laws, R, D, A, U):
    """Fill D, A, U with the tangent of springs, weight and wall alone: symmetric, positive definite when stable."""
    bare = Steady(
        laws.geometry, laws.friction, 0.0, 0.0, 0.0, laws.bit_x, laws.bit_y, laws.bit_z, laws.bit_torque, 0,
        laws.wall_exponent, laws.wall_reference,
    )  # fmt: skip
    assemble(S, n, P, kinks, C, owner, bare, R, D, A, U)


@kernel
def read_loads(S, n, P, kinks, C, owner, laws, joints, contacts):
    """Fill the loads of a steady string.

    joints (n + 1, JOINT_COLUMNS), contacts (n + 1, CONTACT_COLUMNS) : columns above; row 0 is not used.
    """
    for j in range(1, n + 1):
        aw, ax, ay, az = quaternion(P, j - 1)
        bw, bx, by, bz = quaternion(P, j)
        _, _, _, _, _, _, ux, uy, uz = rotation_columns(aw, ax, ay, az)
        _, _, _, _, _, _, lx, ly, lz = rotation_columns(bw, bx, by, bz)
        qw, qx, qy, qz = times(aw, ax, ay, az, kinks[j, 0], kinks[j, 1], kinks[j, 2], kinks[j, 3])
        _, _, _, _, _, _, vx, vy, vz = rotation_columns(qw, qx, qy, qz)
        ex, ey, ez = P[j, 0] - P[j - 1, 0], P[j, 1] - P[j - 1, 1], P[j, 2] - P[j - 1, 2]
        dx, dy, dz = gap(ex, ey, ez, ux, uy, uz, lx, ly, lz, S[ARM_BOTTOM + j - 1], S[ARM_TOP + j])
        twist = twist_angle(qw, qx, qy, qz, bw, bx, by, bz) + P[j, SPIN] - P[j - 1, SPIN]
        kb, kt = S[K_BEND + j], S[K_TWIST + j]
        loads = joint_loads(vx, vy, vz, lx, ly, lz, dx, dy, dz, twist, S[K_AXIAL + j], S[K_SHEAR + j], kb, kt)
        joints[j, JOINT_TENSION] = loads[6]
        joints[j, JOINT_TORQUE] = -kt * twist
        cx, cy, cz = cross(vx, vy, vz, lx, ly, lz)
        joints[j, JOINT_BENDING] = kb * np.arctan2(np.sqrt(cx * cx + cy * cy + cz * cz), vx * lx + vy * ly + vz * lz)
        arm = S[ARM_CONTACT + j]
        contacts[j, 0], contacts[j, 1], contacts[j, 2] = P[j, 0] + arm * lx, P[j, 1] + arm * ly, P[j, 2] + arm * lz
        contacts[j, NORMAL_FORCE:] = 0.0
        if laws.geometry != OPEN:
            wall = wall_loads(
                C, owner[j], laws, P[j, 0], P[j, 1], P[j, 2], bw, bx, by, bz, arm, S[RADIUS + j], S[TRIBUTARY + j]
            )
            contacts[j, NORMAL_FORCE], contacts[j, R_FT], contacts[j, R_MU_FN] = wall[6], wall[7], wall[8]
