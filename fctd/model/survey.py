"""Survey stations to positions along the hole: average angle (Eqs 21–23) and minimum curvature.

Stations are (n, 3) arrays of measured depth [m], inclination and azimuth [rad]; azimuth is unwrapped, so it
may run past 2π.  Positions are (n, 3): north, east, true vertical depth [m].
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.surveys.directions import dogleg as dogleg
from fctd.case.surveys.directions import tangents as tangents


class Courses(NamedTuple):
    """The arcs between stations by minimum curvature, one row each.

    md [m] at the start; start (n, 3) [m]; tangent (n, 3) there; normal (n, 3) towards the centre of
    curvature; curvature [1/m]; length [m].
    """

    md: Array
    start: Array
    tangent: Array
    normal: Array
    curvature: Array
    length: Array


def interpolate_angles(stations: Array, md: Array) -> Array:
    """Stations (k, 3) at other depths md (k,) [m], inclination and unwrapped azimuth linear in measured depth."""
    return np.stack(
        [md, np.interp(md, stations[:, 0], stations[:, 1]), np.interp(md, stations[:, 0], stations[:, 2])],
        axis=1,
    )


def average_angle(stations: Array) -> Array:
    """Positions (n, 3) [m] by Eqs 21–23, with DM the change of measured depth (the paper prints vertical depth)."""
    middle = 0.5 * (stations[1:] + stations[:-1])
    steps = np.diff(stations[:, 0])[:, None] * tangents(middle)
    return np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])


def minimum_curvature(stations: Array) -> Courses:
    """Circular arcs through the stations (n, 3), n − 1 of them (Sawaryn & Thorogood 2005).

    Raises ValueError when neighbouring stations point in opposite directions: no single arc joins them.
    """
    t, angle = tangents(stations), dogleg(stations)
    length = np.diff(stations[:, 0])
    if np.any(angle > np.pi - 1e-6):
        raise ValueError(f"opposite directions at station {int(np.argmax(angle)) + 1}")
    half = 0.5 * np.maximum(angle, 1e-12)
    steps = (0.5 * length * (np.tan(half) / half))[:, None] * (t[1:] + t[:-1])
    start = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])[:-1]
    across = _across(t[1:], t[:-1])
    size = np.linalg.norm(across, axis=1, keepdims=True)
    # Any normal serves a straight course; this one is never zero, as no float has a cosine of exactly zero.
    anything = np.cross(t[:-1], [1.0, 0.0, 0.0])
    anything /= np.linalg.norm(anything, axis=1, keepdims=True)
    # Once more, since of tangents that hardly differ little is left but rounding, some of it along the hole.
    normal = _across(np.where(size > 1e-14, across / np.maximum(size, 1e-300), anything), t[:-1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return Courses(stations[:-1, 0], start, t[:-1], normal, angle / length, length)


def _across(vectors: Array, axes: Array) -> Array:
    """The part of each vector (n, 3) across its axis (n, 3)."""
    across: Array = vectors - np.sum(vectors * axes, axis=1, keepdims=True) * axes
    return across


def along_courses(courses: Courses, md: Array) -> tuple[Array, Array]:
    """Positions (k, 3) [m] and tangents (k, 3) at measured depths md (k,) [m]; straight on beyond both ends."""
    i = np.maximum(np.searchsorted(courses.md, md, side="right") - 1, 0)
    t, n, k = courses.tangent[i], courses.normal[i], courses.curvature[i]
    s = md - courses.md[i]
    inside = np.clip(s, 0.0, courses.length[i])
    angle = (k * inside)[:, None]
    # sin(κs)/κ and (1 − cos κs)/κ written so that κ → 0 is exact.
    forward = inside[:, None] * np.sinc(angle / np.pi)
    aside = 0.5 * inside[:, None] * angle * np.sinc(0.5 * angle / np.pi) ** 2
    direction = np.cos(angle) * t + np.sin(angle) * n
    point = courses.start[i] + forward * t + aside * n
    return point + (s - inside)[:, None] * direction, direction
