"""The paper's search for the cylinder that owns a point (§4.2): a FOR-loop over all cylinders from the top."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from fctd.mechanics.contact import DIRECTION, LENGTH, START, distance_along
from fctd.mechanics.dynamics import padded_columns, step, update_axes
from fctd.mechanics.state import RADIUS, contact_point
from fctd.mechanics.stored_walls import store_cylinder, store_wall


@njit(error_model="numpy")
def for_loop_owner(C, x, y, z):  # type: ignore[no-untyped-def]
    """First cylinder from the top with 0 ≤ Q ≤ |AB|², −1 where there is none."""
    for i in range(C.shape[0]):
        s = distance_along(C, i, x, y, z)
        if 0 <= s <= C[i, LENGTH]:
            return i
    return -1


@njit(error_model="numpy", cache=True)
def _loop(C, points, owners):  # type: ignore[no-untyped-def]
    for k in range(points.shape[0]):
        owners[k] = for_loop_owner(C, points[k, 0], points[k, 1], points[k, 2])


def for_loop_owners(pieces: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.int64]:
    """First cylinder from the top with 0 ≤ Q ≤ |AB|² for each point (n, 3), −1 where there is none."""
    owners = np.full(len(points), -1, dtype=np.int64)
    _loop(pieces, np.ascontiguousarray(points, dtype=float), owners)
    return owners


@njit(error_model="numpy", cache=True)
def _test(C, points, owners, squares):  # type: ignore[no-untyped-def]
    for k in range(points.shape[0]):
        i = owners[k]
        x, y, z = points[k, 0] - C[i, START], points[k, 1] - C[i, START + 1], points[k, 2] - C[i, START + 2]
        s = x * C[i, DIRECTION] + y * C[i, DIRECTION + 1] + z * C[i, DIRECTION + 2]
        squares[k] = x * x + y * y + z * z - s * s if 0 <= s <= C[i, LENGTH] else np.inf


def one_cylinder(
    pieces: NDArray[np.float64], points: NDArray[np.float64], owners: NDArray[np.int64]
) -> NDArray[np.float64]:
    """|PT|² (n,) [m²] of Eqs 5 and 10 for points (n, 3), each with one given cylinder (n,); inf beyond its ends."""
    squares = np.empty(len(points))
    _test(pieces, np.ascontiguousarray(points, dtype=float), owners, squares)
    return squares


@njit(error_model="numpy")
def find_walls(S, owner, n, packed, C, geometry):  # type: ignore[no-untyped-def]
    """``stored_walls.update_walls`` by the FOR-loop, which remembers no owner and knows cylinders alone."""
    for j in range(1, n + 1):
        x, y, z = contact_point(S, j)
        i = for_loop_owner(C, x, y, z)
        if i < 0:  # no cylinder, no wall
            store_wall(S, j, 0.0, 0.0, 0.0, S[RADIUS + j] + 1.0, 0.0, 0.0, 0.0)
        else:
            store_cylinder(S, j, C, i, x, y, z)


@njit(error_model="numpy", cache=True)
def advance_with_for_loop(S, top, n, C, laws, motion, pipe, dt, steps):  # type: ignore[no-untyped-def]
    """The engine's ``dynamics.advance``, compiled as a whole, with the FOR-loop in place of its search."""
    update_axes(S, padded_columns(n))
    owner = np.zeros(n + 2, np.int64)
    for _ in range(steps):
        step(find_walls, S, top, owner, n, C, laws, motion, pipe, dt)
