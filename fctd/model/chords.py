"""The distance of a hole's cylinders from its axis, which a refinement makes small before it cuts the string.

A cylinder of length ℓ in a bend of curvature κ misses the axis by κ ℓ²/8 in its middle.
"""

import numpy as np

from fctd.case.load import Case
from fctd.model import survey


def largest_chord(case: Case) -> float:
    """Largest distance between a cylinder and the hole's axis [m]; 0 in one of arcs."""
    hole = case.wellbore
    if hole.geometry != "cylinders":
        return 0.0
    if hole.cylinder_length is None:
        assert hole.chord_tolerance is not None  # a case has one of the two
        return hole.chord_tolerance
    return _sharpest(case) * hole.cylinder_length**2 / 8


def shorter_cylinders(case: Case) -> Case:
    """The case with cylinders half as long in its bends; they stay longer than their overlap."""
    hole = case.wellbore
    if hole.cylinder_length is None:
        assert hole.chord_tolerance is not None
        chord = hole.chord_tolerance / 4
        update = {"chord_tolerance": chord}
        length = np.sqrt(8 * chord / max(_sharpest(case), 1e-12))
    else:
        length = hole.cylinder_length / 2
        update = {"cylinder_length": length}
    update["overlap"] = min(hole.overlap, 0.5 * length)
    return case.model_copy(update={"wellbore": hole.model_copy(update=update)})


def _sharpest(case: Case) -> float:
    """The largest curvature of the hole [1/m]."""
    stations = case.wellbore.trajectory
    return float((survey.dogleg(stations) / np.diff(stations[:, 0])).max())
