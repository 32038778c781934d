"""The string as a Cosserat rod in PyElastica: PyElastica's beam and integrator, FCTD's wall test and friction at nodes.

Elements are the segments: PyElastica's rod has its springs in the elements (stretch, shear) and between them (bending,
twist).  Rotary inertia across the rod is that of a rigid segment, mL²/12; with that of the pipe's cross-section the
step would be hundreds of times shorter.  PyElastica has no contact with a tube and no friction on it, so both are
external forces that are computed here.
"""

from collections.abc import Collection
from types import ModuleType
from typing import Any, ClassVar, Literal

import numpy as np
from numba import njit
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.case.errors import Table
from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.query import WALL_COLUMNS, query_walls, walls_in
from fctd.mechanics.topdrive import Motion, planned_speeds
from fctd.simulation.run import Run
from references.engines import StepOptions, need
from references.engines.run import InWindows

# Step over the stable step, found by the ladder of best_step.py: PyElastica's gyroscopic moments are explicit and add
# energy to a spinning rod, with twice this step a sixth of the work within ten seconds.
STEP_SHARE = 0.13


@njit(error_model="numpy", cache=True)
def _touch(S, n, walls, mass, place, speed, directors, omega, force, torque, damping, dt):  # type: ignore[no-untyped-def]
    """Add the wall's force at nodes 1..n and its moment on the element above; update sums and losses in S.

    walls (n, 7) : nearest wall of each node, as of ``query_walls``; other arrays in PyElastica's layout: (3, nodes),
    (3, 3, elements), (3, elements).
    """
    for j in range(1, n + 1):
        wall = walls[j - 1]
        radius = S[state.RADIUS + j]
        distance = np.sqrt(wall[0] * wall[0] + wall[1] * wall[1] + wall[2] * wall[2])
        depth = distance - wall[3] + radius
        if depth <= 0:
            continue
        nx, ny, nz = wall[0] / distance, wall[1] / distance, wall[2] / distance
        stiffness = wall[4] * S[state.TRIBUTARY + j]
        vx, vy, vz = speed[0, j], speed[1, j], speed[2, j]
        into = vx * nx + vy * ny + vz * nz
        normal = max(stiffness * depth + damping * into, 0.0)
        k = j - 1
        # Angular velocity of the element above, global.
        wx, wy, wz = 0.0, 0.0, 0.0
        for i in range(3):
            wx += directors[i, 0, k] * omega[i, k]
            wy += directors[i, 1, k] * omega[i, k]
            wz += directors[i, 2, k] * omega[i, k]
        rx, ry, rz = radius * nx, radius * ny, radius * nz
        sx, sy, sz = vx + wy * rz - wz * ry, vy + wz * rx - wx * rz, vz + wx * ry - wy * rx
        along = sx * nx + sy * ny + sz * nz
        sx, sy, sz = sx - along * nx, sy - along * ny, sz - along * nz
        slip = np.sqrt(sx * sx + sy * sy + sz * sz) + state.TINY
        # Implicit limit as in FCTD: friction at most stops the point within the step.
        response = 1 / mass[j] + radius * radius * S[state.INVERSE_JA + j]
        limit = wall[5] * normal
        friction = min(limit, slip / (dt * response))
        fx, fy, fz = -friction * sx / slip, -friction * sy / slip, -friction * sz / slip
        mx, my, mz = ry * fz - rz * fy, rz * fx - rx * fz, rx * fy - ry * fx
        force[0, j] += fx - normal * nx
        force[1, j] += fy - normal * ny
        force[2, j] += fz - normal * nz
        for i in range(3):
            torque[i, k] += directors[i, 0, k] * mx + directors[i, 1, k] * my + directors[i, 2, k] * mz
        about = directors[2, 0, k] * mx + directors[2, 1, k] * my + directors[2, 2, k] * mz
        S[state.SUM_NORMAL + j] += dt * normal
        S[state.SUM_R_MU_N + j] += dt * radius * limit
        S[state.SUM_FRICTION_TORQUE + j] -= dt * about
        S[state.LOST_FRICTION + j] += dt * friction * slip
        S[state.LOST_CONTACT + j] += dt * (normal - stiffness * depth) * into


