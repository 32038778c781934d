"""The spring between two rigid segments (§3.2, Eqs 17–19), from one potential symmetric in both bodies.

With a and b the unit axes of the upper and lower body, d the gap between their hinge points, β the angle
between the axes and τ the twist, t = (a + b)/|a + b| is the direction half-way between them and

    U = ½ k_a (t·d)² + ½ k_s (|d|² − (t·d)²) + ½ k_b β² + ½ k_t τ².

A drill string is round, so shear and bending need no lateral directions: of the mid-frame the potential needs
only the half-way direction, and bending is independent of twist.  The loads are minus the exact derivatives of U.
Taken in the middle of the gap they are one force and one couple, opposite on the two bodies.  Therefore net force and
moment on a free pair vanish, the work over a closed path is zero, and the torque about each body's own axis is k_t τ
for any bend.
"""

import math

from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.jit import entry, inlined
from fctd.mechanics.rotations import angle_over_sine, rotation_columns, twist_angle
from fctd.mechanics.state import (
    ARM_BOTTOM,
    ARM_CONTACT,
    ARM_TOP,
    FX,
    FY,
    FZ,
    INVERSE_JT,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    K_WALL,
    KINK_X,
    KINK_Y,
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
    lateral_inverse_mass,
    position,
    quaternion,
    velocity,
)


@inlined
def cross(ax, ay, az, bx, by, bz):
    """a × b."""
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@inlined
def halfway(ax, ay, az, bx, by, bz):
    """The sum s of two unit axes and 1/|s|².

    With t = s/|s| the vector t (t·v) is s (s·v)/|s|²: no square root on the way to the loads.
    """
    return ax + bx, ay + by, az + bz, reciprocal(2 + 2 * (ax * bx + ay * by + az * bz) + TINY)


@inlined
def joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt):
    """Loads of one joint's springs.

    a, b : unit axes of the upper and lower body; d : gap from the upper to the lower hinge point [m];
    twist [rad]; ka, ks [N/m], kb, kt [N m/rad].  Returns the force on the lower body in the middle of the
    gap [N], the couple on it [N m] and the tension [N], all global: seven scalars.  The force and couple
    on the upper body are opposite.
    """
    c = ax * bx + ay * by + az * bz
    sx, sy, sz, share = halfway(ax, ay, az, bx, by, bz)
    along = share * (sx * dx + sy * dy + sz * dz)
    offset = (ka - ks) * along
    fx = -ks * dx - offset * sx
    fy = -ks * dy - offset * sy
    fz = -ks * dz - offset * sz

    # Bending turns b towards a; twist acts along a + b, with a component along either axis of exactly k_t τ;
    # the last term is the moment of the hinge offset, since the half-way direction turns with either body.
    bend = kb * angle_over_sine(c) + offset * along
    torque = 2 * share * kt * twist
    half = 0.5 * offset
    cx, cy, cz = cross(bx, by, bz, ax, ay, az)
    ex, ey, ez = cross(ax - bx, ay - by, az - bz, dx, dy, dz)
    return (
        fx, fy, fz,
        bend * cx - torque * sx + half * ex,
        bend * cy - torque * sy + half * ey,
        bend * cz - torque * sz + half * ez,
        ka * along * root(2 + 2 * c),
    )  # fmt: skip


@inlined
def joint_damping(ax, ay, az, bx, by, bz, rx, ry, rz, wx, wy, wz, ca, cs, cb, ct):
    """Damping of one joint by its relative motion.

    a, b : unit axes of the upper and lower body; r : velocity [m/s] and w : spin [rad/s] of the lower body
    relative to the upper, both in the middle of the gap; ca, cs [N s/m], cb, ct [N m s/rad].  Returns force and
    couple on the lower body in the middle of the gap and the power lost [W]: seven scalars.
    """
    sx, sy, sz, share = halfway(ax, ay, az, bx, by, bz)
    along = (ca - cs) * share * (sx * rx + sy * ry + sz * rz)
    fx = -cs * rx - along * sx
    fy = -cs * ry - along * sy
    fz = -cs * rz - along * sz
    about = (ct - cb) * share * (sx * wx + sy * wy + sz * wz)
    mx = -cb * wx - about * sx
    my = -cb * wy - about * sy
    mz = -cb * wz - about * sz
    power = -(fx * rx + fy * ry + fz * rz + mx * wx + my * wy + mz * wz)
    return fx, fy, fz, mx, my, mz, power


# What ``shape_damping`` returns of a string without it.
NO_SHAPE_DAMPING = (0.0,) * 10


