"""The string in Rapier, a game engine of single precision: its bodies, joints, solver, contact and friction.

All six axes of a joint are Rapier's motors (implicit springs and dampers) with FCTD's stiffnesses.  Contact is a sphere
on the tube of triangles with Coulomb friction at each point.  Positions are counted from the middle of the string: at
1 km a number of single precision has steps of 0.06 mm, a pull of 2 kN in the joints of 25 m of pipe.

Traps: the impulses of joints are those of the last of ``iterations`` substeps, those of contacts of the whole step; its
points tell none while contacts are clustered; builders return new builders; bodies fall asleep unless told otherwise; a
contact may be 5 mm deep for each metre of ``length_unit`` before it is pushed out.
"""

import itertools
from collections.abc import Collection
from types import ModuleType
from typing import Annotated, Any, ClassVar

import numpy as np
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import Table
from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.topdrive import Motion, planned_speeds
from fctd.simulation.run import Run
from references.contact.tube_mesh import Tube
from references.engines import need
from references.engines.free_bodies import FreeBodyOptions, move_top, place_bodies, poses_of, tube_of
from references.engines.run import InWindows

# Stiffness of a joint by Rapier's axes.
AXES = {
    "LIN_X": state.K_SHEAR, "LIN_Y": state.K_SHEAR, "LIN_Z": state.K_AXIAL,
    "ANG_X": state.K_BEND, "ANG_Y": state.K_BEND, "ANG_Z": state.K_TWIST,
}  # fmt: skip


class RapierOptions(FreeBodyOptions):
    """Options of Rapier.

    iterations : substeps of a step.  length_unit [m] : of Rapier's tolerances.
    """

    iterations: Annotated[int, units.Whole(at_least=1)] = 4
    length_unit: units.PositiveLength = 0.1