class _Surroundings:
    """Wall, weight and the sums that FCTD's recorder reads; called by PyElastica in the middle of each step."""

    def __init__(self, run: Run) -> None:
        n = run.segments
        self.run, self.owner, self.walls = run, run.owner[1 : n + 1].copy(), np.empty((n, WALL_COLUMNS))
        # A long segment hangs half by its lower end, like any other element by its two nodes.
        weight = run.string.weight * _lengths(run)
        self.weight = 0.5 * (np.append(weight, 0.0) + np.append(0.0, weight))
        self.axis = run.S[[state.AX, state.AY, state.AZ]].copy()  # axis of the top drive
        # The driven end starts with the velocity of the first segment if pipe is fed: the whole segment then moves.
        first = run.S[[state.VX + 1, state.VY + 1, state.VZ + 1]]
        self.feed = float(first @ self.axis) if run.string.long_segment else 0.0
        self.dt, self.rate = 0.0, float(run.S[state.WZ + 1])
        self.gained = (0.0, 0.0)  # change of feed and rate over the step

    def apply(self, rod: Any) -> None:
        """Add the external forces and torques of the present step to the rod, and the sums of the recorder."""
        run, dt = self.run, self.dt
        S, n = run.S, run.segments
        if run.laws.geometry != state.OPEN:
            points = np.ascontiguousarray(rod.position_collection[:, 1:].T)
            query_walls(run.hole.pieces, run.laws.geometry, points, self.owner, self.walls)
            _touch(
                S, n, self.walls, rod.mass, rod.position_collection, rod.velocity_collection,
                rod.director_collection, rod.omega_collection, rod.external_forces, rod.external_torques,
                run.laws.contact_damping, dt,
            )  # fmt: skip
        rod.external_forces[2] += self.weight
        tension = rod.internal_stress[2]
        # PyElastica's internal stress has to be divided by the stretch.  The top drive carries and accelerates the
        # driven node and element, against the friction of the node below, which acts on that element.
        pull = rod.director_collection[:, :, 0].T @ rod.internal_stress[:, 0] / rod.dilatation[0]
        hanging = float(self.axis @ pull + self.axis[2] * self.weight[0])
        hookload = hanging - float(rod.mass[0]) * self.gained[0] / dt
        inertia = rod.mass_second_moment_of_inertia[2, 2, 0]
        torque = float(inertia * self.gained[1] / dt - rod.internal_couple[2, 0] - rod.external_torques[2, 0])
        run.top[topdrive.SUM_HOOKLOAD] += dt * hookload
        run.top[topdrive.SUM_TOP_TORQUE] += dt * torque
        run.top[topdrive.TOP_WORK] += dt * (torque * self.rate - hookload * self.feed)
        state.row(S, state.SUM_TENSION, n)[:] += dt * tension
        state.row(S, state.SUM_TORQUE, n)[1:] -= dt * rod.internal_couple[2]
        state.row(S, state.SUM_TORQUE, n)[0] += dt * torque


