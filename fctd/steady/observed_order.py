"""The observed order at which a load converges with the number of segments, and the value at its end.

Richardson's extrapolation (1911) to more than three levels, as Eça and Hoekstra (2014) have it: a load of N segments is
φ = φ∞ + αN⁻ᵖ, by least squares.  The ends of contact move by whole segments, so that what is left scatters as a
segment is long: its weight is N².  The intervals are those of the profile of the sum of squares (Bates and Watts 1988).
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array

# Orders that are tried.  An interval that reaches their ends says nothing of the order.
ORDERS = np.arange(0.2, 4.005, 0.01)
COVERED = 0.95  # of the intervals
UNKNOWNS, SPARE = 3, 3  # φ∞, α and p; loads beyond them that an order takes: of fewer, intervals are too often wrong


class Converging(NamedTuple):
    """A load of ever more segments: its observed order and extrapolated value, each with the ends of its interval.

    order : NaN where the levels show none; the interval of the value is then NaN too.
    """

    order: float
    order_low: float
    order_high: float
    limit: float
    limit_low: float
    limit_high: float


NO_ORDER = Converging(*[float("nan")] * 6)


def observe(segments: Array, loads: Array) -> Converging:
    """Observed order and extrapolated value of loads (n,) of strings of so many segments (n,), NaN without an answer.

    There is no order with fewer than six loads, and where the interval of the order reaches an end of ``ORDERS``.
    """
    from scipy.special import stdtrit  # slow to import

    answered = np.isfinite(loads)
    count, load = segments[answered], loads[answered]
    free = len(load) - UNKNOWNS
    if free < SPARE:
        return NO_ORDER
    # Relative to the last, as squares of loads lose what their differences are.
    last, sizes = load[-1], (count[-1] / count)[:, None] ** ORDERS
    weight, off = (count / count[-1])[:, None] ** 2, (load - last)[:, None]
    # Weighted lines through the loads against N⁻ᵖ, one for each order.
    total = weight.sum()
    size, mean = (weight * sizes).sum(axis=0) / total, (weight * off).sum() / total
    spread = (weight * (sizes - size) ** 2).sum(axis=0)
    slope = (weight * (sizes - size) * (off - mean)).sum(axis=0) / spread
    squares = (weight * (off - mean - slope * (sizes - size)) ** 2).sum(axis=0)
    best = int(squares.argmin())
    allowed = squares[best] * (1 + stdtrit(free, 0.5 * (1 + COVERED)) ** 2 / free)
    inside = np.flatnonzero(squares <= allowed)
    if inside[0] == 0 or inside[-1] == len(ORDERS) - 1:
        return NO_ORDER
    limits = last + mean - slope * size
    # Of a line with this order, the squares grow by the square of the distance over the variance of its end.
    reach = np.sqrt((allowed - squares[inside]) * (1 / total + size[inside] ** 2 / spread[inside]))
    return Converging(
        float(ORDERS[best]), float(ORDERS[inside[0]]), float(ORDERS[inside[-1]]), float(limits[best]),
        float((limits[inside] - reach).min()), float((limits[inside] + reach).max()),
    )  # fmt: skip
