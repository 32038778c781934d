"""Loads that are given to the bodies: a force along the axis of a body, and a torque about it.

They turn with the body, and depend neither on its motion nor on the wall.  What gives them is the mud that flows past
the string; their work is an entry of the ledger.
"""

from fctd.mechanics.jit import inlined
from fctd.mechanics.state import (
    AX,
    AY,
    AZ,
    GIVEN_FORCE,
    GIVEN_TORQUE,
    INVERSE_JA,
    INVERSE_MASS,
    VX,
    VY,
    VZ,
    WZ,
)
from fctd.mechanics.topdrive import GIVEN_WORK


@inlined
def push_given(S, n, dt):
    """Update velocity and spin of every body by its given loads, before mud and wall act."""
    for j in range(1, n + 1):
        gained = dt * S[INVERSE_MASS + j] * S[GIVEN_FORCE + j]
        S[VX + j] += gained * S[AX + j]
        S[VY + j] += gained * S[AY + j]
        S[VZ + j] += gained * S[AZ + j]
        S[WZ + j] += dt * S[INVERSE_JA + j] * S[GIVEN_TORQUE + j]


@inlined
def count_given(S, top, n, dt):
    """Add the work of the given loads, with the velocities after the step."""
    work = 0.0
    for j in range(1, n + 1):
        along = S[VX + j] * S[AX + j] + S[VY + j] * S[AY + j] + S[VZ + j] * S[AZ + j]
        work += S[GIVEN_FORCE + j] * along + S[GIVEN_TORQUE + j] * S[WZ + j]
    top[GIVEN_WORK] += dt * work
