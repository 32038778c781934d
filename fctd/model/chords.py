"""The cylinders of a hole in its bends: their lengths, and their distance from the axis.

A cylinder of length ℓ in a bend of curvature κ misses the axis by κ ℓ²/8 in its middle.  A refinement makes this small
before it cuts the string.
"""

import numpy as np

from fctd.arrays import Array, ceiling
from fctd.case.hole import WellboreSpec
from fctd.case.load import Case
from fctd.model import survey

# Longest cylinder in straight hole [m]; neighbours in the table should stay neighbours in space.
LONGEST_CYLINDER = 30.0


def longest_cylinders(hole: WellboreSpec, curvature: Array) -> Array:
    """The largest length [m] that the case allows cylinders in bends of curvatures (n,) [1/m]."""
    if hole.chord_tolerance is None:
        return np.full(len(curvature), hole.cylinder_length)
    return np.minimum(np.sqrt(8 * hole.chord_tolerance / np.maximum(curvature, 1e-12)), LONGEST_CYLINDER)


def missed_by_cylinders(case: Case, md: Array) -> tuple[Array, Array]:
    """Distances [m] between axis and cylinders in their middles, and their lengths (n,) [m], at depths (n,) [m]."""
    stations = case.wellbore.trajectory
    long = np.diff(stations[:, 0])
    curvature = survey.dogleg(stations) / long
    length = long / np.maximum(ceiling(long / longest_cylinders(case.wellbore, curvature)), 1)
    course = np.clip(np.searchsorted(stations[:, 0], md, side="right") - 1, 0, len(long) - 1)
    return (curvature * length**2 / 8)[course], length[course]


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
