"""The state of a string: one flat buffer, one row per quantity, one column per body.

LLVM packs a loop only when it can prove that rows do not overlap.  It can when every row is a constant
offset into one buffer, so the offsets are written out below and a row is reached as ``S[VX + j]``.
With NamedTuples of arrays, 2-D arrays or reshapes inside a kernel the loop stays scalar.

Column 0 is the top drive, columns 1..n are the rigid segments from the top to the bit.  Joint j connects
bodies j - 1 and j.  The columns after n are inert (no mass, no stiffness): the first of them serves as
lower body of the free joint below the bit, and they fill the last packed operation, since a scalar remainder loop
would take as long as the rest of a 60-segment string.

Short strings lie side by side in one buffer, each in columns of its own (state_memory.py).  A slice across rows, such
as ``S[:]``, therefore spans columns of other strings: ``columns`` and ``put_state`` read and write whole states.
"""

from typing import NamedTuple

import numpy as np

from fctd.mechanics.jit import inlined
from fctd.mechanics.rock import NOTHING, Rock
from fctd.mechanics.state_memory import Blocks, columns_of

MAX_SEGMENTS = 10_000
# Columns handled at once: a cache line, and a multiple of every vector width in use.
LANES = 8
# An odd number of cache lines: column 1 of every row can begin one, and rows spread over all cache sets.
STRIDE = 1255 * LANES
# All bits of a column's number.  ``block & COLUMN_BITS`` is ``block``, but shows LLVM that no index in a loop over one
# packed operation is negative.  It does not pack a loop with indices that may be negative and count from the end.
COLUMN_BITS = 2**14 - 1

# Centre of mass, global frame (x north, y east, z down) [m]; velocity, global [m/s].
X, Y, Z = 0 * STRIDE, 1 * STRIDE, 2 * STRIDE
VX, VY, VZ = 3 * STRIDE, 4 * STRIDE, 5 * STRIDE
# Orientation quaternion, body to global, scalar first; spin in the body frame [rad/s].
QW, QX, QY, QZ = 6 * STRIDE, 7 * STRIDE, 8 * STRIDE, 9 * STRIDE
WX, WY, WZ = 10 * STRIDE, 11 * STRIDE, 12 * STRIDE

# Derived each step: string axis towards the bit and spin, both global.
AX, AY, AZ = 13 * STRIDE, 14 * STRIDE, 15 * STRIDE
GX, GY, GZ = 16 * STRIDE, 17 * STRIDE, 18 * STRIDE

# Body constants: mass [kg], transverse and axial inertia [kg m^2], their inverses, buoyed weight [N].
MASS, J_TRANSVERSE, J_AXIAL = 19 * STRIDE, 20 * STRIDE, 21 * STRIDE
INVERSE_MASS, INVERSE_JT, INVERSE_JA = 22 * STRIDE, 23 * STRIDE, 24 * STRIDE
WEIGHT = 25 * STRIDE
# Arms from the centre of mass along the axis to the upper joint, lower joint and contact point [m].
ARM_TOP, ARM_BOTTOM, ARM_CONTACT = 26 * STRIDE, 27 * STRIDE, 28 * STRIDE
# Contact radius [m]; multiplier of the wall stiffness (1 per point, or tributary length [m]).
RADIUS, TRIBUTARY = 29 * STRIDE, 30 * STRIDE
# Mud damping of the whole segment: axial, lateral [N s/m], rotational [N m s].
MUD_AXIAL, MUD_LATERAL, MUD_SPIN = 31 * STRIDE, 32 * STRIDE, 33 * STRIDE

