"""The string in Exudyn: rigid bodies of FCTD's inertia on Exudyn's own springs and dampers, moved by its integrator.

Joints are Exudyn's ``RigidBodySpringDamper`` in its intrinsic formulation: springs on the logarithm of the relative
placement, in the frame half-way between the bodies.  FCTD's potential (fctd/mechanics/joints.py) has the angle between
the axes and the twist in place of the rotation vector: in a joint bent by β and twisted by τ the two differ by shares
of β²/8 and βτ/8, a thousandth where 25 m of pipe bend by 5°.  Everything else is FCTD's: what its step changes in the
velocities (wall, friction, mud, weight, top drive and its joint, bent housings), less what its own springs of the other
joints do, is handed over as loads.

Exudyn's velocity Verlet staggers velocities and positions as FCTD's step does: loads are asked for once a step, at the
new positions and the velocities half a step before, so that friction may stop a point within the step.  Readings are
those at the end of a step, FCTD's at its start.

Traps of its contact with a mesh: a triangle is touched from one side only, that of its normal; where a sphere touches
several triangles their forces are added up.
"""

from collections.abc import Collection
from importlib import import_module
from types import ModuleType
from typing import Any, ClassVar, Literal

import numpy as np
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.case.errors import Table
from fctd.mechanics import state
from fctd.mechanics.dynamics import load, padded_columns, update_axes, update_velocities
from fctd.mechanics.energy import Energy
from fctd.mechanics.jit import entry
from fctd.mechanics.joints import update_joint_loads
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.rotations import rotation_columns
from fctd.mechanics.stored_walls import update_walls
from fctd.mechanics.topdrive import Motion
from fctd.simulation.features import OWN, UNKNOWN_KEYS, refuse
from fctd.simulation.run import Run
from references.contact.tube_mesh import Tube
from references.engines import need
from references.engines.free_bodies import HONOURS, FreeBodyOptions, move_top, poses_of, tube_of, wall_stiffness
from references.engines.run import InWindows

# What others feed or press (stands, bit, cake), what needs code of its own in the compiled step (orthotropic, bows,
# other laws of the wall), and a rotation that is not planned, whose reading would be a step late.
LEFT_OUT = {"stands", "bit_loads", "cake", "orthotropic", "bows", "wall_law", "flow", "drive", UNKNOWN_KEYS}
# Of Exudyn's contact with a mesh: share of FCTD's step, with which the string leaves the hole, since forces of
# neighbouring triangles are added up; sliding below which friction is less than μN [m/s]; stiffness of triangles in
# series with that of the wall [N/m]; cells of its search: size [m] and most along an axis.
MESH_SHARE, SLOWEST, STIFF, CELL, MOST_CELLS = 0.25, 0.02, 1e15, 4.0, 400


@entry
def _store(S, n, places, speeds):  # type: ignore[no-untyped-def]
    """Update the bodies from Exudyn's coordinates (n, 6): place [m] and rotation vector; velocity and own spin."""
    for j in range(1, n + 1):
        p, v = places[j - 1], speeds[j - 1]
        angle = np.sqrt(p[3] * p[3] + p[4] * p[4] + p[5] * p[5])
        k = 0.5 * np.sinc(0.5 * angle / np.pi)
        w, x, y, z = np.cos(0.5 * angle), k * p[3], k * p[4], k * p[5]
        a, b, c, d = state.quaternion(S, j)
        # Of the two quaternions of an orientation the one nearer to the last: twist is computed from it.
        sign = 1.0 if w * a + x * b + y * c + z * d > 0 else -1.0
        S[state.QW + j], S[state.QX + j], S[state.QY + j], S[state.QZ + j] = sign * w, sign * x, sign * y, sign * z
        S[state.X + j], S[state.Y + j], S[state.Z + j] = p[0], p[1], p[2]
        S[state.VX + j], S[state.VY + j], S[state.VZ + j] = v[0], v[1], v[2]
        S[state.WX + j], S[state.WY + j], S[state.WZ + j] = v[3], v[4], v[5]


