"""Checks that end a run: a state that is not finite, or that the model cannot describe."""

import math
from typing import NamedTuple

import numpy as np

from fctd.mechanics.jit import entry
from fctd.mechanics.state import HOLE, RADIUS, STILL, VX, WZ, axis, position, quaternion, radial


class Worst(NamedTuple):
    """The joints that bend and twist most: bend and twist between two segments [rad], and the lower one of each."""

    bend: float
    twist: float
    joint: tuple[int, int]


class UnstableError(Exception):
    """The state is not finite or outside the model's range; the text says why."""


@entry
def worst_of(S, n):
    """Whether all values are finite, and the worst of three measures of bodies 1..n, each with its body.

    Distance beyond twice the hole radius, less the contact radius [m], above 0 outside; cosine of the bend and
    of half the twist against the body above, below 0 past a right angle.
    """
    finite = True
    outside, bend, twist = (-math.inf, 0), (math.inf, 0), (math.inf, 0)
    for j in range(1, n + 1):
        x, y, z = position(S, j)
        finite = finite and math.isfinite(x + y + z + S[VX + j] + S[WZ + j])
        px, py, pz = radial(S, j)
        deep = math.sqrt(px * px + py * py + pz * pz) - 2 * S[HOLE + j] + S[RADIUS + j]
        if S[HOLE + j] > 0 and deep > outside[0]:
            outside = (deep, j)
        if j == 1:
            continue
        ax, ay, az = axis(S, j - 1)
        bx, by, bz = axis(S, j)
        cosine = ax * bx + ay * by + az * bz
        if cosine < bend[0]:
            bend = (cosine, j)
        aw, ax, ay, az = quaternion(S, j - 1)
        bw, bx, by, bz = quaternion(S, j)
        half = aw * bw + ax * bx + ay * by + az * bz
        if half < twist[0] and S[STILL + j] == S[STILL + j - 1]:  # a swivel turns freely
            twist = (half, j)
    return finite, outside, bend, twist


def check(S: np.ndarray, n: int) -> Worst:
    """Raise UnstableError when the state is not finite, or the string has left the hole or bends or twists too far.

    Axes and walls must belong to the positions.  Returns the joints that bend and twist most.
    """
    finite, outside, bend, twist = worst_of(S, n)
    if not finite:
        raise UnstableError("a position or velocity is not finite")
    if outside[0] > 0:
        raise UnstableError(f"segment {outside[1]} has left the hole")
    if bend[0] < 0:
        raise UnstableError(f"the string has folded at segment {bend[1]}")
    if twist[0] < 0:
        text = f"segment {twist[1]} is twisted by more than half a turn against the one above"
        raise UnstableError(f"{text}: use shorter segments")
    angles = (math.acos(min(bend[0], 1.0)), 2 * math.acos(min(twist[0], 1.0)))
    return Worst(*angles, (bend[1], twist[1]))
