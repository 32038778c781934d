"""What single precision costs in a well: false force of the wall, and steps too short for a body to fall."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from fctd import Case, build_wellbore
from fctd.arrays import Array
from fctd.mechanics import contact
from fctd.mechanics.contact import START
from fctd.mechanics.topdrive import GRAVITY
from references.contact.tube_mesh import Tube, TubeOptions, build_tube
from references.registry import import_optional
from references.timing.operation_count import interpreted
from validation.cases import load

# Vertical, a build and a turn of 286 m radius, and straight hole: that of contact_accuracy.
STATIONS = [[0, 0, 0], [200, 0, 0], [500, 60, 0], [740, 60, 55], [900, 60, 55]]
HOLE, RADIUS, BAND = 0.1556, 0.051, 0.015  # of hole and pipe; points lie so far from touching, at most [m]
CHUNK = 50.0  # [m] of hole with an origin of its own
SEED = 20241128
Integrator = Callable[[float, float, float, type[np.floating[Any]]], float]


def hole_case(geometry: str) -> Case:
    """The hole in cylinders or arcs."""
    size = [{"to_md": STATIONS[-1][0], "diameter": 2 * HOLE, "friction": 0.2}]
    return load(
        "curved_chain", wellbore__stations=STATIONS, wellbore__intervals=size, wellbore__geometry=geometry,
        string__top_md=0.0, operations=None,
    )  # fmt: skip


def single(places: Array, origins: Array) -> Array:
    """Places (n, 3) [m] as single precision keeps them, measured from their origins (n, 3) or (3,)."""
    return np.asarray(origins + (places - origins).astype(np.float32))


class Points(NamedTuple):
    """Points near the wall: places (n, 3) [m], and the origins (n, 3) of their chunks of hole."""

    places: Array
    origins: Array


def points_near_the_wall(count: int) -> Points:
    """Seeded points in all of the hole."""
    hole, rng = build_wellbore(hole_case("arcs")), np.random.default_rng(SEED)
    md = rng.uniform(10, STATIONS[-1][0] - 10, count)
    offset = HOLE - RADIUS + rng.uniform(-BAND, BAND, count)
    return Points(hole.off_axis(md, rng.uniform(0, 2 * np.pi, count), offset), _chunks(md))


def _chunks(md: Array) -> Array:
    """Origins (n, 3) of the chunks at measured depths (n,): the middle of each on the axis of the hole [m]."""
    middles = (np.floor(md / CHUNK) + 0.5) * CHUNK
    return build_wellbore(hole_case("arcs")).at(np.clip(middles, 0, STATIONS[-1][0]))[0]


class Mesh:
    """A tube of triangles: vertices and points are rounded, the query itself is in double precision."""

    name = "mesh, its numbers rounded"

    def __init__(self) -> None:
        self._trimesh = import_optional("trimesh.proximity", "trimesh", self.name, "study")
        self._tube = build_tube(hole_case("arcs"), TubeOptions())
        self._vertices = np.asarray(self._tube.mesh.vertices)
        self._origins = np.repeat(_chunks(self._tube.md), self._tube.facets, axis=0)

    def exact(self, points: Points) -> Array:
        """Penetrations (n,) [m] in double precision."""
        return self._ask(self._tube, points.places)

    def at(self, points: Points, depth: float) -> Array:
        """Penetrations (n,) [m] of hole and points that lie ``depth`` [m] deeper."""
        down = np.array([0, 0, depth])
        return self._of(single(self._vertices + down, np.zeros(3)), single(points.places + down, np.zeros(3)))

    def in_chunks(self, points: Points) -> Array:
        """The same, at any depth, where every chunk of hole has an origin of its own."""
        return self._of(single(self._vertices, self._origins), single(points.places, points.origins))

    def _of(self, vertices: Array, places: Array) -> Array:
        mesh = type(self._tube.mesh)(vertices, self._tube.mesh.faces, process=False, validate=False)
        return self._ask(replace(self._tube, mesh=mesh), places)

    def _ask(self, tube: Tube, places: Array) -> Array:
        near, _, faces = self._trimesh.closest_point(tube.mesh, places)
        return tube.contacts(places, np.full(len(places), RADIUS), np.asarray(near), np.asarray(faces)).penetration


class Pieces:
    """FCTD's own cylinders or arcs: its functions, run as plain Python on numbers in single precision."""

    def __init__(self, geometry: str) -> None:
        self.name = f"FCTD's {geometry}"
        self._hole = build_wellbore(hole_case(geometry))
        self._wall = interpreted(contact.arc_wall if geometry == "arcs" else contact.cylinder_wall)

    def exact(self, points: Points) -> Array:
        """See ``Mesh.exact``."""
        return self._ask(np.zeros((len(points.places), 3)), points, np.float64)

    def at(self, points: Points, depth: float) -> Array:
        """See ``Mesh.at``."""
        return self._ask(np.tile([0.0, 0.0, depth], (len(points.places), 1)), points, np.float32)

    def in_chunks(self, points: Points) -> Array:
        """See ``Mesh.in_chunks``."""
        return self._ask(-points.origins, points, np.float32)

    def _ask(self, moved: Array, points: Points, kind: type[np.floating[Any]]) -> Array:
        """Penetrations of hole and points, both moved by (n, 3) [m] before they are rounded."""
        found = []
        for i, place, by in zip(self._hole.owners(points.places), points.places, moved, strict=True):
            # The overlap of cylinders reads the next piece too.
            near = self._hole.pieces[i : i + 2].copy()
            near[:, START : START + 3] += by
            px, py, pz, hole, *_ = self._wall(near.astype(kind), 0, *(place + by).astype(kind))
            found.append(float(np.sqrt(px * px + py * py + pz * pz) - hole + kind(RADIUS)))
        return np.array(found)