@entry
def _hand_over(S, top, owner, n, C, laws, motion, pipe, dt, speeds, inertia, out):  # type: ignore[no-untyped-def]
    """Loads that give the bodies what FCTD's step gives them, beside the springs of joints 2 to n.

    speeds (n, 6) : of the bodies; inertia (n, 6) : masses [kg] and own moments of inertia [kg m²], as Exudyn has them;
    out (n, 6) : force, global [N], and moment in the frame of the body [N m].  Returns feed and spin rate.
    """
    update_axes(S, padded_columns(n))
    update_joint_loads(S, padded_columns(n), laws.joint_damping, 0.0, laws.torsion_damping)
    for j in range(1, n + 1):
        row = out[j - 1]
        fx, fy, fz = state.joint_force(S, j) if j > 1 else (0.0, 0.0, 0.0)
        gx, gy, gz = state.joint_force(S, j + 1)
        row[0], row[1], row[2] = gx - fx, gy - fy, gz - fz
        mx, my, mz = S[state.UX + j + 1], S[state.UY + j + 1], S[state.UZ + j + 1]
        if j > 1:
            mx, my, mz = mx + S[state.LX + j], my + S[state.LY + j], mz + S[state.LZ + j]
        xx, xy, xz, yx, yy, yz, zx, zy, zz = rotation_columns(*state.quaternion(S, j))
        row[3] = -(xx * mx + xy * my + xz * mz)
        row[4] = -(yx * mx + yy * my + yz * mz)
        row[5] = -(zx * mx + zy * my + zz * mz)
    feed, rate = load(S, top, n, laws, motion, pipe, dt)
    update_walls(S, owner, n, padded_columns(n), C, laws.geometry)
    update_velocities(S, padded_columns(n), laws, dt)
    for j in range(1, n + 1):
        row, before, m = out[j - 1], speeds[j - 1], inertia[j - 1]
        after = (*state.velocity(S, j), *state.spin(S, j))
        for k in range(6):
            row[k] += m[k] / dt * (after[k] - before[k])
    return feed, rate