class _Stepper:
    """A rod of PyElastica, started from the bodies of a run."""

    def __init__(self, elastica: ModuleType, run: Run, step: float | None, rotary: str) -> None:
        self._run, self._around = run, _Surroundings(run)
        self._rod = _rod(elastica, run, rotary)
        best = STEP_SHARE * 2 / _fastest(run, self._rod)
        self.step = step or best
        self._time, self._simulator, self._stepper = (
            np.float64(0.0),
            _simulator(elastica, self),
            elastica.PositionVerlet(),
        )

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        run, around = self._run, self._around
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        around.dt = duration / steps
        for _ in range(steps):
            feed, rate = planned_speeds(run.top, motion, around.dt)
            around.gained = (feed - around.feed, rate - around.rate)
            around.feed, around.rate = feed, rate
            self._time = self._stepper.step(self._simulator, self._time, np.float64(around.dt))
            run.top[topdrive.TOP_TIME] += around.dt
            run.top[topdrive.TOP_LENGTH] += around.dt * around.feed
        run.steps += steps

    def drive(self, rod: Any) -> None:
        """Set the motion of the upper end by the top drive: velocity of the first node, spin of the first element."""
        rod.velocity_collection[:, 0] = self._around.feed * self._around.axis
        rod.omega_collection[:, 0] = 0.0, 0.0, self._around.rate

    def refresh(self) -> None:
        """Write the rod into the run as rigid segments between its nodes."""
        S, n, rod = self._run.S, self._run.segments, self._rod
        axes = rod.tangents.T
        nodes, speeds = rod.position_collection.T, rod.velocity_collection.T
        frames = rod.director_collection
        turns = Rotation.from_matrix(frames.transpose(2, 1, 0)).as_quat(scalar_first=True)
        spins = rod.omega_collection
        bottom = state.row(S, state.ARM_BOTTOM, n)
        S[[state.X, state.Y, state.Z]] = nodes[0]
        middle = nodes[1:] - bottom[:, None] * axes
        mean = np.where(bottom[:, None] > 0, 0.5 * (speeds[1:] + speeds[:-1]), speeds[1:])
        for k in range(3):
            state.row(S, (state.X, state.Y, state.Z)[k], n)[:] = middle[:, k]
            state.row(S, (state.VX, state.VY, state.VZ)[k], n)[:] = mean[:, k]
            state.row(S, (state.WX, state.WY, state.WZ)[k], n)[:] = spins[k]
        # One sign of the quaternions along the string, so that neighbours differ little.
        turns[1:] *= np.cumprod(np.where((turns[1:] * turns[:-1]).sum(axis=1) < 0, -1.0, 1.0))[:, None]
        for k, row in enumerate((state.QW, state.QX, state.QY, state.QZ)):
            state.row(S, row, n)[:] = turns[:, k]
        self._run.refresh()

    def energy(self) -> Energy:
        """See ``Stepper.energy``: energy of the rod, in PyElastica's measure of strain."""
        run, rod = self._run, self._rod
        rod.compute_internal_forces_and_torques(self._time)
        stretch = 0.5 * (rod.internal_stress * rod.sigma * rod.rest_lengths).sum()
        bend = 0.5 * (rod.bend_matrix[[0, 1, 2], [0, 1, 2]] * rod.kappa**2 * rod.rest_voronoi_lengths).sum()
        moving = 0.5 * (rod.mass * (rod.velocity_collection**2).sum(axis=0)).sum()
        inertia = rod.mass_second_moment_of_inertia[[0, 1, 2], [0, 1, 2]]
        turning = 0.5 * (inertia * rod.omega_collection**2).sum()
        contact = 0.0
        if run.laws.geometry != state.OPEN:
            n = run.segments
            query_walls(
                run.hole.pieces, run.laws.geometry, np.ascontiguousarray(rod.position_collection[:, 1:].T),
                self._around.owner, self._around.walls,
            )  # fmt: skip
            walls = walls_in(self._around.walls)
            depth = np.linalg.norm(walls.offset, axis=1) - walls.radius + state.row(run.S, state.RADIUS, n)
            stiffness = walls.stiffness * state.row(run.S, state.TRIBUTARY, n)
            contact = 0.5 * float((stiffness * np.maximum(depth, 0.0) ** 2).sum())
        gravity = -float(self._around.weight @ rod.position_collection[2])
        return Energy(float(moving + turning), gravity, float(stretch + bend), contact)

    def note(self) -> str:
        """See ``Stepper.note``."""
        return ""

    def close(self) -> None:
        """PyElastica holds nothing but memory."""


def _lengths(run: Run) -> Array:
    """Present lengths of the segments (n,) [m]; the pipe fed so far is part of a long segment."""
    length = run.string.length.copy()
    if run.string.long_segment:
        length[0] = run.top[topdrive.TOP_LENGTH]
    return length


def _rod(elastica: ModuleType, run: Run, rotary: str) -> Any:
    """A rod whose elements are the segments of a run, with their poses and velocities."""
    S, n, string = run.S, run.segments, run.string
    length = _lengths(run)
    columns = [
        np.stack([state.row(S, k, n) for k in rows], axis=1)
        for rows in (
            (state.X, state.Y, state.Z),
            (state.VX, state.VY, state.VZ),
            (state.GX, state.GY, state.GZ),
            (state.AX, state.AY, state.AZ),
            (state.QW, state.QX, state.QY, state.QZ),
            (state.WX, state.WY, state.WZ),
        )
    ]
    centre, speed, spin, axis, turn, own_spin = columns
    bottom = state.row(S, state.ARM_BOTTOM, n)[:, None]
    nodes = np.vstack([S[[state.X, state.Y, state.Z]], centre + bottom * axis])
    speeds = np.vstack([S[[state.VX, state.VY, state.VZ]], speed + np.cross(spin, bottom * axis)])
    frames = Rotation.from_quat(turn, scalar_first=True).as_matrix()  # columns: the axes of the body
    directors = np.ascontiguousarray(frames.transpose(2, 1, 0))
    # A joint opens between its segments, while the rod stretches in its elements: its nodes are in the middle of the
    # open joints.  The joint below a long segment belongs to the segment below it.
    open_joint = (centre - state.row(S, state.ARM_TOP, n)[:, None] * axis)[1:] - nodes[1:-1]
    if string.long_segment:
        open_joint[0] = 0.0
    nodes[1:-1] += 0.5 * open_joint
    tangent = np.diff(nodes, axis=0)
    distance = np.linalg.norm(tangent, axis=1)
    # PyElastica's constructor needs directors along its elements; the true ones, set below, are inclined by shear.
    tangent /= distance[:, None]
    side = frames[:, :, 0] - (frames[:, :, 0] * tangent).sum(axis=1, keepdims=True) * tangent
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    upright = np.stack([side, np.cross(tangent, side), tangent]).transpose(0, 2, 1)
    rod = elastica.CosseratRod.straight_rod(
        n, start=nodes[0], direction=tangent[0], normal=side[0].copy(), base_length=float(length.sum()),
        base_radius=float(string.sections[0].outer), density=float(string.sections[0].mass), youngs_modulus=1.0,
        shear_modulus=1.0, position=np.ascontiguousarray(nodes.T), directors=np.ascontiguousarray(upright),
    )  # fmt: skip
    rod.director_collection[:] = directors
    rod.rest_lengths[:] = length
    rod.rest_voronoi_lengths[:] = 0.5 * (length[1:] + length[:-1])
    mass, tilt, along = (string.of(name) * length for name in ("mass", "tilt_inertia", "axial_inertia"))
    rod.mass[:] = 0.5 * (np.append(mass, 0.0) + np.append(0.0, mass))
    across = tilt + (mass * length**2 / 12 if rotary == "segment" else 0.0)
    joints = {row: state.row(S, row, n)[1:] * rod.rest_voronoi_lengths for row in (state.K_BEND, state.K_TWIST)}
    for matrix, values in (
        (rod.shear_matrix, (string.of("shear"), string.of("shear"), string.of("EA"))),
        (rod.bend_matrix, (joints[state.K_BEND], joints[state.K_BEND], joints[state.K_TWIST])),
        (rod.mass_second_moment_of_inertia, (across, across, along)),
        (rod.inv_mass_second_moment_of_inertia, (1 / across, 1 / across, 1 / along)),
    ):
        matrix[:] = 0.0
        for k, value in enumerate(values):
            matrix[k, k] = value
    rod.velocity_collection[:], rod.omega_collection[:] = speeds.T, own_spin.T
    return rod


