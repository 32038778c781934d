"""The string in MuJoCo: free bodies under FCTD's joint wrenches, MuJoCo's contact with the tube as a ``flex``.

MuJoCo's friction is a soft constraint: a sliding point is lifted off its wall and falls back, and where an impact stops
it within the step friction is less than μN.  Its default friction cone is a pyramid, whose corners turn friction away
from the sliding direction.  The ``fair`` settings give a pipe that turns in a straight hole friction by Coulomb's law
(``references/engines/friction_law.py``, measured in the study engines_agree): an elliptic cone, a wall stiffness of at
most STIFFNESS, and the impedance nearest to MuJoCo's default 0.9 that keeps friction within half a percent of μN.
"""

from collections.abc import Collection
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import Table
from fctd.mechanics import state
from fctd.simulation.run import Run
from references.contact.mujoco import STRING_CONTACT, wall_of
from references.contact.tube_mesh import Tube
from references.engines import need
from references.engines.free_bodies import HONOURS, FreeBodies, FreeBodyOptions, poses_of, tube_of, wall_stiffness
from references.engines.run import InWindows

# Share of FCTD's step, found by the ladder of best_step.py: MuJoCo integrates rotation explicitly, and with the whole
# step a spinning string gains energy until it leaves the hole.
SHARE = 0.5
# Impedance and stiffness [N/m] of the fair contact, chosen as above; contact with a stiffer wall chatters.
IMPEDANCE, STIFFNESS = 0.3, 1e6


class MuJoCoOptions(FreeBodyOptions):
    """Options of MuJoCo.

    settings : ``fair`` as above, with an elliptic cone, or ``default``, MuJoCo's default contact and cone.  stiffness
    [N/m] : largest at a contact point, and impedance of a contact, both used by ``fair``.
    """

    settings: Literal["fair", "default"] = "fair"
    stiffness: units.PositiveStiffness = STIFFNESS
    impedance: Annotated[float, units.Number(noun="an impedance", above=0.0, at_most=0.9999)] = IMPEDANCE


class _Bodies:
    """The bodies in a model of MuJoCo."""

    friction_error = (
        "MuJoCo's friction is a soft constraint, and its default cone a pyramid whose corners deviate from sliding"
    )

    def __init__(self, mujoco: Any, run: Run, tube: Tube | None, options: MuJoCoOptions) -> None:
        self._mujoco, poses = mujoco, poses_of(run)
        self._model = mujoco.MjModel.from_xml_string(_model(run, tube, options))
        self._data = mujoco.MjData(self._model)
        self._place = self._data.qpos.reshape(-1, 7)
        self._speed = self._data.qvel.reshape(-1, 6)
        self._place[:], self._speed[:, :3] = poses[:, :7], poses[:, 7:10]
        self._speed[:, 3:] = _turned(poses[:, 3:7] * [1, -1, -1, -1], poses[:, 10:])

    def step(self, poses: Array, wrenches: Array, dt: float) -> Array:
        """See ``Bodies.step``."""
        self._model.opt.timestep = dt
        self._data.xfrc_applied[1:] = wrenches
        self._mujoco.mj_step(self._model, self._data)
        spin = _turned(self._place[:, 3:], self._speed[:, 3:])  # MuJoCo stores it in the frame of the body
        return np.hstack([self._place, self._speed[:, :3], spin])

    def contacts(self) -> tuple[NDArray[np.int64], Array]:
        """See ``Bodies.contacts``."""
        found = self._data.contact
        rows, force = np.empty((len(found.dist), 7)), np.zeros(6)
        for k, frame in enumerate(found.frame.reshape(-1, 3, 3)):
            self._mujoco.mj_contactForce(self._model, self._data, k, force)
            # The force acts on the second body, which is the wall.
            rows[k] = *found.pos[k], force[0], *(-force[1] * frame[1] - force[2] * frame[2])
        return self._model.geom_bodyid[found.geom[:, 0]].astype(np.int64), rows

    def close(self) -> None:
        """MuJoCo holds nothing but memory."""


def _turned(quaternions: Array, vectors: Array) -> Array:
    """Vectors (n, 3) rotated by quaternions (n, 4), scalar first."""
    axis = quaternions[:, 1:]
    twice = 2 * np.cross(axis, vectors)
    return np.asarray(vectors + quaternions[:, :1] * twice + np.cross(axis, twice))


def _model(run: Run, tube: Tube | None, options: MuJoCoOptions) -> str:
    """The model of string and wall in MuJoCo's XML."""
    fair = options.settings == "fair"
    friction = run.case.wellbore.intervals[0].friction
    per_point = np.minimum(wall_stiffness(run), options.stiffness)
    bodies = ""
    for j, pose in enumerate(poses_of(run)):
        mass, across, along, arm, radius = (
            float(run.S[row + 1 + j])
            for row in (state.MASS, state.J_TRANSVERSE, state.J_AXIAL, state.ARM_CONTACT, state.RADIUS)
        )
        soft = ""
        if fair:
            # MuJoCo's stiffness is an acceleration per metre: N/m over the effective mass of the contact point.
            rate = float(per_point[j]) * (1 - options.impedance) * (1 / mass + arm * arm / across)
            soft = f'solref="{-rate!r} {-2 * rate**0.5!r}" solimp="{options.impedance} {options.impedance} 0.001"'
        place, turn = " ".join(map(repr, pose[:3].tolist())), " ".join(map(repr, pose[3:7].tolist()))
        bodies += (
            f'<body pos="{place}" quat="{turn}"><freejoint/>'
            f'<inertial pos="0 0 0" mass="{mass!r}" diaginertia="{across!r} {across!r} {along!r}"/>'
            f'<geom type="sphere" size="{radius!r}" pos="0 0 {arm!r}" {soft} '
            f'friction="{friction!r} 0 0" condim="3" priority="1" contype="1" conaffinity="2"/></body>'
        )
    wall = "" if tube is None else wall_of(tube, STRING_CONTACT)
    cone = 'cone="elliptic" integrator="implicit"' if fair else ""
    return (
        f'<mujoco><compiler balanceinertia="false" boundmass="0" boundinertia="0"/><size memory="256M"/>'
        f'<option gravity="0 0 0" {cone}/><worldbody>{bodies}</worldbody>{wall}</mujoco>'
    )


class MuJoCo(InWindows):
    """Free bodies in MuJoCo against a tube of triangles."""

    name: ClassVar[str] = "mujoco"
    distribution: ClassVar[str] = "mujoco"
    does: ClassVar[str] = "free bodies under FCTD's joint wrenches; MuJoCo's inertia, contact with a mesh and friction"
    honours: ClassVar[Collection[str]] = HONOURS
    Options: ClassVar[type[Table]] = MuJoCoOptions

    def __init__(self, options: MuJoCoOptions) -> None:
        self._mujoco = need("mujoco", self.name)
        self.options = options

    def begin(self, run: Run) -> FreeBodies:
        """See ``StringEngine.begin``."""
        tube = tube_of(run, self.options)
        return FreeBodies(run, _Bodies(self._mujoco, run, tube, self.options), self.options.step or SHARE * run.step)
