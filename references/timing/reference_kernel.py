"""The yardstick of all recorded ratios: a fixed piece of work of the engine's kind.  Never edit this file.

Turning bodies in one flat buffer, a row for each quantity: a packed loop over columns with additions,
multiplications, one division and one square root for each pair, rows read at a neighbour's column, results written
back, the whole in the first-level cache.  Every body stays a unit vector and every rate a number
near 1, so that no value is ever denormal.  A ratio to it outlives a change of clock, of load and, roughly, of
processor.

tests/benchmarks/test_reference_kernel.py holds a hash of this file: an edit would make every record in
benchmarks/history/ a comparison with something else.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

COLUMNS = 64
STRIDE = 80  # rows touch each other, so that where the buffer lies decides nothing
FIRST = 8  # columns before and after the first and last body stay as they are
ROWS = 36
# Rows of the buffer: four quantities of three components, then weights that are only read.
DIRECTION, RATE, TURN, SUM, WEIGHT = 0, 3 * STRIDE, 6 * STRIDE, 9 * STRIDE, 12 * STRIDE
WEIGHTS = 24


def new_buffer() -> NDArray[np.float64]:
    """Unit vectors in all directions, rates and weights of the order of 1."""
    spare = np.zeros(ROWS * STRIDE + 8)
    S = spare[-spare.ctypes.data % 64 // 8 :][: ROWS * STRIDE]  # at the start of a cache line
    j = np.arange(STRIDE)
    for row in range(ROWS):
        S[row * STRIDE : (row + 1) * STRIDE] = 0.5 + 0.4 * np.sin(1.0 + 0.7 * row + 0.31 * j)
    x, y, z = (S[DIRECTION + k * STRIDE : DIRECTION + (k + 1) * STRIDE] for k in range(3))
    length = np.sqrt(x * x + y * y + z * z)
    x /= length
    y /= length
    z /= length
    return S


@njit(forceinline=True)
def _pair(ax, ay, az, bx, by, bz):  # type: ignore[no-untyped-def]
    """What two neighbours do to each other: their cross product over the length of their sum."""
    sx, sy, sz = ax + bx, ay + by, az + bz
    k = 1 / np.sqrt(sx * sx + sy * sy + sz * sz + 0.1)
    return k * (ay * bz - az * by), k * (az * bx - ax * bz), k * (ax * by - ay * bx)


@njit(error_model="numpy", fastmath={"contract"})
def _turn(S):  # type: ignore[no-untyped-def]
    """Update TURN, given DIRECTION and WEIGHT."""
    for j in range(FIRST, FIRST + COLUMNS):
        ax, ay, az = S[DIRECTION + j - 1], S[DIRECTION + STRIDE + j - 1], S[DIRECTION + 2 * STRIDE + j - 1]
        bx, by, bz = S[DIRECTION + j], S[DIRECTION + STRIDE + j], S[DIRECTION + 2 * STRIDE + j]
        cx, cy, cz = S[DIRECTION + j + 1], S[DIRECTION + STRIDE + j + 1], S[DIRECTION + 2 * STRIDE + j + 1]
        px, py, pz = _pair(ax, ay, az, bx, by, bz)
        qx, qy, qz = _pair(bx, by, bz, cx, cy, cz)
        # Every weight is read once a pass, as the constants of bodies and joints are.
        u, v, w = 0.0, 0.0, 0.0
        for k in range(0, WEIGHTS, 3):
            u += S[WEIGHT + k * STRIDE + j]
            v += S[WEIGHT + (k + 1) * STRIDE + j]
            w += S[WEIGHT + (k + 2) * STRIDE + j]
        S[TURN + j] = u * px - v * qx
        S[TURN + STRIDE + j] = v * py - w * qy
        S[TURN + 2 * STRIDE + j] = w * pz - u * qz


@njit(error_model="numpy", fastmath={"contract"})
def _move(S, dt):  # type: ignore[no-untyped-def]
    """Update RATE, DIRECTION and SUM, given TURN."""
    for j in range(FIRST, FIRST + COLUMNS):
        x, y, z = S[DIRECTION + j], S[DIRECTION + STRIDE + j], S[DIRECTION + 2 * STRIDE + j]
        u = S[RATE + j] + dt * S[TURN + j]
        v = S[RATE + STRIDE + j] + dt * S[TURN + STRIDE + j]
        w = S[RATE + 2 * STRIDE + j] + dt * S[TURN + 2 * STRIDE + j]
        # Rates are kept to the length of 1, so that they neither die out nor grow.
        k = 1 / np.sqrt(u * u + v * v + w * w)
        u, v, w = k * u, k * v, k * w
        S[RATE + j], S[RATE + STRIDE + j], S[RATE + 2 * STRIDE + j] = u, v, w
        x, y, z = x + dt * (v * z - w * y), y + dt * (w * x - u * z), z + dt * (u * y - v * x)
        k = 1 / np.sqrt(x * x + y * y + z * z)
        S[DIRECTION + j], S[DIRECTION + STRIDE + j], S[DIRECTION + 2 * STRIDE + j] = k * x, k * y, k * z
        S[SUM + j] += dt * k
        S[SUM + STRIDE + j] += dt * u * v
        S[SUM + 2 * STRIDE + j] += dt * v * w


@njit(error_model="numpy", cache=True)
def reference_kernel(S, passes):  # type: ignore[no-untyped-def]
    """Work through the buffer ``passes`` times."""
    for _ in range(passes):
        _turn(S)
        _move(S, 0.01)
