"""Forces out of balance on a steady string and their derivative.

A steady string slides along the hole at one speed or turns at one rate while its shape stands still.  The
unknowns of a body are the position of its centre of mass, a rotation of its frame and its spin about its own
axis; the frames themselves do not spin, so a string may be twisted by many turns.  The joints are differentiated in
closed form (joint_tangent.py), the wall by a complex step through the law of friction (wall_tangent.py).
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.joints import cross, gap, joint_loads
from fctd.mechanics.rotations import rotation_columns, twist_angle
from fctd.mechanics.state import (
    ARCS,
    ARM_BOTTOM,
    ARM_CONTACT,
    ARM_TOP,
    GIVEN_FORCE,
    GIVEN_TORQUE,
    K_AXIAL,
    K_BEND,
    K_SHEAR,
    K_TWIST,
    MUD_AXIAL,
    MUD_SPIN,
    OPEN,
    SAMPLED,
    STARTING_FORCE,
    WEIGHT,
)
from fctd.steady.block_thomas import SIZE
from fctd.steady.held_friction import Held, add_held_wall, press_rock
from fctd.steady.joint_tangent import LOADS, UNKNOWNS, add_joint
from fctd.steady.pose import SPIN, in_frame, quaternion, times
from fctd.steady.wall_tangent import DIRECTIONS, add_wall, leave_out_change_along, read_wall, spin_of, starting

# Columns of the imbalance: force [N], global; moment [N m] in the frame of the body, the last about its axis.
FORCE, AXIAL_MOMENT = slice(0, 3), 5
# Columns of the loads of joints: tension [N], torque, bending moment [N m].
JOINT_TENSION, JOINT_TORQUE, JOINT_BENDING, JOINT_COLUMNS = 0, 1, 2, 3
# Columns of the loads of contact points, after their place [m], global: normal force [N], r F_t and r μ F_n [N m].
NORMAL_FORCE, R_FT, R_MU_FN, CONTACT_COLUMNS = 3, 4, 5, 6


class Steady(NamedTuple):
    """Motion of a steady string, and the loads at its bit.

    geometry, friction : as in Laws.  friction_scale : multiplies every friction factor.
    speed : along the hole, downwards [m/s]; spin [rad/s].
    bit_x, bit_y, bit_z : force on the bit [N], global; bit_torque : torque that resists the bit's rotation [N m].
    at_axis : 0, or 1 where the loads do no work on a buckled string that rolls round the hole (relaxation.py): friction
    along the hole acts at the string's axis and not at its surface, which leaves out its bending moment, and the torque
    at the bit is semi-tangential, half about the bit's axis and half about the hole's (Ziegler 1968).
    wall_exponent, wall_reference, orthotropic : as in Laws.  given : share of the loads that are given to the bodies.
    held : of a string that is fed, whose friction remembers; None of one that slides or turns at its rates.
    own : True where fittings have a contact of their own, else None, for which the code of others is compiled.
    corners : as in Laws.
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
    given: float = 1.0
    orthotropic: bool | None = None
    held: Held | None = None
    own: bool | None = None
    corners: bool | None = None


@inlined
def add_wall_of(held, S, j, P, C, owner, laws, R, D, pressed):
    """Add the wall with the friction of rates, or with friction that remembers."""
    if held is None:
        add_wall(S, j, P, C, owner, laws, R, D, pressed)
    else:
        add_held_wall(S, j, P, C, owner, laws, R, D, pressed)


@inlined
def add_rock_of(held, S, n, P, R, D):
    """Add the rock under the bit of a string that is fed."""
    if held is not None:
        press_rock(S, n, P, held, R, D)


