"""Bent housings: each tilts the end of the body above it towards its tool face, and turns with that body."""

from itertools import pairwise

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.case.string import ComponentSpec
from fctd.mechanics import state
from fctd.model.drillstring import String
from fctd.model.frames import hole_frame
from fctd.model.wellbore import Wellbore


def bent_joints(string: String) -> dict[int, ComponentSpec]:
    """The joints above bent housings, with their components; the joint at the top drive has no bend."""
    joints = {}
    for k, (part, above) in enumerate(pairwise(string.parts)):
        if part.component.bend and above.origin != part.origin:
            joints[int(np.argmax(string.component == k)) + 1] = part.component
    return joints


def kink_of(part: ComponentSpec, above: Array, direction: Array) -> tuple[float, float]:
    """The components along x and y of the half turn of a bend, as in a quaternion.

    above : orientation of the body above (4,), from which the bend counts; direction : of the hole there (3,), from
    whose high side the tool face counts.
    """
    (high,), (right,) = hole_frame(direction[None])
    towards = np.cos(part.toolface) * high + np.sin(part.toolface) * right
    w, x, y, z = above
    along_x = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    along_y = np.array([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)])
    return _half_turn(part.bend, along_x @ towards, along_y @ towards)


def _half_turn(bend: float, x: float, y: float) -> tuple[float, float]:
    tilt = np.sin(0.5 * bend) / np.hypot(x, y)
    return float(-y * tilt), float(x * tilt)


def put_bends(S: Array, case: Case, string: String, hole: Wellbore | None = None) -> None:
    """Write the bends of a string into a buffer.

    hole : in which the string lies; without it the tool face counts from the x axis of the body above, as for housings
    that are still to come.
    """
    joint_md = string.top_md + np.append(0.0, np.cumsum(string.length))
    for j, part in bent_joints(string).items():
        if hole is None:
            kink = _half_turn(part.bend, np.cos(part.toolface), np.sin(part.toolface))
        else:
            above = S[[row + j - 1 for row in (state.QW, state.QX, state.QY, state.QZ)]]
            kink = kink_of(part, above, hole.at(joint_md[j - 1 : j])[1][0])
        S[state.KINK_X + j], S[state.KINK_Y + j] = kink
