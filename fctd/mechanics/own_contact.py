"""Fittings that do not touch as bare pipe does: their own friction factor, and bow springs that centre the pipe.

Bows that are wider than the hole press the pipe towards its axis in proportion to how far it lies off it, and drag by
a starting force wherever it lies.  Within ``GAP`` of the axis, where a force has no direction, they do not press.
"""

import math

from fctd.mechanics.jit import inlined
from fctd.mechanics.state import (
    BOW_STIFFNESS,
    FRICTION,
    FRICTION_AROUND,
    HOLE,
    INVERSE_JA,
    INVERSE_MASS,
    J_AXIAL,
    K_WALL,
    LOST_FRICTION,
    MASS,
    OWN_FRICTION,
    RADIUS,
    STARTING_FORCE,
    SUM_FRICTION_TORQUE,
    TINY,
    VX,
    VY,
    VZ,
    WZ,
    axis,
)

GAP = 1e-4  # [m]


@inlined
def has_own_contact(S, j):
    """Whether contact point j is that of such a fitting."""
    return S[OWN_FRICTION + j] != 0 or S[BOW_STIFFNESS + j] != 0


@inlined
def store_own_contact(S, j):
    """Change the wall that is stored beside contact point j to what its fitting has."""
    if S[OWN_FRICTION + j] != 0:
        S[FRICTION + j] = S[FRICTION_AROUND + j] = S[OWN_FRICTION + j]
    if S[BOW_STIFFNESS + j] != 0:
        S[HOLE + j] = max(S[HOLE + j], S[RADIUS + j] + GAP)
        S[K_WALL + j] = S[BOW_STIFFNESS + j]


@inlined
def drag_bows(S, n, scale, dt):
    """Slow every body along and about its axis by the starting force of its bows; scale : share of friction.

    It is dry friction, which stops a motion and does not reverse it.
    """
    for j in range(1, n + 1):
        if S[STARTING_FORCE + j] == 0:
            continue
        ax, ay, az = axis(S, j)
        along, rate, r = S[VX + j] * ax + S[VY + j] * ay + S[VZ + j] * az, S[WZ + j], S[RADIUS + j]
        pull = scale * dt * S[STARTING_FORCE + j] / (math.sqrt(along * along + r * r * rate * rate) + TINY)
        less = along * min(pull * S[INVERSE_MASS + j], 1.0)
        fewer = rate * min(pull * r * r * S[INVERSE_JA + j], 1.0)
        S[VX + j] -= less * ax
        S[VY + j] -= less * ay
        S[VZ + j] -= less * az
        S[WZ + j] -= fewer
        S[SUM_FRICTION_TORQUE + j] += S[J_AXIAL + j] * fewer
        # As the work of other impulses, by the velocity that they leave.
        S[LOST_FRICTION + j] += S[MASS + j] * less * (along - less) + S[J_AXIAL + j] * fewer * (rate - fewer)