@entry
def assemble(S, n, P, kinks, C, owner, laws, R, D, A, U):
    """Fill R (n + 1, 6) with forces [N] and moments [N m] out of balance and D, A, U with the tangent −∂R.

    Forces and shifts are global, moments and rotations in the frame of the body.  Row 0 contains the reactions of
    the top drive.  C : table of the hole; kinks (n + 2, 4) : bend above each joint.
    """
    R[0] = 0.0
    D[0] = 0.0
    loads, slopes = np.empty(LOADS), np.empty(LOADS * UNKNOWNS)
    pressed = np.empty(2 * SIZE * DIRECTIONS)
    blocks = D.reshape(-1), A.reshape(-1), U.reshape(-1)
    for j in range(1, n + 1):
        add_joint(S, j, P, kinks, R, *blocks, loads, slopes)
        R[j, 2] += S[WEIGHT + j]
        # Mud drags a sliding string along its own axis and a turning one about it, as given loads push and turn it, and
        # as bow springs do.
        spin = spin_of(S, j, laws)
        push = laws.given * S[GIVEN_FORCE + j] - S[MUD_AXIAL + j] * laws.speed
        turn = S[MUD_SPIN + j] * spin
        if S[STARTING_FORCE + j] != 0:
            along, about = starting(S, j, C, owner[j], laws)
            push, turn = push - along, turn + about
        w, x, y, z = quaternion(P, j)
        xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(w, x, y, z)
        R[j, 0] += push * zx
        R[j, 1] += push * zy
        R[j, 2] += push * zz
        R[j, AXIAL_MOMENT] -= turn
        R[j, AXIAL_MOMENT] += laws.given * S[GIVEN_TORQUE + j]
        # A tilt (a, b) turns the axis by a (−y) + b x.
        for i, dx, dy in ((0, xx, yx), (1, xy, yy), (2, xz, yz)):
            D[j, i, 3] += push * dy
            D[j, i, 4] -= push * dx
        if laws.geometry != OPEN:
            add_wall_of(laws.held, S, j, P, C, owner, laws, R, D, pressed)
    add_rock_of(laws.held, S, n, P, R, D)
    R[n, 0] += laws.bit_x
    R[n, 1] += laws.bit_y
    R[n, 2] += laws.bit_z
    # The force acts at the bit, an arm away from the centre of the last body.
    arm = S[ARM_BOTTOM + n]
    w, x, y, z = quaternion(P, n)
    fa, fb, fc = in_frame(w, x, y, z, laws.bit_x, laws.bit_y, laws.bit_z)
    R[n, 3] -= arm * fb
    R[n, 4] += arm * fa
    D[n, 3, 3] += arm * fc
    D[n, 4, 4] += arm * fc
    pressing = np.sqrt(laws.bit_x * laws.bit_x + laws.bit_y * laws.bit_y + laws.bit_z * laws.bit_z)
    if laws.at_axis == 0 or pressing == 0:
        R[n, AXIAL_MOMENT] -= laws.bit_torque
        return
    # Half of the torque acts about the direction in which the bit is pressed.
    half = 0.5 * laws.bit_torque / pressing
    R[n, 3] += half * fa
    R[n, 4] += half * fb
    R[n, AXIAL_MOMENT] += half * fc - 0.5 * laws.bit_torque
    D[n, 3, 4] += half * fc
    D[n, 4, 3] -= half * fc
    D[n, 5, 3] += half * fb
    D[n, 5, 4] -= half * fa


@entry
def frictionless_tangent(S, n, P, kinks, C, owner, laws, R, D, A, U):
    """Fill D, A, U with the tangent of springs, weight and wall alone: symmetric, positive definite when stable.

    A bent housing keeps its toolface: the spin of its body does not turn the bend.  So the moment about the body's axis
    is more than the derivative of the energy by the spin: it contains what holds the toolface against the bending
    moment.  That does no work, and in the row of the spin the derivative of the torque alone takes its place.  Given
    loads turn with their bodies and have no energy: they are left out.  So is how the wall
    presses harder or less along a shoe between arcs (wall_tangent.leave_out_change_along).
    """
    bare = Steady(
        laws.geometry, laws.friction, 0.0, 0.0, 0.0, laws.bit_x, laws.bit_y, laws.bit_z, laws.bit_torque,
        laws.at_axis, laws.wall_exponent, laws.wall_reference, 0.0, laws.orthotropic, None, laws.own,
        laws.corners,
    )  # fmt: skip
    assemble(S, n, P, kinks, C, owner, bare, R, D, A, U)
    if laws.geometry in (ARCS, SAMPLED):
        for j in range(1, n + 1):
            leave_out_change_along(S, j, P, C, owner[j], laws, D)
    for j in range(2, n + 1):
        if kinks[j, 1] == 0 and kinks[j, 2] == 0:
            continue
        for k in range(AXIAL_MOMENT):
            D[j - 1, AXIAL_MOMENT, k] = D[j - 1, k, AXIAL_MOMENT]
        D[j - 1, AXIAL_MOMENT, AXIAL_MOMENT] += U[j, AXIAL_MOMENT, AXIAL_MOMENT] - A[j, AXIAL_MOMENT, AXIAL_MOMENT]
        for k in range(SIZE):
            U[j, AXIAL_MOMENT, k] = A[j, k, AXIAL_MOMENT]


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
            normal, r_ft, r_mu_fn = read_wall(S, j, P, C, owner[j], laws)
            contacts[j, NORMAL_FORCE], contacts[j, R_FT], contacts[j, R_MU_FN] = normal, r_ft, r_mu_fn
