"""Directions of the hole at stations (n, 3) of measured depth [m], inclination and azimuth [rad]."""

import numpy as np

from fctd.arrays import Array


def tangents(stations: Array) -> Array:
    """Unit vectors (n, 3) along the hole at the stations (n, 3) [m, rad, rad]: north, east, down."""
    inclination, azimuth = stations[:, 1], stations[:, 2]
    across = np.sin(inclination)
    return np.stack([across * np.cos(azimuth), across * np.sin(azimuth), np.cos(inclination)], axis=1)


def dogleg(stations: Array) -> Array:
    """Angle between the tangents of neighbouring stations [rad], shape (n − 1,)."""
    t = tangents(stations)
    # 2 asin(|Δt|/2) keeps its precision where acos(t·t) loses half of it: at small angles.
    half = 0.5 * np.linalg.norm(np.diff(t, axis=0), axis=1)
    return np.asarray(2 * np.arcsin(np.minimum(half, 1.0)))


def severity(stations: Array) -> Array:
    """Dog-leg of the courses between stations [deg/30 m], shape (n − 1,)."""
    return np.asarray(np.degrees(dogleg(stations)) * 30.0 / np.diff(stations[:, 0]))
