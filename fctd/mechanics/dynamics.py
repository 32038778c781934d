"""One step of the string's motion, in the order of §4, and the compiled loop over steps.

Symplectic Euler: loads at the present positions change the velocities, the new velocities move the bodies.
Mud, settling damping and wall friction act on each body as impulses that can stop its motion but not reverse it:
mud and settling damping by the implicit factor 1/(1 + c dt/m), friction by a clamp.  The energy ledger multiplies
each of these impulses by the velocity after it, with which the body then moves.
"""

from functools import cache
from typing import Any

from fctd.mechanics.bit import drill, press_bit
from fctd.mechanics.cake import press_into_cake
from fctd.mechanics.derrick import immerse
from fctd.mechanics.friction import (
    approach,
    factor_around,
    limit_around,
    net_of,
    normal_impulse,
    turning_limit,
    wall_normal,
)
from fctd.mechanics.given_loads import count_given, push_given
from fctd.mechanics.jit import entry, inlined
from fctd.mechanics.joints import bend_housings, update_joint_loads
from fctd.mechanics.laws import LAWS, dispatch
from fctd.mechanics.own_contact import held_by_bows, radius_of
from fctd.mechanics.readings import read_step
from fctd.mechanics.rock import NO_ROCK
from fctd.mechanics.rotations import rotation_columns, turned
from fctd.mechanics.state import (
    ADDED_MASS,
    ARM_CONTACT,
    AX,
    AY,
    AZ,
    COLUMN_BITS,
    FRICTION,
    GX,
    GY,
    GZ,
    HELD_BACK,
    HOLE,
    INVERSE_JA,
    INVERSE_JT,
    INVERSE_MASS,
    J_AXIAL,
    J_TRANSVERSE,
    LANES,
    LAYER_DRAG,
    LAYER_SPEED,
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
    QW,
    QX,
    QY,
    QZ,
    RADIUS,
    SUM_FRICTION_TORQUE,
    SUM_MUD_TORQUE,
    SUM_NORMAL,
    SUM_R_MU_N,
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
    joint_force,
    lateral_inverse_mass,
    quaternion,
    radial,
    spin,
    velocity,
)
from fctd.mechanics.stored_walls import update_walls
from fctd.mechanics.topdrive import IN_DERRICK, SUM_HOOKLOAD, SUM_TOP_TORQUE, drive_top, move_top_drive
from fctd.mechanics.unbalance import swing_unbalance
from fctd.mechanics.wall_law import stiffen_walls

# Share of the clearance within which a string certainly does not touch; 1 − NEARLY is far above rounding.
NEARLY = 1 - 1e-6


