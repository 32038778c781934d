"""The result of a comparison of contact methods and engines on one well: one schema for screen, files and pictures.

Values are SI but for the units that names state.  ``model_dump_json`` writes a comparison, ``model_validate_json``
reads it, with numpy and pydantic alone.
"""

import math
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BaseModel, ConfigDict, Field

from fctd.case.systems import System

SCHEMA = 1
# measured: it answered, whatever its answers are worth.  not run: nothing was asked of it.
Status = Literal["measured", "failed", "refused", "not installed", "not run"]
Kind = Literal["contact", "engine"]


class _Part(BaseModel):
    """A part of a result: it has no other keys, and a number that is not finite is null in JSON."""

    model_config = ConfigDict(extra="forbid", ser_json_inf_nan="null")


class Quartiles(_Part):
    """A measured time or ratio: its median, and the quartiles of its rounds."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, values: ArrayLike) -> "Quartiles":
        """The quartiles of values, at least one."""
        low, median, high = np.percentile(np.asarray(values, dtype=float), [25, 50, 75])
        return cls(median=float(median), low=float(low), high=float(high))

    def times(self, factor: float) -> "Quartiles":
        """The same in another unit."""
        return Quartiles(median=factor * self.median, low=factor * self.low, high=factor * self.high)

    @property
    def all(self) -> tuple[float, float, float]:
        """Median, low and high."""
        return self.median, self.low, self.high

    def __format__(self, spec: str) -> str:
        """The median, and the quartiles in brackets: ``1.32 (1.3 to 1.34)``."""
        return "{:{spec}} ({:{spec}} to {:{spec}})".format(*self.all, spec=spec)

    def over(self, other: "Quartiles") -> "Quartiles":
        """The ratio to what was not measured in the same rounds: no ratio of two quartiles lies outside."""
        return Quartiles(median=self.median / other.median, low=self.low / other.high, high=self.high / other.low)


class WallErrors(_Part):
    """Errors of a method's wall at points near the wall of the hole.

    region : of the hole; empty for all of it.  points : asked; touching : of them, by the reference; no_answer :
    without a penetration or a clearance.  largest_penetration_m, rms_penetration_m : errors where the method has an
    answer; largest_angle_deg : of a normal where the point touches too; largest_md_m : of the measured depth.
    depth_over_bound, angle_over_bound : the largest errors in parts of what the geometry of the method allows there.
    missed, false_contacts : points that touch by the reference alone, and by the method alone; missed_beyond_m : how
    much deeper than its bound the deepest of the missed lies.
    """

    region: str = ""
    points: int
    touching: int
    no_answer: int
    largest_penetration_m: float | None
    rms_penetration_m: float | None = None
    largest_angle_deg: float | None
    largest_md_m: float | None = None
    depth_over_bound: float | None = None
    angle_over_bound: float | None = None
    missed: int
    missed_beyond_m: float = 0.0
    false_contacts: int


class Cost(_Part):
    """What a method costs.

    points : of a call.  point_ns : processor time of a point; kernels, arcs : the same in columns of the reference
    kernel, and in points of the engine's own arcs, from ratios within the rounds.
    """

    points: int
    point_ns: Quartiles
    kernels: Quartiles
    arcs: Quartiles | None = None


class Loads(_Part):
    """Loads of a string over the window, means under a Hann window.

    status, message : of the checks of the run.  force_off_N, force_off_md_m : largest difference of a contact force
    from that of the engine's own arcs, and where; forces_N : of the contact points from the top.  step_us : processor
    time of a step; step_kernels : the same in columns of the reference kernel, from ratios within the records.
    energy_error : of the window, a jump from one wall to the other included.
    """

    status: str
    message: str
    hookload_N: float | None
    surface_torque_N_m: float | None
    sum_r_mu_fn_N_m: float | None
    force_off_N: float | None
    force_off_md_m: float | None
    forces_N: list[float | None] = Field(repr=False)
    step_us: Quartiles
    step_kernels: Quartiles | None = None
    step_s: float
    steps: int
    energy_error: float | None


class Row(_Part):
    """A contact method or an engine.

    status, reason : of its answers.  broken : what it breaks of the contract of contact methods, or of the gate of
    engines; None where it was not held to them.  remarks : what breaks neither.  errors, regions : at all points, and
    at those of each region.  costs : of a point, in calls of each size.  memory_MB, build_s : growth of resident
    memory and time of building it.  loads_reason : why it has no loads; predicted_s : the time that they were expected
    to take.
    """

    kind: Kind
    name: str
    options: dict[str, Any] = {}
    package: str = ""
    version: str | None = None
    licence: str | None = None
    status: Status = "not run"
    reason: str = ""
    broken: list[str] | None = None
    remarks: list[str] = []
    pieces: int | None = None
    errors: WallErrors | None = None
    regions: list[WallErrors] = []
    costs: list[Cost] = []
    memory_MB: float | None = None
    build_s: float | None = None
    predicted_s: float | None = None
    loads: Loads | None = None
    loads_reason: str = ""

    @property
    def label(self) -> str:
        """Name and options; "engine" before those of an engine, since libraries are both."""
        name = f"engine {self.name}" if self.kind == "engine" else self.name
        return ", ".join([name, *(f"{key}={value}" for key, value in self.options.items())])

    @property
    def cost(self) -> Cost | None:
        """The first of the costs: in calls of as many points as the string has."""
        return self.costs[0] if self.costs else None

    @property
    def struck(self) -> bool:
        """Whether its numbers are struck through: it breaks the contract or the gate, or its run is invalid."""
        return bool(self.broken) or (self.loads is not None and self.loads.status != "valid")

    @property
    def sound(self) -> bool:
        """Whether nothing that was asked of it failed; a row that was not run for its cost is sound."""
        return self.status in ("measured", "not run") and not self.struck

    @property
    def verdict(self) -> str:
        """In a word or two."""
        if self.status not in ("measured", "not run"):
            return self.status
        if self.broken:
            return "BROKEN" if self.kind == "contact" else "FAILED"
        if self.loads is not None and self.loads.status != "valid":
            return self.loads.status
        return "" if self.broken is None else "kept" if self.kind == "contact" else "passed"


class WindowOf(_Part):
    """The window of the loads: what the string does, from where to where [m], when [s], and the slowest vibration.

    whole : of its periods in the window.
    """

    operation: str
    from_md_m: float
    to_md_m: float
    start_s: float
    duration_s: float
    vibration: Literal["torsional", "axial"]
    period_s: float
    whole: int
    segments: int
    step_s: float

    @property
    def steps(self) -> int:
        """Of the engine's own."""
        return max(math.ceil(self.duration_s / self.step_s), 1)


