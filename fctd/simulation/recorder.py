"""What is kept of a run: history, profiles along the string, and the energy ledger."""

from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import energy_of, penetration
from fctd.model.operations import sensors
from fctd.results.notes import Note, string_notes
from fctd.results.profile import Loads, profile_table
from fctd.results.status import RunStatus
from fctd.results.tables import SimulationResult
from fctd.simulation.run import Run, contact_points

Array = NDArray[np.float64]

SAME_DEPTH = 1e-3  # [m]: the schedule meets its depths to the rounding of a step
SUMS = (
    state.SUM_NORMAL, state.SUM_FRICTION_TORQUE, state.SUM_R_MU_N,
    state.SUM_MUD_TORQUE, state.SUM_TENSION, state.SUM_TORQUE,
)  # fmt: skip
LOSSES = {
    "lost_friction_J": state.LOST_FRICTION,
    "lost_contact_J": state.LOST_CONTACT,
    "lost_mud_J": state.LOST_MUD,
    "lost_joints_J": state.LOST_JOINT,
}


def _work(energy: pd.DataFrame) -> float:
    """Energy turned over in a run [J]: the larger of all losses and of the top drive's work beyond lifting.

    Lifting and lowering move hundreds of times more energy back and forth, which would hide any error.  NaN where a
    term is no number.
    """
    losses = energy[list(LOSSES)].sum(axis=1, skipna=False)
    beyond = (energy["top_drive_work_J"] - energy["gravity_J"]).abs()
    return float(pd.concat([losses, beyond]).max(skipna=False))


