"""MuJoCo's native model of a string: nested rigid bodies on ball joints, its springs and integrator, no contact.

For freely hanging strings.  A ball joint has one stiffness for bending and twist, here that of twist, and does not
stretch; the chain hangs from a body that the top drive turns.  With contact it cannot represent a string: nested
bodies leave the hole.
"""

from collections.abc import Collection
from typing import Any, ClassVar

import numpy as np

from fctd.case.errors import InputError, Table
from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.topdrive import Motion, planned_speeds
from fctd.simulation.run import Run
from references.engines import StepOptions, need
from references.engines.run import InWindows

# Step over the stability limit of the chain's twist.
SHARE = 0.5


class _Stepper:
    """A chain in MuJoCo that starts straight and untwisted below the top drive of a run."""

    def __init__(self, mujoco: Any, run: Run, step: float | None) -> None:
        self._mujoco, self._run = mujoco, run
        n = run.segments
        self._twist = state.row(run.S, state.K_TWIST, n).copy()
        fastest = np.sqrt(4 * self._twist / state.row(run.S, state.J_AXIAL, n)).max()
        self.step = step or float(SHARE * 2 / fastest)
        self._model = mujoco.MjModel.from_xml_string(_model(run))
        self._data = mujoco.MjData(self._model)
        self._turned = 0.0
        mujoco.mj_forward(self._model, self._data)

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        run, model, data, mujoco = self._run, self._model, self._data, self._mujoco
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        dt = duration / steps
        model.opt.timestep = dt
        for _ in range(steps):
            _, rate = planned_speeds(run.top, motion, dt)
            model.qpos_spring[:4] = np.cos(0.5 * self._turned), 0.0, 0.0, np.sin(0.5 * self._turned)
            mujoco.mj_step(model, data)
            self._turned += dt * rate
            torque, hookload = self._loads()
            run.top[topdrive.SUM_HOOKLOAD] += dt * hookload
            run.top[topdrive.SUM_TOP_TORQUE] += dt * torque
            run.top[topdrive.TOP_WORK] += dt * rate * torque
            run.top[topdrive.TOP_TIME] += dt
        run.steps += steps

    def _angles(self) -> np.ndarray:
        """Twist of every joint [rad]."""
        quaternion = self._data.qpos.reshape(-1, 4)
        twist = 2 * np.arctan2(quaternion[:, 3], quaternion[:, 0])
        twist[0] -= self._turned
        return np.asarray((twist + np.pi) % (2 * np.pi) - np.pi)

    def _loads(self) -> tuple[float, float]:
        """Torque of the first joint [N m] and hook load of the chain [N]."""
        self._mujoco.mj_rnePostConstraint(self._model, self._data)
        first = self._angles()[0]
        return -float(self._twist[0] * first), -float(self._data.cfrc_int[1, 5])

    def refresh(self) -> None:
        """Write the bodies into the run."""
        run, data, n = self._run, self._data, self._run.segments
        velocity = np.zeros(6)
        for j in range(1, n + 1):
            body = j + 1  # body 1 is the one from which the chain hangs
            for k, row in enumerate((state.X, state.Y, state.Z)):
                run.S[row + j] = data.xipos[body, k]
            for k, row in enumerate((state.QW, state.QX, state.QY, state.QZ)):
                run.S[row + j] = data.xquat[body, k]
            self._mujoco.mj_objectVelocity(self._model, data, self._mujoco.mjtObj.mjOBJ_BODY, body, velocity, 1)
            for k, row in enumerate((state.WX, state.WY, state.WZ)):
                run.S[row + j] = velocity[k]
        run.refresh()

    def energy(self) -> Energy:
        """See ``Stepper.energy``: MuJoCo's energies; its springs have the same stiffness about all axes."""
        self._mujoco.mj_energyPos(self._model, self._data)
        self._mujoco.mj_energyVel(self._model, self._data)
        spring = 0.5 * float((self._twist * self._angles() ** 2).sum())
        return Energy(float(self._data.energy[1]), float(self._data.energy[0]) - spring, spring, 0.0)

    def note(self) -> str:
        """See ``Stepper.note``."""
        return ""

    def close(self) -> None:
        """MuJoCo holds nothing but memory."""


def _model(run: Run) -> str:
    """The chain in MuJoCo's XML: buoyed weight as gravity on the mass of the steel."""
    S, n = run.S, run.segments
    gravity = state.row(S, state.WEIGHT, n).sum() / state.row(S, state.MASS, n).sum()
    inside = ""
    for j in range(n, 0, -1):
        top = S[state.ARM_TOP + j]
        mass, across, along = (float(S[row + j]) for row in (state.MASS, state.J_TRANSVERSE, state.J_AXIAL))
        above = S[state.ARM_TOP + j - 1] + S[state.ARM_BOTTOM + j - 1] if j > 1 else 0.0
        inside = (
            f'<body pos="0 0 {float(above)!r}"><joint type="ball" stiffness="{float(S[state.K_TWIST + j])!r}"/>'
            f'<inertial pos="0 0 {float(top)!r}" mass="{mass!r}" diaginertia="{across!r} {across!r} {along!r}"/>'
            f"{inside}</body>"
        )
    start = " ".join(repr(float(S[row])) for row in (state.X, state.Y, state.Z))
    return (
        f'<mujoco><compiler balanceinertia="false"/><option gravity="0 0 {float(gravity)!r}" '
        f'integrator="implicitfast"/><worldbody><body pos="{start}">{inside}</body></worldbody></mujoco>'
    )


class MuJoCoChain(InWindows):
    """Nested bodies on ball joints, hanging freely."""

    name: ClassVar[str] = "mujoco_chain"
    distribution: ClassVar[str] = "mujoco"
    does: ClassVar[str] = "nested bodies on ball joints, MuJoCo's native model; freely hanging strings without a wall"
    honours: ClassVar[Collection[str]] = frozenset({"no_wall"})
    Options: ClassVar[type[Table]] = StepOptions

    def __init__(self, options: StepOptions) -> None:
        self._mujoco = need("mujoco", self.name)
        self.options = options

    def begin(self, run: Run) -> _Stepper:
        """See ``StringEngine.begin``."""
        if run.top[topdrive.TOP_TIME] > 0:
            raise InputError(f"a window that starts at 0 s with {self.name}", key="window", value="a moving string")
        return _Stepper(self._mujoco, run, self.options.step)
