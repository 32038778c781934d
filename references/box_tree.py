"""A sphere against the tube mesh through a tree of boxes, in plain Python so that its operations can be counted.

python-fcl and coal do not report their counts.  This tree halves the triangles in their order along and around the
hole; its boxes are aligned with the global axes, whose test is the cheapest there is (an oriented box adds three
dot products to it), so a count is a lower bound for a node of theirs.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class BoxTree:
    """Boxes as a heap: node k has the children 2k + 1 and 2k + 2, the last level holds one triangle a leaf.

    corners (m, 9) [m] : of the triangles, in order.  low, high (nodes, 3) [m] : empty boxes have low > high.
    """

    def __init__(self, triangles: Array) -> None:
        self.corners = triangles.reshape(-1, 9)
        leaves = 1 << int(np.ceil(np.log2(len(triangles))))
        low, high = np.full((leaves, 3), np.inf), np.full((leaves, 3), -np.inf)
        low[: len(triangles)], high[: len(triangles)] = triangles.min(axis=1), triangles.max(axis=1)
        lows, highs = [low], [high]
        while len(lows[0]) > 1:
            lows.insert(0, np.minimum(lows[0][::2], lows[0][1::2]))
            highs.insert(0, np.maximum(highs[0][::2], highs[0][1::2]))
        self.low, self.high = np.concatenate(lows), np.concatenate(highs)
        self.first_leaf = leaves - 1


def penetration(tree: BoxTree, low: Any, high: Any, corners: Any, x: Any, y: Any, z: Any, radius: Any) -> Any:
    """How deep a sphere reaches beyond the nearest triangle [m], −inf where it meets none; nodes and triangles tested.

    low, high, corners : the tree's arrays, or the same as `Counted`.
    """
    reach, nearest, nodes, triangles = radius * radius, None, 0, 0
    waiting = [0]
    while waiting:
        k = waiting.pop()
        nodes += 1
        if not _near(low, high, k, x, y, z, reach):
            continue
        if k < tree.first_leaf:
            waiting += [2 * k + 1, 2 * k + 2]
            continue
        triangles += 1
        away = _from_triangle(corners, k - tree.first_leaf, x, y, z)
        if away <= reach:
            nearest = reach = away  # only what is nearer still matters
    return (-np.inf if nearest is None else radius - np.sqrt(nearest)), nodes, triangles


def _near(low: Any, high: Any, k: int, x: Any, y: Any, z: Any, reach: Any) -> bool:
    """Whether a sphere meets a box (Arvo 1990)."""
    square = None
    for i, at in enumerate((x, y, z)):
        if at < low[k, i]:
            out = low[k, i] - at
        elif at > high[k, i]:
            out = at - high[k, i]
        else:
            continue
        square = out * out if square is None else square + out * out
    return square is None or bool(square <= reach)


def _from_triangle(corners: Any, k: int, x: Any, y: Any, z: Any) -> Any:
    """Squared distance of a point from a triangle [m²], region by region (Ericson 2005, §5.1.5)."""
    a, b, c = (tuple(corners[k, 3 * i + j] for j in range(3)) for i in range(3))
    p = (x, y, z)
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
    return _square(tuple(ap[i] - v * ab[i] - w * ac[i] for i in range(3)))


def _minus(a: Any, b: Any) -> tuple[Any, ...]:
    return tuple(a[i] - b[i] for i in range(3))


def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _square(a: Any) -> Any:
    return _dot(a, a)


def _beyond(a: Any, edge: Any, share: Any) -> Any:
    """Squared length of ``a`` less a share of an edge."""
    return _square(tuple(a[i] - share * edge[i] for i in range(3)))
