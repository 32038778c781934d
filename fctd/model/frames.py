"""Frames across the hole: by the high side, and those that do not jump where the high side has no meaning."""

import numpy as np

from fctd.arrays import Array

# Below this inclination the high side is north [rad].
VERTICAL = np.radians(0.1)
INCLINED = np.radians(5.0)  # from this inclination on the high side is a steady direction


def hole_frame(direction: Array) -> tuple[Array, Array]:
    """Unit vectors to the high side and to the right looking downhole, for tangents (n, 3).

    Within 0.1° of vertical the high side is north.
    """
    up = np.where(np.hypot(direction[:, 0], direction[:, 1])[:, None] < np.sin(VERTICAL), [[1.0, 0, 0]], [[0, 0, -1.0]])
    high = up - np.sum(up * direction, axis=1, keepdims=True) * direction
    high /= np.linalg.norm(high, axis=1, keepdims=True)
    return high, np.cross(direction, high)


def carried_frame(direction: Array) -> tuple[Array, Array]:
    """Two directions across the hole (n, 3) along it, without a turn about it; near the bit the first is the low side.

    direction : tangents (n, 3).  High side and right have no meaning in vertical hole, and jump where it begins to
    build.
    """
    high, _ = hole_frame(direction[-1:])
    first = np.empty_like(direction)
    first[-1] = -high[0]
    for j in range(len(direction) - 2, -1, -1):
        here = first[j + 1] - (first[j + 1] @ direction[j]) * direction[j]
        first[j] = here / np.linalg.norm(here)
    return first, np.cross(first, direction)


def steady_offsets(md: Array, direction: Array, high: Array, right: Array) -> Array:
    """Offsets (n, 2) to the high side and to the right, without jumps, of those of ``hole_frame`` (n,).

    md (n,) [m], direction (n, 3) : of the hole there.  Beyond 5° of inclination they are those of ``hole_frame``.
    Nearer to vertical the frame is carried along the hole, and turns evenly between the inclined parts above and below.
    """
    inclined = np.arccos(np.clip(direction[:, 2], -1.0, 1.0)) >= INCLINED
    if inclined.all():
        return np.column_stack((high, right))
    up, _ = hole_frame(direction)
    low, carried_right = carried_frame(direction)
    # Angle from the carried frame to the high side, clockwise looking downhole.
    angle = np.unwrap(np.arctan2((up * carried_right).sum(axis=1), -(up * low).sum(axis=1)))
    steady = np.zeros_like(angle)
    if inclined.any():
        steady = np.where(inclined, angle, np.interp(md, md[inclined], np.unwrap(angle[inclined])))
    turn = steady - angle
    return np.column_stack((high * np.cos(turn) + right * np.sin(turn), right * np.cos(turn) - high * np.sin(turn)))
