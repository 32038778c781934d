"""Laws ``karnopp`` and ``stribeck``: a point at rest on the wall sticks until the force on it exceeds the static limit.

``karnopp`` (Karnopp 1985) has a static and a kinetic factor.  ``stribeck`` leads from the one to the other as the
sliding grows: μ = μ_k + (μ_s − μ_k)/(1 + (v/v_s)²) with the decay speed v_s (Hess & Soom 1990).  Karnopp's window of
speeds within which a body counts as stuck is not needed: the impulse that stops the point is known (``resisting``).
Where factors along and around the string differ, the static ellipse has the shape of the kinetic one, and v is the size
of the sliding, whatever its direction.
"""

import numpy as np
from numba import types
from numba.extending import overload

from fctd.mechanics.friction import Law, against, ellipse, resisting, sliding
from fctd.mechanics.jit import INLINED, inlined
from fctd.mechanics.laws.coulomb import shares, steady_load
from fctd.mechanics.state import CAKE_AROUND, CAKE_IMPULSE, DECAY, EXCESS, STUCK, TINY


@inlined
def at_once(S, j, p, shape, excess):
    """The limit of law ``karnopp`` for a point that slides [N s]."""
    return shape.largest


@inlined
def gradually(S, j, p, shape, excess):
    """That of law ``stribeck``, which falls as the sliding grows.

    It takes the sliding that static friction would leave: at break-away, where the factor falls most, that of the end
    of the step.  Of an ellipse that is measured in units of its half axes, where the yield is the mean of both
    directions by the squares of the sliding.
    """
    ss, tt = (shape.along * p.along) ** 2, (shape.around * p.around) ** 2
    k = 1 / (ss + tt + TINY)
    yields = k * (ss * shape.along**2 * p.yields_along + tt * shape.around**2 * p.yields_around)
    left = np.sqrt((ss + tt) / (p.square + TINY)) - (shape.largest + excess) * yields
    left = np.sqrt(k * (p.along * p.along + p.around * p.around)) * (left if left > 0 else 0.0)
    decay = S[DECAY + j] * S[DECAY + j]
    return shape.largest + excess * decay / (decay + left * left + TINY)


@inlined
def with_cake(limit, more):
    """A limit of friction with what mud cake adds to it [N s]."""
    limit += more
    return limit if limit > 0 else 0.0


def with_cake_around(S, j, around):
    """``with_cake`` of the limit around the string; None where it is that along it."""
    return None if around is None else with_cake(around, S[CAKE_AROUND + j])


@overload(with_cake_around, jit_options=INLINED)
def _with_cake_around(S, j, around):
    if isinstance(around, types.NoneType):
        return lambda S, j, around: None
    return lambda S, j, around: with_cake(around, S[CAKE_AROUND + j])


@inlined
def impulse(kinetic, S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    """The impulse that stops the sliding where the limit allows it, else one against the sliding; see ``Law``.

    The limit is static for a point that stuck in the last step, and else ``kinetic``, ``at_once`` or ``gradually``.
    Mud cake changes it by its own factor.
    """
    limit, around = with_cake(limit, S[CAKE_IMPULSE + j]), with_cake_around(S, j, around)
    p, shape = sliding(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz), ellipse(limit, around)
    excess = S[EXCESS + j] * shape.largest
    moving = kinetic(S, j, p, shape, excess)
    holding = shape.largest + excess if S[STUCK + j] > 0 else moving
    f, g, sticks = resisting(p, shape, holding, moving, around)
    S[STUCK + j] = 1.0 if sticks else 0.0
    return against(S, j, f, g, p, nx, ny, nz)


@inlined
def sticking(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    """``impulse`` of law ``karnopp``."""
    return impulse(at_once, S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around)


@inlined
def weakening(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    """``impulse`` of law ``stribeck``."""
    return impulse(gradually, S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around)


KARNOPP = Law(sticking, steady_load, shares)
STRIBECK = Law(weakening, steady_load, shares)