class Recorder:
    """Reads a settled run at its start and after every record interval."""

    def __init__(self, run: Run) -> None:
        self.run = run
        self.start = energy_of(run.S, run.segments)
        self.start_depth = run.string.bit_depth
        self.start_length = float(run.top[topdrive.TOP_LENGTH])
        self.last_time = 0.0
        self.history: list[dict[str, Any]] = []
        self.ledger: list[dict[str, float]] = []
        self.profiles: dict[float, pd.DataFrame] = {}  # by time
        self.wanted = list(run.case.record.profile_at)
        self.mean = {offset: np.zeros(run.segments) for offset in SUMS}
        self.notes: dict[str, Note] = {}  # by code, the worst of each

    def rows(self, offset: int) -> Array:
        """One quantity of every segment."""
        return state.row(self.run.S, offset, self.run.segments)

    @property
    def bit_depth(self) -> float:
        """Unstretched length below the rotary table [m]."""
        return self.start_depth + float(self.run.top[topdrive.TOP_LENGTH]) - self.start_length

    def record(self, operation: int) -> None:
        """Append a row of history and ledger, and a profile at a wanted depth; start new sums."""
        top, case = self.run.top, self.run.case
        span = float(top[topdrive.TOP_TIME]) - self.last_time
        self.last_time = float(top[topdrive.TOP_TIME])
        for offset in SUMS:
            self.mean[offset] = self.rows(offset) / span
            self.rows(offset)[:] = 0.0
        hookload = float(top[topdrive.SUM_HOOKLOAD]) / span
        torque = float(top[topdrive.SUM_TOP_TORQUE]) / span
        top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] = 0.0

        kind = case.operations[operation].kind
        indicator, drive = sensors(case, kind, hookload, torque)
        before = self.history[-1]["bit_depth_m"] if self.history else self.start_depth
        self.history.append(
            {
                "time_s": self.last_time,
                "operation": kind,
                "bit_depth_m": self.bit_depth,
                "bit_md_m": self._bit_md(),
                "hookload_N": hookload,
                "surface_torque_N_m": torque,
                "weight_indicator_N": indicator,
                "drive_torque_N_m": drive,
                "sum_r_ft_N_m": float(self.mean[state.SUM_FRICTION_TORQUE].sum()),
                "sum_r_mu_fn_N_m": float(self.mean[state.SUM_R_MU_N].sum()),
                "mud_torque_N_m": float(self.mean[state.SUM_MUD_TORQUE].sum()),
                "total_contact_force_N": float(self.mean[state.SUM_NORMAL].sum()),
                "contact_count": int((penetration(self.run.S, self.run.segments) > 0).sum()),
            }
        )
        self.ledger.append(self._balance())
        self._look(hookload)
        low, high = sorted((before, self.bit_depth))
        passed = [depth for depth in self.wanted if low - SAME_DEPTH <= depth <= high + SAME_DEPTH]
        if passed:
            self.wanted = [depth for depth in self.wanted if depth not in passed]
            self.profiles[self.last_time] = self._profile()

    def result(self, status: RunStatus, message: str, wall: float, residual: float) -> SimulationResult:
        """Everything recorded, with the profile of the end and the numbers of the run."""
        run = self.run
        if self.history:
            self.profiles[self.last_time] = self._profile()
        energy = pd.DataFrame(self.ledger)
        work = _work(energy) if self.ledger else np.nan
        numbers = {
            "segments": run.segments,
            "pieces_of_hole": len(run.hole.pieces),
            "contact": run.case.wellbore.geometry if run.queried is None else run.queried.method.name,
            "step_s": run.step,
            "steps": run.steps,
            "simulated_s": self.last_time,
            "wall_s": wall,
            "real_time_factor": self.last_time / wall if wall > 0 else np.nan,
            "work_J": work,
            # The largest of the run: the residual of a swinging string passes through zero again and again.
            "energy_error": float(energy["residual_J"].abs().max(skipna=False)) / work if work > 0 else np.nan,
            "settling_residual": residual,
        }
        profile = pd.concat(list(self.profiles.values()), ignore_index=True) if self.profiles else pd.DataFrame()
        history, notes = pd.DataFrame(self.history), tuple(self.notes.values())
        return SimulationResult(run.case, status, message, history, profile, energy, numbers, notes)

    def _bit_md(self) -> float:
        """Where the bit is along the hole [m]."""
        run, n = self.run, self.run.segments
        place, arm = run.S[[state.X + n, state.Y + n, state.Z + n]], run.S[state.ARM_CONTACT + n]
        bit = place + arm * run.S[[state.AX + n, state.AY + n, state.AZ + n]]
        return float(run.hole.walls(bit, run.owner[n : n + 1])[0, 6])

    def _walls(self) -> tuple[Array, Array]:
        """Contact points (n, 3) [m] and the walls beside them (Wellbore.walls)."""
        points = contact_points(self.run.S, self.run.segments)
        return points, self.run.hole.walls(points, self.run.owner[1 : self.run.segments + 1])

    def _balance(self) -> dict[str, float]:
        """The ledger: energy held since the start, work and fed pipe as gains, losses, and what is left."""
        energy, top = energy_of(self.run.S, self.run.segments), self.run.top
        held = {f"{name}_J": now - then for name, now, then in zip(energy._fields, energy, self.start, strict=True)}
        gains = {
            "top_drive_work_J": float(top[topdrive.TOP_WORK]),
            "fed_pipe_J": float(top[topdrive.FED_ENERGY]),
        }
        losses = {name: float(self.rows(offset).sum()) for name, offset in LOSSES.items()}
        residual = sum(held.values()) + sum(losses.values()) - sum(gains.values())
        return {"time_s": self.last_time, **held, **gains, **losses, "residual_J": residual}

    def _look(self, hookload: float) -> None:
        """Keep a note that is new, or says worse than the one before."""
        run = self.run
        _, walls = self._walls()
        radius, in_hole = self.rows(state.RADIUS), run.case.contact.enabled
        for note in string_notes(run.string, self._loads(), hookload, walls, radius, in_hole=in_hole):
            if note.code not in self.notes or note.excess > self.notes[note.code].excess:
                self.notes[note.code] = replace(note, text=f"{note.text}, with the bit at {self.bit_depth:.0f} m")

    def _loads(self) -> Loads:
        """What the string carries: means over the last interval, bending as it is."""
        run = self.run
        axes = np.stack([run.S[a : a + run.segments + 1] for a in (state.AX, state.AY, state.AZ)], axis=1)
        turn = np.linalg.norm(np.diff(axes, axis=0), axis=1)
        tension, torque = self.mean[state.SUM_TENSION].copy(), self.mean[state.SUM_TORQUE].copy()
        if run.string.long_segment:
            # Half of a long segment's weight and mud is not lumped below but at the top.
            tension[0], torque[0] = (self.history[-1][name] for name in ("hookload_N", "surface_torque_N_m"))
        return Loads(
            tension=tension,
            torque=torque,
            bending=self.rows(state.K_BEND) * 2 * np.arcsin(np.minimum(0.5 * turn, 1.0)),
            normal=self.mean[state.SUM_NORMAL],
        )

    def _profile(self) -> pd.DataFrame:
        """The string from the top to the bit: loads are means over the last interval.

        A row per contact point and one for the top.
        """
        run = self.run
        points, walls = self._walls()
        top = run.S[[state.X, state.Y, state.Z]]
        table = profile_table(run.hole, run.string, run.case.mud.density, top, points, walls, self._loads())
        table.insert(0, "operation", self.history[-1]["operation"])
        table.insert(0, "bit_depth_m", self.bit_depth)
        return table
