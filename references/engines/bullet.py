"""The string in Bullet (pybullet): free bodies under FCTD's joint wrenches, Bullet's contact with the concave tube.

Traps: chains of Bullet's constraints sag by metres; a sphere that is part of the body's shape, away from its origin,
rattles on a concave mesh, so each body has a fixed link with the sphere; damping and sleeping are on by default.

The direction of friction is wrong.  Bullet solves friction along two directions that depend only on the wall's normal
and on the global axes (btPlaneSpace1), each with the effective mass of the body in that direction, and limits the
resultant to μN.  Friction then opposes M·v, not the sliding velocity v (bullet3 pull request 4539 reports the same).
The effective mass of a pipe is five times smaller across it than along it, so that friction deviates by up to 30°
where the hole lies between the two directions, and not at all where it lies along one of them.  With Bullet's z axis
across the plane of the hole, one direction lies along the hole wherever the wall's normal is within 45° of that plane.
The ``fair`` settings rotate the scene in this way for the lower end of the string.
"""

from collections.abc import Collection
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import Table
from fctd.mechanics import state
from fctd.simulation.run import Run
from references.contact.bullet import wall_of
from references.contact.tube_mesh import Tube
from references.engines import need
from references.engines.free_bodies import HONOURS, FreeBodies, FreeBodyOptions, poses_of, tube_of, wall_stiffness
from references.engines.run import InWindows

# Share of FCTD's step, found by the ladder of best_step.py: Bullet integrates rotation explicitly, and with the whole
# step a spinning string gains energy until it leaves the hole.
SHARE = 0.5
# Distance beyond which Bullet drops a contact point [m]; its default, 20 mm, keeps points that have moved away.
BREAKING_DISTANCE = 1e-3
ITERATIONS = 50
# Bits of the collision filter: wall and string collide with each other and with nothing else.
WALL, STRING = 1, 2
LINK = 0  # link of a body that has its sphere
# Fields of a contact point of Bullet.
BODY, PLACE, FORCE, FRICTION = 1, 6, 9, (10, 12)


class BulletOptions(FreeBodyOptions):
    """Options of Bullet.

    settings : ``fair``, the wall's stiffness and damping of the case, or ``default``, Bullet's hard contact with
    every parameter at its default.  unit [m] : Bullet's unit of length.  axes : Bullet's axes, z across the plane of
    the ``string`` (with fair), or the ``global`` axes (with default).
    """

    settings: Literal["fair", "default"] = "fair"
    unit: units.PositiveLength = 1.0
    axes: Literal["string", "global"] | None = None