class Counts(_Part):
    """Loads of the string of a window over a range of counts of segments, in the hole of the engine's own arcs.

    tolerance : relative, of the counts that suffice.  steps, orders : rows of ``fctd.refine(case, segments=...)`` by
    their columns, those of the stage ``counts`` alone.
    """

    tolerance: float
    steps: list[dict[str, str | int | float | None]]
    orders: list[dict[str, str | int | float | None]]


class Comparison(_Part):
    """Contact methods and engines on one well.

    case, digest : its name, and the hash of its contents.  reference : of the errors.  md_m : of the contact points in
    the window, from the top.  kernel_ns : processor time of a column of the reference kernel.  counts : of segments,
    where a range was asked for.  machine : what times depend on.  units : in which people see it.  date : on which it
    began, ISO 8601.  notes : what a reader of the numbers has to know.  interrupted : whether Ctrl-C ended it.
    """

    schema_version: int = SCHEMA
    case: str
    digest: str
    reference: str
    window: WindowOf | None = None
    md_m: list[float] = Field(default=[], repr=False)
    rows: list[Row] = []
    kernel_ns: Quartiles | None = None
    counts: Counts | None = None
    machine: dict[str, str] = {}
    budget_s: float
    quick: bool = False
    units: System = "si"
    date: str = ""
    seconds: float = 0.0
    notes: list[str] = []
    interrupted: bool = False

    @property
    def sound(self) -> bool:
        """Whether nothing that was asked for failed."""
        return not self.interrupted and all(row.sound for row in self.rows)

    def flat(self) -> list[dict[str, Any]]:
        """A row of plain cells for each method and engine, all with the same columns; nan for a number it has not."""
        return [_flat(row) for row in self.rows]


def _flat(row: Row) -> dict[str, Any]:
    errors, cost, loads = row.errors, row.cost, row.loads
    nan = float("nan")

    def number(value: float | None) -> float:
        return nan if value is None else float(value)

    def three(name: str, value: Quartiles | None) -> dict[str, float]:
        return {
            name: nan if value is None else value.median,
            f"{name}_low": nan if value is None else value.low,
            f"{name}_high": nan if value is None else value.high,
        }

    return {
        "kind": row.kind,
        "name": row.name,
        "setting": row.label,
        "verdict": row.verdict,
        "status": row.status,
        "reason": row.reason,
        "broken": "; ".join(row.broken or []),
        "remarks": "; ".join(row.remarks),
        "package": row.package,
        "version": row.version or "",
        "licence": row.licence or "",
        "pieces": number(row.pieces),
        **{
            name: number(None if errors is None else getattr(errors, name))
            for name in WallErrors.model_fields if name != "region"
        },
        "points_of_a_call": number(None if cost is None else cost.points),
        **three("point_ns", None if cost is None else cost.point_ns),
        **three("point_kernels", None if cost is None else cost.kernels),
        **three("point_arcs", None if cost is None else cost.arcs),
        "memory_MB": number(row.memory_MB),
        "build_s": number(row.build_s),
        "run": "" if loads is None else loads.status,
        "run_message": row.loads_reason if loads is None else loads.message,
        "predicted_s": number(row.predicted_s),
        **{
            name: number(None if loads is None else getattr(loads, name))
            for name in ("hookload_N", "surface_torque_N_m", "sum_r_mu_fn_N_m", "force_off_N", "force_off_md_m")
        },
        **three("step_us", None if loads is None else loads.step_us),
        **three("step_kernels", None if loads is None else loads.step_kernels),
        "step_s": number(None if loads is None else loads.step_s),
        "steps": number(None if loads is None else loads.steps),
        "energy_error": number(None if loads is None else loads.energy_error),
    }  # fmt: skip