def _fastest(run: Run, rod: Any) -> float:
    """Highest angular frequency of the rod [rad/s]: stretch, twist, or an element's turning against shear."""
    string, length = run.string, rod.rest_lengths
    node = np.minimum(rod.mass[1:], np.append(rod.mass[1:-1], np.inf))
    stretch = 4 * string.of("EA") / length / node
    wall = (
        run.hole.stiffest_wall * state.row(run.S, state.TRIBUTARY, run.segments)
        if run.laws.geometry != state.OPEN
        else 0.0
    )
    shear = string.of("shear") * length / rod.mass_second_moment_of_inertia[0, 0]
    turning = shear + 4 * string.of("shear") / length / node + wall / rod.mass[1:]
    twist = 4 * state.row(run.S, state.K_TWIST, run.segments) / rod.mass_second_moment_of_inertia[2, 2]
    return float(np.sqrt(max(stretch.max(), turning.max(), twist[1:].max())))


def _simulator(elastica: ModuleType, stepper: _Stepper) -> Any:
    """PyElastica's system of the rod, its driven end and its external forces."""

    class DrivenEnd(elastica.ConstraintBase):  # type: ignore[name-defined,misc]
        def constrain_values(self, system: Any, time: Any) -> None:
            """Position and direction follow from the rates."""

        def constrain_rates(self, system: Any, time: Any) -> None:
            stepper.drive(system)

    class ExternalForces(elastica.NoForces):  # type: ignore[name-defined,misc]
        def apply_forces(self, system: Any, time: Any = 0.0) -> None:
            stepper._around.apply(system)

    class Simulator(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):  # type: ignore[name-defined,misc]
        pass

    simulator = Simulator()
    simulator.append(stepper._rod)
    simulator.constrain(stepper._rod).using(DrivenEnd)
    simulator.add_forcing_to(stepper._rod).using(ExternalForces)
    simulator.finalize()
    return simulator


class ElasticaOptions(StepOptions):
    """Options of PyElastica.

    rotary : inertia of an element about its cross axes: that of a rigid ``segment``, mL²/12, or that of the
    cross-section of the ``pipe``, which is PyElastica's default and limits the step.
    """

    rotary: Literal["segment", "pipe"] = "segment"


class Elastica(InWindows):
    """A Cosserat rod of PyElastica in FCTD's hole."""

    name: ClassVar[str] = "elastica"
    distribution: ClassVar[str] = "pyelastica"
    does: ClassVar[str] = "Cosserat rod; PyElastica's beam and integrator, FCTD's wall test and friction"
    honours: ClassVar[Collection[str]] = frozenset({"wall", "no_wall", "feed", "incline", "friction_along_hole"})
    Options: ClassVar[type[Table]] = ElasticaOptions

    def __init__(self, options: ElasticaOptions) -> None:
        self._elastica = need("elastica", self.name)
        self.options = options

    def begin(self, run: Run) -> _Stepper:
        """See ``StringEngine.begin``."""
        return _Stepper(self._elastica, run, self.options.step, self.options.rotary)
