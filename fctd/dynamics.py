"""One step of the string's motion, in the order of §4, and the compiled loop over steps.

Symplectic Euler: loads at the present positions change the velocities, the new velocities move the bodies.
Everything that dissipates is applied to each body as an impulse that at most stops what it acts on: mud and
settling damping by the implicit factor 1/(1 + c dt/m), wall friction by a clamp.  The ledger multiplies every
dissipating impulse by the velocity after it, which is what moves the body.
"""

import math
from typing import NamedTuple

import numpy as np
from numba import njit

from fctd.contact import update_walls
from fctd.joints import joint_twist, strain_energy, update_joint_loads
from fctd.rotations import body_axis, rotation_columns, turned
from fctd.state import (
    ARM_BOTTOM,
    ARM_CONTACT,
    ARM_TOP,
    AX,
    AY,
    AZ,
    FRICTION,
    FX,
    FY,
    FZ,
    GX,
    GY,
    GZ,
    HOLE,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    J_AXIAL,
    J_TRANSVERSE,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    K_WALL,
    LANES,
    LOST_CONTACT,
    LOST_FRICTION,
    LOST_MUD,
    LX,
    LY,
    LZ,
    MASS,
    MUD_AXIAL,
    MUD_LATERAL,
    MUD_SPIN,
    OPEN,
    PAPER,
    QW,
    QX,
    QY,
    QZ,
    RADIUS,
    SUM_FRICTION_TORQUE,
    SUM_MUD_TORQUE,
    SUM_NORMAL,
    SUM_R_MU_N,
    TINY,
    TURNS,
    UX,
    UY,
    UZ,
    VX,
    VY,
    VZ,
    WEIGHT,
    WX,
    WY,
    WZ,
    X,
    Y,
    Z,
    axis,
    joint_force,
    quaternion,
    radial,
    spin,
    velocity,
)

GRAVITY = 9.80665


class Motion(NamedTuple):
    """What the top drive does during one stretch of a run; a ramp when the ends differ.

    start, duration [s]; feed speed downwards [m/s] and rotation speed [rad/s] at both ends.
    """

    start: float
    duration: float
    feed_from: float
    feed_to: float
    spin_from: float
    spin_to: float


class PerMetre(NamedTuple):
    """The pipe that is fed in at the top, per metre: the long segment's properties follow its length.

    mass [kg/m], weight (buoyed) [N/m], axial_inertia [kg m], EA [N], GJ, EI [N m^2], shear (κGA) [N],
    mud damping axial, lateral [N s/m^2], rotational [N s].
    """

    mass: float
    weight: float
    axial_inertia: float
    EA: float
    GJ: float
    EI: float
    shear: float
    mud_axial: float
    mud_lateral: float
    mud_spin: float


# Top drive's own numbers, shape (TOP_SIZE,): angle turned [rad], length of the long segment [m] (0: none),
# simulated time [s]; sums since the last record of hook load [N s] and torque [N m s]; work done by the
# top drive and energy brought in by fed pipe since the start [J].
TOP_ANGLE, TOP_LENGTH, TOP_TIME, SUM_HOOKLOAD, SUM_TOP_TORQUE, TOP_WORK, FED_ENERGY = range(7)
# Quaternion of the top drive before it turns.
TOP_FRAME = 7
TOP_SIZE = 11


@njit(forceinline=True)
def ramp(at, start, duration, first, last):
    """Smooth step from ``first`` to ``last``: no jump of acceleration to set the string ringing."""
    u = min(max((at - start) / duration, 0.0), 1.0)
    return first + (last - first) * u * u * (3 - 2 * u)


