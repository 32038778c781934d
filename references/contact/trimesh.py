"""trimesh's proximity query: an R-tree over the triangles, all points in one call."""

from typing import ClassVar

import numpy as np

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.tube_mesh import MESHES, MeshMethod, TubeOptions, build_tube
from references.registry import import_optional


class TriMesh(MeshMethod):
    """Closest points on the tube mesh."""

    name = "trimesh"
    distribution: ClassVar[str] = "trimesh"
    does: ClassVar[str] = "closest points on a triangle mesh through an R-tree, written in Python"
    gives_clearance = True
    Options: ClassVar[type[Table]] = TubeOptions
    settings: ClassVar[Settings] = MESHES[:2]  # milliseconds a point

    def __init__(self, case: Case, options: TubeOptions) -> None:
        import_optional("rtree", "rtree", self.name, "contact")
        self._proximity = need("trimesh.proximity", self.name)
        self.tube = build_tube(case, options)
        # trimesh builds the tree on first use: build it here, so that no query includes the time.
        assert self.tube.mesh.triangles_tree is not None

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        if not len(points):  # which the library cannot answer
            return self.tube.contacts(points, radii, points, np.zeros(0, dtype=np.int64))
        near, _, faces = self._proximity.closest_point(self.tube.mesh, points)
        return self.tube.contacts(points, radii, np.asarray(near), np.asarray(faces))
