"""Bullet's collision detection through pybullet: closest points of a sphere and a concave mesh, no dynamics.

Traps: a client that stays connected is never freed; a mesh has at most 174 762 triangles; a result does not say
which triangle was hit.
"""

import weakref
from typing import Any, ClassVar

import numpy as np

from fctd.arrays import Array, Contacts
from fctd.case.errors import InputError, Table
from fctd.case.load import Case
from references.contact import need
from references.contact.tube_mesh import MeshMethod, Tube, TubeOptions, build_tube

# The bindings accept at most this many indices in one shape.
MOST_TRIANGLES = 524_288 // 3
UPRIGHT = (0.0, 0.0, 0.0, 1.0)
# Fields of a closest point: normal on the mesh towards the sphere, distance (negative is penetration).
NORMAL, DISTANCE = 7, 8


class Bullet(MeshMethod):
    """Move a sphere body to each point and query its closest points on the tube."""

    name = "bullet"
    distribution: ClassVar[str] = "pybullet"
    does: ClassVar[str] = "axis-aligned tree over a triangle mesh (Bullet), contacts only, no clearance"
    gives_clearance = False
    Options: ClassVar[type[Table]] = TubeOptions

    def __init__(self, case: Case, options: TubeOptions) -> None:
        self._bullet = bullet = need("pybullet", self.name)
        self.tube = build_tube(case, options)
        self._client = client = bullet.connect(bullet.DIRECT)
        weakref.finalize(self, bullet.disconnect, client)
        self._wall = wall_of(bullet, client, np.asarray(self.tube.mesh.vertices), self.tube)
        self._spheres: dict[float, int] = {}

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        closest, move = self._bullet.getClosestPoints, self._bullet.resetBasePositionAndOrientation
        n = len(points)
        penetration, normal, md = np.full(n, -np.inf), np.full((n, 3), np.nan), np.full(n, np.nan)
        for k, (place, radius) in enumerate(zip(points, radii, strict=True)):
            sphere = self._sphere(radius)
            move(sphere, place, UPRIGHT, physicsClientId=self._client)
            hits = closest(sphere, self._wall, 0.0, physicsClientId=self._client)
            if hits:
                deepest = min(hits, key=_distance)
                penetration[k], normal[k] = -deepest[DISTANCE], deepest[NORMAL]
        touching = penetration > 0
        md[touching] = self.tube.md_near(points[touching])
        return Contacts(penetration, -normal, md)

    def _sphere(self, radius: float) -> int:
        """The body of a sphere of this radius, created on first use."""
        if radius not in self._spheres:
            shape = self._bullet.createCollisionShape(
                self._bullet.GEOM_SPHERE, radius=radius, physicsClientId=self._client
            )
            self._spheres[radius] = self._bullet.createMultiBody(1, shape, physicsClientId=self._client)
        return self._spheres[radius]


def wall_of(bullet: Any, client: int, vertices: Array, tube: Tube) -> int:
    """A fixed body of the tube's triangles, its vertices (n, 3) in Bullet's own units and axes.

    Raises InputError for more triangles than Bullet accepts.
    """
    if tube.triangles > MOST_TRIANGLES:
        raise InputError(
            f"at most the {MOST_TRIANGLES} triangles that bullet accepts",
            key="facets",
            value=f"{tube.triangles} triangles",
        )
    shape = bullet.createCollisionShape(
        bullet.GEOM_MESH,
        vertices=vertices.tolist(),
        indices=np.asarray(tube.mesh.faces).ravel().tolist(),
        flags=bullet.GEOM_FORCE_CONCAVE_TRIMESH,
        physicsClientId=client,
    )
    wall: int = bullet.createMultiBody(0, shape, physicsClientId=client)
    return wall


def _distance(hit: Any) -> float:
    distance: float = hit[DISTANCE]
    return distance
