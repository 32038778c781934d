"""The wall as a spring of another power: F = K d₀ (d/d₀)^p at penetration d; exponent 1.5 is Hertz's.

K is the stiffness of the linear wall, and both walls press equally at the reference penetration d₀.  The stepper
multiplies a stiffness by the penetration, so the stiffness beside a point is set to the secant K (d/d₀)^(p − 1).
"""

import math

from fctd.mechanics.jit import entry, kernel
from fctd.mechanics.state import HOLE, K_WALL, MARGIN_END, RADIUS, radial
from fctd.mechanics.topdrive import TOP_PENETRATION


@kernel
def stiffen_walls(S, top, n, laws):
    """Update the wall's stiffness beside every point that touches it, and the largest penetration so far."""
    for j in range(1, n + 1):
        px, py, pz = radial(S, j)
        depth = math.sqrt(px * px + py * py + pz * pz) - S[HOLE + j] + S[RADIUS + j]
        if depth > 0:
            S[K_WALL + j] *= (depth / laws.wall_reference) ** (laws.wall_exponent - 1)
            # This stiffness is valid for this step only; an empty interval makes the next step look up the wall's.
            S[MARGIN_END + j] = -math.inf
            if depth > top[TOP_PENETRATION]:
                top[TOP_PENETRATION] = depth


@entry
def put_stiffness(S, top, n, laws):
    """``stiffen_walls`` for Python."""
    stiffen_walls(S, top, n, laws)


def tangent_over_linear(exponent: float, reference: float, penetration: float) -> float:
    """Tangent stiffness of the wall at a penetration [m], over the stiffness K of the linear wall."""
    return float(exponent * (penetration / reference) ** (exponent - 1))
