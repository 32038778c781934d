"""python-fcl, bindings of the Flexible Collision Library, which descends from RAPID, the contact code of Adams.

Traps: a penetrating sphere has no valid distance, so the query is for its centre; all contacts have to be requested,
since the first ones found are not the deepest; normals point into the hole, depths are negative; capsules on the
long triangles of a tube report depths that are wrong by decimetres.
"""

from collections.abc import Callable
from functools import cache
from typing import Any, ClassVar, Literal

import numpy as np

from fctd.arrays import Array, Contacts
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.tube_mesh import MeshMethod, Tube, TubeOptions, build_tube

# Radius of the sphere that represents a point [m]; the library does not accept 0.
POINT = 1e-6
# At any sensible resolution one sphere touches fewer triangles than this.
MOST_CONTACTS = 1000


class SphereOptions(TubeOptions):
    """``query``: the distance of the centre from the wall, or the collision of a sphere with it."""

    query: Literal["distance", "collide"] = "distance"


class SphereMethod(MeshMethod):
    """A sphere at each point against a bounding-volume tree over the tube; a sphere of each radius is kept."""

    Options: ClassVar[type[Table]] = SphereOptions
    _by_distance: Callable[[Array, Array], Contacts]
    _by_collision: Callable[[Array, Array], Contacts]

    def __init__(self, case: Case, options: SphereOptions, sphere: Callable[[float], Any]) -> None:
        self.tube = build_tube(case, options)
        self._sphere = cache(sphere)
        self._collide = options.query == "collide"
        self.gives_clearance = not self._collide

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        return self._by_collision(points, radii) if self._collide else self._by_distance(points, radii)


class Fcl(SphereMethod):
    """FCL's tree."""

    name = "fcl"
    distribution: ClassVar[str] = "python-fcl"
    does: ClassVar[str] = "bounding-volume tree over a triangle mesh (FCL)"

    def __init__(self, case: Case, options: SphereOptions) -> None:
        self._fcl = fcl = need("fcl", self.name)
        super().__init__(case, options, lambda radius: fcl.CollisionObject(fcl.Sphere(radius), fcl.Transform()))
        self._wall = wall_of(fcl, self.tube)
        self._distance_request = fcl.DistanceRequest(enable_nearest_points=True)
        self._request = fcl.CollisionRequest(num_max_contacts=MOST_CONTACTS, enable_contact=True)

    def _by_distance(self, points: Array, radii: Array) -> Contacts:
        fcl, wall, point, request = self._fcl, self._wall, self._sphere(POINT), self._distance_request
        near, faces = np.empty((len(points), 3)), np.empty(len(points), np.int64)
        for k, place in enumerate(points):
            point.setTranslation(place)
            result = fcl.DistanceResult()
            fcl.distance(wall, point, request, result)
            near[k], faces[k] = result.nearest_points[0], result.b1
        return self.tube.contacts(points, radii, near, faces)

    def _by_collision(self, points: Array, radii: Array) -> Contacts:
        fcl, wall, request = self._fcl, self._wall, self._request
        n = len(points)
        penetration, normal = np.full(n, -np.inf), np.full((n, 3), np.nan)
        faces = np.zeros(n, np.int64)
        for k, (place, radius) in enumerate(zip(points, radii, strict=True)):
            sphere = self._sphere(radius)
            sphere.setTranslation(place)
            result = fcl.CollisionResult()
            if fcl.collide(wall, sphere, request, result):
                deepest = min(result.contacts, key=_depth)
                penetration[k], normal[k], faces[k] = -deepest.penetration_depth, deepest.normal, deepest.b1
        return Contacts(penetration, -normal, np.where(penetration > 0, self.tube.md_of(faces, points), np.nan))


def wall_of(fcl: Any, tube: Tube) -> Any:
    """The tube as a collision object of FCL."""
    vertices, faces = np.asarray(tube.mesh.vertices), np.asarray(tube.mesh.faces)
    model = fcl.BVHModel()
    model.beginModel(len(faces), len(vertices))
    model.addSubModel(vertices, faces)
    model.endModel()
    return fcl.CollisionObject(model, fcl.Transform())


def _depth(contact: Any) -> float:
    depth: float = contact.penetration_depth
    return depth
