"""The arrays of floats that all rooms pass on, and what a contact query returns."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Contacts(NamedTuple):
    """Result of a contact query, one row per point.

    penetration (n,) [m], negative is clearance; normal (n, 3) from the hole axis to the wall; md (n,) [m].
    """

    penetration: Array
    normal: Array
    md: Array