@njit(error_model="numpy")
def set_long_segment(S, length, pipe):
    """Update the long segment (body 1 and joint 1) to its length [m].

    A massless arm with springs EA/L and GJ/L, half its mass lumped at the lower end (§6.2, §5.1): hanging
    it stretches by its load and by its own weight exactly.
    """
    half = 0.5 * length
    S[ARM_TOP + 1] = length
    S[MASS + 1] = pipe.mass * half
    S[WEIGHT + 1] = pipe.weight * half
    S[J_AXIAL + 1] = pipe.axial_inertia * half
    S[J_TRANSVERSE + 1] = pipe.mass * half * length * length / 3
    S[INVERSE_MASS + 1] = 1 / S[MASS + 1]
    S[INVERSE_JA + 1] = 1 / S[J_AXIAL + 1]
    S[INVERSE_JT + 1] = 1 / S[J_TRANSVERSE + 1]
    S[MUD_AXIAL + 1] = pipe.mud_axial * half
    S[MUD_LATERAL + 1] = pipe.mud_lateral * half
    S[MUD_SPIN + 1] = pipe.mud_spin * half
    S[K_AXIAL + 1] = pipe.EA / length
    S[K_SHEAR + 1] = pipe.shear / length
    S[K_BEND + 1] = pipe.EI / length
    S[K_TWIST + 1] = pipe.GJ / length


@njit(error_model="numpy")
def long_segment_energy(S):
    """Kinetic, gravity and strain energy that depend on the long segment's length [J]."""
    vx, vy, vz = velocity(S, 1)
    wx, wy, wz = spin(S, 1)
    kinetic = 0.5 * S[MASS + 1] * (vx * vx + vy * vy + vz * vz)
    kinetic += 0.5 * (S[J_TRANSVERSE + 1] * (wx * wx + wy * wy) + S[J_AXIAL + 1] * wz * wz)
    return kinetic - S[WEIGHT + 1] * S[Z + 1] + strain_energy(S, 1)


@njit(error_model="numpy")
def move_top_drive(S, top, motion, pipe, dt):
    """Update the top drive's angle, feed and clamp velocity for this step; returns dL [m] and dθ [rad]."""
    now = top[TOP_TIME]
    feed = ramp(now, motion.start, motion.duration, motion.feed_from, motion.feed_to)
    rate = ramp(now, motion.start, motion.duration, motion.spin_from, motion.spin_to)
    if feed != 0:
        # The energy that longer pipe holds, by a central difference about the length at which this step's
        # loads are taken: a one-sided one would leave ½k dL² of every step in the ledger.
        top[TOP_LENGTH] += dt * feed
        set_long_segment(S, top[TOP_LENGTH] - 0.5 * dt * feed, pipe)
        before = long_segment_energy(S)
        set_long_segment(S, top[TOP_LENGTH] + 0.5 * dt * feed, pipe)
        top[FED_ENERGY] += long_segment_energy(S) - before
        set_long_segment(S, top[TOP_LENGTH], pipe)
    top[TOP_ANGLE] += dt * rate
    top[TOP_TIME] += dt
    half = 0.5 * (top[TOP_ANGLE] + S[TURNS + 1])
    c, s = math.cos(half), math.sin(half)
    w, x, y, z = top[TOP_FRAME], top[TOP_FRAME + 1], top[TOP_FRAME + 2], top[TOP_FRAME + 3]
    S[QW], S[QX], S[QY], S[QZ] = w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s
    ax, ay, az = axis(S, 0)
    S[VX], S[VY], S[VZ] = feed * ax, feed * ay, feed * az
    S[GX], S[GY], S[GZ] = rate * ax, rate * ay, rate * az
    return dt * feed, dt * rate


@njit(error_model="numpy")
def read_top_drive(S, top, pipe, fed, turned_by, dt):
    """Update the sums of hook load, torque and work, given the loads of joint 1."""
    ax, ay, az = axis(S, 0)
    fx, fy, fz = joint_force(S, 1)
    # The half of the long segment's weight that is not lumped below hangs on the top drive itself.
    tension = -(fx * ax + fy * ay + fz * az)
    hookload = tension + 0.5 * pipe.weight * top[TOP_LENGTH]
    torque = -(S[UX + 1] * ax + S[UY + 1] * ay + S[UZ + 1] * az)
    top[SUM_HOOKLOAD] += dt * hookload
    top[SUM_TOP_TORQUE] += dt * torque
    # The pipe passes the clamp stretched, (1 + T/EA) times its unstretched length.
    raised = hookload * fed * (1 + tension / pipe.EA)
    top[TOP_WORK] += torque * turned_by - raised
    top[FED_ENERGY] += raised
    # Quaternions hold twist within two turns: a whole turn is moved into TURNS long before.
    held = joint_twist(S, 1) - S[TURNS + 1]
    if held > math.pi:
        S[TURNS + 1] += 2 * math.pi
    elif held < -math.pi:
        S[TURNS + 1] -= 2 * math.pi


