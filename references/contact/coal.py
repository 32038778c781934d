"""coal, the faster successor of FCL.

Traps: for a penetrating sphere coal returns the distance of the first triangle that it overlaps, not of the deepest
one, so the query is for the sphere's centre; depths are negative; only trees of OBB or OBBRSS can test a sphere
against a mesh.
"""

from typing import Any, ClassVar

import numpy as np

from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from references.contact import need
from references.contact.fcl import MOST_CONTACTS, POINT, SphereMethod, SphereOptions
from references.contact.tube_mesh import Tube


class Coal(SphereMethod):
    """coal's tree; requests and results are reused."""

    name = "coal"
    distribution: ClassVar[str] = "coal"
    does: ClassVar[str] = "bounding-volume tree over a triangle mesh (successor of FCL)"

    def __init__(self, case: Case, options: SphereOptions) -> None:
        self._coal = coal = need("coal", self.name)
        super().__init__(case, options, coal.Sphere)
        # The tree suits the query: OBB is faster for collisions, RSS bounds distances.
        self._wall = wall_of(coal, self.tube, coal.BVHModelOBB() if self._collide else coal.BVHModelOBBRSS())
        self._identity, self._placement = coal.Transform3s(), coal.Transform3s()
        self._distance_request, self._distance = coal.DistanceRequest(True), coal.DistanceResult()
        self._request, self._result = coal.CollisionRequest(), coal.CollisionResult()
        self._request.num_max_contacts = MOST_CONTACTS

    def _by_distance(self, points: Array, radii: Array) -> Contacts:
        distance, wall, identity, placement = self._coal.distance, self._wall, self._identity, self._placement
        request, result, point = self._distance_request, self._distance, self._sphere(POINT)
        near, faces = np.empty((len(points), 3)), np.empty(len(points), np.int64)
        for k, place in enumerate(points):
            placement.setTranslation(place)
            result.clear()
            distance(wall, identity, point, placement, request, result)
            near[k], faces[k] = result.getNearestPoint1(), result.b1
        return self.tube.contacts(points, radii, near, faces)

    def _by_collision(self, points: Array, radii: Array) -> Contacts:
        collide, wall, identity, placement = self._coal.collide, self._wall, self._identity, self._placement
        request, result = self._request, self._result
        n = len(points)
        penetration, normal = np.full(n, -np.inf), np.full((n, 3), np.nan)
        faces = np.zeros(n, np.int64)
        for k, (place, radius) in enumerate(zip(points, radii, strict=True)):
            placement.setTranslation(place)
            result.clear()
            if collide(wall, identity, self._sphere(radius), placement, request, result):
                for i in range(result.numContacts()):
                    contact = result.getContact(i)
                    if -contact.penetration_depth > penetration[k]:
                        penetration[k], normal[k], faces[k] = -contact.penetration_depth, contact.normal, contact.b1
        return Contacts(penetration, -normal, np.where(penetration > 0, self.tube.md_of(faces, points), np.nan))


def wall_of(coal: Any, tube: Tube, model: Any) -> Any:
    """Fill an empty tree of coal with the triangles of the tube; returns the tree."""
    vertices, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for vertex in np.asarray(tube.mesh.vertices):
        vertices.append(vertex)
    for a, b, c in np.asarray(tube.mesh.faces).tolist():
        faces.append(coal.Triangle(a, b, c))
    model.beginModel(len(faces), len(vertices))
    model.addSubModel(vertices, faces)
    model.endModel()
    return model
