"""Bent housings of a string in time: each tilts the end of the body above it, and turns with that body."""

import numpy as np
from numpy.typing import NDArray

from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.drillstring import String
from fctd.model.wellbore import Wellbore, hole_frame

Array = NDArray[np.float64]


def bent_joints(case: Case, string: String) -> dict[int, int]:
    """The joints above bent housings, with their components; the joint at the top drive has no bend."""
    parts = case.string.components[: len(string.sections)]
    joints = {int(np.argmax(string.component == k)) + 1: k for k, part in enumerate(parts) if part.bend}
    return {j: k for j, k in joints.items() if j > 1}


def put_bends(S: Array, case: Case, string: String, hole: Wellbore | None = None) -> None:
    """Write the bends of a string into a buffer.

    hole : in which the string lies, for the tool face from the high side; without it the tool face counts from the x
    axis of the body above, as for housings that are still to come.
    """
    joint_md = string.top_md + np.append(0.0, np.cumsum(string.length))
    for j, k in bent_joints(case, string).items():
        part = case.string.components[k]
        x, y = np.cos(part.toolface), np.sin(part.toolface)
        if hole is not None:
            (high,), (right,) = hole_frame(hole.at(joint_md[j - 1 : j])[1])
            x, y = _across(S, j - 1, x * high + y * right)
        tilt = np.sin(0.5 * part.bend) / np.hypot(x, y)
        S[state.KINK_X + j], S[state.KINK_Y + j] = -y * tilt, x * tilt


def _across(S: Array, j: int, towards: Array) -> tuple[float, float]:
    """The components of a global vector (3,) along x and y of body j."""
    w, x, y, z = (S[row + j] for row in (state.QW, state.QX, state.QY, state.QZ))
    across = np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    along = np.array([2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)])
    return float(across @ towards), float(along @ towards)
