"""Friction that remembers, and the rock under a bit: the wall beside a string that is fed.

A contact point sticks where it was at the end of the last increment, as on a spring that is ``STICK`` times as stiff as
the wall, and carries on with the friction that it had there.  Beyond the limit it slides: the force is returned to the
limit (return mapping, Simo & Hughes 1998).  With factors μ_a along the string and μ_r around it the limit is an ellipse
with the half axes μ_a N and μ_r N.  The spring around the string is (μ_r/μ_a)² times as stiff as that along it: then
the return in units of the half axes is radial, and the sliding takes most energy (Moreau 1970).
"""

from typing import NamedTuple

from fctd.arrays import Array
from fctd.mechanics.contact import owner_of
from fctd.mechanics.dual import reciprocal, root
from fctd.mechanics.friction import limit_around, turning_limit
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.joints import cross
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.state import ARM_BOTTOM, ARM_CONTACT, OPEN, RADIUS, TINY, TRIBUTARY
from fctd.steady.block_thomas import SIZE
from fctd.steady.pose import SPIN, in_frame, quaternion, stepped
from fctd.steady.wall_gradient import wall_of
from fctd.steady.wall_tangent import (
    DIRECTIONS,
    ONE_BY_ONE,
    STEP,
    UNIT,
    contact_place,
    depth_of,
    left_of_both,
    moved,
    reach_of,
    unit_of,
)

# Columns of what a contact point remembers: its place [m], the spin of its body [rad], friction along the hole and
# around it [N].
PLACE_THEN, SPIN_THEN, ALONG_THEN, AROUND_THEN, MEMORY = slice(0, 3), 3, 4, 5, 6
# Stiffness of a point that sticks, over that of the wall: on linear walls it moves by ten times μ times its penetration
# before it slides, a millimetre or less.
STICK = 0.1


class Held(NamedTuple):
    """What a fed string remembers, and what resists its bit.

    memory (n + 2, MEMORY); rock : stiffness [N/m], 0 without; level [m] : of its face, along the direction (x, y, z) of
    the hole at the bit; torque : that resists the bit's rotation [N m].
    """

    memory: Array
    rock: float
    level: float
    x: float
    y: float
    z: float
    torque: float


@inlined
def turning_stiffness(orthotropic, factor, around):
    """Stiffness of sticking around the string over that along it."""
    if orthotropic is None:
        return 1.0
    ratio = around / (factor + TINY)
    return ratio * ratio


@inlined
def returned(laws, normal, factor, around, along_trial, around_trial):
    """Friction along and around [N]: the trial forces of sticking, returned to the limit where they exceed it."""
    limit = laws.friction_scale * factor * normal
    turning = turning_limit(limit, limit_around(laws.orthotropic, laws.friction_scale, around, normal))
    u, v = along_trial * reciprocal(limit + TINY), around_trial * reciprocal(turning + TINY)
    size = root(u * u + v * v)
    if size.real > 1:
        share = reciprocal(size)
        return share * along_trial, share * around_trial
    return along_trial, around_trial


@inlined
def friction_now(
    laws, memory, j, radius, stiff, stiff_around, normal, factor, around, sx, sy, sz, turned, nx, ny, nz, tx, ty, tz
):  # fmt: skip
    """Friction on body j along and around [N], and the direction around (3), where it was shifted by s and turned since
    it remembered."""
    ox, oy, oz = cross(tx, ty, tz, nx, ny, nz)
    ahead = sx * tx + sy * ty + sz * tz
    aside = sx * ox + sy * oy + sz * oz + radius * turned
    along, turning = returned(
        laws, normal, factor, around,
        memory[j, ALONG_THEN] - stiff * ahead, memory[j, AROUND_THEN] - stiff_around * aside,
    )  # fmt: skip
    return along, turning, ox, oy, oz