# Joint constants: axial, shear [N/m], bending, torsional [N m/rad] stiffness; whole turns of twist,
# which quaternions cannot represent [rad].
K_AXIAL, K_SHEAR, K_BEND, K_TWIST = 34 * STRIDE, 35 * STRIDE, 36 * STRIDE, 37 * STRIDE
TURNS = 38 * STRIDE
# Joint loads, global: force on the lower body [N] (opposite on the upper), moments about the centres
# of mass of the upper and of the lower body [N m].
FX, FY, FZ = 39 * STRIDE, 40 * STRIDE, 41 * STRIDE
UX, UY, UZ = 42 * STRIDE, 43 * STRIDE, 44 * STRIDE
LX, LY, LZ = 45 * STRIDE, 46 * STRIDE, 47 * STRIDE

# Wall beside the contact point: vector PT from the hole axis to the point [m], hole radius such that
# |PT| - HOLE + RADIUS is the penetration [m], stiffness [N/m], friction factor along the string.
PX, PY, PZ, HOLE = 48 * STRIDE, 49 * STRIDE, 50 * STRIDE, 51 * STRIDE
K_WALL, FRICTION = 52 * STRIDE, 53 * STRIDE
# Copy of the piece of hole that owns the contact point (see contact.py): start, axis there; for arcs also normal,
# curvature and the direction of the end.
OX, OY, OZ = 54 * STRIDE, 55 * STRIDE, 56 * STRIDE
TX, TY, TZ = 57 * STRIDE, 58 * STRIDE, 59 * STRIDE
NX, NY, NZ = 60 * STRIDE, 61 * STRIDE, 62 * STRIDE
CURVE, END_COS, END_SIN = 63 * STRIDE, 64 * STRIDE, 65 * STRIDE
# Limits of the distances past the piece's start and along its end within which the point needs no new search;
# how far it is inside them, where 0 or less makes it look up the table [m].
MARGIN_TOP, MARGIN_END, SLACK = 66 * STRIDE, 67 * STRIDE, 68 * STRIDE

# Sums over the steps since the last record: impulses of the wall's normal force [N s], of the friction
# torque Σ r F_t, of Σ r μ F_n and of the mud torque [N m s], of joint tension [N s] and torque [N m s].
SUM_NORMAL, SUM_FRICTION_TORQUE, SUM_R_MU_N = 69 * STRIDE, 70 * STRIDE, 71 * STRIDE
SUM_MUD_TORQUE, SUM_TENSION, SUM_TORQUE = 72 * STRIDE, 73 * STRIDE, 74 * STRIDE
# Energy lost since the start of the run [J]: friction, contact damping, mud, joint damping.
LOST_FRICTION, LOST_CONTACT, LOST_MUD, LOST_JOINT = 75 * STRIDE, 76 * STRIDE, 77 * STRIDE, 78 * STRIDE
# Mud that moves sideways with a body: its mass a [kg], and by how much it lowers the inverse mass m⁻¹ sideways,
# m⁻¹ − (m + a)⁻¹ [1/kg].  Both are 0 without such mud, and then change no result.  The transverse inertia holds its own
# share of the mud.
ADDED_MASS, HELD_BACK = 79 * STRIDE, 80 * STRIDE
# Mass times the offset of its centre from the axis, along the body's own x [kg m].
UNBALANCE = 81 * STRIDE

