"""The hole for the tests of all contact methods, and points near its wall."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.case.load import Case
from fctd.model.wellbore import build_wellbore

from ..cases import make_case, pipe

RADIUS = 0.05  # contact radius [m]
HOLE = 0.10795  # hole radius of make_case [m]
# Vertical, a build of 12°/30 m in a plane, and a turn of 8°/30 m at constant inclination (a course in space).
STATIONS = [[0, 0, 0], [60, 0, 0], [90, 12, 0], [120, 24, 0], [150, 24, 20], [180, 24, 40], [240, 24, 40]]
REGIONS = {"straight": (5.0, 55.0), "build": (62.0, 118.0), "turn": (122.0, 178.0)}


def bent_case(**wellbore: Any) -> Case:
    """The case of the hole above, with exact arcs by default; ``wellbore`` overrides its keys."""
    return make_case(STATIONS, [pipe(200, 20)], wellbore={"geometry": "arcs", "cylinder_length": 2.0} | wellbore)


def points_near_wall(region: str, count: int, seed: int = 7) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points (n, 3) [m] within 15 mm of touching, from exact arcs, and their distance from the axis (n,) [m]."""
    rng = np.random.default_rng(seed)
    md, angle = rng.uniform(*REGIONS[region], count), rng.uniform(0, 2 * np.pi, count)
    offset = HOLE - RADIUS + rng.uniform(-0.015, 0.015, count)
    return build_wellbore(bent_case()).off_axis(md, angle, offset), offset
