"""Embree's ray tracing through embreex: a ray from the axis of the hole outwards through the point.

Embree has no distances, and needs to be told where the axis is.  In a tube of flat facets about its axis the facet
that the ray meets first is the nearest one; the distance from its plane is computed here, in double precision.

Trap: the length of the ray is no distance, it is 0.2 mm too long between the edges of 48 facets.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.chunks import ChunkOptions, SinglePrecision


class Embree(SinglePrecision):
    """A scene for each chunk; all points of a chunk in one call."""

    name = "embree"
    distribution: ClassVar[str] = "embreex"
    does: ClassVar[str] = "a ray from the axis to a triangle mesh (Embree), in single precision"
    Options: ClassVar[type[Table]] = ChunkOptions

    def __init__(self, case: Case, options: ChunkOptions) -> None:
        tracing = need("embreex.rtcore_scene", self.name)
        triangles = need("embreex.mesh_construction", self.name)
        super().__init__(case, options)
        self._corners = np.asarray(self.tube.mesh.triangles)[:, 0]
        self._scenes = []
        for part in self.chunks.parts:
            scene = tracing.EmbreeScene()
            triangles.TriangleMesh(scene, part.vertices, part.faces)
            self._scenes.append(scene)

    def nearest(self, points: Array, ring: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
        """See ``SinglePrecision.nearest``; a ray that meets nothing has no answer."""
        chunk = self.chunks.of[ring]
        axis = self.tube.axis_beside(ring, points)
        outwards = points - axis
        distance = np.linalg.norm(outwards, axis=1)
        # A point on the axis has no direction: any will do, as all facets are equally far.
        central = distance < 1e-9
        outwards[central] = np.asarray(self.tube.mesh.vertices)[self.tube.facets * ring[central]] - axis[central]
        rays = outwards.astype(np.float32)
        starts = (axis - self.chunks.origins[chunk]).astype(np.float32)
        hit = np.empty(len(points), np.int64)
        for part in np.unique(chunk):
            chosen = chunk == part
            hit[chosen] = self._scenes[part].run(starts[chosen], rays[chosen])
        faces = np.where(hit < 0, 0, hit) + self.chunks.first_faces[chunk]
        plane = self.tube.normals[faces]
        away = np.sum((self._corners[faces] - points) * plane, axis=1)
        return points + np.where(hit < 0, np.nan, away)[:, None] * plane, faces
