"""The strings of a view: one for each bit depth of a chart, or one for each kept record of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, with_friction
from fctd.case.message import Message, within
from fctd.case.operation_names import kinds_of
from fctd.case.operations import KINDS
from fctd.model.depths import depths_of
from fctd.model.frames import hole_frame
from fctd.model.operations import rates_of_all
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.plots.tracks import side_force
from fctd.results.buckling import MODES
from fctd.results.status import SteadyStatus
from fctd.results.tables import SimulationResult
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from fctd.steady.torque_drag import Progress
from fctd.view.hole import DrawnHole, drawn_hole

if TYPE_CHECKING:
    import pandas as pd

# Columns of a profile, and of a run's segments, that a view keeps.
KEPT: Final = (
    "md_m", "contact_force_N", "effective_tension_N", "torque_N_m", "bending_moment_N_m", "von_mises_Pa",
    "clearance_m", "sinusoidal_limit_N", "helical_limit_N",
)  # fmt: skip
NEEDED: Final = (*KEPT, "offset_high_m", "offset_right_m", "buckling")
# More records would make a page that opens slowly.
MOST_RECORDS: Final = 200
RUN: Final = "run"


@dataclass(frozen=True)
class Snapshot:
    """A string at one bit depth or time.

    at : bit depth [m], or time [s]; group : operation of a chart, ``RUN`` of a run.  columns : of ``KEPT``,
    ``side_force`` [N/m], ``gap_m`` to the wall (0 in touch), ``contact_angle_deg`` and ``buckling`` (index into
    ``MODES``), each (n,), from the top to the bit; offset (n, 3) : from the axis of the hole [m].  Without a balance
    they are empty, and ``status`` says why.
    """

    group: str
    operation: str
    at: float
    bit_depth: float
    status: str
    hookload: float
    torque: float
    columns: Mapping[str, Array]
    offset: Array

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Contact points (n,) that bear on the wall."""
        return self.columns["contact_force_N"] > 0


@dataclass(frozen=True)
class Strings:
    """What a view shows.  along : what its slider goes over; left_out : depths at which there is no string, and why."""

    case: Case
    along: Literal["bit depth", "time"]
    snapshots: tuple[Snapshot, ...]
    drawn: DrawnHole
    left_out: str = ""

    @property
    def groups(self) -> list[str]:
        """Groups in order; the slider goes over the snapshots of one."""
        return list(dict.fromkeys(one.group for one in self.snapshots))

    def of(self, group: str) -> list[Snapshot]:
        """The snapshots of a group."""
        return [one for one in self.snapshots if one.group == group]

    @cached_property
    def typical_clearance(self) -> float:
        """Median clearance of all strings [m]."""
        found = [one.columns["clearance_m"] for one in self.snapshots if len(one.offset)]
        return float(np.median(np.concatenate(found))) if found else float("nan")


def of_chart(
    case: Case,
    operation: str | Sequence[str],
    bit_depths: float | str | Sequence[float | str],
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    progress: Progress | None = None,
    *,
    friction: FrictionChoice | None = None,
) -> Strings:
    """Steady strings of operations at bit depths.

    bit_depths, speed, rpm, flow : as for ``fctd.torque_drag``; friction : one set of factors.  Raises InputError where
    string and hole fit at none of the depths.
    """
    kinds = kinds_of(operation)
    rates, solver = rates_of_all(case, kinds, speed, rpm, flow), Solver(with_friction(case, friction))
    depths = depths_of(bit_depths, case, "bit_depths")
    points, unfit = [], dict[float, InputError]()
    for k, depth in enumerate(depths, start=1):
        try:
            laid = solver.lay_out(depth)
            points += [solver.solve_string(kind, rates[kind], laid) for kind in kinds]
        except InputError as error:
            unfit[depth] = error
        if progress is not None:
            progress(k, len(depths))
    if not points:
        raise next(iter(unfit.values()))
    points.sort(key=lambda point: kinds.index(point.operation))
    return replace(of_points(points, solver.hole), left_out=_left_out(unfit))