@inlined
def shape_dampers(S, j, time, own_time, wall_exponent, dt):
    """Dampers of shear [N s/m] and bending [N m s/rad] of joint j for ``shape_damping``, in proportion to stiffness.

    With half of each body for either of its joints a motion is stable for ω²h² + 2E ≤ 4, E the share of it that all
    dampers take in a step.  Where the joint with its own damping of ``own_time`` [s], and the wall at the lower body,
    leave less room than these dampers want, they are weaker, so that they neither shorten the step nor reverse a
    motion, however short the segments are.
    """
    bottom, top, arm = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j], S[ARM_CONTACT + j]
    upper, lower = S[INVERSE_JT + j - 1], S[INVERSE_JT + j]
    mass = lateral_inverse_mass(S, j)
    cs, cb = time * S[K_SHEAR + j], time * S[K_BEND + j]
    in_shear = lateral_inverse_mass(S, j - 1) + mass + bottom * bottom * upper + top * top * lower
    on_wall = wall_exponent * S[K_WALL + j] * (mass + arm * arm * lower)
    springs = 2 * dt * (S[K_SHEAR + j] * in_shear + S[K_BEND + j] * (upper + lower))
    taken = time * springs
    room = 2 - (0.5 * dt + own_time) * springs - dt * dt * on_wall
    room = room if room > 0 else 0.0
    room = room if room < 1 else 1.0
    k = room / ((taken if taken > room else room) + TINY)
    return k * cs, k * cb


@inlined
def shape_damping(S, j, time, own_time, wall_exponent, dt):
    """Damping of the change of shape in space at joint j, zero for a bent string that turns steadily.

    time [s] : of the damping in proportion to stiffness; own_time [s] : of the joint's own damping.  With the unit axes
    a and b of the upper and lower body, their rates ȧ = ω × a and that of the gap ḋ in space, ḋ_s across the half-way
    direction, the power is
    −c_b |ḃ − ȧ|² − c_s |ḋ_s|², and the loads are its gradient: couples c_b a × (ḃ − ȧ) and −c_b b × (ḃ − ȧ), forces
    ∓c_s ḋ_s at the hinge points.  In rotor dynamics this is a non-rotating damping.  Returns force on the lower body
    at its hinge point, moments about the centres of the upper and the lower body, and the power lost: ten scalars.
    """
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    cs, cb = shape_dampers(S, j, time, own_time, wall_exponent, dt)
    u0, v0, w0 = velocity(S, j - 1)
    u1, v1, w1 = velocity(S, j)
    ex, ey, ez = cross(*global_spin(S, j - 1), ax, ay, az)
    hx, hy, hz = cross(*global_spin(S, j), bx, by, bz)
    rx, ry, rz = u1 - u0 - top * hx - bottom * ex, v1 - v0 - top * hy - bottom * ey, w1 - w0 - top * hz - bottom * ez
    sx, sy, sz, share = halfway(ax, ay, az, bx, by, bz)
    along = share * (sx * rx + sy * ry + sz * rz)
    fx, fy, fz = -cs * (rx - along * sx), -cs * (ry - along * sy), -cs * (rz - along * sz)
    hx, hy, hz = cb * (hx - ex), cb * (hy - ey), cb * (hz - ez)
    ux, uy, uz = cross(ax, ay, az, hx - bottom * fx, hy - bottom * fy, hz - bottom * fz)
    lx, ly, lz = cross(bx, by, bz, -hx - top * fx, -hy - top * fy, -hz - top * fz)
    power = (hx * hx + hy * hy + hz * hz) / (cb + TINY) - (fx * rx + fy * ry + fz * rz)
    return fx, fy, fz, ux, uy, uz, lx, ly, lz, power


@inlined
def gap(ex, ey, ez, ax, ay, az, bx, by, bz, bottom, top):
    """Gap from the hinge point of the upper body to that of the lower [m].

    e : from centre to centre [m]; a, b : unit axes; bottom, top : arms to the joint along them [m].
    """
    return ex - top * bx - bottom * ax, ey - top * by - bottom * ay, ez - top * bz - bottom * az


@inlined
def arms_to_gap(ax, ay, az, bx, by, bz, dx, dy, dz, bottom, top):
    """Vectors from the centre of the upper and of the lower body to the middle of the gap [m]; see ``gap``."""
    return (
        bottom * ax + 0.5 * dx, bottom * ay + 0.5 * dy, bottom * az + 0.5 * dz,
        -top * bx - 0.5 * dx, -top * by - 0.5 * dy, -top * bz - 0.5 * dz,
    )  # fmt: skip