@njit(error_model="numpy", fastmath={"contract"})
def update_axes(S, n):
    """Update axis and global spin of every body, given orientation and body-frame spin."""
    for j in range(1, n + 1):
        w, x, y, z = quaternion(S, j)
        a, b, c = spin(S, j)
        xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
        S[AX + j], S[AY + j], S[AZ + j] = zx, zy, zz
        S[GX + j] = a * xx + b * yx + c * zx
        S[GY + j] = a * xy + b * yy + c * zy
        S[GZ + j] = a * xz + b * yz + c * zz


@njit(forceinline=True)
def free_motion(S, j, dt):
    """Velocity and spin of body j in its own frame after springs and weight, before mud and wall.

    Newton–Euler (Eqs 1–2) but for the gyroscopic term, which ``move`` applies.  Returns velocity and
    spin (6).
    """
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    fx, fy, fz = joint_force(S, j)
    gx, gy, gz = joint_force(S, j + 1)
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    k = dt * im
    vx, vy, vz = velocity(S, j)
    vx += k * (fx - gx)
    vy += k * (fy - gy)
    vz += k * (fz - gz + S[WEIGHT + j])
    u = xx * vx + xy * vy + xz * vz
    v = yx * vx + yy * vy + yz * vz
    w = zx * vx + zy * vy + zz * vz

    # Joint forces act at the arms along the body's z axis: their moment is z × (their weighted sum).
    top, bottom = S[ARM_TOP + j], S[ARM_BOTTOM + j]
    hx, hy, hz = top * fx + bottom * gx, top * fy + bottom * gy, top * fz + bottom * gz
    mx = S[LX + j] + S[UX + j + 1]
    my = S[LY + j] + S[UY + j + 1]
    mz = S[LZ + j] + S[UZ + j + 1]
    a, b, c = spin(S, j)
    a += dt * it * (xx * mx + xy * my + xz * mz + yx * hx + yy * hy + yz * hz)
    b += dt * it * (yx * mx + yy * my + yz * mz - xx * hx - xy * hy - xz * hz)
    c += dt * ia * (zx * mx + zy * my + zz * mz)
    return u, v, w, a, b, c


@njit(forceinline=True)
def mud_factors(S, j, settling, dt):
    """Factors that mud (and artificial settling) damping leaves of lateral, axial and spin velocity."""
    slow = 1 + dt * settling
    lateral = slow + dt * S[INVERSE_MASS + j] * S[MUD_LATERAL + j]
    axial = slow + dt * S[INVERSE_MASS + j] * S[MUD_AXIAL + j]
    rotational = slow + dt * S[INVERSE_JA + j] * S[MUD_SPIN + j]
    # One division in place of three: division is the slowest packed operation there is.
    k = 1 / (lateral * axial * rotational)
    return k * axial * rotational, k * lateral * rotational, k * lateral * axial


@njit(forceinline=True)
def wall_normal(S, j):
    """Penetration [m] (Eq. 11, settled sign) and the normal towards the wall in the frame of body j."""
    px, py, pz = radial(S, j)
    distance = np.sqrt(px * px + py * py + pz * pz)
    # A point on the hole axis has no direction.
    k = 1 / (distance + TINY)
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    return (
        distance - S[HOLE + j] + S[RADIUS + j],
        k * (xx * px + xy * py + xz * pz),
        k * (yx * px + yy * py + yz * pz),
        k * (zx * px + zy * py + zz * pz),
    )


