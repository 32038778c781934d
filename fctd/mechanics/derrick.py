"""The part of a string above the rotary table, which is in air: no mud, no buoyancy.

A body passes the table gradually.  Its buoyancy and mud damping are those of the whole body times the share of its
length below the table, so that the buoyancy is the derivative of a potential and the ledger stays exact.
"""

from fctd.mechanics.jit import entry, inlined
from fctd.mechanics.joints import hinge_gap, joint_loads, joint_twist
from fctd.mechanics.state import (
    ARM_BOTTOM,
    ARM_TOP,
    AZ,
    BUOYANCY,
    IMMERSED,
    IN_MUD_AXIAL,
    IN_MUD_LATERAL,
    IN_MUD_SPIN,
    K_AXIAL,
    K_SHEAR,
    MASS,
    MUD_AXIAL,
    MUD_LATERAL,
    MUD_SPIN,
    WEIGHT,
    Z,
    axis,
)
from fctd.mechanics.topdrive import GRAVITY


@inlined
def half_height(S, j):
    """Half of the vertical extent of body j along the axis of the top drive [m]."""
    return 0.5 * (S[ARM_TOP + j] + S[ARM_BOTTOM + j]) * S[AZ]


@inlined
def immerse(S, n):
    """Update weight and mud damping of the bodies that are not wholly in mud, given positions.

    From the top down to the first body that is: those below it were in mud before.
    """
    j, share = 1, 0.0
    while j <= n and share < 1:
        share = min(max(0.5 + 0.5 * S[Z + j] / half_height(S, j), 0.0), 1.0)
        S[IMMERSED + j] = share
        S[WEIGHT + j] = S[MASS + j] * GRAVITY - share * S[BUOYANCY + j]
        S[MUD_AXIAL + j] = share * S[IN_MUD_AXIAL + j]
        S[MUD_LATERAL + j] = share * S[IN_MUD_LATERAL + j]
        S[MUD_SPIN + j] = share * S[IN_MUD_SPIN + j]
        j += 1


@entry
def put_immersed(S, n):
    """``immerse`` for Python."""
    immerse(S, n)


@entry
def read_joint(S, j):
    """Force of the springs of joint j on body j [N], three scalars, and its twist [rad]; axes must be up to date."""
    ax, ay, az = axis(S, j - 1)
    bx, by, bz = axis(S, j)
    dx, dy, dz = hinge_gap(S, j)
    loads = joint_loads(ax, ay, az, bx, by, bz, dx, dy, dz, 0.0, S[K_AXIAL + j], S[K_SHEAR + j], 0.0, 0.0)
    return loads[0], loads[1], loads[2], joint_twist(S, j)


@inlined
def part_immersed(S, j):
    """What weight times height leaves out of the energy of body j, while it passes the table [J].

    With 2h the height of the body and s the share of it below the table, the buoyancy B s has the potential
    B (z + h)²/4h = B s z + B h s (1 - s).
    """
    share = S[IMMERSED + j]
    return S[BUOYANCY + j] * half_height(S, j) * share * (1 - share)