class _Stepper:
    """The bodies of a run in a system of Exudyn; tube : the mesh that they touch in place of FCTD's wall, or None."""

    def __init__(self, exudyn: ModuleType, run: Run, tube: Tube | None, step: float) -> None:
        self._run, self.step = run, step
        self._laws = run.laws if tube is None else run.laws._replace(geometry=state.OPEN)
        self._motion, self._dt, self._feed, self._rate = STILL, step, 0.0, 0.0
        n = run.segments
        rows = (state.MASS, state.MASS, state.MASS, state.J_TRANSVERSE, state.J_TRANSVERSE, state.J_AXIAL)
        self._inertia = np.stack([state.row(run.S, row, n) for row in rows], axis=1)
        self._loads = np.empty((n, 6))
        exudyn.config.printToConsole = False
        # The container has to outlive its system.
        self._container = exudyn.SystemContainer()
        self._system = self._container.AddSystem()
        self._contact: Any = None if tube is None else self._system.AddGeneralContact()
        self._assemble(tube)
        self._settings = exudyn.SimulationSettings()
        self._settings.timeIntegration.solverType = exudyn.DynamicSolverType.VelocityVerlet
        self._settings.timeIntegration.explicit.useLieGroupIntegration = True
        self._settings.timeIntegration.verboseMode = 0
        self._settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
        self._settings.solution.file.write = False
        self._solver = exudyn.MainSolverExplicit()
        # The solver asks for the loads at the start, which are no part of a step.
        kept = state.copy_state(run.S), run.top.copy()
        self._solver.InitializeSolver(self._system, self._settings)
        state.put_state(run.S, kept[0])
        run.top[:] = kept[1]
        # Feed and rotation of the top drive until loads are asked for again.
        axis = run.S[[state.AX, state.AY, state.AZ]]
        self._feed = float(axis @ run.S[[state.VX, state.VY, state.VZ]])
        self._rate = float(axis @ run.S[[state.GX, state.GY, state.GZ]])

    def _assemble(self, tube: Tube | None) -> None:
        """Add bodies in the state of the run, springs between them, contact, and the function that gives the loads."""
        items, system, S, n = import_module("exudyn.itemInterface"), self._system, self._run.S, self._run.segments
        poses = poses_of(self._run)
        turns = Rotation.from_quat(poses[:, 3:7], scalar_first=True).as_rotvec()
        spins = np.stack([state.row(S, row, n) for row in (state.WX, state.WY, state.WZ)], axis=1)
        places, speeds = np.hstack([poses[:, :3], turns]), np.hstack([poses[:, 7:10], spins])
        nodes, bodies = [], []
        for place, speed, (mass, _, _, *moments) in zip(places, speeds, self._inertia.tolist(), strict=True):
            node = system.AddNode(items.NodeRigidBodyRotVecLG(initialCoordinates=place, initialVelocities=speed))
            nodes.append(node)
            bodies.append(
                system.AddObject(items.ObjectRigidBody(mass=mass, inertia=[*moments, 0, 0, 0], nodeNumber=node))
            )
        laws = self._run.laws
        stiffness = (state.K_SHEAR, state.K_SHEAR, state.K_AXIAL, state.K_BEND, state.K_BEND, state.K_TWIST)
        damped = laws.joint_damping * np.ones(6) + laws.torsion_damping * np.eye(6)[5]
        for j in range(2, n + 1):
            arms = ((bodies[j - 2], S[state.ARM_BOTTOM + j - 1]), (bodies[j - 1], -S[state.ARM_TOP + j]))
            ends = [
                system.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, arm]))
                for body, arm in arms
            ]
            springs = np.array([S[row + j] for row in stiffness])
            joint = items.ObjectConnectorRigidBodySpringDamper(
                markerNumbers=ends, stiffness=np.diag(springs), damping=np.diag(damped * springs),
                useIntrinsicFormulation=True,
            )  # fmt: skip
            system.AddObject(joint)
        if tube is not None:
            self._touch(items, bodies, tube)
        none = np.zeros((6 * n, 6 * n))
        system.AddObject(items.ObjectGenericODE2(nodeNumbers=nodes, massMatrix=none, forceUserFunction=self._given))
        system.Assemble()

    def _touch(self, items: Any, bodies: list[Any], tube: Tube) -> None:
        """Add the spheres of the contact points and the tube to Exudyn's contact; normals point into the hole."""
        run, contact, system = self._run, self._contact, self._system
        contact.SetFrictionPairings([[run.case.wellbore.intervals[0].friction]])
        contact.SetFrictionProportionalZone(SLOWEST)
        contact.computeContactForces = True
        vertices = np.asarray(tube.mesh.vertices)
        contact.SetSearchTreeBox(vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist())
        spans = np.ptp(vertices, axis=0) / CELL
        contact.SetSearchTreeCellSize(np.clip(np.ceil(spans), 1, MOST_CELLS).astype(int).tolist())
        ground = system.AddMarker(items.MarkerBodyRigid(bodyNumber=system.AddObject(items.ObjectGround())))
        faces = np.asarray(tube.mesh.faces)[:, ::-1]
        contact.AddTrianglesRigidBodyBased(ground, STIFF, 0.0, 0, vertices.tolist(), faces.tolist(), True)
        for j, (body, stiffness) in enumerate(zip(bodies, wall_stiffness(run), strict=True), 1):
            arm, radius = float(run.S[state.ARM_CONTACT + j]), float(run.S[state.RADIUS + j])
            marker = system.AddMarker(items.MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, arm]))
            contact.AddSphereWithMarker(marker, radius, float(stiffness), run.laws.contact_damping, 0)

    def _sum_contact(self, speeds: Array) -> None:
        """Add the loads of Exudyn's contact to the sums of the run, those of the last step."""
        S, n, dt = self._run.S, self._run.segments, self._dt
        loads = np.array(self._contact.GetSystemODE2RhsContactForces()).reshape(n, 6)
        update_walls(S, self._run.owner, n, n, self._run.hole.pieces, self._run.laws.geometry)
        update_axes(S, n)
        outwards, axes, spins = (
            np.stack([state.row(S, row, n) for row in rows], axis=1)
            for rows in (
                (state.PX, state.PY, state.PZ), (state.AX, state.AY, state.AZ), (state.GX, state.GY, state.GZ),
            )
        )  # fmt: skip
        outwards /= np.linalg.norm(outwards, axis=1)[:, None]
        normal = -(loads[:, :3] * outwards).sum(axis=1)
        radius = state.row(S, state.RADIUS, n)
        swing = state.row(S, state.ARM_CONTACT, n)[:, None] * np.cross(spins, axes)
        approach = ((speeds[:, :3] + swing) * outwards).sum(axis=1)
        state.row(S, state.SUM_NORMAL, n)[:] += dt * normal
        state.row(S, state.SUM_R_MU_N, n)[:] += dt * radius * state.row(S, state.FRICTION, n) * normal
        state.row(S, state.SUM_FRICTION_TORQUE, n)[:] -= dt * loads[:, 5]
        state.row(S, state.LOST_FRICTION, n)[:] -= dt * ((loads * speeds).sum(axis=1) + normal * approach)

    def _given(self, system: Any, time: float, number: int, *coordinates: Any) -> Array:
        """Loads (6 n,) at the coordinates and the velocities half a step before, after the top drive has moved."""
        run, n, dt = self._run, self._run.segments, self._dt
        move_top(run.S, run.top, run.pipe, self._feed, self._rate, dt)
        speeds = self._put()
        if self._contact is not None:
            self._sum_contact(speeds)
        self._feed, self._rate = _hand_over(
            run.S, run.top, run.owner, n, run.hole.pieces, self._laws, self._motion, run.pipe, dt, speeds,
            self._inertia, self._loads,
        )  # fmt: skip
        return self._loads.ravel()

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        self._motion, self._dt = motion, duration / steps
        clock = self._solver.it
        clock.startTime, clock.currentTime, clock.endTime, clock.maxStepSize = 0.0, 0.0, duration, self._dt
        self._solver.SolveSteps(self._system, self._settings)
        self._run.steps += steps

    def refresh(self) -> None:
        """See ``Stepper.refresh``."""
        self._put()
        self._run.refresh()

    def _put(self) -> Array:
        """Write Exudyn's bodies into the run; returns their speeds (n, 6)."""
        n, data = self._run.segments, self._system.systemData
        places, speeds = (
            np.asarray(read(copy=False)).reshape(n, 6) for read in (data.GetODE2Coordinates, data.GetODE2Coordinates_t)
        )
        _store(self._run.S, n, places, speeds)
        return speeds

    def energy(self) -> Energy:
        """See ``Stepper.energy``."""
        return self._run.energy()

    def note(self) -> str:
        """See ``Stepper.note``."""
        return ""

    def close(self) -> None:
        """Release Exudyn's system."""
        self._container.Reset()