@inlined
def hinge_gap(S, j):
    """Gap at joint j from the hinge point of body j - 1 to that of body j [m], global."""
    x0, y0, z0 = position(S, j - 1)
    x1, y1, z1 = position(S, j)
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    bottom, top = S[ARM_BOTTOM + j - 1], S[ARM_TOP + j]
    return gap(x1 - x0, y1 - y0, z1 - z0, ax, ay, az, bx, by, bz, bottom, top)


@inlined
def joint_twist(S, j):
    """Twist of body j against body j - 1 [rad], whole turns included."""
    aw, ax, ay, az = quaternion(S, j - 1)
    bw, bx, by, bz = quaternion(S, j)
    return twist_angle(aw, ax, ay, az, bw, bx, by, bz) + S[TURNS + j]


@inlined
def relative_motion(S, j, px, py, pz, qx, qy, qz):
    """Velocity [m/s] and spin [rad/s] of body j relative to body j - 1 in the middle of joint j's gap, global.

    p, q : vectors from the two centres to the middle [m].
    """
    u0, v0, w0 = velocity(S, j - 1)
    u1, v1, w1 = velocity(S, j)
    gx, gy, gz = global_spin(S, j - 1)
    hx, hy, hz = global_spin(S, j)
    return (
        u1 + (hy * qz - hz * qy) - (u0 + (gy * pz - gz * py)),
        v1 + (hz * qx - hx * qz) - (v0 + (gz * px - gx * pz)),
        w1 + (hx * qy - hy * qx) - (w0 + (gx * py - gy * px)),
        hx - gx, hy - gy, hz - gz,
    )  # fmt: skip


@inlined
def update_joint_loads(S, n, damping_time, dt, torsion_time=0.0, shape_time=0.0, wall_exponent=1.0):
    """Update joint loads, their sums and the energy lost, given positions, orientations and velocities.

    damping_time : stiffness-proportional damping [s]; torsion_time : more of it for torsion [s]; shape_time : of
    ``shape_damping`` [s]; wall_exponent : of the wall's law, whose stiffness it multiplies.
    """
    if shape_time == 0:
        for j in range(1, n + 1):
            load_joint(S, j, damping_time, dt, torsion_time, NO_SHAPE_DAMPING)
        return
    for j in range(1, n + 1):
        shape = shape_damping(S, j, shape_time, damping_time, wall_exponent, dt)
        load_joint(S, j, damping_time, dt, torsion_time, shape)


@inlined
def load_joint(S, j, damping_time, dt, torsion_time, shape):
    """Update loads, sums and the energy lost of joint j; shape : of ``shape_damping``."""
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    dx, dy, dz = hinge_gap(S, j)
    twist = joint_twist(S, j)
    ka, ks, kb, kt = S[K_AXIAL + j], S[K_SHEAR + j], S[K_BEND + j], S[K_TWIST + j]
    fx, fy, fz, cx, cy, cz, tension = joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt)
    px, py, pz, qx, qy, qz = arms_to_gap(ax, ay, az, bx, by, bz, dx, dy, dz, S[ARM_BOTTOM + j - 1], S[ARM_TOP + j])
    rx, ry, rz, wx, wy, wz = relative_motion(S, j, px, py, pz, qx, qy, qz)
    gx, gy, gz, mx, my, mz, power = joint_damping(
        ax, ay, az, bx, by, bz, rx, ry, rz, wx, wy, wz,
        damping_time * ka, damping_time * ks, damping_time * kb, (damping_time + torsion_time) * kt,
    )  # fmt: skip
    fx, fy, fz = fx + gx, fy + gy, fz + gz
    cx, cy, cz = cx + mx, cy + my, cz + mz
    ux, uy, uz = cross(fx, fy, fz, px, py, pz)
    lx, ly, lz = cross(qx, qy, qz, fx, fy, fz)
    hx, hy, hz, ox, oy, oz, ix, iy, iz, shaped = shape
    S[FX + j], S[FY + j], S[FZ + j] = fx + hx, fy + hy, fz + hz
    S[UX + j], S[UY + j], S[UZ + j] = ux - cx + ox, uy - cy + oy, uz - cz + oz
    S[LX + j], S[LY + j], S[LZ + j] = lx + cx + ix, ly + cy + iy, lz + cz + iz
    S[SUM_TENSION + j] += dt * tension
    S[SUM_TORQUE + j] += -dt * kt * twist
    S[LOST_JOINT + j] += dt * (power + shaped)