@inlined
def store_axis(S, j, w, x, y, z, a, b, c):
    """Write axis and global spin of body j, given its orientation and its spin in its own frame."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
    S[AX + j], S[AY + j], S[AZ + j] = zx, zy, zz
    S[GX + j] = a * xx + b * yx + c * zx
    S[GY + j] = a * xy + b * yy + c * zy
    S[GZ + j] = a * xz + b * yz + c * zz


@entry
def update_axes(S, n):
    """Update axis and global spin of every body, given orientation and body-frame spin."""
    for j in range(1, n + 1):
        w, x, y, z = quaternion(S, j)
        a, b, c = spin(S, j)
        store_axis(S, j, w, x, y, z, a, b, c)


@inlined
def free_motion(S, j, dt):
    """Velocity and spin of body j in its own frame after springs and weight act, before mud and wall.

    Newton–Euler (Eqs 1–2) without the gyroscopic term, which ``move_bodies`` applies; sideways a body takes mud along.
    Returns velocity and spin (6).
    """
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    fx, fy, fz = joint_force(S, j)
    gx, gy, gz = joint_force(S, j + 1)
    im, it, ia = S[INVERSE_MASS + j], S[INVERSE_JT + j], S[INVERSE_JA + j]
    k, held = dt * im, dt * S[HELD_BACK + j]
    fx, fy, fz = fx - gx, fy - gy, fz - gz + S[WEIGHT + j]
    vx, vy, vz = velocity(S, j)
    vx += k * fx
    vy += k * fy
    vz += k * fz
    u = xx * vx + xy * vy + xz * vz - held * (xx * fx + xy * fy + xz * fz)
    v = yx * vx + yy * vy + yz * vz - held * (yx * fx + yy * fy + yz * fz)
    w = zx * vx + zy * vy + zz * vz

    mx = S[LX + j] + S[UX + j + 1]
    my = S[LY + j] + S[UY + j + 1]
    mz = S[LZ + j] + S[UZ + j + 1]
    a, b, c = spin(S, j)
    a += dt * it * (xx * mx + xy * my + xz * mz)
    b += dt * it * (yx * mx + yy * my + yz * mz)
    c += dt * ia * (zx * mx + zy * my + zz * mz)
    return u, v, w, a, b, c


@inlined
def mud_factors(S, j, settling, layer, dt):
    """Factors by which mud and artificial settling damping multiply lateral, axial and spin velocity.

    layer : drag of the boundary layers over the mass of the body, times the step.  The lateral one is that of the spin
    across the axis too: the mud acts all along a segment of length L, with the moment c L³/12 about its centre, and its
    inertia there is (m + a) L²/12.
    """
    slow = 1 + dt * settling
    lateral = slow + dt * lateral_inverse_mass(S, j) * S[MUD_LATERAL + j]
    axial = slow + dt * S[INVERSE_MASS + j] * S[MUD_AXIAL + j] + layer
    rotational = slow + dt * S[INVERSE_JA + j] * S[MUD_SPIN + j]
    # One division in place of three: division is the slowest packed operation.
    k = 1 / (lateral * axial * rotational)
    return k * axial * rotational, k * lateral * rotational, k * lateral * axial


@inlined
def brake(S, j, u, v, w, a, b, c, laws, dt):
    """Apply mud and settling damping to body j; returns its velocity and spin.

    The boundary layers follow the body, ẏ = ω (w − y), and drag it by their lag c (w − y): at the frequency ω this is
    the drag of mud on a wall that swings along itself, in size and phase (Stokes 1851), and none on a wall that slides
    steadily.  The energy that they take, and may give back, counts as lost to the mud.
    """
    layer = dt * S[INVERSE_MASS + j] * S[LAYER_DRAG + j]
    lateral, axial, rotational = mud_factors(S, j, laws.settling, layer, dt)
    share = lateral * (1 - lateral)
    sideways = (u * u + v * v) * share
    slowed = (w + layer * S[LAYER_SPEED + j]) * axial
    along, c = held_by_bows(laws.bows, S, j, slowed, c, laws.friction_scale, dt)
    S[LAYER_SPEED + j] += dt * laws.layer_rate * (along - S[LAYER_SPEED + j])
    lost = S[MASS + j] * (sideways + (w - slowed) * along) + S[ADDED_MASS + j] * sideways
    lost += S[J_TRANSVERSE + j] * (a * a + b * b) * share
    S[LOST_MUD + j] += lost + S[J_AXIAL + j] * c * c * rotational * (1 - rotational)
    S[SUM_MUD_TORQUE + j] += S[J_AXIAL + j] * c * (1 - rotational)
    return u * lateral, v * lateral, along, a * lateral, b * lateral, c * rotational


@inlined
def touch_wall(S, j, u, v, w, a, b, c, friction_impulse, laws, dt):
    """Apply the wall's normal and friction impulses and the mud to body j; returns its velocity and spin."""
    penetration, nx, ny, nz = wall_normal(S, j)
    normal, damper = normal_impulse(S, j, u, v, w, a, b, nx, ny, nz, penetration, laws.contact_damping, dt)
    h, k = normal * lateral_inverse_mass(S, j), normal * S[INVERSE_MASS + j]
    q = normal * S[ARM_CONTACT + j] * S[INVERSE_JT + j]
    u, v, w, a, b = u - h * nx, v - h * ny, w - k * nz, a + q * ny, b - q * nx
    limit = laws.friction_scale * S[FRICTION + j] * normal
    around = limit_around(laws.orthotropic, laws.friction_scale, factor_around(S, j, laws.orthotropic), normal)
    radius, net = radius_of(laws.bows, S, j, penetration), net_of(laws.corners, S, j)
    du, dv, dw, da, db, dc = friction_impulse(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around)
    u, v, w, a, b, c = brake(S, j, u + du, v + dv, w + dw, a + da, b + db, c + dc, laws, dt)
    m, jt, ja = S[MASS + j], S[J_TRANSVERSE + j], S[J_AXIAL + j]
    S[SUM_NORMAL + j] += normal
    S[SUM_R_MU_N + j] += radius * turning_limit(limit, around)
    S[SUM_FRICTION_TORQUE + j] -= ja * dc
    S[LOST_CONTACT + j] += damper * approach(S, j, u, v, w, a, b, nx, ny, nz)
    S[LOST_FRICTION + j] -= m * (du * u + dv * v + dw * w) + jt * (da * a + db * b) + ja * dc * c
    S[LOST_FRICTION + j] -= S[ADDED_MASS + j] * (du * u + dv * v)
    return u, v, w, a, b, c


