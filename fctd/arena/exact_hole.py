"""A round hole of circular arcs, and the exact contacts in it: every arc is tried for every point, without a search.

It shares the arcs between stations with the engine, and neither its pieces nor its search.
"""

import numpy as np

from fctd.arrays import Array, Contacts
from fctd.case.errors import InputError
from fctd.case.hole import WellboreSpec
from fctd.model.frames import hole_frame
from fctd.model.perturbed import perturb_stations
from fctd.model.survey import Courses, along_courses, minimum_curvature
from fctd.model.tortuosity import winding

# A hole goes on straight beyond both ends for this length [m].
BEYOND = 1000.0
# An arc that turns by less than this [rad] is straight: it leaves its chord by less than a nanometre in a kilometre.
STRAIGHT = 1e-11
POINTS = 500  # that are tried together, so that memory stays small


class ExactHole:
    """The hole of a case as arcs.

    md (2,) : measured depths of its ends [m].  perturbed : the seed of the noise that the engine's hole has
    (``solver.perturbed``).  Raises InputError where sections are no circles (a caliper).
    """

    def __init__(self, spec: WellboreSpec, perturbed: int | None = None) -> None:
        if spec.geometry == "sampled":
            raise InputError("arcs or cylinders: a sampled wall has no exact contacts", key="wellbore.geometry",
                             value=spec.geometry)  # fmt: skip
        stations = perturb_stations(spec.trajectory, perturbed)
        if spec.tortuosity is not None:
            stations = winding(stations, spec.tortuosity)
        self.md = stations[[0, -1], 0]
        self.courses = minimum_curvature(stations)
        self._tried = _with_ends(self.courses)
        self._sizes = _sizes(spec)

    @property
    def curvature(self) -> float:
        """Curvature of the sharpest arc [1/m]."""
        return float(self.courses.curvature.max())

    def at(self, md: Array) -> tuple[Array, Array]:
        """Positions (n, 3) [m] and unit tangents (n, 3) of the axis at measured depths (n,) [m]."""
        return along_courses(self.courses, md)

    def curvatures(self, md: Array) -> Array:
        """Curvatures (n,) [1/m] at measured depths (n,) [m]; 0 beyond the ends."""
        inside = (md >= self.md[0]) & (md <= self.md[1])
        arc = np.clip(np.searchsorted(self.courses.md, md, side="right") - 1, 0, None)
        return np.where(inside, self.courses.curvature[arc], 0.0)

    def radii(self, md: Array) -> Array:
        """Radii of the hole (n,) [m] at measured depths (n,) [m]."""
        return np.asarray(np.interp(md, *self._sizes))

    def wall(self, md: Array, angle: Array) -> Array:
        """Distances of the wall from the axis (n,) [m], at angles (n,) [rad] from the high side clockwise."""
        return self.radii(md)

    def off_axis(self, md: Array, angle: Array, distance: Array) -> Array:
        """Points (n, 3) [m] beside the axis; angle (n,) [rad] from the high side clockwise, distance (n,) [m]."""
        axis, tangent = self.at(md)
        high, right = hole_frame(tangent)
        return axis + distance[:, None] * (np.cos(angle)[:, None] * high + np.sin(angle)[:, None] * right)

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """Exact contacts of points (n, 3) [m] with contact radii (n,) [m]."""
        parts = [self._feet(points[k : k + POINTS]) for k in range(0, max(len(points), 1), POINTS)]
        md, feet = (np.concatenate(each) for each in zip(*parts, strict=True))
        offset = points - feet
        distance = np.linalg.norm(offset, axis=1)
        normal = offset / np.maximum(distance, 1e-300)[:, None]
        return Contacts(distance - self.radii(md) + radii, normal, md)

    def _feet(self, points: Array) -> tuple[Array, Array]:
        """Measured depths (n,) [m] and places (n, 3) [m] of the nearest points of the axis."""
        arcs = self._tried
        away = points[:, None] - arcs.start
        forward, aside = np.sum(away * arcs.tangent, axis=2), np.sum(away * arcs.normal, axis=2)
        turn = arcs.curvature * arcs.length
        bent = turn > STRAIGHT
        k = np.where(bent, arcs.curvature, 1.0)
        # From the middle of the arc, so that a point behind the centre takes the end that is nearer to it.
        angle = np.arctan2(k * forward, 1 - k * aside) - 0.5 * turn
        angle = np.clip((angle + np.pi) % (2 * np.pi) - np.pi, -0.5 * turn, 0.5 * turn) + 0.5 * turn
        along = np.where(bent, angle / k, np.clip(forward, 0.0, arcs.length))
        # Distances in the plane of each arc; what a point lies beside the plane is the same for all of its arc.
        to_x, to_y = np.where(bent, np.sin(angle) / k, along), np.where(bent, (1 - np.cos(angle)) / k, 0.0)
        beside = np.sum(away * away, axis=2) - forward**2 - aside**2
        nearest = np.argmin((forward - to_x) ** 2 + (aside - to_y) ** 2 + beside, axis=1)
        each = np.arange(len(points))
        s, x, y = (part[each, nearest] for part in (along, to_x, to_y))
        places = arcs.start[nearest] + x[:, None] * arcs.tangent[nearest] + y[:, None] * arcs.normal[nearest]
        return arcs.md[nearest] + s, places


def _with_ends(courses: Courses) -> Courses:
    """The arcs with a straight one before the first and after the last."""
    end = courses.md[-1:] + courses.length[-1:]
    bottom, down = along_courses(courses, end)
    top, up = courses.start[:1], courses.tangent[:1]
    straight, long = np.zeros(1), np.full(1, BEYOND)
    first = Courses(courses.md[:1] - BEYOND, top - BEYOND * up, up, courses.normal[:1], straight, long)
    last = Courses(end, bottom, down, courses.normal[-1:], straight, long)
    return Courses(*(np.concatenate(each) for each in zip(first, courses, last, strict=True)))


def _sizes(spec: WellboreSpec) -> tuple[Array, Array]:
    """Measured depths and radii of the hole [m], linear in between: a shoe leads from one size to the next."""
    ends = np.array([interval.to_md for interval in spec.intervals])
    radii = np.array([0.5 * interval.diameter for interval in spec.intervals])
    shoes = np.minimum(ends[:-1] + spec.overlap, ends[1:])
    md = np.stack([ends[:-1], shoes], axis=1).ravel()
    sizes = np.stack([radii[:-1], radii[1:]], axis=1).ravel()
    return (md, sizes) if len(md) else (ends, radii)
