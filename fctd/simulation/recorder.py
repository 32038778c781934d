"""The records of a run: history, profiles along the string, and the energy ledger."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import readings, state, topdrive
from fctd.mechanics.energy import Energy, penetration
from fctd.mechanics.joints import find_bends
from fctd.mechanics.moving_string import Sums
from fctd.mechanics.query import Walls
from fctd.mechanics.readings import Readings
from fctd.mechanics.rock import NO_ROCK
from fctd.model.operations import drive_torque, weight_indicator
from fctd.model.string_in_hole import squeeze_of
from fctd.results import ledger
from fctd.results.buckling import (
    HELICAL_LIMIT,
    MODE,
    NOT_BUCKLED,
    ROW_COLUMNS,
    SINUSOIDAL_LIMIT,
    Buckling,
    buckling_along,
    pipe_of,
)
from fctd.results.hanging_body import MOMENT
from fctd.results.profile import Loads, at_contacts, hanging_along, profile_table, stress_along
from fctd.results.status import RunStatus
from fctd.results.tables import SimulationResult
from fctd.simulation.guards import Guards
from fctd.simulation.preparation import contact_points
from fctd.simulation.run import Run
from fctd.simulation.series import SegmentSeries
from fctd.store.facts import Restorable

if TYPE_CHECKING:
    import pandas as pd


SAME_DEPTH = 1e-3  # [m]: the schedule reaches its depths to the rounding of a step


class Recorder(Restorable):
    """Reads a settled run at its start and after every record interval, without changing it.

    time : at the start [s]; energy : returns the string's energy, by default that of the run.  A checkpoint keeps what
    the next record needs, and chunks the records.
    """

    FACTS = ("start", "start_time", "last_time", "wanted", "mean", "guards", "series")

    def __init__(self, run: Run, time: float = 0.0, energy: Callable[[], Energy] | None = None) -> None:
        self.run = run
        self.energy = energy or run.energy
        self.start = self.energy()
        self.start_time = self.last_time = time
        self.mean = Sums._make((np.zeros(0),) * 6 + (0.0,) * 4)  # of the last record
        self.history: list[dict[str, Any]] = []
        self.ledger: list[dict[str, float]] = []
        self.profiles: dict[float, pd.DataFrame] = {}  # by time
        self.wanted = list(run.case.record.profile_at)
        self.guards = Guards(run)
        self.series = SegmentSeries()

    def rows(self, offset: int) -> Array:
        """One quantity of every segment (n,)."""
        return state.row(self.run.S, offset, self.run.segments)

    def record(self, operation: int, sums: Sums) -> None:
        """Append a row of history and ledger, and a profile at a depth of ``record.profile_at``.

        sums : drained from the run, over the time since the last record.
        """
        case, upper_end = self.run.case, self.run.upper_end
        self.mean = mean = sums.over(self.run.time - self.last_time)
        hookload, torque = mean.hookload, mean.top_torque
        span, self.last_time = self.run.time - self.last_time, self.run.time

        kind = case.operations[operation].kind
        spin = float(np.linalg.norm(self.run.S[[state.GX, state.GY, state.GZ]]))  # of the top drive, row 0
        steps = readings.drain(self.run.top)
        pull, turn = (0.0, 0.0) if upper_end.in_slips else (hookload, torque)  # of the string on block and drive
        before = self.history[-1]["bit_depth_m"] if self.history else upper_end.start_depth
        loads, (_, walls) = self._loads(), self._walls()
        limits, buckling = self._buckling(loads, walls)
        self.history.append(
            {
                "time_s": self.last_time,
                "operation": kind,
                "bit_depth_m": self.run.bit_depth,
                "bit_md_m": self._bit_md(),
                "hookload_N": hookload,
                "surface_torque_N_m": torque,
                "weight_indicator_N": weight_indicator(case.rig, upper_end.direction(kind), pull),
                "drive_torque_N_m": drive_torque(case.rig, spin, turn),
                "sum_r_ft_N_m": float(mean.friction_torque.sum()),
                "sum_r_mu_fn_N_m": float(mean.r_mu_normal.sum()),
                "mud_torque_N_m": float(mean.mud_torque.sum()),
                "total_contact_force_N": float(mean.normal.sum()),
                "contact_count": int((penetration(self.run.S, self.run.segments) > 0).sum()),
                **buckling.columns(),
                **_of_steps(steps, hookload, torque, span),
                "lateral_speed_m_s": float(np.sqrt((self._lateral_speeds() ** 2).mean())),
                **upper_end.columns(self.run),
                **self._bit(),
            }
        )
        row = ledger.entry(self.run.S, self.run.top, self.run.segments, self.start, self.energy())
        self.ledger.append({"time_s": self.last_time, **row})
        record = self.history[-1]
        pulls, turning = (hookload, record["hookload_min_N"]), (spin, torque)
        shown = record["weight_indicator_N"], record["drive_torque_N_m"], hookload if upper_end.in_slips else 0.0
        self.guards.timed(
            self.guards.check_record, self.run.bit_depth, pulls, loads, walls, buckling, row, turning, shown
        )
        self._keep_segments(loads, walls, limits)
        low, high = sorted((before, self.run.bit_depth))
        passed = [depth for depth in self.wanted if low - SAME_DEPTH <= depth <= high + SAME_DEPTH]
        if passed:
            self.wanted = [depth for depth in self.wanted if depth not in passed]
            self.profiles[self.last_time] = self._profile()

    def result(self, status: RunStatus, message: str, wall: float, residual: float) -> SimulationResult:
        """All records, with a profile at the end, unless the state there is not finite, and the numbers of the run."""
        import pandas as pd

        run = self.run
        profiles = dict(self.profiles)
        if self.history:
            sound = bool(np.isfinite(self._walls()[0]).all())
            if sound or not profiles:  # of a state that is not finite, the columns
                profiles[self.last_time] = self._profile() if sound else self._profile().iloc[:0]
        energy = pd.DataFrame(self.ledger)
        numbers = {
            "segments": run.segments,
            "pieces_of_hole": len(run.hole.pieces),
            "contact": run.wall.name,
            "step_s": run.step,
            "steps": run.steps,
            "simulated_s": self.last_time,
            "wall_s": wall,
            "real_time_factor": self.last_time / wall if wall > 0 else np.nan,
            "guards_s": self.guards.seconds,
            "work_J": ledger.work(energy),
            "energy_error": ledger.error(energy),
            "settling_residual": residual,
        }
        profile = pd.concat(list(profiles.values()), ignore_index=True) if profiles else pd.DataFrame()
        history, notes = pd.DataFrame(self.history), tuple(self.guards.notes.values())
        return SimulationResult(
            run.case, status, message, history, profile, energy, numbers, notes, run.case.warnings,
            segments=self.series.table(run.hole),
        )  # fmt: skip

    def _bit(self) -> dict[str, float]:
        """Loads and rotation of a bit on rock, means over the last interval, and the hole that it has made."""
        if self.run.laws.rock.law == NO_ROCK:
            return {}
        return {
            "weight_on_bit_N": self.mean.bit_weight,
            "bit_torque_N_m": self.mean.bit_torque,
            "hole_made_m": float(self.run.top[topdrive.HOLE_MADE]),
        }

    def _bit_md(self) -> float:
        """Measured depth of the bit [m]; segments keep the length that the mud's pressure left them where laid out."""
        run, n = self.run, self.run.segments
        string = run.laid_out
        laid = state.row(run.S, state.ARM_TOP, n).sum() + state.row(run.S, state.ARM_BOTTOM, n).sum()
        squeeze = squeeze_of(run.case, string, run.hole)
        shorter = float((string.length * (1 - squeeze)).sum() - laid)
        place, arm = run.S[[state.X + n, state.Y + n, state.Z + n]], run.S[state.ARM_CONTACT + n]
        bit = place + arm * run.S[[state.AX + n, state.AY + n, state.AZ + n]]
        return float(run.hole.walls(bit, run.owner[n : n + 1]).md[0]) + shorter

    def _lateral_speeds(self) -> Array:
        """Speeds of the segments (n,) across their own axes [m/s]."""
        velocity, axis = (
            np.stack([self.rows(offset) for offset in rows])
            for rows in ((state.VX, state.VY, state.VZ), (state.AX, state.AY, state.AZ))
        )
        square = (velocity**2).sum(axis=0) - (velocity * axis).sum(axis=0) ** 2
        return np.asarray(np.sqrt(np.maximum(square, 0.0)))

    def _walls(self) -> tuple[Array, Walls]:
        """Contact points (n, 3) [m] and the walls beside them."""
        points = contact_points(self.run.S, self.run.segments)
        near = self.run.owner[1 : self.run.segments + 1]
        return points, self.run.hole.walls(points, near, self.rows(state.RADIUS))

    def _buckling(self, loads: Loads, walls: Walls) -> tuple[Array | None, Buckling]:
        """Limits of ``buckling_along`` and where the string is buckled; a string without a wall is not judged."""
        run = self.run
        if not run.case.contact.enabled or loads.tension.min() >= 0:
            return None, NOT_BUCKLED
        top_md = run.string.top_md
        pipe = pipe_of(run.string)
        return buckling_along(run.hole, pipe, top_md, walls.md, walls.radius, loads.tension, loads.bit_tension)

    def _keep_segments(self, loads: Loads, walls: Walls, limits: Array | None) -> None:
        """Add the contact points to the series where it keeps this record."""
        if not self.series.wants_next:
            self.series.skip()
            return
        string, n = self.run.string, self.run.segments
        tension, twist = at_contacts(string, loads)
        hanging = hanging_along(self.run.hole, string, loads, walls.md, self.run.case.contact.enabled)
        excess = self.run.excess_pressure()
        stress = stress_along(string, tension, twist, hanging[:, MOMENT], excess)
        rows = np.full((n + 1, ROW_COLUMNS), np.nan) if limits is None else limits
        mode = np.zeros(n) if limits is None else limits[1:, MODE]
        self.series.add(
            self.last_time, self.run.bit_depth, walls.md,
            (tension[1:], twist[1:], loads.normal, hanging[1:, MOMENT], stress[1:]),
            walls.radius - string.contact_radius(), rows[1:, [SINUSOIDAL_LIMIT, HELICAL_LIMIT]], mode, walls.offset,
        )  # fmt: skip

    def _loads(self) -> Loads:
        """Loads of the string: means over the last interval, but bending at its end."""
        run = self.run
        bends = np.empty(run.segments)
        find_bends(run.S, run.segments, bends)
        tension, torque = self.mean.tension.copy(), self.mean.torque.copy()
        if run.string.long_segment:
            # Half of a long segment's weight and mud load is lumped at the top.
            tension[0], torque[0] = self.mean.hookload, self.mean.top_torque
        return Loads(
            tension=tension,
            torque=torque,
            bending=self.rows(state.K_BEND) * bends,
            normal=self.mean.normal,
        )

    def _profile(self) -> pd.DataFrame:
        """Profile from the top to the bit: a row for the top and one per contact point.

        Loads are means over the last interval.
        """
        run = self.run
        points, walls = self._walls()
        top = run.S[[state.X, state.Y, state.Z]]
        table = profile_table(
            run.hole, run.string, run.case.mud.density, top, points, walls, self._loads(), run.case.contact.enabled,
            run.friction,
        )  # fmt: skip
        table.insert(0, "operation", self.history[-1]["operation"])
        table.insert(0, "bit_depth_m", self.run.bit_depth)
        return table


def _of_steps(steps: Readings, hookload: float, torque: float, span: float) -> dict[str, float]:
    """Columns of the readings of all steps; an engine that keeps none has its means, and no rotation of the bit."""
    low, high = steps.hookload if steps.known else (hookload, hookload)
    least, most = steps.torque if steps.known else (torque, torque)
    turns = 60 / (2 * np.pi * span)
    return {
        "hookload_min_N": low,
        "hookload_max_N": high,
        "surface_torque_min_N_m": least,
        "surface_torque_max_N_m": most,
        "top_rpm": steps.top_angle * turns if steps.known else np.nan,
        "bit_rpm": steps.bit_angle * turns if steps.known else np.nan,
        "bit_still_s": steps.bit_still if steps.known else np.nan,
    }
