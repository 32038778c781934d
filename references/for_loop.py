"""The paper's own search for the owner of a point (§4.2): a FOR-loop over all cylinders from the top."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from fctd.contact import LENGTH, distance_along


@njit(error_model="numpy", cache=True)
def _loop(C, points, owners):  # type: ignore[no-untyped-def]
    for k in range(points.shape[0]):
        x, y, z = points[k]
        for i in range(C.shape[0]):
            s = distance_along(C, i, x, y, z)
            if 0 <= s <= C[i, LENGTH]:
                owners[k] = i
                break


def for_loop_owners(pieces: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.int64]:
    """First cylinder from the top with 0 ≤ Q ≤ |AB|² for each point (n, 3), −1 where there is none."""
    owners = np.full(len(points), -1, dtype=np.int64)
    _loop(pieces, np.ascontiguousarray(points, dtype=float), owners)
    return owners
