"""From values of the unknowns to readings: the loads of the strings, then what the rig and the source make of them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.calibration.rows import Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import Unknown, with_values
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.specs import RigSpec
from fctd.model.drillstring import String, section_of
from fctd.model.operations import drive_torque, rad_per_s, weight_indicator
from fctd.steady.equilibrium import Solver
from fctd.steady.sensitivity import Changed, solve_with_changes

Array = NDArray[np.float64]
Load = Literal["hookload", "torque"]

# The change of an unknown for the tangent, over its typical size.
_STEP = 1e-4


class Reading(NamedTuple):
    """A measured load: index of its row, which load, the recorded range [SI] and its noise, one standard deviation.

    The range of a reading that was not measured is NaN.
    """

    row: int
    load: Load
    range: Range
    noise: float


class StringLoads(NamedTuple):
    """Loads of a row's string: (hook load [N], torque [N m]), their derivatives by the unknowns (2, k), and a reason.

    reason : why there are no loads, "" where there are.
    """

    loads: Array
    slopes: Array
    reason: str


@dataclass(frozen=True)
class Evaluation:
    """What the rig would read: value (m,) [SI] of each reading, slopes (m, k) by the unknowns; NaN without loads.

    reasons : of the rows without loads, by index.  loads (r, 2) : of the strings of the rows, hook load [N] and surface
    torque [N m].
    """

    value: Array
    slopes: Array
    reasons: dict[int, str]
    loads: Array


class Forward:
    """The readings of rows for values of the unknowns; solved strings are kept for other constants of the rig.

    Raises InputError for a string that does not fit its hole at a row's depth.
    """

    def __init__(
        self, rows: Sequence[Row], strings: Mapping[str, Case], unknowns: Sequence[Unknown], setup: Setup
    ) -> None:
        self.rows, self.unknowns, self.setup = tuple(rows), tuple(unknowns), setup
        self.strings = {name: case for name, case in strings.items() if any(row.string == name for row in rows)}
        self._solvers = {name: Solver(case) for name, case in self.strings.items()}
        self._laid: dict[tuple[str, float], String] = {}
        for row in rows:
            key = row.string, row.bit_depth
            if row.has_string and key not in self._laid:
                try:
                    self._laid[key] = self._solvers[row.string].lay_out(row.bit_depth)
                except InputError as error:
                    file = self.strings[row.string].file
                    named = error if file is None else error.in_file(file)
                    raise InputError(f"a string that fits at {row.bit_depth:g} m ({named})", key=row.id) from None
        self.readings = tuple(self._readings())
        self.names = tuple(unknown.name for unknown in unknowns)
        self._by_string = [k for k, unknown in enumerate(unknowns) if unknown.changes_string]
        self._kept: dict[bytes, list[StringLoads]] = {}

    def _readings(self) -> list[Reading]:
        """Both loads of every row, as far as the row can have them."""
        found = []
        nothing = Range(float("nan"), float("nan"))
        for k, row in enumerate(self.rows):
            source = self.setup.source(row.source)
            found.append(Reading(k, "hookload", row.hookload or nothing, source.hookload_noise))
            if row.operation != "in_slips":
                found.append(Reading(k, "torque", row.torque or nothing, source.torque_noise))
        return found

    def evaluate(self, values: Array) -> Evaluation:
        """The readings at values (k,) of the unknowns [SI]."""
        solved = self._solve(values)
        by_name = dict(zip(self.names, map(float, values), strict=True))
        rigs = {name: with_values(case, by_name).rig for name, case in self.strings.items()}
        value, slopes = np.empty(len(self.readings)), np.zeros((len(self.readings), len(values)))
        for i, reading in enumerate(self.readings):
            row, loads = self.rows[reading.row], solved[reading.row]
            value[i], slopes[i] = self._read(row, reading.load, rigs[row.string], by_name, loads)
        reasons = {k: loads.reason for k, loads in enumerate(solved) if loads.reason}
        return Evaluation(value, slopes, reasons, np.array([loads.loads for loads in solved]))

    def _read(
        self, row: Row, load: Load, rig: RigSpec, values: Mapping[str, float], solved: StringLoads
    ) -> tuple[float, Array]:
        """A reading and its derivatives."""
        own = {name: self.names.index(name) for name in self.names}
        bias, sign = f"bias.{load}.{row.source}", self._sign(row, load)
        if load == "hookload":
            d = row.direction
            gain = rig.sheave_efficiency**-d
            at_block = float(solved.loads[0]) + rig.block_weight - d * rig.guide_friction
            value = weight_indicator(rig, d, float(solved.loads[0]))
            slopes = gain * solved.slopes[0]
            by_rig = {
                "rig.block_weight": gain,
                "rig.guide_friction": -d * gain,
                "rig.sheave_efficiency": -d * at_block * gain / rig.sheave_efficiency,
            }
        else:
            value = drive_torque(rig, row.rates.spin, float(solved.loads[1]))
            slopes = solved.slopes[1].copy()
            by_rig = {"rig.torque_offset": 1.0, "rig.torque_per_rpm": row.rates.spin / rad_per_s(1.0)}
        for name, slope in {**by_rig, bias: sign}.items():
            if name in own:
                slopes[own[name]] += slope
        return value + sign * values.get(bias, 0.0), slopes

    def _sign(self, row: Row, load: Load) -> float:
        """How a source's bias enters a reading."""
        peak = self.setup.source(row.source).reading == "peak"
        return float(-row.direction) if peak and load == "hookload" else 1.0

    def _solve(self, values: Array) -> list[StringLoads]:
        """The loads of every row's string, kept for values that change no string."""
        key = values[self._by_string].tobytes()
        if key not in self._kept:
            if len(self._kept) >= 16:
                self._kept.pop(next(iter(self._kept)))
            self._kept[key] = self._solve_rows(values)
        return self._kept[key]

    def _solve_rows(self, values: Array) -> list[StringLoads]:
        steps = [_STEP * unknown.size for unknown in self.unknowns]
        nothing = StringLoads(np.zeros(2), np.zeros((2, len(values))), "")
        found: dict[tuple[object, ...], StringLoads] = {}
        answers = []
        for row in self.rows:
            if not row.has_string:
                answers.append(nothing)
                continue
            key = row.string, row.bit_depth, row.operation, row.rates
            if key not in found:
                found[key] = self._solve_row(row, values, steps)
            answers.append(found[key])
        return answers

    def _solve_row(self, row: Row, values: Array, steps: Sequence[float]) -> StringLoads:
        base = self._changed(row, values)
        changes = []
        for k in self._by_string:
            moved = values.copy()
            moved[k] += steps[k] if moved[k] + steps[k] <= self.unknowns[k].high else -steps[k]
            changes.append(self._changed(row, moved, base))
        try:
            point, by = solve_with_changes(base.solver, row.operation, row.rates, base.string, changes)
        except InputError as error:  # as of a resolved string with too many segments
            return self._failed(str(error))
        if not point.answered:
            return self._failed(f"{point.status}: {point.message}")
        slopes = np.zeros((2, len(values)))
        for k, change in zip(self._by_string, by, strict=True):
            step = steps[k] if values[k] + steps[k] <= self.unknowns[k].high else -steps[k]
            slopes[:, k] = change / step
        if not np.isfinite(slopes).all():
            return self._failed(f"{point.status}, and none with friction or mass a little larger")
        return StringLoads(np.array([point.hookload, point.surface_torque]), slopes, "")

    def _failed(self, reason: str) -> StringLoads:
        return StringLoads(np.full(2, np.nan), np.full((2, len(self.unknowns)), np.nan), reason)

    def _changed(self, row: Row, values: Array, base: Changed | None = None) -> Changed:
        """Solver and string of a row for values of the unknowns; those of ``base`` where they do not differ."""
        of = self._solvers[row.string]
        case = with_values(of.case, dict(zip(self.names, map(float, values), strict=True)))
        factors = np.array([interval.friction for interval in case.wellbore.intervals])
        laid = self._laid[row.string, row.bit_depth] if base is None else base.string
        sections = tuple(section_of(part, case.mud.density) for part in case.string.components[: len(laid.sections)])
        string = laid if sections == laid.sections else replace(laid, sections=sections)
        return Changed(Solver(case, of.hole.with_friction(factors), of.work), string)
