"""libigl, a geometry library: closest points on a mesh in double precision, all points in one call.

Its tree keeps no mesh, so that vertices and faces go with every query.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.tube_mesh import MESHES, MeshMethod, TubeOptions, build_tube


class LibIgl(MeshMethod):
    """Closest points on the tube mesh."""

    name = "libigl"
    distribution: ClassVar[str] = "libigl"
    does: ClassVar[str] = "closest points on a triangle mesh through a tree of boxes, double precision"
    gives_clearance = True
    Options: ClassVar[type[Table]] = TubeOptions
    settings: ClassVar[Settings] = (*MESHES, *(mesh | {"smooth_normals": True} for mesh in MESHES))

    def __init__(self, case: Case, options: TubeOptions) -> None:
        igl = need("igl", self.name)
        self.tube = build_tube(case, options)
        self._vertices = np.ascontiguousarray(self.tube.mesh.vertices, dtype=float)
        self._faces = np.ascontiguousarray(self.tube.mesh.faces, dtype=np.int64)
        self._tree = igl.AABB()
        self._tree.init(self._vertices, self._faces)

    def nearest(self, points: Array) -> tuple[Array, NDArray[np.int64], Array]:
        """Squared distance (n,) [m²], nearest face (n,) and nearest point (n, 3) [m] of points (n, 3) [m]."""
        squared, faces, near = self._tree.squared_distance(self._vertices, self._faces, np.ascontiguousarray(points))
        return np.atleast_1d(squared), np.atleast_1d(faces), np.atleast_2d(near)

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        _, faces, near = self.nearest(points)
        return self.tube.contacts(points, radii, near, faces)
