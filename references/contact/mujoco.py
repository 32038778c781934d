"""MuJoCo's collision detection: sphere bodies against the tube as a flex of the world, no dynamics.

Traps: MuJoCo replaces a mesh geom by its convex hull, a solid bar in place of a hole, so the wall has to be a
``flex``; fixed and mocap bodies do not collide with the world, so the spheres have free joints whose positions are
set before each query.
"""

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, Contacts
from fctd.case.errors import Table
from fctd.case.load import Case
from references.contact import need
from references.contact.tube_mesh import MeshMethod, Tube, TubeOptions, build_tube

BATCH = 64  # spheres in the model
FACE_RADIUS = 1e-6  # half the thickness of the flex, which cannot be 0 [m]
STRING_CONTACT = '<contact contype="2" conaffinity="1" selfcollide="none"/>'  # the wall collides with the string alone
PARKED = 1e5  # height above the well at which unused spheres are kept [m]


class MuJoCo(MeshMethod):
    """Move spheres to the points in batches, with one collision pass per batch."""

    name = "mujoco"
    distribution: ClassVar[str] = "mujoco"
    does: ClassVar[str] = "bounding-volume tree over a triangle mesh (flex), contacts only, no clearance"
    gives_clearance = False
    Options: ClassVar[type[Table]] = TubeOptions

    def __init__(self, case: Case, options: TubeOptions) -> None:
        self._mujoco = mujoco = need("mujoco", self.name)
        self.tube = build_tube(case, options)
        self._model = mujoco.MjModel.from_xml_string(_model(self.tube))
        self._data = mujoco.MjData(self._model)
        # A view of the library's own memory: positions of the spheres.
        self._places = self._data.qpos.reshape(BATCH, 7)[:, :3]
        self._park(0)
        mujoco.mj_fwdPosition(self._model, self._data)  # places the vertices of the flex, once

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """See ``MeshMethod.contacts``."""
        n = len(points)
        penetration, normal = np.full(n, -np.inf), np.full((n, 3), np.nan)
        faces = np.zeros(n, np.int64)
        for start in range(0, n, BATCH):
            batch = slice(start, min(start + BATCH, n))
            self._collide(points[batch], radii[batch], penetration[batch], normal[batch], faces[batch])
        return Contacts(penetration, normal, np.where(penetration > 0, self.tube.md_of(faces, points), np.nan))

    def _collide(
        self, points: Array, radii: Array, penetration: Array, normal: Array, faces: NDArray[np.int64]
    ) -> None:
        """Write the contacts of at most BATCH points into ``penetration``, ``normal`` and ``faces``."""
        mujoco, model, data, n = self._mujoco, self._model, self._data, len(points)
        self._places[:n] = points
        self._park(n)
        model.geom_size[:n, 0] = model.geom_rbound[:n] = radii
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        contacts = data.contact
        # Sorted from shallow to deep: of several contacts of a point the deepest is written last and stays.
        order = np.argsort(-contacts.dist)
        point = contacts.geom[order, 0]
        penetration[point] = -contacts.dist[order] - FACE_RADIUS
        normal[point] = contacts.frame[order, :3]
        faces[point] = contacts.elem[order, 1]

    def _park(self, first: int) -> None:
        """Move the spheres from number ``first`` on away from the well, apart from each other."""
        self._places[first:] = 0.0
        self._places[first:, 2] = -PARKED * (1 + np.arange(BATCH - first))


def _model(tube: Tube) -> str:
    """MuJoCo's description of the spheres and the wall; the spheres collide with the wall alone."""
    sphere = '<body><freejoint/><geom type="sphere" size="1" mass="1" contype="1" conaffinity="2"/></body>'
    wall = wall_of(tube, STRING_CONTACT)
    return f'<mujoco><size memory="64M"/><worldbody>{BATCH * sphere}</worldbody>{wall}</mujoco>'


def wall_of(tube: Tube, contact: str = "") -> str:
    """MuJoCo's description of the tube as a flex of the world."""
    vertices = " ".join(map(repr, np.asarray(tube.mesh.vertices).ravel().tolist()))
    faces = " ".join(map(str, np.asarray(tube.mesh.faces).ravel().tolist()))
    return (
        f'<deformable><flex dim="2" body="world" radius="{FACE_RADIUS}" vertex="{vertices}" element="{faces}">'
        f"{contact}</flex></deformable>"
    )
