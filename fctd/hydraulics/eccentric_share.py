"""What part of the friction pressure pulls at a pipe, on the axis of its hole or beside it."""

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array


def pull_square(
    outer: ArrayLike,
    hole: ArrayLike,
    eccentricity: ArrayLike = 0.0,
    index: ArrayLike = 1.0,
    yield_share: ArrayLike = 0.0,
) -> Array:
    """λ² [m²] at radii [m]: laminar flow lifts a pipe at rest by f + πr_o² dp_f/ds = πλ² dp_f/ds [N/m], f its shear.

    eccentricity : offset over clearance, 0 to 1; index and yield_share (of the stress at the wall) : of the flow curve.

    Concentric, λ is the radius of zero shear.  With m = r_o r_h and δ the distance of the walls in bipolar coordinates,
    cosh δ = (r_o² + r_h² − d²)/(2m) at an offset d, a Newtonian mud has λ² = m sinh δ/δ: exact, from the constant
    part of its velocity (Piercy, Hooper & Winny 1933).  Of λ² − m of the concentric annulus another mud has the share
    1.5 (1 − s² − 2su/(1+n) − u²/(1+2n)), u = 1 − s, the limit of a narrow gap; eccentricity takes it down alike.
    """
    inner, wide, e, n, s = (np.asarray(value, float) for value in (outer, hole, eccentricity, index, yield_share))
    product, sheared = inner * wide, 1 - s
    share = 1.5 * (1 - s**2 - 2 * s * sheared / (1 + n) - sheared**2 / (1 + 2 * n))
    axial = _excess(inner, wide, np.zeros(()))
    return np.asarray(product * (1 + share * axial) * (1 + _excess(inner, wide, e)) / (1 + axial))


def _excess(inner: Array, wide: Array, eccentricity: Array) -> Array:
    """sinh δ/δ − 1."""
    clearance = (wide - inner) * np.sqrt((1 - eccentricity) * (1 + eccentricity))
    distance = 2 * np.arcsinh(0.5 * clearance / np.sqrt(inner * wide))
    return np.where(distance > 0, np.sinh(distance) / np.where(distance > 0, distance, 1.0) - 1, 0.0)
