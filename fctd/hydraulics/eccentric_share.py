"""What part of the friction pressure pulls at a pipe beside the axis of its hole: exact for a Newtonian mud."""

import numpy as np
from numpy.typing import ArrayLike

from fctd.arrays import Array


def pull_square(outer: ArrayLike, hole: ArrayLike, eccentricity: ArrayLike = 0.0) -> Array:
    """λ² [m²] for radii [m] and eccentricity (offset over clearance, 0 to 1); friction pulls a pipe up by πλ² dp_f/ds.

    This is the shear at the pipe with its area times the gradient.  λ² = r_o r_h sinh δ/δ, where δ is the distance of
    the walls in bipolar coordinates, cosh δ = (r_o² + r_h² − d²)/(2 r_o r_h), d the offset.  Concentric it is
    (r_h² − r_o²)/(2 ln(r_h/r_o)), and where the pipe touches r_o r_h.  A pipe that moves at v down drags the flow
    π(λ² − r_o²) v down with it, and is dragged up by 2πμv/δ a metre.

    Exact for a Newtonian mud in laminar flow (Piercy, Hooper & Winny 1933).
    """
    inner, wide, e = (np.asarray(value, float) for value in (outer, hole, eccentricity))
    product = inner * wide
    half = np.arcsinh(0.5 * (wide - inner) * np.sqrt((1 - e) * (1 + e) / product))
    between = 2 * half
    return np.asarray(
        product * np.divide(np.sinh(between), between, out=np.ones_like(between * product), where=between > 0)
    )
