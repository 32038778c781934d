"""The spring between two rigid segments (§3.2, Eqs 17–19), from one potential symmetric in both bodies.

With a and b the unit axes of the upper and lower body, d the gap between their hinge points, β the angle
between the axes and τ the twist, t = (a + b)/|a + b| is the direction half-way between them and

    U = ½ k_a (t·d)² + ½ k_s (|d|² − (t·d)²) + ½ k_b β² + ½ k_t τ².

A drill string is round, so shear and bending need no lateral directions: the half-way direction is all of
the mid-frame that the potential sees, and bending does not mix with any amount of twist.  The loads are
minus the exact derivatives of U.  Net force and moment on a free pair therefore vanish, a closed path does
no work, and the torque about each body's own axis is k_t τ whatever the bend.
"""

import math

from numba import njit

from fctd.dual import reciprocal, root
from fctd.rotations import angle_over_sine, twist_angle
from fctd.state import (
    ARM_BOTTOM,
    ARM_TOP,
    FX,
    FY,
    FZ,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    LOST_JOINT,
    LX,
    LY,
    LZ,
    SUM_TENSION,
    SUM_TORQUE,
    TINY,
    TURNS,
    UX,
    UY,
    UZ,
    axis,
    global_spin,
    position,
    quaternion,
    velocity,
)


@njit(forceinline=True)
def cross(ax, ay, az, bx, by, bz):
    """a × b."""
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@njit(forceinline=True)
def joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt):
    """Loads of one joint's springs.

    a, b : unit axes of the upper and lower body; d : gap from the upper to the lower hinge point [m];
    twist [rad]; ka, ks [N/m], kb, kt [N m/rad].  Returns force on the lower body [N], moment on the upper
    and on the lower body [N m], all global, and the tension [N]: ten scalars.
    """
    c = ax * bx + ay * by + az * bz
    sx, sy, sz = ax + bx, ay + by, az + bz
    inverse = reciprocal(root(2 + 2 * c + TINY))
    tx, ty, tz = sx * inverse, sy * inverse, sz * inverse
    stretch = tx * dx + ty * dy + tz * dz
    px, py, pz = dx - stretch * tx, dy - stretch * ty, dz - stretch * tz

    tension = ka * stretch
    fx = -tension * tx - ks * px
    fy = -tension * ty - ks * py
    fz = -tension * tz - ks * pz

    # Bending turns b towards a; twist acts along a + b, whose share along either axis is exactly k_t τ;
    # the last term is the moment of the hinge offset, shared by the turning of the half-way direction.
    bend = kb * angle_over_sine(c)
    cx, cy, cz = cross(bx, by, bz, ax, ay, az)
    torque = 2 * inverse * inverse * kt * twist
    offset = (ka - ks) * stretch * inverse
    apx, apy, apz = cross(ax, ay, az, px, py, pz)
    bpx, bpy, bpz = cross(bx, by, bz, px, py, pz)
    mx = bend * cx - torque * sx
    my = bend * cy - torque * sy
    mz = bend * cz - torque * sz
    return (
        fx, fy, fz,
        -mx - offset * apx, -my - offset * apy, -mz - offset * apz,
        mx - offset * bpx, my - offset * bpy, mz - offset * bpz,
        tension,
    )  # fmt: skip


@njit(forceinline=True)
def joint_damping(ax, ay, az, bx, by, bz, dx, dy, dz, rx, ry, rz, wx, wy, wz, ca, cs, cb, ct):
    """Damping of one joint, on relative motion only.

    d : gap [m]; r : its rate seen from a frame that turns with the pair [m/s]; w : spin of the lower body
    relative to the upper [rad/s]; ca, cs [N s/m], cb, ct [N m s/rad].  Returns force on the lower body,
    moment on the upper and lower body and the power lost [W]: ten scalars.
    """
    c = ax * bx + ay * by + az * bz
    inverse = reciprocal(root(2 + 2 * c + TINY))
    tx, ty, tz = (ax + bx) * inverse, (ay + by) * inverse, (az + bz) * inverse
    along = tx * rx + ty * ry + tz * rz
    fx = -cs * rx - (ca - cs) * along * tx
    fy = -cs * ry - (ca - cs) * along * ty
    fz = -cs * rz - (ca - cs) * along * tz
    about = tx * wx + ty * wy + tz * wz
    mx = -cb * wx - (ct - cb) * about * tx
    my = -cb * wy - (ct - cb) * about * ty
    mz = -cb * wz - (ct - cb) * about * tz
    # The force works at a gap: its couple is shared equally, as the turning of the pair is their mean.
    ox, oy, oz = cross(0.5 * dx, 0.5 * dy, 0.5 * dz, fx, fy, fz)
    power = -(fx * rx + fy * ry + fz * rz + mx * wx + my * wy + mz * wz)
    return fx, fy, fz, -mx - ox, -my - oy, -mz - oz, mx - ox, my - oy, mz - oz, power


