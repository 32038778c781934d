"""Stations without the dog-legs that rounding made.

Within the angle that rounding may have turned it, every direction is chosen so that the curvature of the hole varies
least: its total variation is a minimum, which keeps straight sections straight and builds even (Kim, Koh, Boyd &
Gorinevsky 2009, ℓ1 trend filtering).  It is a linear program, which scipy solves.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.message import within
from fctd.case.surveys.directions import tangents

LARGEST_ANGLE: Final = 0.02  # [rad]: whole degrees turn a direction by up to 0.0123
MOST_SMOOTHED: Final = 5000  # stations: the program takes seconds for them
# What a turn of a station costs against the variation of curvature that it saves: a station that gains nothing stays.
_TURN: Final = 0.05


def smooth(stations: Array, angle: float) -> Array:
    """The stations (n, 3) [m, rad, rad] at the same depths, each direction within `angle` [rad] of the one given.

    Raises InputError for more than `MOST_SMOOTHED` stations.
    """
    from scipy import sparse
    from scipy.optimize import linprog

    count = len(stations)
    if count < 3:
        return stations
    if count > MOST_SMOOTHED:
        raise InputError(f"at most {MOST_SMOOTHED} stations to smooth, found {count}", key="wellbore.survey_smoothing")
    length = np.diff(stations[:, 0])
    t = tangents(stations)
    inclination, azimuth = stations[:, 1], stations[:, 2]
    flat = np.cos(inclination)
    down = np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), -np.sin(inclination)])
    right = np.stack([-np.sin(azimuth), np.cos(azimuth), np.zeros(count)])
    # The change of curvature at the inner stations [1/m], times the mean length, of one component of the tangents.
    inner = sparse.eye_array(count - 2, count - 1, k=1) - sparse.eye_array(count - 2, count - 1)
    slope = sparse.diags_array(1 / length) @ (
        sparse.eye_array(count - 1, count, k=1) - sparse.eye_array(count - 1, count)
    )
    change = length.mean() * inner @ slope
    turns = sparse.vstack(
        [
            sparse.hstack([change @ sparse.diags_array(d), change @ sparse.diags_array(r)])
            for d, r in zip(down, right, strict=True)
        ]
    )
    variation = sparse.eye_array(turns.shape[0])
    # Every turn and every difference is one of two numbers of at least 0, of which one is 0.
    found = linprog(
        np.concatenate([np.full(4 * count, _TURN), np.ones(2 * turns.shape[0])]),
        A_eq=sparse.hstack([turns, -turns, -variation, variation]),
        b_eq=-(change @ t).T.ravel(),
        bounds=[(0.0, angle / np.sqrt(2.0))] * (4 * count) + [(0.0, None)] * (2 * turns.shape[0]),
        method="highs",
    )
    if found.x is None:
        raise InputError(f"stations that can be smoothed ({within(found.message)})", key="wellbore.survey_smoothing")
    u, v = (found.x[: 2 * count] - found.x[2 * count : 4 * count]).reshape(2, count)
    return _turned(stations, t + (u * down + v * right).T, (u != 0.0) | (v != 0.0))


def _turned(stations: Array, directions: Array, moved: NDArray[np.bool_]) -> Array:
    """The stations with the directions (n, 3) where they moved; the azimuth of a vertical one stays."""
    out = stations.copy()
    across = np.hypot(directions[:, 0], directions[:, 1])
    out[moved, 1] = np.arctan2(across, directions[:, 2])[moved]
    turned = moved & (across > 1e-12)
    out[turned, 2] = np.arctan2(directions[:, 1], directions[:, 0])[turned]
    out[:, 2] = np.unwrap(out[:, 2])
    return out
