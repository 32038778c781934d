"""The tube mesh for libraries in single precision: in chunks along the hole, each about an origin of its own.

Single precision resolves 0.06 mm at 1 km from its origin and 0.5 mm at 8 km, but 0.004 mm in a chunk.
"""

from abc import abstractmethod
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from references.contact.tube_mesh import MeshMethod, Tube, TubeOptions, build_tube

CHUNK = 100.0  # length of hole about one origin [m]
# Faces of a chunk reach this far beyond its ends [m], more than the nearest face is from a point along the hole.
BEYOND = 2.0
# Units in the last place that a distance may be wrong by: a half in each coordinate of point, vertices and answer.
ROUNDING = 3 * 0.5 * 3**0.5


class ChunkOptions(TubeOptions):
    """``origin``: that of each chunk, or that of the well for all, the obvious way."""

    origin: Literal["chunk", "well"] = "chunk"


class Chunk(NamedTuple):
    """A part of the tube about its origin.

    vertices (v, 3) [m], faces (f, 3) : as the library takes them.  first_face : that of the tube which is its face 0.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]
    first_face: int


class Chunks:
    """The chunks of a tube.

    whole : one chunk about the origin of the well.  parts : the chunks in order of depth.
    of (rings − 1,) : the chunk of each stretch between rings.  origins (chunks, 3) [m], first_faces (chunks,) : theirs.
    rounding : largest error of a distance [m] by single precision.
    """

    def __init__(self, tube: Tube, whole: bool) -> None:
        md, vertices = tube.md, np.asarray(tube.mesh.vertices).reshape(len(tube.md), tube.facets, 3)
        number = np.zeros(len(md) - 1) if whole else (md[:-1] - md[0]) // CHUNK
        kept, self.of = np.unique(number, return_inverse=True)
        starts = np.searchsorted(number, kept)
        ends = np.append(starts[1:], len(md) - 1)
        self.origins = np.zeros((1, 3)) if whole else tube.centres[(starts + ends) // 2]
        self.parts: list[Chunk] = []
        for start, end, origin in zip(starts, ends, self.origins, strict=True):
            first = max(int(np.searchsorted(md, md[start] - BEYOND, side="right")) - 1, 0)
            last = min(int(np.searchsorted(md, md[end] + BEYOND)), len(md) - 1)
            faces = np.asarray(tube.mesh.faces)[2 * tube.facets * first : 2 * tube.facets * last]
            local = (vertices[first : last + 1] - origin).reshape(-1, 3).astype(np.float32)
            self.parts.append(Chunk(local, (faces - tube.facets * first).astype(np.int32), 2 * tube.facets * first))
        self.first_faces = np.array([part.first_face for part in self.parts])
        farthest = max(np.abs(part.vertices).max() for part in self.parts)
        self.rounding = ROUNDING * float(np.spacing(farthest))


class SinglePrecision(MeshMethod):
    """Common part of the contact methods whose library computes in single precision."""

    gives_clearance = True

    def __init__(self, case: Case, options: ChunkOptions) -> None:
        self.tube = build_tube(case, options)
        self.chunks = Chunks(self.tube, whole=options.origin == "well")

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        near, faces = self.nearest(points, self.tube.ring_above(points))
        return self.tube.contacts(points, radii, near, faces)

    @abstractmethod
    def nearest(self, points: Array, ring: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
        """Ask the library: nearest points on the mesh (n, 3) [m] and their faces (n,).

        points (n, 3) [m] : each below its ring (n,).  A point without an answer has NaN.
        """

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Errors of the mesh, and of rounding to single precision; see ``Tube.error_bound``."""
        depth, turn = self.tube.error_bound(curvature)
        return depth + self.chunks.rounding, turn