@njit(forceinline=True)
def gap(ex, ey, ez, ax, ay, az, bx, by, bz, bottom, top):
    """Gap from the hinge point of the upper body to that of the lower [m].

    e : from centre to centre [m]; a, b : unit axes; bottom, top : arms to the joint along them [m].
    """
    return ex - top * bx - bottom * ax, ey - top * by - bottom * ay, ez - top * bz - bottom * az


@njit(forceinline=True)
def hinge_gap(S, j):
    """Gap at joint j from the hinge point of body j - 1 to that of body j [m], global."""
    x0, y0, z0 = position(S, j - 1)
    x1, y1, z1 = position(S, j)
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    return gap(x1 - x0, y1 - y0, z1 - z0, ax, ay, az, bx, by, bz, bottom, top)


@njit(forceinline=True)
def joint_twist(S, j):
    """Twist of body j against body j - 1 [rad], whole turns included."""
    aw, ax, ay, az = quaternion(S, j - 1)
    bw, bx, by, bz = quaternion(S, j)
    return twist_angle(aw, ax, ay, az, bw, bx, by, bz) + S[TURNS + j]


@njit(forceinline=True)
def gap_rate(S, j, dx, dy, dz):
    """Rate of the gap seen from the turning pair [m/s] and relative spin [rad/s] of joint j, global."""
    u0, v0, w0 = velocity(S, j - 1)
    u1, v1, w1 = velocity(S, j)
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    gx, gy, gz = global_spin(S, j - 1)
    hx, hy, hz = global_spin(S, j)
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    px, py, pz = cross(gx, gy, gz, ax, ay, az)
    qx, qy, qz = cross(hx, hy, hz, bx, by, bz)
    mx, my, mz = cross(0.5 * (gx + hx), 0.5 * (gy + hy), 0.5 * (gz + hz), dx, dy, dz)
    return (
        u1 - u0 - top * qx - bottom * px - mx,
        v1 - v0 - top * qy - bottom * py - my,
        w1 - w0 - top * qz - bottom * pz - mz,
        hx - gx, hy - gy, hz - gz,
    )  # fmt: skip


@njit(error_model="numpy", fastmath={"contract"})
def update_joint_loads(S, n, damping_time, dt):
    """Update joint loads, their sums and the energy lost, given positions, orientations and velocities.

    damping_time : stiffness-proportional damping [s].
    """
    for j in range(1, n + 1):
        ax, ay, az = axis(S, j - 1)
        bx, by, bz = axis(S, j)
        dx, dy, dz = hinge_gap(S, j)
        twist = joint_twist(S, j)
        ka, ks, kb, kt = S[K_AXIAL + j], S[K_SHEAR + j], S[K_BEND + j], S[K_TWIST + j]
        fx, fy, fz, ux, uy, uz, lx, ly, lz, tension = joint_loads(
            ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt
        )
        rx, ry, rz, wx, wy, wz = gap_rate(S, j, dx, dy, dz)
        gx, gy, gz, vx, vy, vz, mx, my, mz, power = joint_damping(
            ax, ay, az, bx, by, bz, dx, dy, dz, rx, ry, rz, wx, wy, wz,
            damping_time * ka, damping_time * ks, damping_time * kb, damping_time * kt,
        )  # fmt: skip
        S[FX + j], S[FY + j], S[FZ + j] = fx + gx, fy + gy, fz + gz
        S[UX + j], S[UY + j], S[UZ + j] = ux + vx, uy + vy, uz + vz
        S[LX + j], S[LY + j], S[LZ + j] = lx + mx, ly + my, lz + mz
        S[SUM_TENSION + j] += dt * tension
        S[SUM_TORQUE + j] += -dt * kt * twist
        S[LOST_JOINT + j] += dt * power


@njit(error_model="numpy")
def strain_energy(S, j):
    """Strain energy of joint j [J]: the potential that ``joint_loads`` differentiates."""
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    dx, dy, dz = hinge_gap(S, j)
    tx, ty, tz = ax + bx, ay + by, az + bz
    stretch = (tx * dx + ty * dy + tz * dz) / math.sqrt(tx * tx + ty * ty + tz * tz)
    sx, sy, sz = cross(ax, ay, az, bx, by, bz)
    bend = math.atan2(math.sqrt(sx * sx + sy * sy + sz * sz), ax * bx + ay * by + az * bz)
    twist = joint_twist(S, j)
    shear = dx * dx + dy * dy + dz * dz - stretch * stretch
    stiff = S[K_AXIAL + j] * stretch * stretch + S[K_SHEAR + j] * shear
    return 0.5 * (stiff + S[K_BEND + j] * bend * bend + S[K_TWIST + j] * twist * twist)
