"""The load at which a string reaches a limit: it grows from nothing, past loads without a steady string."""

from collections.abc import Callable, Iterable
from typing import Final

import numpy as np

# A margin is known within this share of the load, and a load at which the string buckles or stops within the next.
EXACT, CLOSE = 1e-9, 2e-3
# Overpull and torque grow from this share of the weakest section's capacity on, by doubling, up to its multiple.
FIRST, MOST_CAPACITY = 1 / 64, 4.0
# Where no string is found in the middle of an interval, other shares of it are tried; and others of a larger load.
WITHIN, NEARBY = (0.5, 0.4, 0.6, 0.25, 0.75, 0.1, 0.9), (1.0, 0.9, 1.1, 0.8)
NAN: Final = float("nan")


def root_of(excess: Callable[[float], float], scale: float) -> float:
    """The least load at which an excess is 0, NaN where it is above 0 from the start, or no string is found.

    excess : of a load, NaN where it has no steady string; scale : a load of about that size.
    """
    from scipy.optimize import brentq  # slow to import, and most commands need none

    low, high = 0.0, FIRST * scale
    if not excess(0.0) < 0:
        return NAN
    while high <= MOST_CAPACITY * scale:
        high, value = _known(excess, (share * high for share in NEARBY))
        if value >= 0:
            try:
                return float(brentq(excess, low, high, xtol=EXACT * scale, rtol=EXACT))
            except ValueError:  # from NaN: no steady string at a load on the way
                return _between(excess, low, high, EXACT * scale)
        if not np.isfinite(value):
            return NAN
        low, high = high, 2 * high
    return NAN


def _between(excess: Callable[[float], float], low: float, high: float, apart: float) -> float:
    """The largest load below the root at which a string was found, where some between have none."""
    while high - low > apart:
        load, value = _known(excess, (low + share * (high - low) for share in WITHIN))
        if not np.isfinite(value):
            break
        low, high = (low, load) if value >= 0 else (load, high)
    return low


def _known(excess: Callable[[float], float], loads: Iterable[float]) -> tuple[float, float]:
    """The first of several loads with a steady string, and its excess; NaN of none."""
    return next(((load, value) for load in loads if np.isfinite(value := excess(load))), (NAN, NAN))


def last_of(holds: Callable[[float], bool], most: float) -> float:
    """The largest load, within ``CLOSE``, up to which something holds; NaN where it does up to ``most``.

    It grows from a small one: strings far beyond buckling take longest.
    """
    low, high = 0.0, FIRST * most
    if not holds(low):
        return low
    while holds(high):
        if high >= most:
            return NAN
        low, high = high, min(2 * high, most)
    while high - low > CLOSE * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low
