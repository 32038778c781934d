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


@inlined
def impulse(S, j, u, v, w, a, b, c, nx, ny, nz, limit):
    """The impulse that stops the sliding where the limit allows it, else one against the sliding; see ``Law``.

    The limit is static for a point that stuck in the last step, and falls from there to the kinetic one as the sliding
    grows: at once without a decay speed (0), which is law ``karnopp``.  Mud cake changes it by its own factor.
    """
    sx, sy, sz, mx, my, mz = sliding(S, j, u, v, w, a, b, c, nx, ny, nz)
    square = sx * sx + sy * sy + sz * sz
    # A body yields more in one direction than in another: an impulse against s would leave sliding along t, at a right
    # angle to s in the wall.  The impulse −f·s − g·t that stops both solves a system of two equations.
    tx, ty, tz = cross(nx, ny, nz, sx, sy, sz)
    ox, oy, oz = cross(*lever(S, j, nx, ny, nz), tx, ty, tz)
    along = response(S, j, sx, sy, sz, mx, my, mz, sx, sy, sz, mx, my, mz)
    mixed = response(S, j, sx, sy, sz, mx, my, mz, tx, ty, tz, ox, oy, oz)
    across = response(S, j, tx, ty, tz, ox, oy, oz, tx, ty, tz, ox, oy, oz)
    share = square / (along * across - mixed * mixed + TINY)
    f, g = share * across, -share * mixed

    limit += S[CAKE_IMPULSE + j]
    limit = limit if limit > 0 else 0.0
    excess = S[EXCESS + j] * limit
    # The sliding that static friction would leave: at break-away, where the factor falls most, that of the step's end.
    speed = np.sqrt(square)
    left = speed - (limit + excess) * along / (square + TINY)
    left = left if left > 0 else 0.0
    decay = S[DECAY + j] * S[DECAY + j]
    moving = limit + excess * decay / (decay + left * left + TINY)
    most = limit + excess if S[STUCK + j] > 0 else moving
    sticks = (f * f + g * g) * square <= most * most
    # Sliding friction stops what it would reverse, as in law ``coulomb``.
    slowing, stopping = moving * along, speed * square
    slowed = (slowing if slowing < stopping else stopping) / (speed * along + TINY)
    f, g = f if sticks else slowed, g if sticks else 0.0 * g
    S[STUCK + j] = 1.0 if sticks else 0.0
    return against(S, j, 1.0, f * sx + g * tx, f * sy + g * ty, f * sz + g * tz,
                   f * mx + g * ox, f * my + g * oy, f * mz + g * oz)  # fmt: skip


KARNOPP = Law("karnopp", impulse, steady_load, shares)
STRIBECK = Law("stribeck", impulse, steady_load, shares)