def by_positions(height: float, step: float, seconds: float, kind: type[np.floating[Any]]) -> float:
    """Fall [m] of a body in free space at a height [m], by an integrator that keeps places alone.

    Position-based dynamics (Müller et al. 2007) and descent on vertices (VBD, Chen et al. 2024): the velocity of the
    next step is the difference of two places over the step.
    """
    z, v, h, g = kind(height), kind(0), kind(step), kind(GRAVITY)
    for _ in range(round(seconds / step)):
        before = z
        z = z + h * v - h * h * g
        v = (z - before) / h
    return height - float(z)


def by_velocities(height: float, step: float, seconds: float, kind: type[np.floating[Any]]) -> float:
    """The same by symplectic Euler, which keeps the velocity as a number of its own."""
    z, v, h, g = kind(height), kind(0), kind(step), kind(GRAVITY)
    for _ in range(round(seconds / step)):
        v = v - h * g
        z = z + h * v
    return height - float(z)


def spacing(height: float) -> float:
    """Distance of a height [m] to the next smaller number in single precision [m]."""
    place = np.float32(height)
    return float(place - np.nextafter(place, np.float32(0)))


def frozen_by_positions(height: float) -> float:
    """Step [s] below which a body at rest does not fall where places alone are kept: g h² is half a spacing."""
    return float(np.sqrt(spacing(height) / (2 * GRAVITY)))


def exact_by_positions(height: float, error: float) -> float:
    """Step [s] from which its fall is right to a relative error: g h² is rounded by half a spacing at most."""
    return float(np.sqrt(spacing(height) / (2 * error * GRAVITY)))


def frozen_by_velocities(height: float, seconds: float) -> float:
    """Step [s] below which a body has not moved after some seconds where velocities are kept: h g t is half a
    spacing."""
    return spacing(height) / (2 * GRAVITY * seconds)


def rounding_error(fall: Integrator, height: float, step: float, seconds: float) -> float:
    """Relative error of a fall in single precision, against the same integrator and step in double precision."""
    return abs(fall(height, step, seconds, np.float32) / fall(height, step, seconds, np.float64) - 1)