# Friction that sticks (laws/sticking.py): 1 where friction stopped the contact point when it last acted, else 0; excess
# of the static over the kinetic factor, as a share of it; speed at which half of the excess is left [m/s].
STUCK, EXCESS, DECAY = 82 * STRIDE, 83 * STRIDE, 84 * STRIDE
# Mud cake (cake.py): age of the cake below the contact point [s], what its friction factor adds to the limit [N s].
CAKE_AGE, CAKE_IMPULSE = 85 * STRIDE, 86 * STRIDE
# Of a string that hangs from a moving block (derrick.py), whose upper part is in air: buoyancy of the whole body in mud
# [N], the share of the body that is below the rotary table, and the mud damping of the whole body in mud.
BUOYANCY, IMMERSED = 87 * STRIDE, 88 * STRIDE
IN_MUD_AXIAL, IN_MUD_LATERAL, IN_MUD_SPIN = 89 * STRIDE, 90 * STRIDE, 91 * STRIDE
# Bent housing above joint j (joints.py): x and y of the quaternion by which the end of body j - 1 is tilted, in its
# frame.
KINK_X, KINK_Y = 92 * STRIDE, 93 * STRIDE
# Boundary layers of mud on a body whose axial velocity changes (dynamics.py): their drag on the body [N s/m] by the
# difference of both velocities, and their own axial velocity [m/s].
LAYER_DRAG, LAYER_SPEED = 94 * STRIDE, 95 * STRIDE
# Numbers of the waves within the long segment, one after the other (waves.py): the least number of columns of a state.
WAVES = 96 * STRIDE
LEAST_COLUMNS = 5 * LANES
# Loads that are given to a body (given_loads.py): a force along its axis towards the bit [N], a torque about it [N m].
GIVEN_FORCE, GIVEN_TORQUE = 97 * STRIDE, 98 * STRIDE
# Friction that differs along and around the string (laws.orthotropic), of the wall beside the contact point: the factor
# around it, and what mud cake adds to the limit there [N s].
FRICTION_AROUND, CAKE_AROUND = 99 * STRIDE, 100 * STRIDE
# Share of the wall's friction that a steady string has among its given loads in place of the wall's own.
GIVEN_FRICTION = 101 * STRIDE
# Fittings that touch the wall (own_contact.py): their own friction factor, 0 where it is that of the wall; stiffness of
# bow springs [N/m], 0 without them, and friction that compressed ones have wherever the pipe lies [N].
OWN_FRICTION, BOW_STIFFNESS, STARTING_FORCE = 102 * STRIDE, 103 * STRIDE, 104 * STRIDE
# 1 below a swivel, where a steady string does not rotate.
STILL = 105 * STRIDE
# Beside bow springs: radius of the hole itself [m].  Of a disc that may touch two places (laws.corners): share of the
# friction of both that is left across the body (``friction.Sliding``).
BARE_HOLE, NET = 106 * STRIDE, 107 * STRIDE

ROWS = 108


class Laws(NamedTuple):
    """Choices and constants of a run, as scalars, so that one compiled stepper serves every case.

    geometry : CYLINDERS, ARCS, SAMPLED (sampled.py) or OPEN (no wall at all).  friction : a law's code of
    ``law_names.CODES``.
    friction_scale : multiplies every friction factor (0 while the string settles).
    contact_damping : wall damping [N s/m].  joint_damping : stiffness-proportional damping time [s].
    settling : artificial mass-proportional damping rate [1/s], 0 in a run.
    wall_exponent : p of the wall's force K d₀ (d/d₀)^p at penetration d; wall_reference : d₀ [m].
    cake_thickness [m], cake_time [s] : final thickness of mud cake and the time in which it grows so thick;
    cake_friction : its factor.  0 thickness: no cake.  rock : under the bit.
    torsion_damping : damping time of torsion in addition to that of the joints [s].
    shape_damping : damping time of bending and shear in space [s].
    layer_rate : rate at which the mud's boundary layers follow the string along itself [1/s].
    unbalanced : whether any body has an unbalance; bent : whether any joint has a bent housing; given : whether any
    body has given loads.
    orthotropic : True where friction factors along and around the string differ, else None, a type of its own: code for
    factors that differ is compiled where it is needed, and that for equal factors does without it.  bows : the same, of
    bow springs.  corners : the same, of a hole in which a disc may touch two places at once (sampled.py).
    """

    geometry: int
    friction: int
    friction_scale: float
    contact_damping: float
    joint_damping: float
    settling: float
    wall_exponent: float = 1.0
    wall_reference: float = 1e-3
    cake_thickness: float = 0.0
    cake_time: float = 1.0
    cake_friction: float = 0.0
    rock: Rock = NOTHING
    torsion_damping: float = 0.0
    shape_damping: float = 0.0
    layer_rate: float = 0.0
    unbalanced: bool = False
    bent: bool = False
    given: bool = False
    orthotropic: bool | None = None
    bows: bool | None = None
    corners: bool | None = None