@njit(forceinline=True)
def normal_impulse(S, j, u, v, w, a, b, nx, ny, nz, penetration, damping, dt):
    """Impulse of the wall's normal force on body j [N s] (Eq. 12 with damping) and the energy it damps.

    The damper is implicit in the velocity it changes.  The wall never pulls.
    """
    arm = S[ARM_CONTACT + j]
    response = (nx * nx + ny * ny + nz * nz) * S[INVERSE_MASS + j]
    response += arm * arm * (nx * nx + ny * ny) * S[INVERSE_JT + j]
    speed = u * nx + v * ny + w * nz + arm * (b * nx - a * ny)
    elastic = dt * S[K_WALL + j] * penetration
    impulse = (elastic + dt * damping * speed) / (1 + dt * damping * response)
    impulse = impulse if penetration > 0 else 0.0
    impulse = impulse if impulse > 0 else 0.0
    elastic = elastic if penetration > 0 else 0.0
    return impulse, (impulse - elastic) * (speed - impulse * response)


@njit(forceinline=True)
def coulomb_impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """Law ``coulomb``: one impulse against the sliding velocity at the wall side of the string.

    limit : μ × normal impulse [N s].  It acts at T + r_ds·normal, hence gives force and torque, and at most
    stops the sliding of the free body (implicit clamp).  Returns the change of velocity and spin (6) and
    the energy lost.
    """
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    r = S[RADIUS + j]
    rx, ry, rz = r * nx, r * ny, S[ARM_CONTACT + j] + r * nz
    sx = u + b * rz - c * ry
    sy = v + c * rx - a * rz
    sz = w + a * ry - b * rx
    into = sx * nx + sy * ny + sz * nz
    sx, sy, sz = sx - into * nx, sy - into * ny, sz - into * nz
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
        f * (square - f * response),
    )  # fmt: skip


@njit(forceinline=True)
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
    lost = drag * (sliding - drag * im) + couple * (spinning - couple * ia)
    return 0.0 * w, 0.0 * w, dw, 0.0 * w, 0.0 * w, dc, lost


@njit(forceinline=True)
def brake(S, j, u, v, w, a, b, c, settling, dt):
    """Apply mud and settling damping to body j; returns its velocity and spin."""
    lateral, axial, rotational = mud_factors(S, j, settling, dt)
    swing = 1 / (1 + dt * settling)
    lost = S[MASS + j] * ((u * u + v * v) * lateral * (1 - lateral) + w * w * axial * (1 - axial))
    S[LOST_MUD + j] += lost + S[J_AXIAL + j] * c * c * rotational * (1 - rotational)
    S[SUM_MUD_TORQUE + j] += S[J_AXIAL + j] * c * (1 - rotational)
    return u * lateral, v * lateral, w * axial, a * swing, b * swing, c * rotational


@njit(forceinline=True)
def touch_wall(S, j, u, v, w, a, b, c, friction_impulse, laws, dt):
    """Apply the wall's normal and friction impulses to body j; returns its velocity and spin."""
    penetration, nx, ny, nz = wall_normal(S, j)
    normal, damped = normal_impulse(S, j, u, v, w, a, b, nx, ny, nz, penetration, laws.contact_damping, dt)
    k, q = normal * S[INVERSE_MASS + j], normal * S[ARM_CONTACT + j] * S[INVERSE_JT + j]
    u, v, w, a, b = u - k * nx, v - k * ny, w - k * nz, a + q * ny, b - q * nx
    limit = laws.friction_scale * S[FRICTION + j] * normal
    du, dv, dw, da, db, dc, rubbed = friction_impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit)
    S[SUM_NORMAL + j] += normal
    S[SUM_R_MU_N + j] += S[RADIUS + j] * limit
    S[SUM_FRICTION_TORQUE + j] -= S[J_AXIAL + j] * dc
    S[LOST_CONTACT + j] += damped
    S[LOST_FRICTION + j] += rubbed
    return u + du, v + dv, w + dw, a + da, b + db, c + dc