@inlined
def tilted_end(S, j):
    """Axis of the end of body j - 1 at joint j, which a bent housing tilts, and the twist of body j against it [rad].

    The tilt is fixed to body j - 1 and turns with it.
    """
    w, x, y, z = quaternion(S, j - 1)
    kx, ky = S[KINK_X + j], S[KINK_Y + j]
    kw = math.sqrt(1 - kx * kx - ky * ky)
    w, x, y, z = w * kw - x * kx - y * ky, w * kx + x * kw - z * ky, w * ky + y * kw + z * kx, z * kw + x * ky - y * kx
    _, _, _, _, _, _, ax, ay, az = rotation_columns(w, x, y, z)
    return ax, ay, az, twist_angle(w, x, y, z, *quaternion(S, j)) + S[TURNS + j]


@inlined
def bend_housings(S, n, dt):
    """Update loads and sums of the joints with a bent housing, given those of straight ones.

    The potential is that of a straight joint between the tilted end of the upper body and the lower body.
    """
    for j in range(2, n + 1):
        if S[KINK_X + j] == 0 and S[KINK_Y + j] == 0:
            continue
        ax, ay, az = axis(S, j - 1)
        bx, by, bz = axis(S, j)
        dx, dy, dz = hinge_gap(S, j)
        twist = joint_twist(S, j)
        vx, vy, vz, turned = tilted_end(S, j)
        ka, ks, kb, kt = S[K_AXIAL + j], S[K_SHEAR + j], S[K_BEND + j], S[K_TWIST + j]
        straight = joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, twist, ka, ks, kb, kt)
        bent = joint_loads(vx, vy, vz, bx, by, bz, dx, dy, dz, turned, ka, ks, kb, kt)
        fx, fy, fz = bent[0] - straight[0], bent[1] - straight[1], bent[2] - straight[2]
        cx, cy, cz = bent[3] - straight[3], bent[4] - straight[4], bent[5] - straight[5]
        px, py, pz, qx, qy, qz = arms_to_gap(ax, ay, az, bx, by, bz, dx, dy, dz, S[ARM_BOTTOM + j - 1], S[ARM_TOP + j])
        ux, uy, uz = cross(fx, fy, fz, px, py, pz)
        lx, ly, lz = cross(qx, qy, qz, fx, fy, fz)
        S[FX + j], S[FY + j], S[FZ + j] = S[FX + j] + fx, S[FY + j] + fy, S[FZ + j] + fz
        S[UX + j], S[UY + j], S[UZ + j] = S[UX + j] + ux - cx, S[UY + j] + uy - cy, S[UZ + j] + uz - cz
        S[LX + j], S[LY + j], S[LZ + j] = S[LX + j] + lx + cx, S[LY + j] + ly + cy, S[LZ + j] + lz + cz
        S[SUM_TENSION + j] += dt * (bent[6] - straight[6])
        S[SUM_TORQUE + j] -= dt * kt * (turned - twist)


@entry
def find_bends(S, n, bends):
    """Fill the angles (n,) [rad] by which the joints are bent out of their unloaded shape; axes must be up to date."""
    for j in range(1, n + 1):
        ax, ay, az, _ = tilted_end(S, j)
        bx, by, bz = axis(S, j)
        sx, sy, sz = cross(ax, ay, az, bx, by, bz)
        bends[j - 1] = math.atan2(math.sqrt(sx * sx + sy * sy + sz * sz), ax * bx + ay * by + az * bz)


@inlined
def strain_energy(S, j):
    """Strain energy of joint j [J]: the potential that ``joint_loads`` differentiates."""
    ax, ay, az = axis(S, j - 1)
    twist = joint_twist(S, j)
    if S[KINK_X + j] != 0 or S[KINK_Y + j] != 0:
        ax, ay, az, twist = tilted_end(S, j)
    bx, by, bz = axis(S, j)
    dx, dy, dz = hinge_gap(S, j)
    tx, ty, tz = ax + bx, ay + by, az + bz
    stretch = (tx * dx + ty * dy + tz * dz) / math.sqrt(tx * tx + ty * ty + tz * tz)
    sx, sy, sz = cross(ax, ay, az, bx, by, bz)
    bend = math.atan2(math.sqrt(sx * sx + sy * sy + sz * sz), ax * bx + ay * by + az * bz)
    shear = dx * dx + dy * dy + dz * dz - stretch * stretch
    stiff = S[K_AXIAL + j] * stretch * stretch + S[K_SHEAR + j] * shear
    return 0.5 * (stiff + S[K_BEND + j] * bend * bend + S[K_TWIST + j] * twist * twist)
