"""Laws ``karnopp`` and ``stribeck``: a point at rest on the wall sticks until the force on it exceeds the static limit.

``karnopp`` (Karnopp 1985) has a static and a kinetic factor.  ``stribeck`` leads from the one to the other as the
sliding grows: μ = μ_k + (μ_s − μ_k)/(1 + (v/v_s)²) with the decay speed v_s (Hess & Soom 1990).  Karnopp's window of
speeds within which a body counts as stuck is not needed: the impulse that stops the point is known, and within the
limit it is applied in full, so that the point rests and does not creep.
"""

import numpy as np

from fctd.mechanics.friction import Law, against, lever, response, sliding
from fctd.mechanics.jit import inlined
from fctd.mechanics.joints import cross
from fctd.mechanics.laws.coulomb import shares, steady_load
from fctd.mechanics.state import CAKE_IMPULSE, DECAY, EXCESS, STUCK, TINY

# Newton's method for the direction of friction: number of iterations, and how many times smaller than the impulse that
# stops the sliding one may be whose direction it looks for: that of a smaller one is the same.
ITERATIONS, SMALLER = 2, 1e9


@inlined
def opposing(along, mixed, across, inverse):
    """The sliding that an impulse −f·s − g·t of the size 1/``inverse`` leaves, opposite to it, over the impulse.

    along, mixed, across : elements of the matrix A by which the sliding along s and t yields to it.  With this ratio ν
    the impulse solves (A + ν)(f, g) = (1, 0), so that it is parallel to (across + ν, −mixed) (Moré & Sorensen 1983).
    Newton's method for 1/|(f, g)| begins at a lower bound of ν and stays below it.
    """
    shift = inverse - along - across
    shift = shift if shift > 0 else 0.0
    for _ in range(ITERATIONS):
        first, second, square = along + shift, across + shift, mixed * mixed
        size = second * second + square
        slope = size / (second * size + square * (first + second) + TINY)
        shift += slope * (inverse * np.sqrt(size) - first * second + square)
    return shift


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
    # A body yields more in one direction than in another: an impulse against s would leave sliding along t, at a right
    # angle to s in the wall.  The impulse −f·s − g·t that stops both solves A (f, g) = (1, 0): it is parallel to
    # (across, −mixed), and 1/det A times as large.
    tx, ty, tz = cross(nx, ny, nz, sx, sy, sz)
    ox, oy, oz = cross(*lever(S, j, nx, ny, nz), tx, ty, tz)
    share = 1 / (square + TINY)
    along = share * response(S, j, sx, sy, sz, mx, my, mz, sx, sy, sz, mx, my, mz)
    mixed = share * response(S, j, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz)
    across = share * response(S, j, tx, ty, tz, ox, oy, oz, tx, ty, tz, ox, oy, oz)
    determinant = along * across - mixed * mixed

    limit += S[CAKE_IMPULSE + j]
    limit = limit if limit > 0 else 0.0
    excess = S[EXCESS + j] * limit
    speed = np.sqrt(square)
    moving = kinetic(S, j, speed, along, limit, excess)
    most = limit + excess if S[STUCK + j] > 0 else moving
    sticks = (across * across + mixed * mixed) * square <= most * most * determinant * determinant
    # Friction opposes the sliding that it leaves, not the one before it: a point that swings across the string's axis
    # would lose its friction along it by overshooting from step to step.
    inverse = speed / (moving + TINY)
    inverse = inverse if inverse < SMALLER * along else SMALLER * along
    f = across + (0.0 if sticks else opposing(along, mixed, across, inverse))
    size = speed * np.sqrt(f * f + mixed * mixed)
    share = (1.0 if sticks else moving) / ((determinant if sticks else size) + TINY)
    f, g = share * f, -share * mixed
    S[STUCK + j] = 1.0 if sticks else 0.0
    return against(S, j, 1.0, f * sx + g * tx, f * sy + g * ty, f * sz + g * tz,
                   f * mx + g * ox, f * my + g * oy, f * mz + g * oz)  # fmt: skip


@inlined
def sticking(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """``impulse`` of law ``karnopp``."""
    return impulse(at_once, S, j, u, v, w, a, b, c, nx, ny, nz, limit)


@inlined
def weakening(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """``impulse`` of law ``stribeck``."""
    return impulse(gradually, S, j, u, v, w, a, b, c, nx, ny, nz, limit)


KARNOPP = Law("karnopp", sticking, steady_load, shares)
STRIBECK = Law("stribeck", weakening, steady_load, shares)
