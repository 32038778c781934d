"""Warp's query for the nearest point on a triangle mesh, on the processor or on a GPU: all points in one launch.

Traps: the queries that give a side are wrong beside the edges of a tube, so that the side is that of the face; meshes
are in single precision alone; a mesh is freed with its Python object, whatever still holds its number.
"""

from functools import cache
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError, Table
from fctd.case.load import Case
from references.contact import need
from references.contact.chunks import ChunkOptions, SinglePrecision

ANYWHERE = 1e6  # as far as a query looks [m]


class WarpOptions(ChunkOptions):
    """``device``: the processor, or the first GPU of CUDA."""

    device: Literal["cpu", "cuda"] = "cpu"


class Warp(SinglePrecision):
    """A mesh for each chunk; the kernel chooses it for each point."""

    name = "warp"
    distribution: ClassVar[str] = "warp-lang"
    does: ClassVar[str] = "closest points on a triangle mesh (NVIDIA Warp), in single precision, also on a GPU"
    Options: ClassVar[type[Table]] = WarpOptions

    def __init__(self, case: Case, options: WarpOptions) -> None:
        self._warp = warp = plain(need("warp", self.name))
        if options.device == "cuda" and not warp.is_cuda_available():
            raise InputError('"cpu", since there is no GPU of CUDA', key="device", value=options.device)
        super().__init__(case, options)
        self._device, self._kernel = options.device, _nearest(warp)
        self._meshes = [
            warp.Mesh(self._array(part.vertices, warp.vec3), self._array(part.faces.ravel(), warp.int32))
            for part in self.chunks.parts
        ]
        self._ids = self._array(np.array([mesh.id for mesh in self._meshes], np.uint64), warp.uint64)

    def _array(self, values: NDArray[Any], kind: Any) -> Any:
        return self._warp.array(values, dtype=kind, device=self._device)

    def nearest(self, points: Array, ring: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
        """See ``SinglePrecision.nearest``."""
        warp, n, chunk = self._warp, len(points), self.chunks.of[ring]
        origins = self.chunks.origins[chunk]
        near, faces = (warp.empty(n, dtype=kind, device=self._device) for kind in (warp.vec3, warp.int32))
        asked = [self._array(chunk.astype(np.int32), warp.int32)]
        asked += [self._array((points - origins).astype(np.float32), warp.vec3)]
        warp.launch(self._kernel, n, [self._ids, *asked], [near, faces], device=self._device)
        return origins + near.numpy(), self.chunks.first_faces[chunk] + faces.numpy()


def plain(warp: Any) -> Any:
    """Warp without lines about itself, and without derivatives, for which it compiles twice as long."""
    warp.config.log_level, warp.config.enable_backward = warp.LOG_ERROR, False
    return warp


@cache
def _nearest(warp: Any) -> Any:
    """The kernel, compiled on its first launch."""

    def nearest(meshes, chunk, points, near, faces):  # type: ignore[no-untyped-def]
        k = warp.tid()
        mesh = meshes[chunk[k]]
        found = warp.mesh_query_point_no_sign(mesh, points[k], ANYWHERE)
        near[k] = warp.mesh_eval_position(mesh, found.face, found.u, found.v)
        faces[k] = found.face

    places, numbers = warp.array(dtype=warp.vec3), warp.array(dtype=warp.int32)
    nearest.__annotations__ = {
        "meshes": warp.array(dtype=warp.uint64), "chunk": numbers, "points": places, "near": places, "faces": numbers,
    }  # fmt: skip
    return warp.kernel(nearest)