@inlined
def store_motion(S, j, u, v, w, a, b, c):
    """Write velocity and spin of body j, both given in its own frame."""
    xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*quaternion(S, j))
    S[VX + j] = xx * u + yx * v + zx * w
    S[VY + j] = xy * u + yy * v + zy * w
    S[VZ + j] = xz * u + yz * v + zz * w
    S[WX + j], S[WY + j], S[WZ + j] = a, b, c


@inlined
def may_touch(S, first):
    """Whether any body of the packed operation that begins with column ``first`` may touch the wall."""
    found = False
    for lane in range(LANES):
        j = first + lane
        px, py, pz = radial(S, j)
        # The clearance; negative where the string is thicker than the hole.
        room = S[HOLE + j] - S[RADIUS + j]
        # Written so that NaN counts as contact; the check of the state then stops the run.
        found |= not (px * px + py * py + pz * pz <= NEARLY * room * abs(room))
    return found


@inlined
def push_in_hole(S, n, friction_impulse, laws, dt):
    """Update velocity and spin of every body in a hole; n is a multiple of LANES.

    Where no body of an operation touches the wall, the wall's normal and friction impulses are exactly 0.
    """
    for block in range(1, n + 1, LANES):
        first = block & COLUMN_BITS
        if may_touch(S, first):
            for lane in range(LANES):
                j = first + lane
                u, v, w, a, b, c = free_motion(S, j, dt)
                u, v, w, a, b, c = touch_wall(S, j, u, v, w, a, b, c, friction_impulse, laws, dt)
                store_motion(S, j, u, v, w, a, b, c)
        else:
            for lane in range(LANES):
                j = first + lane
                u, v, w, a, b, c = free_motion(S, j, dt)
                u, v, w, a, b, c = brake(S, j, u, v, w, a, b, c, laws, dt)
                store_motion(S, j, u, v, w, a, b, c)


@cache
def push_with(impulse: Any) -> Any:
    """A function that updates velocity and spin of every body in a hole by a law's friction impulse (stage 4)."""

    @inlined
    def push(S, n, laws, dt):
        push_in_hole(S, n, impulse, laws, dt)

    return push


# Indexed by a law's code.
PUSHES = tuple(push_with(law.impulse) for law in LAWS)
push_by_law = dispatch(PUSHES)


@inlined
def push_freely(S, n, laws, dt):
    """Update velocity and spin of every body where there is no wall."""
    for j in range(1, n + 1):
        u, v, w, a, b, c = free_motion(S, j, dt)
        u, v, w, a, b, c = brake(S, j, u, v, w, a, b, c, laws, dt)
        store_motion(S, j, u, v, w, a, b, c)


