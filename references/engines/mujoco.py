"""The string in MuJoCo: free bodies under our joint wrenches, MuJoCo's own contact with the tube as a ``flex``.

MuJoCo's friction is a soft constraint: a sliding point is lifted off its wall and falls back, and where a blow stops
it within the step friction is less than μN.  Its default cone is a pyramid, whose corners pull aside.  The ``fair``
settings are those that return Coulomb's law to a pipe turning in a straight hole (``references/friction_law.py``,
measured in the study engines_agree): an elliptic cone, a wall of at most STIFFNESS, and of the impedances the nearest
to MuJoCo's own 0.9 that keeps friction within half a percent of μN.
"""

from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.case import units
from fctd.case.errors import Table
from fctd.mechanics import state
from fctd.simulation.run import Run
from references.contact.mujoco import MEETS_STRING, wall_of
from references.contact.tube_mesh import Tube
from references.engines import check_coulomb, check_no_mud, need
from references.engines.free_bodies import FreeBodies, FreeBodyOptions, poses_of, tube_of, wall_stiffness
from references.engines.run import InWindows

Array = NDArray[np.float64]

# Share of FCTD's own step, by the ladder of best_step.py: MuJoCo turns bodies explicitly, and at all of it a spinning
# string gains energy until it leaves the hole.
SHARE = 0.5
# Impedance and stiffness [N/m] of the fair contact, chosen as above; a stiffer wall chatters.
IMPEDANCE, STIFFNESS = 0.3, 1e6


class MuJoCoOptions(FreeBodyOptions):
    """What can be set.

    settings : ``fair`` as above, with an elliptic cone, or ``default``: contact and cone as they come.  stiffness
    [N/m] of a point of the wall at most, and impedance of a contact, both of ``fair``.
    """

    settings: Literal["fair", "default"] = "fair"
    stiffness: units.PositiveStiffness = STIFFNESS
    impedance: Annotated[float, units.Number(noun="an impedance", above=0.0, at_most=0.9999)] = IMPEDANCE


class _Bodies:
    """The bodies in a model of MuJoCo."""

    lean = "MuJoCo's friction is a soft constraint, and its default cone a pyramid whose corners pull aside"

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
        spin = _turned(self._place[:, 3:], self._speed[:, 3:])  # MuJoCo keeps it in the frame of the body
        return np.hstack([self._place, self._speed[:, :3], spin])

    def contacts(self) -> tuple[NDArray[np.int64], Array]:
        """See ``Bodies.contacts``."""
        found = self._data.contact
        rows, force = np.empty((len(found.dist), 7)), np.zeros(6)
        for k, frame in enumerate(found.frame.reshape(-1, 3, 3)):
            self._mujoco.mj_contactForce(self._model, self._data, k, force)
            # Acts on the second of the two, which is the wall.
            rows[k] = *found.pos[k], force[0], *(-force[1] * frame[1] - force[2] * frame[2])
        return self._model.geom_bodyid[found.geom[:, 0]].astype(np.int64), rows

    def close(self) -> None:
        """Nothing is held beyond memory."""


def _turned(quaternions: Array, vectors: Array) -> Array:
    """Vectors (n, 3) turned by quaternions (n, 4), scalar first."""
    axis = quaternions[:, 1:]
    twice = 2 * np.cross(axis, vectors)
    return np.asarray(vectors + quaternions[:, :1] * twice + np.cross(axis, twice))


def _model(run: Run, tube: Tube | None, options: MuJoCoOptions) -> str:
    """MuJoCo's description of string and wall."""
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
            # MuJoCo's stiffness is an acceleration per metre: N/m times what the contact point gives way to a force.
            rate = float(per_point[j]) * (1 - options.impedance) * (1 / mass + arm * arm / across)
            soft = f'solref="{-rate!r} {-2 * rate**0.5!r}" solimp="{options.impedance} {options.impedance} 0.001"'
        place, turn = " ".join(map(repr, pose[:3].tolist())), " ".join(map(repr, pose[3:7].tolist()))
        bodies += (
            f'<body pos="{place}" quat="{turn}"><freejoint/>'
            f'<inertial pos="0 0 0" mass="{mass!r}" diaginertia="{across!r} {across!r} {along!r}"/>'
            f'<geom type="sphere" size="{radius!r}" pos="0 0 {arm!r}" {soft} '
            f'friction="{friction!r} 0 0" condim="3" priority="1" contype="1" conaffinity="2"/></body>'
        )
    wall = "" if tube is None else wall_of(tube, MEETS_STRING)
    cone = 'cone="elliptic" integrator="implicit"' if fair else ""
    return (
        f'<mujoco><compiler balanceinertia="false" boundmass="0" boundinertia="0"/><size memory="256M"/>'
        f'<option gravity="0 0 0" {cone}/><worldbody>{bodies}</worldbody>{wall}</mujoco>'
    )


class MuJoCo(InWindows):
    """Free bodies in MuJoCo against a tube of triangles."""

    name: ClassVar[str] = "mujoco"
    distribution: ClassVar[str] = "mujoco"
    does: ClassVar[str] = "free bodies under our joint wrenches; inertia, contact with a mesh and friction are MuJoCo's"
    Options: ClassVar[type[Table]] = MuJoCoOptions

    def __init__(self, options: MuJoCoOptions) -> None:
        self._mujoco = need("mujoco", self.name)
        self.options = options

    def begin(self, run: Run) -> FreeBodies:
        """See ``StringEngine.begin``."""
        check_coulomb(run.case, self.name)
        check_no_mud(run.case, self.name)
        tube = tube_of(run, self.options)
        return FreeBodies(run, _Bodies(self._mujoco, run, tube, self.options), self.options.step or SHARE * run.step)