@njit(forceinline=True)
def move(S, j, u, v, w, a, b, c, dt):
    """Store velocity (given in the body frame) and spin of body j and move it with them.

    The gyroscopic term of Eq. 2 turns the transverse spin about the axis, here as a rotation in Cayley's
    form, after all impulses: an explicit term would feed energy to a spinning string, and a rotation before
    the impulses would turn every moment by the angle of the step.
    """
    qw, qx, qy, qz = quaternion(S, j)
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(qw, qx, qy, qz)
    vx = xx * u + yx * v + zx * w
    vy = xy * u + yy * v + zy * w
    vz = xz * u + yz * v + zz * w
    S[VX + j], S[VY + j], S[VZ + j] = vx, vy, vz
    S[X + j] += dt * vx
    S[Y + j] += dt * vy
    S[Z + j] += dt * vz
    h = 0.5 * dt * c * (1 - S[J_AXIAL + j] * S[INVERSE_JT + j])
    k = 1 / (1 + h * h)
    S[WX + j], S[WY + j] = k * ((1 - h * h) * a + 2 * h * b), k * ((1 - h * h) * b - 2 * h * a)
    S[WZ + j] = c
    qw, qx, qy, qz = turned(qw, qx, qy, qz, dt * a, dt * b, dt * c)
    S[QW + j], S[QX + j], S[QY + j], S[QZ + j] = qw, qx, qy, qz


@njit(error_model="numpy", fastmath={"contract"})
def move_with_coulomb(S, n, laws, dt):
    """Update the motion of every body in a hole with law ``coulomb`` (stages 4 and 5)."""
    for j in range(1, n + 1):
        u, v, w, a, b, c = free_motion(S, j, dt)
        u, v, w, a, b, c = touch_wall(S, j, u, v, w, a, b, c, coulomb_impulse, laws, dt)
        u, v, w, a, b, c = brake(S, j, u, v, w, a, b, c, laws.settling, dt)
        move(S, j, u, v, w, a, b, c, dt)


@njit(error_model="numpy", fastmath={"contract"})
def move_with_paper(S, n, laws, dt):
    """Update the motion of every body in a hole with law ``paper`` (stages 4 and 5)."""
    for j in range(1, n + 1):
        u, v, w, a, b, c = free_motion(S, j, dt)
        u, v, w, a, b, c = touch_wall(S, j, u, v, w, a, b, c, paper_impulse, laws, dt)
        u, v, w, a, b, c = brake(S, j, u, v, w, a, b, c, laws.settling, dt)
        move(S, j, u, v, w, a, b, c, dt)


@njit(error_model="numpy", fastmath={"contract"})
def move_freely(S, n, laws, dt):
    """Update the motion of every body where there is no wall."""
    for j in range(1, n + 1):
        u, v, w, a, b, c = free_motion(S, j, dt)
        u, v, w, a, b, c = brake(S, j, u, v, w, a, b, c, laws.settling, dt)
        move(S, j, u, v, w, a, b, c, dt)


@njit(error_model="numpy")
def update_motion(S, n, laws, dt):
    """Update velocities, positions and orientations, given joint loads and walls."""
    if laws.geometry == OPEN:
        move_freely(S, n, laws, dt)
    elif laws.friction == PAPER:
        move_with_paper(S, n, laws, dt)
    else:
        move_with_coulomb(S, n, laws, dt)


@njit(error_model="numpy")
def step(S, top, owner, n, C, laws, motion, pipe, dt):
    """Advance the string by one step: the algorithm of §4 and Fig. 7 in order."""
    packed = (n + LANES - 1) // LANES * LANES
    update_axes(S, packed)
    fed, turned_by = move_top_drive(S, top, motion, pipe, dt)
    update_joint_loads(S, packed, laws.joint_damping, dt)
    read_top_drive(S, top, pipe, fed, turned_by, dt)
    update_walls(S, owner, n, packed, C, laws.geometry)
    update_motion(S, packed, laws, dt)


@njit(error_model="numpy", cache=True)
def advance(S, top, owner, n, C, laws, motion, pipe, dt, steps):
    """Advance by ``steps`` steps of ``dt`` [s]; the one compiled entry of a run, allocating nothing."""
    for _ in range(steps):
        step(S, top, owner, n, C, laws, motion, pipe, dt)