@inlined
def move_bodies(S, n, dt):
    """Update position, orientation, axis and spin of every body, given its velocity and spin.

    The gyroscopic term of Eq. 2 turns the transverse spin about the axis.  Here it is a rotation in Cayley's
    form, half before and half after the body turns: an explicit term would feed energy to a spinning string,
    and a rotation before the impulses would turn every moment by the angle of the step.
    """
    for j in range(1, n + 1):
        u, v, w = velocity(S, j)
        S[X + j] += dt * u
        S[Y + j] += dt * v
        S[Z + j] += dt * w
        a, b, c = spin(S, j)
        h = 0.25 * dt * c * (1 - S[J_AXIAL + j] * S[INVERSE_JT + j])
        k = 1 / (1 + h * h)
        cosine, sine = k * (1 - h * h), 2 * k * h
        a, b = cosine * a + sine * b, cosine * b - sine * a
        w, x, y, z = quaternion(S, j)
        w, x, y, z = turned(w, x, y, z, dt * a, dt * b, dt * c)
        a, b = cosine * a + sine * b, cosine * b - sine * a
        S[QW + j], S[QX + j], S[QY + j], S[QZ + j] = w, x, y, z
        S[WX + j], S[WY + j] = a, b
        store_axis(S, j, w, x, y, z, a, b, c)


@inlined
def update_velocities(S, n, laws, dt):
    """Update velocity and spin of every body by springs, weight, wall and mud, given joint loads and walls."""
    if laws.unbalanced:
        swing_unbalance(S, n, dt)
    if laws.given:
        push_given(S, n, dt)
    if laws.geometry == OPEN:
        push_freely(S, n, laws, dt)
    else:
        push_by_law(laws.friction, S, n, laws, dt)


@inlined
def padded_columns(n):
    """Columns of ``n`` bodies rounded up to whole packed operations."""
    return (n + LANES - 1) // LANES * LANES


@inlined
def load(S, top, n, laws, motion, pipe, dt):
    """Stage 1: loads of the joints, of the top drive and of the rock on the bit at the present positions.

    Returns feed [m/s] and rotation [rad/s] of the top drive.
    """
    packed = padded_columns(n)
    update_joint_loads(S, packed, laws.joint_damping, dt, laws.torsion_damping, laws.shape_damping, laws.wall_exponent)
    if laws.bent:
        bend_housings(S, n, dt)
    hookload, torque = top[SUM_HOOKLOAD], top[SUM_TOP_TORQUE]
    feed, rate = drive_top(S, top, motion, pipe, dt, laws.settling)
    read_step(S, top, n, hookload, torque, rate, laws.rock.motor, dt)
    if top[IN_DERRICK] > 0:
        immerse(S, n)
    if laws.rock.law != NO_ROCK:
        press_bit(S, top, n, laws.rock, motion, dt)
    return feed, rate


@inlined
def move(S, top, n, laws, pipe, feed, rate, dt):
    """Stages 4 and 5, given the loads and the walls: impulses, then the motion that they leave."""
    packed = padded_columns(n)
    # 4: impulses of the wall, normal and friction, and those of springs, weight and mud.
    update_velocities(S, packed, laws, dt)
    if laws.given:
        count_given(S, top, packed, dt)
    # 5: motion of the bodies, of the bit in the rock, and of the top drive.
    if laws.rock.law != NO_ROCK:
        drill(S, top, n, laws.rock, dt)
    move_bodies(S, packed, dt)
    move_top_drive(S, top, pipe, feed, rate, dt)


@inlined
def step(find_walls, S, top, owner, n, C, laws, motion, pipe, dt):
    """Advance the string by one step: the stages of §4 and Fig. 7 in order.

    find_walls : ``update_walls``, or another search for the walls beside the contact points, with its arguments.
    Compiled into its caller: code that takes a function as an argument cannot be stored on disk.
    """
    feed, rate = load(S, top, n, laws, motion, pipe, dt)
    # 2 and 3: the piece of hole that owns each contact point, and the point's distance from its axis and wall.
    find_walls(S, owner, n, padded_columns(n), C, laws.geometry)
    if laws.wall_exponent != 1:
        stiffen_walls(S, top, n, laws)
    if laws.cake_thickness > 0:
        press_into_cake(S, owner, n, C, laws, dt)
    move(S, top, n, laws, pipe, feed, rate, dt)


@entry
def advance(S, top, owner, n, C, laws, motion, pipe, dt, steps):
    """Advance by ``steps`` steps of ``dt`` [s]; the one compiled entry of a run, allocating nothing."""
    update_axes(S, padded_columns(n))
    for _ in range(steps):
        step(update_walls, S, top, owner, n, C, laws, motion, pipe, dt)
