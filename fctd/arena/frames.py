"""Points near the wall of holes, with their exact contacts: what every contact method is measured by."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from fctd.arena.exact_hole import ExactHole
from fctd.arrays import Array, Contacts
from fctd.case.load import Case

RADIUS = 0.051  # contact radius of the string [m]
BAND = 0.015  # points lie within this distance of touching [m]
SEED = 20261128


@dataclass(frozen=True)
class Frame:
    """A hole and points near its wall.

    md (n,) [m] : where they lie.  places (n, 3) [m], radii (n,) [m].
    """

    hole: ExactHole
    md: Array
    places: Array
    radii: Array

    @cached_property
    def exact(self) -> Contacts:
        """The contacts of the points."""
        return self.hole.contacts(self.places, self.radii)

    def part(self, of: Any) -> "Frame":
        """Some of the points: a mask, or numbers in any order."""
        return Frame(self.hole, self.md[of], self.places[of], self.radii[of])


def frame(
    hole: ExactHole, count: int, *, seed: int = SEED, radius: float = RADIUS, md: tuple[float, float] | None = None
) -> Frame:
    """Points in random order within BAND of touching: in the order of depth a tree finds its way too easily.

    md : between which they lie [m]; all of the hole by default.
    """
    rng = np.random.default_rng(seed)
    top, bottom = md or (hole.md[0] + 5.0, hole.md[1] - 5.0)
    return beside(hole, rng.uniform(top, bottom, count), rng, radius)


def beside(hole: ExactHole, md: Array, rng: np.random.Generator, radius: float = RADIUS) -> Frame:
    """Points at measured depths (n,) [m], at any angle, within BAND of touching."""
    count = len(md)
    angle = rng.uniform(0, 2 * np.pi, count)
    distance = hole.wall(md, angle) - radius + rng.uniform(-BAND, BAND, count)
    return Frame(hole, md, hole.off_axis(md, angle, distance), np.full(count, radius))


def case_of(name: str, stations: list[list[float]], intervals: list[tuple[float, float]], **hole: Any) -> Case:
    """A case with a hole of arcs and a pipe in it.

    stations : measured depth [m], inclination and azimuth [deg].  intervals : end [m] and diameter [m] of each.
    hole : further keys of it.
    """
    sizes = [{"to_md": end, "diameter": diameter, "friction": 0.2, "kind": "open"} for end, diameter in intervals]
    pipe = {"name": "pipe", "outer_diameter": 2 * RADIUS, "inner_diameter": 0.06, "segment_length": 10.0}
    wellbore = {"stations": stations, "geometry": "arcs", "intervals": sizes} | hole
    return Case.model_validate({"name": name, "wellbore": wellbore, "string": {"components": [pipe]}})
