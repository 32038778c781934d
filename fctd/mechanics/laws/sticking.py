"""Laws ``karnopp`` and ``stribeck``: a point at rest on the wall sticks until the force on it exceeds the static limit.

``karnopp`` (Karnopp 1985) has a static and a kinetic factor.  ``stribeck`` leads from the one to the other as the
sliding grows: μ = μ_k + (μ_s − μ_k)/(1 + (v/v_s)²) with the decay speed v_s (Hess & Soom 1990).  Karnopp's window of
speeds within which a body counts as stuck is not needed: the impulse that stops the point is known (``resisting``).
"""

import numpy as np

from fctd.mechanics.friction import Law, against, resisting, sliding, yielding
from fctd.mechanics.jit import inlined
from fctd.mechanics.laws.coulomb import shares, steady_load
from fctd.mechanics.state import CAKE_IMPULSE, DECAY, EXCESS, STUCK, TINY


@inlined
def at_once(S, j, speed, along, limit, excess):
    """The limit of law ``karnopp`` for a point that slides [N s]."""
    return limit


@inlined
def gradually(S, j, speed, along, limit, excess):
    """That of law ``stribeck``, which falls as the sliding grows.

    It takes the sliding that static friction would leave: at break-away, where the factor falls most, that of the end
    of the step.
    """
    left = speed - (limit + excess) * along
    left = left if left > 0 else 0.0
    decay = S[DECAY + j] * S[DECAY + j]
    return limit + excess * decay / (decay + left * left + TINY)


@inlined
def impulse(kinetic, S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """The impulse that stops the sliding where the limit allows it, else one against the sliding; see ``Law``.

    The limit is static for a point that stuck in the last step, and else ``kinetic``, ``at_once`` or ``gradually``.
    Mud cake changes it by its own factor.
    """
    sx, sy, sz, mx, my, mz = sliding(S, j, u, v, w, a, b, c, nx, ny, nz)
    square = sx * sx + sy * sy + sz * sz
    tx, ty, tz, ox, oy, oz, along, mixed, across = yielding(S, j, nx, ny, nz, sx, sy, sz, mx, my, mz, square)
    limit += S[CAKE_IMPULSE + j]
    limit = limit if limit > 0 else 0.0
    excess = S[EXCESS + j] * limit
    moving = kinetic(S, j, np.sqrt(square), along, limit, excess)
    holding = limit + excess if S[STUCK + j] > 0 else moving
    f, g, sticks = resisting(along, mixed, across, square, holding, moving)
    S[STUCK + j] = 1.0 if sticks else 0.0
    return against(S, j, f, g, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz)


@inlined
def sticking(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """``impulse`` of law ``karnopp``."""
    return impulse(at_once, S, j, u, v, w, a, b, c, nx, ny, nz, limit)


@inlined
def weakening(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """``impulse`` of law ``stribeck``."""
    return impulse(gradually, S, j, u, v, w, a, b, c, nx, ny, nz, limit)


KARNOPP = Law(sticking, steady_load, shares)
STRIBECK = Law(weakening, steady_load, shares)
