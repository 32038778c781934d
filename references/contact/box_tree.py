"""Contact of a sphere with the tube mesh through a tree of boxes; one source serves for timing and for counting.

python-fcl and coal do not report how many nodes and triangles they test.  This tree halves the triangles in their
order along and around the hole.  Its boxes are aligned with the global axes, which is the cheapest box test (an
oriented box adds three dot products), so that an operation count is a lower bound for a node of fcl or coal.
"""

import numpy as np
from numba import njit

from fctd.arrays import Array


class BoxTree:
    """Boxes as a heap: node k has the children 2k + 1 and 2k + 2, the last level holds one triangle per leaf.

    corners (m, 9) [m] : corners of the triangles, in order.  low, high (nodes, 3) [m] : empty boxes have low > high.
    """

    def __init__(self, triangles: Array) -> None:
        self.corners = np.ascontiguousarray(triangles, dtype=float).reshape(-1, 9)
        leaves = 1 << int(np.ceil(np.log2(len(triangles))))
        low, high = np.full((leaves, 3), np.inf), np.full((leaves, 3), -np.inf)
        low[: len(triangles)], high[: len(triangles)] = triangles.min(axis=1), triangles.max(axis=1)
        lows, highs = [low], [high]
        while len(lows[0]) > 1:
            lows.insert(0, np.minimum(lows[0][::2], lows[0][1::2]))
            highs.insert(0, np.maximum(highs[0][::2], highs[0][1::2]))
        self.low, self.high = np.concatenate(lows), np.concatenate(highs)
        self.first_leaf = leaves - 1

    def penetrations(self, points: Array, radii: Array) -> Array:
        """Penetrations (n,) [m] of spheres with centres (n, 3) [m] and radii (n,) [m], see ``penetration``."""
        found = np.empty(len(points))
        _all(self.low, self.high, self.corners, self.first_leaf, np.ascontiguousarray(points), radii, found)
        return found


@njit(error_model="numpy")
def _minus(a, b):  # type: ignore[no-untyped-def]
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@njit(error_model="numpy")
def _dot(a, b):  # type: ignore[no-untyped-def]
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(error_model="numpy")
def _beyond(a, edge, share):  # type: ignore[no-untyped-def]
    """Squared length of ``a`` less a share of an edge."""
    rest = a[0] - edge[0] * share, a[1] - edge[1] * share, a[2] - edge[2] * share
    return _dot(rest, rest)


@njit(error_model="numpy")
def _near(low, high, k, x, y, z, reach):  # type: ignore[no-untyped-def]
    """Whether a sphere of radius √reach meets a box (Arvo 1990)."""
    for i, at in enumerate((x, y, z)):
        if at < low[k, i]:
            out = low[k, i] - at
        elif at > high[k, i]:
            out = at - high[k, i]
        else:
            continue
        reach = reach - out * out
        if reach < 0:
            return False
    return True


@njit(error_model="numpy")
def _from_triangle(corners, k, x, y, z):  # type: ignore[no-untyped-def]
    """Squared distance of a point from a triangle [m²], region by region (Ericson 2005, §5.1.5)."""
    a = corners[k, 0], corners[k, 1], corners[k, 2]
    b = corners[k, 3], corners[k, 4], corners[k, 5]
    c = corners[k, 6], corners[k, 7], corners[k, 8]
    p = x, y, z
    ab, ac, ap = _minus(b, a), _minus(c, a), _minus(p, a)
    d1, d2 = _dot(ab, ap), _dot(ac, ap)
    if d1 <= 0 and d2 <= 0:
        return _dot(ap, ap)
    bp = _minus(p, b)
    d3, d4 = _dot(ab, bp), _dot(ac, bp)
    if d3 >= 0 and d4 <= d3:
        return _dot(bp, bp)
    vc = d1 * d4 - d3 * d2
    if vc <= 0 and d1 >= 0 and d3 <= 0:
        return _beyond(ap, ab, d1 / (d1 - d3))
    cp = _minus(p, c)
    d5, d6 = _dot(ab, cp), _dot(ac, cp)
    if d6 >= 0 and d5 <= d6:
        return _dot(cp, cp)
    vb = d5 * d2 - d1 * d6
    if vb <= 0 and d2 >= 0 and d6 <= 0:
        return _beyond(ap, ac, d2 / (d2 - d6))
    va, up, down = d3 * d6 - d5 * d4, d4 - d3, d5 - d6
    if va <= 0 and up >= 0 and down >= 0:
        return _beyond(bp, _minus(c, b), up / (up + down))
    share = 1 / (va + vb + vc)
    v, w = vb * share, vc * share
    rest = (
        ap[0] - v * ab[0] - w * ac[0],
        ap[1] - v * ab[1] - w * ac[1],
        ap[2] - v * ab[2] - w * ac[2],
    )
    return _dot(rest, rest)


@njit(error_model="numpy")
def penetration(low, high, corners, first_leaf, x, y, z, radius):  # type: ignore[no-untyped-def]
    """Depth of a sphere beyond the nearest triangle [m], −inf without contact; numbers of nodes and triangles tested.

    low, high, corners, first_leaf : attributes of the tree; the arrays may be `Counted`.
    """
    reach, meets, nodes, triangles = radius * radius, False, 0, 0
    waiting = [0]
    while len(waiting) > 0:
        k = waiting.pop()
        nodes += 1
        if not _near(low, high, k, x, y, z, reach):
            continue
        if k < first_leaf:
            waiting.append(2 * k + 1)
            waiting.append(2 * k + 2)
            continue
        triangles += 1
        away = _from_triangle(corners, k - first_leaf, x, y, z)
        if away <= reach:
            reach, meets = away, True  # from here on only nearer triangles matter
    return (radius - np.sqrt(reach) if meets else -np.inf), nodes, triangles


@njit(error_model="numpy", cache=True)
def _all(low, high, corners, first_leaf, points, radii, found):  # type: ignore[no-untyped-def]
    for j in range(points.shape[0]):
        found[j] = penetration(low, high, corners, first_leaf, points[j, 0], points[j, 1], points[j, 2], radii[j])[0]
