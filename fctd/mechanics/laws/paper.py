"""Law ``paper`` (Eqs 15–16): axial drag μF_n and a couple r μ F_n about the axis, each in full.

Where the factors along the string and around it differ, the drag has the one and the couple the other.
"""

import numpy as np

from fctd.mechanics.friction import Law, turning_limit
from fctd.mechanics.jit import inlined
from fctd.mechanics.state import INVERSE_JA, INVERSE_MASS, J_AXIAL, MASS


@inlined
def impulse(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    """Axial drag and a couple about the axis; each may stop its motion but not reverse it; see ``Law``."""
    m, ja, im, ia = S[MASS + j], S[J_AXIAL + j], S[INVERSE_MASS + j], S[INVERSE_JA + j]
    sliding, spinning = np.sqrt(w * w), np.sqrt(c * c)
    drag = limit if limit < m * sliding else m * sliding
    couple = radius * turning_limit(limit, around)
    couple = couple if couple < ja * spinning else ja * spinning
    dw = drag * im if w < 0 else -drag * im
    dc = couple * ia if c < 0 else -couple * ia
    return 0.0 * w, 0.0 * w, dw, 0.0 * w, 0.0 * w, dc


@inlined
def steady_load(speed, spin, limit, around, radius, ax, ay, az, nx, ny, nz, tx, ty, tz):
    """Axial drag and a couple about the axis, each in full; see ``Law``."""
    drag = -limit * np.sign(speed)
    torque = -radius * turning_limit(limit, around) * np.sign(spin)
    return drag * ax, drag * ay, drag * az, torque * ax, torque * ay, torque * az, torque


@inlined
def shares(speed, turning, limit, around):
    """Each in full; friction around the hole is a couple and bears no lateral load."""
    return limit * np.sign(speed), turning_limit(limit, around) * np.sign(turning), 0.0


LAW = Law(impulse, steady_load, shares)