def _left_out(unfit: dict[float, InputError]) -> str:
    if not unfit:
        return ""
    depths = ", ".join(f"{depth:g}" for depth in unfit)
    return f"no string with the bit at {depths} m: {next(iter(unfit.values()))}"


def of_points(points: Sequence[Equilibrium], hole: Wellbore | None = None, drawn: DrawnHole | None = None) -> Strings:
    """Steady strings of one case; hole, drawn : the case's, if they have been made already."""
    case = points[0].case
    hole = build_wellbore(case) if hole is None else hole
    snapshots = tuple(
        Snapshot(
            point.operation, point.operation, point.bit_depth, point.bit_depth, _status(point), point.hookload,
            point.surface_torque, *(_values(point.profile, hole) if point.answered else _nothing()),
        )
        for point in points
    )  # fmt: skip
    drawn = drawn_hole(case, hole, case.string.top_md) if drawn is None else drawn
    return Strings(case, "bit depth", snapshots, drawn)


def of_run(result: SimulationResult, most: int = MOST_RECORDS) -> Strings:
    """The strings of a run in time, evenly chosen records where it keeps more than ``most``.

    Raises InputError for a result without records, or of a version that kept no offsets of the string.
    """
    table, history = result.segments, result.history
    if not len(history) or not len(table):
        raise InputError("a result with records", key="result", value=result.case.name)
    missing = sorted(set(NEEDED) - set(table.columns))
    if missing:
        expected = f"a run whose segments have {', '.join(missing)}: simulate the case again"
        raise InputError(expected, key="result", value=result.case.name)
    times = table["time_s"].unique()
    picked = times[np.unique(np.linspace(0, len(times) - 1, min(most, len(times))).round().astype(int))]
    return of_records(result.case, build_wellbore(result.case), table[table["time_s"].isin(picked)], history)


def of_records(case: Case, hole: Wellbore, table: pd.DataFrame, history: pd.DataFrame) -> Strings:
    """The strings of a run at the times of its segments ``table``; history : of the run, with these times."""
    records: dict[Any, dict[Any, Any]] = history.set_index("time_s").to_dict("index")
    snapshots = []
    for time, rows in table.groupby("time_s", sort=True):
        record = records[time]
        snapshots.append(
            Snapshot(
                RUN, str(record["operation"]), float(str(time)), float(record["bit_depth_m"]), "", record["hookload_N"],
                record["surface_torque_N_m"], *_values(rows, hole),
            )
        )  # fmt: skip
    top = min(case.string.top_md, *(float(one.columns["md_m"].min()) for one in snapshots))
    return Strings(case, "time", tuple(snapshots), drawn_hole(case, hole, max(top, 0.0)))


def _values(table: pd.DataFrame, hole: Wellbore) -> tuple[dict[str, Array], Array]:
    """Values and offset of a snapshot from a profile, or from the segments of a record."""
    values = {name: table[name].to_numpy(float) for name in KEPT}
    high, right = (table[f"offset_{name}_m"].to_numpy(float) for name in ("high", "right"))
    up, aside = hole_frame(hole.at(values["md_m"])[1])
    values["side_force"] = side_force(table, "length") if len(table) > 1 else np.zeros(len(table))
    # In touch the wall's spring is pressed in by less than a picture can show.
    values["gap_m"] = np.maximum(values["clearance_m"] - np.hypot(high, right), 0.0)
    values["contact_angle_deg"] = np.degrees(np.arctan2(right, high)) % 360 % 360
    values["buckling"] = np.array([MODES.index(mode) for mode in table["buckling"]], float)
    return values, high[:, None] * up + right[:, None] * aside


def _nothing() -> tuple[dict[str, Array], Array]:
    names = (*KEPT, "side_force", "gap_m", "contact_angle_deg", "buckling")
    return {name: np.empty(0) for name in names}, np.empty((0, 3))


def _status(point: Equilibrium) -> str:
    """What is to be said of a string that did not converge."""
    if point.status == SteadyStatus.CONVERGED:
        return ""
    words = point.status.replace("_", " ")
    return Message(f"{words}: {within(point.message)}") if point.message else words


def label_of_group(group: str) -> str:
    """A group in the driller's words."""
    return KINDS[group].label if group in KINDS else group
