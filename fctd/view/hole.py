"""The hole as a view draws it: rings and lines as wide as the exaggerated clearance, and casing shoes.

A string of centimetres of clearance in a hole of kilometres cannot be seen to scale.  Offsets of the string from the
axis are drawn ``exaggeration`` times as large, and the hole with that many times the clearance for its radius: the
string is drawn on the wall exactly where it lies on the wall.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model.frames import carried_frame
from fctd.model.wellbore import Wellbore

RINGS: Final = 64  # along the hole
BETWEEN: Final = 4  # stations of the lines for each ring
AROUND: Final = np.radians(np.arange(0.0, 361.0, 20.0))  # corners of a ring
SIDES: Final = np.radians(np.arange(0.0, 360.0, 60.0))  # of the lines
AXIS_STEP: Final = 2.0  # of the axis from which a page interpolates [m]
SHARE: Final = 0.02  # drawn radius of the hole over the largest extent of the well


@dataclass(frozen=True)
class Stations:
    """Places along the hole: md (k,) [m], centre (k, 3) [m], and two directions across the hole, each (k, 3).

    The directions are carried along the hole without a turn about it, so that lines between stations do not twist.
    """

    md: Array
    centre: Array
    first: Array
    second: Array

    def picked(self, index: NDArray[np.int64]) -> "Stations":
        """Some of the stations."""
        return Stations(self.md[index], self.centre[index], self.first[index], self.second[index])


@dataclass(frozen=True)
class DrawnHole:
    """A hole from md ``top`` to its end: lines through all stations, rings at some of them, casing shoes [m]."""

    hole: Wellbore
    lines: Stations
    rings: Stations
    shoes: Stations

    @property
    def size(self) -> float:
        """Largest extent of the axis [m]."""
        return float(np.ptp(self.lines.centre, axis=0).max())


def drawn_hole(case: Case, hole: Wellbore, top: float) -> DrawnHole:
    """The hole of a case below a measured depth [m]."""
    shoes = np.array([shoe for shoe in case.shoes if top < shoe < hole.total_depth])
    even = np.linspace(top, hole.total_depth, RINGS * BETWEEN + 1)
    md = np.union1d(even, shoes)
    centre, tangent = hole.at(md)
    every = Stations(md, centre, *carried_frame(tangent))
    rings = np.searchsorted(md, even[::BETWEEN])
    return DrawnHole(hole, every, every.picked(rings), every.picked(np.searchsorted(md, shoes)))


def exaggeration_of(size: float, clearance: float) -> float:
    """A round number of times that makes a hole of a clearance [m] visible in a well of a size [m]."""
    if not clearance > 0:
        return 1.0
    wanted = max(SHARE * size / clearance, 1.0)
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(step for step in (1.0, 2.0, 5.0) if step * power <= wanted))


def clearance_at(md: Array, of: Array, clearance: Array) -> Array:
    """Clearance [m] at depths md [m], of a string with clearance (n,) at its contact points of (n,) [m].

    Below the bit it is that of the bit, above the top that of the top; where a component is wider than the hole, 0.
    """
    if not len(of):
        return np.zeros_like(md)
    return np.maximum(np.interp(md, of, clearance), 0.0)


def wall_lines(stations: Stations, radius: Array) -> Array:
    """Lines along the wall, (m, 3) [m], with a row of NaN after each; radius (k,) [m] : drawn at each station."""
    lines = [_beside(stations, radius, np.full(len(radius), side)) for side in SIDES]
    return _joined(lines)


def rings(stations: Stations, radius: Array) -> Array:
    """Rings around the hole, (m, 3) [m], with a row of NaN after each; radius (k,) [m] : drawn at each station."""
    shape = len(AROUND)
    return _joined([
        _beside(stations.picked(np.full(shape, k)), np.full(shape, one), AROUND) for k, one in enumerate(radius)
    ])  # fmt: skip


def _beside(stations: Stations, radius: Array, angle: Array) -> Array:
    across = np.cos(angle)[:, None] * stations.first + np.sin(angle)[:, None] * stations.second
    return stations.centre + radius[:, None] * across


def _joined(parts: list[Array]) -> Array:
    gap = np.full((1, 3), np.nan)
    return np.concatenate([piece for part in parts for piece in (part, gap)]) if parts else np.empty((0, 3))