@inlined
def add_held_wall(S, j, P, C, owner, laws, R, D, K):
    """The same as ``wall_tangent.add_wall``, with friction that remembers."""
    memory = laws.held.memory
    x, y, z = contact_place(S, j, P)
    i = owner_of(C, owner[j], laws.geometry, x, y, z)
    owner[j] = i
    radius, arm, tributary = S[RADIUS + j], S[ARM_CONTACT + j], S[TRIBUTARY + j]
    wall = wall_of(laws.own, S, j, C, i, laws.geometry, x, y, z)
    if wall.beyond[0] + radius < 0:
        return
    w, qx, qy, qz = quaternion(P, j)
    xx, xy, xz, yx, yy, yz, _, _, _ = rotation_columns(w, qx, qy, qz)
    depth = depth_of(laws, complex(wall.beyond[0] + radius, STEP))
    pressed, slope = tributary * depth.real, tributary * depth.imag * UNIT
    stiff = STICK * wall.stiffness[0] * tributary
    stiff_around = stiff * turning_stiffness(laws.orthotropic, wall.factor[0], wall.around[0])
    ux, uy, uz = x - memory[j, 0], y - memory[j, 1], z - memory[j, 2]
    turned = P[j, SPIN] - memory[j, SPIN_THEN]
    for k in range(DIRECTIONS):
        a, b = ONE_BY_ONE[3, k], ONE_BY_ONE[4, k]
        dx = ONE_BY_ONE[0, k] + arm * (b * xx - a * yx)
        dy = ONE_BY_ONE[1, k] + arm * (b * xy - a * yy)
        dz = ONE_BY_ONE[2, k] + arm * (b * xz - a * yz)
        cw, cx, cy, cz = stepped(w, qx, qy, qz, complex(0.0, a), complex(0.0, b))
        nx, ny, nz = unit_of(moved(wall.x, dx, dy, dz), moved(wall.y, dx, dy, dz), moved(wall.z, dx, dy, dz))
        normal = moved(wall.stiffness, dx, dy, dz) * complex(pressed, slope * moved(wall.beyond, dx, dy, dz).imag)
        tx, ty, tz = moved(wall.tx, dx, dy, dz), moved(wall.ty, dx, dy, dz), moved(wall.tz, dx, dy, dz)
        reach = reach_of(laws.own, radius, wall.reach, dx, dy, dz)
        along, around, ox, oy, oz = friction_now(
            laws, memory, j, reach, stiff, stiff_around,
            normal, moved(wall.factor, dx, dy, dz), moved(wall.around, dx, dy, dz),
            complex(ux, dx), complex(uy, dy), complex(uz, dz), complex(turned, ONE_BY_ONE[5, k]),
            nx, ny, nz, tx, ty, tz,
        )  # fmt: skip
        _, _, _, _, _, _, ax, ay, az = rotation_columns(cw, cx, cy, cz)
        fx, fy, fz = along * tx + around * ox, along * ty + around * oy, along * tz + around * oz
        mx, my, mz = cross(reach * nx, reach * ny, reach * nz, fx, fy, fz)
        fx, fy, fz, mx, my, mz = left_of_both(
            laws.corners, moved(wall.net, dx, dy, dz), fx, fy, fz, mx, my, mz, ax, ay, az, nx, ny, nz
        )
        if laws.at_axis:
            about = mx * ax + my * ay + mz * az
            mx, my, mz = about * ax, about * ay, about * az
        fx, fy, fz = fx - normal * nx, fy - normal * ny, fz - normal * nz
        lx, ly, lz = cross(arm * ax, arm * ay, arm * az, fx, fy, fz)
        ma, mb, mc = in_frame(cw, cx, cy, cz, mx + lx, my + ly, mz + lz)
        K[k], K[8 + k], K[16 + k] = fx.imag * UNIT, fy.imag * UNIT, fz.imag * UNIT
        K[24 + k], K[32 + k], K[40 + k] = ma.imag * UNIT, mb.imag * UNIT, mc.imag * UNIT
        K[48 + k], K[56 + k], K[64 + k] = fx.real, fy.real, fz.real
        K[72 + k], K[80 + k], K[88 + k] = ma.real, mb.real, mc.real
    for i in range(SIZE):
        R[j, i] += K[DIRECTIONS * (SIZE + i)]
        for k in range(SIZE):
            D[j, i, k] -= K[DIRECTIONS * i + k]