# Keeps 0/0 out of packed arithmetic, where a branch would cost more, and changes no other result.
TINY = 1e-300

CYLINDERS, ARCS, OPEN, SAMPLED = 0, 1, 2, 3


_BLOCKS = Blocks(ROWS, STRIDE, LANES)


def new_state(segments: int) -> np.ndarray:
    """Return a fresh buffer for ``segments`` bodies: at rest at the origin, upright, without mass.

    Raises ValueError for more bodies than fit into the buffer; ``lay_out`` rejects such a string before.
    """
    if segments > MAX_SEGMENTS:
        raise ValueError(f"at most {MAX_SEGMENTS} segments fit into a buffer, not {segments}")
    # The columns before and after the bodies lie in cache lines of their own.
    packed = (segments + LANES - 1) // LANES * LANES
    S = _BLOCKS.take(max(packed + 2 * LANES, LEAST_COLUMNS))
    columns(S)[[QW // STRIDE, AZ // STRIDE]] = 1.0
    return S


def columns(S: np.ndarray) -> np.ndarray:
    """View of a state as a matrix (ROWS, columns), a row per quantity, a column per body."""
    return columns_of(S, ROWS, STRIDE)


def copy_state(S: np.ndarray) -> np.ndarray:
    """Return a copy of a state with the same alignment, so that steps are as fast."""
    copied = _BLOCKS.take(columns(S).shape[1])
    columns(copied)[:] = columns(S)
    return copied


def put_state(S: np.ndarray, other: np.ndarray) -> None:
    """Write another state, of a string with as many columns, into a state."""
    columns(S)[:] = columns(other)


def row(S: np.ndarray, offset: int, segments: int) -> np.ndarray:
    """View of one quantity for bodies 1..n, outside kernels (shape (n,))."""
    return S[offset + 1 : offset + 1 + segments]


@inlined
def position(S, j):
    """Centre of mass of body j [m], global."""
    return S[X + j], S[Y + j], S[Z + j]


@inlined
def velocity(S, j):
    """Velocity of the centre of mass of body j [m/s], global."""
    return S[VX + j], S[VY + j], S[VZ + j]


@inlined
def quaternion(S, j):
    """Orientation of body j, body to global, scalar first."""
    return S[QW + j], S[QX + j], S[QY + j], S[QZ + j]


@inlined
def spin(S, j):
    """Spin of body j in its own frame [rad/s]."""
    return S[WX + j], S[WY + j], S[WZ + j]


@inlined
def axis(S, j):
    """Unit vector along body j towards the bit, global."""
    return S[AX + j], S[AY + j], S[AZ + j]


@inlined
def global_spin(S, j):
    """Spin of body j [rad/s], global."""
    return S[GX + j], S[GY + j], S[GZ + j]


@inlined
def lateral_inverse_mass(S, j):
    """Inverse of the mass of body j, mud included, that moves sideways [1/kg]."""
    return S[INVERSE_MASS + j] - S[HELD_BACK + j]


@inlined
def joint_force(S, j):
    """Force of joint j on body j [N], global; opposite on body j - 1."""
    return S[FX + j], S[FY + j], S[FZ + j]


@inlined
def radial(S, j):
    """Vector PT from the hole axis to contact point j [m], global."""
    return S[PX + j], S[PY + j], S[PZ + j]


@inlined
def contact_point(S, j):
    """T (§4.1): the contact point on the axis of body j [m], global."""
    x, y, z = position(S, j)
    ax, ay, az = axis(S, j)
    arm = S[ARM_CONTACT + j]
    return x + arm * ax, y + arm * ay, z + arm * az