class _Bodies:
    """The bodies in a client of pybullet, lengths in ``unit``, vectors along Bullet's axes."""

    friction_error = (
        "Bullet solves friction along two fixed directions, so that it deviates from the sliding direction where the "
        "hole turns, and the torque is too low"
    )

    def __init__(self, bullet: Any, run: Run, tube: Tube | None, options: BulletOptions) -> None:
        self._bullet, self._scale, self._dt = bullet, 1.0 / options.unit, 0.0
        own = options.axes or ("string" if options.settings == "fair" else "global")
        self._axes = _axes_of(run) if own == "string" else np.eye(3)
        self._client = bullet.connect(bullet.DIRECT)
        bullet.setGravity(0, 0, 0, physicsClientId=self._client)
        fair = options.settings == "fair"
        if fair:
            bullet.setPhysicsEngineParameter(
                numSolverIterations=ITERATIONS, solverResidualThreshold=0, enableConeFriction=1,
                contactBreakingThreshold=BREAKING_DISTANCE * self._scale, physicsClientId=self._client,
            )  # fmt: skip
        friction = run.case.wellbore.intervals[0].friction
        poses, stiffness = _turned_poses(poses_of(run), self._axes), wall_stiffness(run)
        damping = run.laws.contact_damping
        self._bodies = [self._add_body(run, j, poses[j], fair) for j in range(run.segments)]
        self._number = {body: j + 1 for j, body in enumerate(self._bodies)}
        for body, k in zip(self._bodies, stiffness, strict=True):
            soft = {"contactStiffness": k, "contactDamping": damping} if fair and damping > 0 else {}
            bullet.changeDynamics(
                body, LINK, lateralFriction=friction, restitution=0, physicsClientId=self._client, **soft
            )
            bullet.setCollisionFilterGroupMask(body, LINK, STRING, WALL, physicsClientId=self._client)
        self._wall = -1 if tube is None else self._add_wall(tube)

    def _add_wall(self, tube: Tube) -> int:
        bullet, client = self._bullet, self._client
        wall = wall_of(bullet, client, self._scale * np.asarray(tube.mesh.vertices) @ self._axes.T, tube)
        bullet.changeDynamics(wall, -1, lateralFriction=1.0, restitution=0, physicsClientId=client)
        bullet.setCollisionFilterGroupMask(wall, -1, WALL, STRING, physicsClientId=client)
        return wall

    def _add_body(self, run: Run, j: int, pose: Array, fair: bool) -> int:
        """Segment j with FCTD's inertia, and on its fixed link the sphere of its contact point."""
        bullet, client, u = self._bullet, self._client, self._scale
        mass, across, along, arm, radius = (
            float(run.S[row + 1 + j])
            for row in (state.MASS, state.J_TRANSVERSE, state.J_AXIAL, state.ARM_CONTACT, state.RADIUS)
        )
        at = (0, 0, u * arm)
        shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=u * radius, physicsClientId=client)
        x, y, z, qw, qx, qy, qz = pose[:7]
        still = (0, 0, 0, 1)
        body: int = bullet.createMultiBody(
            mass, -1, -1, (u * x, u * y, u * z), (qx, qy, qz, qw), physicsClientId=client,
            linkMasses=[0], linkCollisionShapeIndices=[shape], linkVisualShapeIndices=[-1],
            linkPositions=[at], linkOrientations=[still], linkInertialFramePositions=[(0, 0, 0)],
            linkInertialFrameOrientations=[still], linkParentIndices=[0],
            linkJointTypes=[bullet.JOINT_FIXED], linkJointAxis=[(0, 0, 1)],
        )  # fmt: skip
        bullet.changeDynamics(
            body, -1, linearDamping=0, angularDamping=0, physicsClientId=client,
            activationState=bullet.ACTIVATION_STATE_DISABLE_SLEEPING,
            localInertiaDiagonal=(u * u * across, u * u * across, u * u * along),
        )  # fmt: skip
        if fair:
            # The default limits velocities to 100 units per second.
            bullet.changeDynamics(body, -1, maxJointVelocity=1e12, physicsClientId=client)
        bullet.resetBaseVelocity(body, (u * pose[7:10]).tolist(), pose[10:13].tolist(), physicsClientId=client)
        return body

    def step(self, poses: Array, wrenches: Array, dt: float) -> Array:
        """See ``Bodies.step``."""
        bullet, client, u = self._bullet, self._client, self._scale
        if dt != self._dt:
            bullet.setTimeStep(dt, physicsClientId=client)
            self._dt = dt
        push, turn, world = bullet.applyExternalForce, bullet.applyExternalTorque, bullet.WORLD_FRAME
        scales = (u, u, u * u)
        given = (poses[:, :3], wrenches[:, :3], wrenches[:, 3:])
        turned = (k * v @ self._axes.T for k, v in zip(scales, given, strict=True))
        places, forces, moments = (vectors.tolist() for vectors in turned)
        for body, force, moment, place in zip(self._bodies, forces, moments, places, strict=True):
            push(body, -1, force, place, world, client)
            turn(body, -1, moment, world, client)
        bullet.stepSimulation(client)
        place_of, speed_of = bullet.getBasePositionAndOrientation, bullet.getBaseVelocity
        rows = []
        for body in self._bodies:
            place, (qx, qy, qz, qw) = place_of(body, client)
            speed, spin = speed_of(body, client)
            rows.append((*place, qw, qx, qy, qz, *speed, *spin))
        after = np.array(rows)
        after[:, :3] /= u
        after[:, 7:10] /= u
        return _turned_poses(after, self._axes.T)

    def contacts(self) -> tuple[NDArray[np.int64], Array]:
        """See ``Bodies.contacts``."""
        hits = self._bullet.getContactPoints(bodyB=self._wall, physicsClientId=self._client)
        bodies, rows = [], []
        for hit in hits:
            first, second = (np.array(hit[k + 1]) * hit[k] for k in FRICTION)
            bodies.append(self._number[hit[BODY]])
            rows.append((*hit[PLACE], hit[FORCE], *(first + second)))
        found = np.array(rows).reshape(-1, 7) / self._scale
        for vectors in (found[:, :3], found[:, 4:]):
            vectors[:] = vectors @ self._axes
        return np.array(bodies, np.int64), found

    def close(self) -> None:
        """Disconnect the client; pybullet does not free it otherwise."""
        self._bullet.disconnect(self._client)


def _axes_of(run: Run) -> Array:
    """Axes as rows x, y, z (3, 3): y down, z normal to the vertical plane of the lower end of the string."""
    heading = np.arctan2(run.S[state.AY + run.segments], run.S[state.AX + run.segments])
    c, s = np.cos(heading), np.sin(heading)
    return np.array([[c, s, 0.0], [0.0, 0.0, 1.0], [s, -c, 0.0]])


def _turned_poses(poses: Array, axes: Array) -> Array:
    """Poses (n, 13) in a frame whose axes are the rows (3, 3)."""
    turned = Rotation.from_matrix(axes) * Rotation.from_quat(poses[:, 3:7], scalar_first=True)
    place, speed, spin = (poses[:, k : k + 3] @ axes.T for k in (0, 7, 10))
    return np.hstack([place, turned.as_quat(scalar_first=True), speed, spin])


class Bullet(InWindows):
    """Free bodies in Bullet against a concave tube of triangles."""

    name: ClassVar[str] = "bullet"
    distribution: ClassVar[str] = "pybullet"
    does: ClassVar[str] = "free bodies under FCTD's joint wrenches; Bullet's inertia, contact with a mesh and friction"
    honours: ClassVar[Collection[str]] = HONOURS
    Options: ClassVar[type[Table]] = BulletOptions

    def __init__(self, options: BulletOptions) -> None:
        self._bullet = need("pybullet", self.name)
        self.options = options

    def begin(self, run: Run) -> FreeBodies:
        """See ``StringEngine.begin``."""
        tube = tube_of(run, self.options)
        return FreeBodies(run, _Bodies(self._bullet, run, tube, self.options), self.options.step or SHARE * run.step)
