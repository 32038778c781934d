"""What measures contact methods in the hole of a case: exact arcs, or the engine's own wall where it has none."""

import numpy as np

from fctd.arena.exact_hole import ExactHole
from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from fctd.model.frames import hole_frame
from fctd.model.wellbore import build_wellbore, find_contacts

EXACT = "exact circular arcs"
SAMPLED = "the engine's sampled wall of the caliper: a wall that is no circle has no exact arcs"


AVERAGE = "the engine's own cylinders: a survey by average angle has no arcs"


class OwnHole(ExactHole):
    """The engine's own wall of a case in the place of exact arcs."""

    def __init__(self, case: Case) -> None:
        self.hole = build_wellbore(case)
        self.md = np.array([self.hole.md[0], self.hole.total_depth])

    def at(self, md: Array) -> tuple[Array, Array]:
        """See ``ExactHole.at``."""
        return self.hole.at(md)

    def curvatures(self, md: Array) -> Array:
        """Curvatures (n,) [1/m] of the axis at measured depths (n,) [m], between points a metre apart."""
        before, after = (self.hole.at(np.clip(md + by, *self.md))[1] for by in (-0.5, 0.5))
        return np.asarray(np.linalg.norm(after - before, axis=1))

    def radii(self, md: Array) -> Array:
        """Radii of the hole (n,) [m]: the mean of the wall around the axis at measured depths (n,) or (n, k) [m]."""
        flat = np.clip(np.ravel(md), *self.md)
        high, right = hole_frame(self.hole.at(flat)[1])
        angles = np.linspace(0, 2 * np.pi, 16, endpoint=False)
        towards = np.cos(angles)[:, None] * high[:, None] + np.sin(angles)[:, None] * right[:, None]
        return np.asarray(self.hole.radii_towards(flat, towards).mean(axis=1)).reshape(np.shape(md))

    def wall(self, md: Array, angle: Array) -> Array:
        """See ``ExactHole.wall``."""
        high, right = hole_frame(self.hole.at(md)[1])
        towards = np.cos(angle)[:, None] * high + np.sin(angle)[:, None] * right
        return np.asarray(self.hole.radii_towards(md, towards[:, None])[:, 0])

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """The contacts that the engine has; in a sampled wall those of a disc that rolls around the section."""
        return find_contacts(self.hole, points, radii)


def hole_of(case: Case) -> tuple[ExactHole, str]:
    """What the errors of a case are measured by, and what it is."""
    if case.wellbore.geometry == "sampled":
        return OwnHole(case), SAMPLED
    if case.wellbore.survey_method == "average_angle":
        return OwnHole(case), AVERAGE
    return ExactHole(case.wellbore, case.solver.perturbed), EXACT