class _Stepper:
    """The bodies of a run in a world of Rapier."""

    def __init__(self, rapier: ModuleType, run: Run, tube: Tube | None, options: RapierOptions, step: float) -> None:
        self._rapier, self._run, self.step = rapier, run, step
        self._iterations = options.iterations
        self._origin = np.array([state.row(run.S, row, run.segments).mean() for row in (state.X, state.Y, state.Z)])
        self._axis = run.S[[state.AX, state.AY, state.AZ]].copy()
        self._world = rapier.PhysicsWorld()
        self._world.set_num_threads(1)
        setting = self._world.integration_parameters
        setting.num_solver_iterations = options.iterations
        setting.length_unit = options.length_unit
        setting.friction_model = rapier.FrictionModel.COULOMB
        setting.contact_clustering = False
        self._top, self._bodies, colliders = self._add_bodies()
        self._number = {collider: j for j, collider in enumerate(colliders)}
        self._joints = self._add_joints()
        self._touches = tube is not None
        if tube is not None:
            self._add_wall(tube)
        self._spin = state.row(run.S, state.WZ, run.segments).copy()

    def _add_bodies(self) -> tuple[Any, list[Any], list[Any]]:
        """The top drive, and the segments with FCTD's inertia and the spheres of their contact points."""
        rapier, world, S = self._rapier, self._world, self._run.S
        kinds = rapier.RigidBodyType
        place = S[[state.X, state.Y, state.Z]] - self._origin
        turn = _rotation_vector(S[[state.QW, state.QX, state.QY, state.QZ]])
        top = rapier.RigidBodyBuilder(kinds.KINEMATIC_VELOCITY_BASED).translation(place).rotation(turn)
        handle, bodies, colliders = world.add_body(top), [], []
        groups = rapier.InteractionGroups(rapier.Group.GROUP_1, rapier.Group.GROUP_2)
        for j, pose in enumerate(poses_of(self._run), 1):
            mass, across, along = (float(S[row + j]) for row in (state.MASS, state.J_TRANSVERSE, state.J_AXIAL))
            inertia = rapier.MassProperties((0, 0, 0), mass, (across, across, along))
            body = (
                rapier.RigidBodyBuilder(kinds.DYNAMIC)
                .translation(pose[:3] - self._origin).rotation(_rotation_vector(pose[3:7]))
                .linvel(pose[7:10]).angvel(pose[10:]).linear_damping(0).angular_damping(0).can_sleep(False)
                .gyroscopic_forces(True).allow_fast_rotation(True).additional_mass_properties(inertia)
            )  # fmt: skip
            bodies.append(world.add_body(body))
            world.rigid_bodies[bodies[-1]].add_force((0, 0, float(S[state.WEIGHT + j])))
            sphere = (
                rapier.Collider.ball(float(S[state.RADIUS + j])).translation((0, 0, float(S[state.ARM_CONTACT + j])))
                .density(0).friction(self._run.case.wellbore.intervals[0].friction).collision_groups(groups)
            )  # fmt: skip
            colliders.append(world.add_collider(sphere, bodies[-1]))
        return handle, bodies, colliders

    def _add_joints(self) -> list[Any]:
        """Six springs and dampers between each body and the one above, the top drive for the first."""
        rapier, S, laws = self._rapier, self._run.S, self._run.laws
        joints = []
        for j, (above, below) in enumerate(itertools.pairwise([self._top, *self._bodies]), 1):
            joint = (
                rapier.GenericJoint.builder(rapier.JointAxesMask.empty())
                .local_anchor1((0, 0, float(S[state.ARM_BOTTOM + j - 1])))
                .local_anchor2((0, 0, -float(S[state.ARM_TOP + j])))
            )
            for name, row in AXES.items():
                axis, stiffness = getattr(rapier.JointAxis, name), float(S[row + j])
                damping = stiffness * laws.joint_damping
                joint = joint.motor_model(axis, rapier.MotorModel.FORCE_BASED).motor(axis, 0, 0, stiffness, damping)
            joints.append(self._world.impulse_joints.insert(above, below, joint.build()))
        return joints

    def _add_wall(self, tube: Tube) -> None:
        """The tube of triangles; its friction factor is the sphere's, as Rapier takes the mean of both."""
        rapier = self._rapier
        wall = (
            rapier.Collider.trimesh(
                np.asarray(tube.mesh.vertices) - self._origin, np.asarray(tube.mesh.faces),
                rapier.TriMeshFlags.FIX_INTERNAL_EDGES_TWO_SIDED,
            )
            .friction(self._run.case.wellbore.intervals[0].friction)
            .collision_groups(rapier.InteractionGroups(rapier.Group.GROUP_2, rapier.Group.GROUP_1))
        )  # fmt: skip
        self._world.add_collider(wall)

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        run, world = self._run, self._world
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        dt = duration / steps
        world.integration_parameters.dt = dt
        top = world.rigid_bodies[self._top]
        for _ in range(steps):
            _, rate = planned_speeds(run.top, motion, dt)
            top.angvel = rate * self._axis
            world.step()
            self._sum(rate, dt)
        run.steps += steps

    def _sum(self, rate: float, dt: float) -> None:
        """Add the loads of a step to the sums of the run, and what friction took."""
        run, S, n = self._run, self._run.S, self._run.segments
        axes = self._rapier.JointAxis
        share = self._iterations / dt
        motors = [self._world.impulse_joints[joint].data for joint in self._joints]
        tension = share * np.array([joint.motor(axes.LIN_Z).impulse for joint in motors])
        torque = -share * np.array([joint.motor(axes.ANG_Z).impulse for joint in motors])
        run.top[topdrive.SUM_HOOKLOAD] += dt * tension[0]
        run.top[topdrive.SUM_TOP_TORQUE] += dt * torque[0]
        run.top[topdrive.TOP_WORK] += dt * rate * torque[0]
        poses = self._poses()
        place_bodies(S, poses)
        move_top(S, run.top, run.pipe, 0.0, rate, dt)
        state.row(S, state.SUM_TENSION, n)[:] += dt * tension
        state.row(S, state.SUM_TORQUE, n)[:] += dt * torque
        if self._touches:
            self._sum_contacts(poses, torque - np.append(torque[1:], 0.0), dt)

    def _sum_contacts(self, poses: Array, twisted: Array, dt: float) -> None:
        """Add the contacts of a step.  twisted (n,) [N m] : moment of the two joints about the axis of each body.

        Rapier tells the size of friction and not its direction: its moment is what the joints' leaves, its power that
        against the sliding.
        """
        S, n = self._run.S, self._run.segments
        before = self._spin
        axes = Rotation.from_quat(poses[:, 3:7], scalar_first=True).as_matrix()[:, :, 2]
        self._spin = (poses[:, 10:] * axes).sum(axis=1)
        normal, friction = self._impulses()
        size = np.linalg.norm(normal, axis=1)
        radius = state.row(S, state.RADIUS, n)
        outwards = -normal / np.maximum(size, state.TINY)[:, None]
        lever = state.row(S, state.ARM_CONTACT, n)[:, None] * axes + radius[:, None] * outwards
        speed = poses[:, 7:10] + np.cross(poses[:, 10:], lever)
        sliding = np.linalg.norm(speed - (speed * outwards).sum(axis=1)[:, None] * outwards, axis=1)
        state.row(S, state.SUM_NORMAL, n)[:] += size
        state.row(S, state.SUM_R_MU_N, n)[:] += radius * state.row(S, state.FRICTION, n) * size
        state.row(S, state.LOST_FRICTION, n)[:] += friction * sliding
        gained = state.row(S, state.J_AXIAL, n) * (self._spin - before)
        state.row(S, state.SUM_FRICTION_TORQUE, n)[:] += dt * twisted - gained

    def _impulses(self) -> tuple[Array, Array]:
        """Of the walls on the bodies in the last step [N s]: normal (n, 3), and size of friction (n,)."""
        normal, friction = np.zeros((len(self._bodies), 3)), np.zeros(len(self._bodies))
        for pair in self._world.narrow_phase.contact_pairs():
            sign = 1.0 if pair.collider2 in self._number else -1.0
            j = self._number[pair.collider2 if sign > 0 else pair.collider1]
            normal[j] += sign * np.array(pair.total_impulse().to_tuple())
            friction[j] += sum(
                np.hypot(*point.tangent_impulse) for manifold in pair.manifolds for point in manifold.points
            )
        return normal, friction

    def _poses(self) -> Array:
        """Poses (n, 13) as of ``poses_of``."""
        rows = []
        for handle in self._bodies:
            body = self._world.rigid_bodies[handle]
            turn = body.rotation
            rows.append(
                (*body.translation.to_tuple(), turn.w, turn.i, turn.j, turn.k, *body.linvel.to_tuple(),
                 *body.angvel.to_tuple())
            )  # fmt: skip
        poses = np.array(rows)
        poses[:, :3] += self._origin
        return poses

    def refresh(self) -> None:
        """See ``Stepper.refresh``; every step has updated poses and velocities."""
        self._run.refresh()

    def energy(self) -> Energy:
        """See ``Stepper.energy``."""
        return self._run.energy()

    def note(self) -> str:
        """See ``Stepper.note``."""
        return ""

    def close(self) -> None:
        """Rapier holds nothing but memory."""


def _rotation_vector(quaternion: Array) -> Array:
    return np.asarray(Rotation.from_quat(quaternion, scalar_first=True).as_rotvec())


class Rapier(InWindows):
    """Bodies, springs and contact with a tube of triangles in Rapier."""

    name: ClassVar[str] = "rapier"
    distribution: ClassVar[str] = "rapier3d"
    does: ClassVar[str] = "single precision; Rapier's bodies, springs, contact with a mesh and friction"
    honours: ClassVar[Collection[str]] = frozenset({"wall", "no_wall", "middle_contact", "incline"})
    Options: ClassVar[type[Table]] = RapierOptions

    def __init__(self, options: RapierOptions) -> None:
        self._rapier = need("rapier3d", self.name)
        self.options = options

    def begin(self, run: Run) -> _Stepper:
        """See ``StringEngine.begin``."""
        tube = tube_of(run, self.options)
        return _Stepper(self._rapier, run, tube, self.options, self.options.step or run.step)