class ExudynOptions(FreeBodyOptions):
    """Options of Exudyn.

    contact : FCTD's ``wall``, or Exudyn's own of spheres with a ``mesh``, whose depth sums over neighbouring triangles.
    """

    contact: Literal["wall", "mesh"] = "wall"


class Exudyn(InWindows):
    """Rigid bodies on Exudyn's springs in FCTD's hole."""

    name: ClassVar[str] = "exudyn"
    distribution: ClassVar[str] = "exudyn"
    does: ClassVar[str] = "rigid bodies on Exudyn's springs, by its integrator; FCTD's wall, friction and top drive"
    honours: ClassVar[Collection[str]] = OWN - LEFT_OUT
    Options: ClassVar[type[Table]] = ExudynOptions

    def __init__(self, options: ExudynOptions) -> None:
        self._exudyn = need("exudyn", self.name)
        self.options = options

    def begin(self, run: Run) -> _Stepper:
        """See ``StringEngine.begin``."""
        tube, share = None, 1.0
        if self.options.contact == "mesh":
            share = MESH_SHARE
            refuse(run, HONOURS - LEFT_OUT, f"{self.name} with contact = mesh")
            tube = tube_of(run, self.options)
        return _Stepper(self._exudyn, run, tube, self.options.step or share * run.step)
