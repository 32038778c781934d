"""The groove that tool joints wear into casing: its area, its depth, and the pressure that the rest of the wall bears.

The volume that is worn off a metre of casing is the wear factor times side force and sliding distance, V = WF·F·s
(White and Dawson 1987).  The groove is the crescent between the casing's bore and a tool joint that lies deeper in the
wall by the depth of the groove.
"""

import math
from typing import Final

from scipy.optimize import brentq

from fctd.model.capacity import PSI

WEAR_UNIT: Final = 1e-10 / PSI  # [1/Pa]: wear factors are given in 1e-10 1/psi
SMALL: Final = 0.1  # [rad], below which a segment's area is its series


def groove_area(depth: float, joint_radius: float, bore_radius: float) -> float:
    """Area of a groove [m²] by its depth, the radius of the tool joint and that of the casing's bore [m].

    What the circle of the tool joint has beyond that of the bore, both cut by the chord through their crossings.
    """
    if depth <= 0:
        return 0.0
    apart = bore_radius - joint_radius + depth
    # 1 - cos of the angles from the deepest point to a crossing, at the centre of each circle.
    of_joint = depth * (2 * bore_radius + depth) / (2 * joint_radius * apart)
    of_bore = depth * (2 * joint_radius - depth) / (2 * bore_radius * apart)
    return joint_radius**2 * _segment(of_joint) - bore_radius**2 * _segment(of_bore)


def groove_depth(area: float, joint_radius: float, bore_radius: float, wall: float) -> float:
    """Depth of a groove [m] by its area [m²] and the radii of tool joint and bore [m]; the wall [m] at most."""
    if area <= 0:
        return 0.0
    if area >= groove_area(wall, joint_radius, bore_radius):
        return wall
    found = brentq(lambda h: groove_area(h, joint_radius, bore_radius) - area, 0.0, wall, xtol=1e-18, maxiter=500)
    return float(found)


def _segment(short: float) -> float:
    """Area of a segment of the unit circle by 1 - cos of half its angle."""
    angle = 4 * math.asin(math.sqrt(min(0.5 * short, 1.0)))
    if angle < SMALL:
        square = angle * angle
        return angle**3 / 12 * (1 - square / 20 * (1 - square / 42 * (1 - square / 72)))
    return 0.5 * (angle - math.sin(angle))
