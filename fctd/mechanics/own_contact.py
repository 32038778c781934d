"""Fittings that do not touch as bare pipe does: their own friction factor, and bow springs that centre the pipe.

Bows that are wider than the hole press the pipe towards its axis in proportion to how far it lies off it, and drag by
a starting force wherever it lies; others press where they touch.  Within ``GAP`` of the axis, where a force has no
direction, they do not press.

Bows slide on the wall, at the radius R of the hole.  Their starting force, all round, has this arm about the axis.  The
spring presses at one place, towards which the pipe lies e off the axis: the pipe's own axis is R − e away from it.
"""

import math

from numba import types
from numba.extending import overload

from fctd.mechanics.jit import INLINED, inlined
from fctd.mechanics.state import (
    BARE_HOLE,
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
)

GAP = 1e-4  # [m]


@inlined
def has_bows(S, j):
    """Whether bow springs touch at contact point j; a wall does not lean for them, which may press where it does not.

    Between two cylinders a wall leans as far as the string is deep in it, and in narrow hole bows always are.
    """
    return S[BOW_STIFFNESS + j] != 0


@inlined
def has_own_contact(S, j):
    """Whether contact point j is that of such a fitting."""
    return S[OWN_FRICTION + j] != 0 or has_bows(S, j)


@inlined
def store_own_contact(S, j):
    """Change the wall that is stored beside contact point j to what its fitting has."""
    if S[OWN_FRICTION + j] != 0:
        S[FRICTION + j] = S[FRICTION_AROUND + j] = S[OWN_FRICTION + j]
    if has_bows(S, j):
        S[BARE_HOLE + j] = S[HOLE + j]
        S[HOLE + j] = max(S[HOLE + j], S[RADIUS + j] + GAP)
        S[K_WALL + j] = S[BOW_STIFFNESS + j]


def radius_of(bows, S, j, penetration):
    """Distance from the axis of body j to the place of the wall that it touches [m]; bows : of ``Laws``."""
    if has_bows(S, j):
        return S[BARE_HOLE + j] - (penetration + S[HOLE + j] - S[RADIUS + j])
    return S[RADIUS + j]


@overload(radius_of, jit_options=INLINED)
def _radius_of(bows, S, j, penetration):
    if isinstance(bows, types.NoneType):
        return lambda bows, S, j, penetration: S[RADIUS + j]
    return radius_of


def held_by_bows(bows, S, j, along, rate, scale, dt):
    """Speed along the axis of body j [m/s] and spin about it [rad/s], slowed by the starting force of its bows.

    It is dry friction, which stops a motion and does not reverse it.  bows : of ``Laws``, None where no body has one;
    scale : share of friction.
    """
    pull, r = _pull(S, j, along, rate, scale, dt), S[BARE_HOLE + j]
    less = along * min(pull * S[INVERSE_MASS + j], 1.0)
    fewer = rate * min(pull * r * r * S[INVERSE_JA + j], 1.0)
    along, rate = along - less, rate - fewer
    S[SUM_FRICTION_TORQUE + j] += S[J_AXIAL + j] * fewer
    S[LOST_FRICTION + j] += S[MASS + j] * less * along + S[J_AXIAL + j] * fewer * rate
    return along, rate


@inlined
def _pull(S, j, along, rate, scale, dt):
    """Impulse of the starting force over the speed with which bows slide [kg]; none where nothing compresses them."""
    turning = S[BARE_HOLE + j] * rate
    scale *= S[HOLE + j] <= S[RADIUS + j] + GAP
    return scale * dt * S[STARTING_FORCE + j] / (math.sqrt(along * along + turning * turning) + TINY)


@overload(held_by_bows, jit_options=INLINED)
def _held_by_bows(bows, S, j, along, rate, scale, dt):
    if isinstance(bows, types.NoneType):
        return lambda bows, S, j, along, rate, scale, dt: (along, rate)
    return held_by_bows