@kernel
def remember(S, n, P, C, owner, laws):
    """Let every contact point remember its place and its friction: the end of an increment."""
    memory = laws.held.memory
    for j in range(1, n + 1):
        x, y, z = contact_place(S, j, P)
        along, around = 0.0, 0.0
        if laws.geometry != OPEN:
            i = owner_of(C, owner[j], laws.geometry, x, y, z)
            owner[j] = i
            radius = S[RADIUS + j]
            wall = wall_of(laws.own, S, j, C, i, laws.geometry, x, y, z)
            penetration = wall.beyond[0] + radius
            if penetration >= 0:
                stiff = STICK * wall.stiffness[0] * S[TRIBUTARY + j]
                stiff_around = stiff * turning_stiffness(laws.orthotropic, wall.factor[0], wall.around[0])
                normal = wall.stiffness[0] * S[TRIBUTARY + j] * depth_of(laws, penetration)
                nx, ny, nz = unit_of(wall.x[0], wall.y[0], wall.z[0])
                reach = radius if laws.own is None else wall.reach[0]
                along, around, _, _, _ = friction_now(
                    laws, memory, j, reach, stiff, stiff_around, normal, wall.factor[0], wall.around[0],
                    x - memory[j, 0], y - memory[j, 1], z - memory[j, 2], P[j, SPIN] - memory[j, SPIN_THEN],
                    nx, ny, nz, wall.tx[0], wall.ty[0], wall.tz[0],
                )  # fmt: skip
        memory[j, 0], memory[j, 1], memory[j, 2], memory[j, SPIN_THEN] = x, y, z, P[j, SPIN]
        memory[j, ALONG_THEN], memory[j, AROUND_THEN] = along, around


@entry
def end_increment(S, n, P, C, owner, laws):
    """``remember`` for a caller in Python."""
    remember(S, n, P, C, owner, laws)


@inlined
def add_torque(n, R, D, torque, fa, fb, fc):
    """Add a semi-tangential torque at the bit, half of it about the direction f in the frame of the body n; f is
    against the bit.  See ``tangent.Steady``."""
    half = 0.5 * torque
    R[n, 3] += half * fa
    R[n, 4] += half * fb
    R[n, 5] += half * fc - half
    D[n, 3, 4] += half * fc
    D[n, 4, 3] -= half * fc
    D[n, 5, 3] += half * fb
    D[n, 5, 4] -= half * fa


@inlined
def press_rock(S, n, P, held, R, D):
    """Add what the rock does to the bit, at the lower end of body n: its force, and the torque."""
    w, qx, qy, qz = quaternion(P, n)
    da, db, dc = in_frame(w, qx, qy, qz, held.x, held.y, held.z)
    add_torque(n, R, D, held.torque, -da, -db, -dc)
    arm = S[ARM_BOTTOM + n]
    _, _, _, _, _, _, zx, zy, zz = rotation_columns(w, qx, qy, qz)
    bx, by, bz = P[n, 0] + arm * zx, P[n, 1] + arm * zy, P[n, 2] + arm * zz
    beyond = bx * held.x + by * held.y + bz * held.z - held.level
    if held.rock == 0 or beyond <= 0:
        return
    force = held.rock * beyond
    R[n, 0] -= force * held.x
    R[n, 1] -= force * held.y
    R[n, 2] -= force * held.z
    R[n, 3] += arm * force * db
    R[n, 4] -= arm * force * da
    D[n, 3, 3] -= arm * force * dc
    D[n, 4, 4] -= arm * force * dc
    for k, slope in enumerate((held.x, held.y, held.z, -arm * db, arm * da)):
        change = held.rock * slope
        D[n, 0, k] += change * held.x
        D[n, 1, k] += change * held.y
        D[n, 2, k] += change * held.z
        D[n, 3, k] -= arm * change * db
        D[n, 4, k] += arm * change * da
