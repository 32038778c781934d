"""The arrays of floats that all rooms pass on, and what a contact query returns."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def ceiling(number: Array | float) -> Any:
    """The least whole numbers, as floats, that numbers do not exceed but for rounding: 236 of 236.00000000000003.

    So a length in feet has as many pieces as in metres.
    """
    return np.ceil(number - 1e-9)


def nearest(number: float) -> Any:
    """The whole number, as a float, that is nearest; halfway between two the upper one, but for rounding."""
    return np.floor(number + 0.5 + 1e-9)


def first_largest(numbers: Array) -> int:
    """Index of the largest of positive numbers, the first of those that are equal but for rounding."""
    return int(np.argmax(numbers >= numbers.max() * (1 - 1e-9)))


class Contacts(NamedTuple):
    """Result of a contact query, one row per point.

    penetration (n,) [m], negative is clearance; normal (n, 3) from the hole axis to the wall; md (n,) [m].
    """

    penetration: Array
    normal: Array
    md: Array
