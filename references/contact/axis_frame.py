"""The contact of most codes for lateral vibration: nodes at fixed measured depths, and no search.

A node keeps the section of the hole in which it was first found; its contact is the offset from the axis in the plane
of that section against the clearance.  A string that slides along the hole leaves its sections: the error grows with
the square of the way in a bend, until the node is found anew.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case import units
from fctd.case.errors import Table
from fctd.case.load import Case
from fctd.model.wellbore import build_wellbore


class AxisFrameOptions(Table):
    """drift : largest way [m] of a node along the hole from its section, before it is found anew."""

    drift: units.PositiveLength = 1.0


class AxisFrame:
    """Offset from the axis at a fixed measured depth; a section is found by the exact closest point on the axis."""

    name = "axis_frame"
    distribution: ClassVar[str] = "fctd"
    does: ClassVar[str] = "offset from the axis in the section of a fixed measured depth, no search"
    gives_clearance = True
    Options: ClassVar[type[Table]] = AxisFrameOptions
    settings: ClassVar[Settings] = ({"drift": 2.0}, {"drift": 1.0}, {"drift": 0.25})

    def __init__(self, case: Case, options: AxisFrameOptions) -> None:
        self.options, self.hole = options, build_wellbore(case)
        self._md = np.empty(0)

    def query(self, points: Array, radii: Array) -> Contacts:
        """See ``ContactMethod.query``."""
        if len(self._md) != len(points):
            self._md, self._centre, self._tangent = np.empty(len(points)), np.empty_like(points), np.empty_like(points)
            self._find(points, np.arange(len(points)))
        along = self._along(points)
        lost = np.flatnonzero(np.abs(along) > self.options.drift)
        if len(lost):
            self._find(points, lost)
            along = self._along(points)
        offset = points - self._centre - along[:, None] * self._tangent
        distance = np.linalg.norm(offset, axis=1)
        normal = offset / np.maximum(distance, 1e-300)[:, None]
        radius = self.hole.radii_towards(self._md, normal[:, None])[:, 0]
        return Contacts(distance - radius + radii, normal, self._md.copy())

    def _find(self, points: Array, which: NDArray[np.int64]) -> None:
        """Tie points, by their numbers, to the sections of the hole in which they lie now."""
        md = self.hole.walls(points[which]).md
        self._md[which] = md
        inside = np.clip(md, self.hole.md[0], self.hole.md[-1])
        centre, self._tangent[which] = self.hole.at(inside)
        # Beyond its ends the hole goes on straight: a string that stretches past them has its sections there.
        self._centre[which] = centre + (md - inside)[:, None] * self._tangent[which]

    def _along(self, points: Array) -> Array:
        """Way along the hole (n,) [m] of each point from its section."""
        return np.asarray(np.sum((points - self._centre) * self._tangent, axis=1))

    @property
    def pieces(self) -> int:
        """Number of cylinders or arcs of the hole, which find the sections."""
        return len(self.hole.pieces)

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Distance of an arc from its tangent after the way ``drift``, and the angle between the two."""
        return 0.5 * curvature * self.options.drift**2, curvature * self.options.drift
