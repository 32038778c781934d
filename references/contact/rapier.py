"""Rapier's point projection on a triangle mesh, point by point.

Trap: the feature that it names is one of a triangle, whose number it does not say; so the face is found from where the
answer lies around the axis.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.chunks import ChunkOptions, SinglePrecision


class Rapier(SinglePrecision):
    """A world of one fixed body for each chunk, without dynamics."""

    name = "rapier"
    distribution: ClassVar[str] = "rapier3d"
    does: ClassVar[str] = "closest points on a triangle mesh (Rapier), in single precision"
    Options: ClassVar[type[Table]] = ChunkOptions

    def __init__(self, case: Case, options: ChunkOptions) -> None:
        rapier = need("rapier3d", self.name)
        super().__init__(case, options)
        self._worlds = [rapier.PhysicsWorld() for _ in self.chunks.parts]
        for world, part in zip(self._worlds, self.chunks.parts, strict=True):
            world.add_collider(rapier.Collider.trimesh(part.vertices, part.faces))
            world.detect_collisions()  # builds the tree of the queries
        self._project = [world.query_pipeline.project_point for world in self._worlds]

    def nearest(self, points: Array, ring: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
        """See ``SinglePrecision.nearest``."""
        chunk = self.chunks.of[ring]
        origins, project = self.chunks.origins[chunk], self._project
        near = np.empty((len(points), 3))
        for k, (part, place) in enumerate(zip(chunk.tolist(), (points - origins).tolist(), strict=True)):
            _, projection = project[part](place, False)
            near[k] = projection.point.to_tuple()
        near += origins
        return near, self.tube.face_beside(ring, near)
