"""Johancsik's soft string: a cable without bending stiffness or clearance, summed from the bit upwards.

Johancsik, Friesen & Dawson 1984, here with the side force of an element as the length of a vector: the
turn of the hole times tension, plus the weight across the hole.  In a plane build in slack-off the two
oppose each other and the wall force changes side; the length of the vector handles that.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd import survey
from fctd.case import Case
from fctd.drillstring import lay_out
from fctd.wellbore import build_wellbore

ELEMENT = 1.0  # [m]
PULL = {"trip_out": 1.0, "trip_in": -1.0, "rotate_off_bottom": 0.0}


class SoftString(NamedTuple):
    """Hook load [N], surface torque [N m] and summed side force [N]."""

    hookload: float
    surface_torque: float
    total_contact_force: float


def soft_string(case: Case, operation: str, bit_depth: float) -> SoftString:
    """Steady sliding or rotating string off bottom; ``operation`` is a key of PULL.

    Rotating, law ``coulomb`` climbs the wall until weight balances normal force and friction together, so
    the torque follows μ/√(1 + μ²); law ``paper`` has no such side force.
    """
    hole = build_wellbore(case)
    string = lay_out(case, bit_depth)
    joints = string.top_md + np.concatenate([[0.0], np.cumsum(string.length)])
    count = int(np.ceil((bit_depth - string.top_md) / ELEMENT))
    md = np.linspace(string.top_md, bit_depth, count + 1)
    middle = 0.5 * (md[1:] + md[:-1])
    segment = np.clip(np.searchsorted(joints, middle) - 1, 0, string.segments - 1)
    tangents = _tangents(case, md)
    friction = hole.walls(hole.at(middle)[0])[:, 5]
    weight, radius = string.of("weight")[segment], string.of("contact_radius")[segment]
    length = md[1] - md[0]
    pull = PULL[operation]
    down = np.array([0.0, 0.0, 1.0])

    tension = torque = contact = 0.0
    for k in range(count - 1, -1, -1):
        mean = 0.5 * (tangents[k] + tangents[k + 1])
        turn = tangents[k + 1] - tangents[k]
        across = weight[k] * length * (down - mean[2] * mean)
        along = weight[k] * length * mean[2]
        half = tension + 0.5 * along
        for _ in range(3):  # the side force depends on the tension in the middle of the element
            side = float(np.linalg.norm(half * turn + across))
            half = tension + 0.5 * (along + pull * friction[k] * side)
        if pull == 0 and case.contact.friction_law == "coulomb":
            side /= float(np.sqrt(1 + friction[k] ** 2))
        tension += along + pull * friction[k] * side
        torque += (pull == 0) * friction[k] * radius[k] * side
        contact += side
    return SoftString(tension, torque, contact)


def _tangents(case: Case, md: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions of the hole itself, not of the cylinders that stand for it, at measured depths (n,) [m]."""
    stations = survey.to_radians(case.wellbore.read_stations())
    if case.wellbore.survey_method == "minimum_curvature":
        return survey.along_courses(survey.minimum_curvature(stations), md)[1]
    return survey.tangents(survey.interpolate_angles(stations, md))
