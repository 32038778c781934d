"""Loads that are given to the bodies: a force along the axis of a body, and a torque about it.

They turn with the body, and depend neither on its motion nor on the wall.  What gives them while a string moves is the
mud that flows past it: the ledger counts their work as a negative loss to the mud.
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
    LOST_MUD,
    VX,
    VY,
    VZ,
    WZ,
)


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
def count_given(S, n, dt):
    """Take the work of the given loads off the loss to the mud, with the velocities after the step."""
    for j in range(1, n + 1):
        along = S[VX + j] * S[AX + j] + S[VY + j] * S[AY + j] + S[VZ + j] * S[AZ + j]
        S[LOST_MUD + j] -= dt * (S[GIVEN_FORCE + j] * along + S[GIVEN_TORQUE + j] * S[WZ + j])
