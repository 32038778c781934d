"""Noise of the size of rounding, by which a case shows whether an answer hangs on rounding (``solver.perturbed``).

A compressed string may have several balances, and another processor's rounding leads to another one.  So does this
noise, which is far below any tolerance of a survey or a pipe.
"""

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case

SHARE = 1e-13  # standard deviation, relative
TURN = 1e-9  # largest turn of the whole survey about the vertical [rad]: some micrometres at the end of a well
# What each draw is of: the same seed gives independent noise.
STATIONS, SEGMENTS = range(2)


def with_noise(case: Case, seed: int | None) -> Case:
    """The case with the noise of a seed; without noise for None."""
    return case.model_copy(update={"solver": case.solver.model_copy(update={"perturbed": seed})})


def perturb_stations(stations: Array, seed: int | None) -> Array:
    """Stations (n, 3) of measured depth [m], inclination and azimuth [rad] with noise, and turned about the vertical.

    A vertical station stays vertical, and the ends of the hole stay where they are.  None leaves all as it is.
    """
    if seed is None:
        return stations
    draw = np.random.default_rng([seed, STATIONS])
    noisy = stations * (1 + SHARE * draw.standard_normal(stations.shape))
    noisy[[0, -1], 0] = stations[[0, -1], 0]
    noisy[:, 2] += TURN * draw.uniform(-1, 1)
    return noisy


def perturb_lengths(length: Array, seed: int | None) -> Array:
    """Lengths (n,) [m] of segments with noise, each by itself, and so their masses, weights, arms and stiffnesses."""
    if seed is None:
        return length
    draw = np.random.default_rng([seed, SEGMENTS])
    return length * (1 + SHARE * draw.standard_normal(length.shape))
