"""From values of the unknowns to readings: the loads of the strings, then what the rig and the source make of them."""

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.calibration.rows import Load, Range, Row
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import Unknown, with_values
from fctd.case.errors import InputError
from fctd.case.friction import table_of
from fctd.case.load import Case
from fctd.case.message import Message, quantity, within
from fctd.case.rig import RigSpec
from fctd.model.fluids import fluids_of
from fctd.model.joints import sections_of
from fctd.model.operations import drive_torque, rad_per_s, weight_indicator
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.problem import Workspace
from fctd.steady.sensitivity import Changed, solve_with_changes

# The change of an unknown for the tangent, over its typical size.
_STEP = 1e-4


class Reading(NamedTuple):
    """A measured load: index of its row, which load, the recorded range [SI] and its noise, one standard deviation.

    The range of a reading that was not measured is NaN.  A torque with a bit on bottom has the bit's mean ``added``,
    and the bit's standard deviation is part of its noise.
    """

    row: int
    load: Load
    range: Range
    noise: float
    added: float = 0.0


class StringLoads(NamedTuple):
    """Loads of a row's string: (hook load [N], torque [N m]), their derivatives by the unknowns (2, k), and a reason.

    reason : why there are no loads, "" where there are.  doubt : status and message where the string has
    loads but is not ``converged``, else "".  lift : that mud which flows takes off the load along the string [N].
    """

    loads: Array
    slopes: Array
    reason: str = ""
    doubt: str = ""
    lift: float = 0.0


@dataclass(frozen=True)
class Evaluation:
    """What the rig would read: value (m,) [SI] of each reading, slopes (m, k) by the unknowns; NaN without loads.

    reasons, doubts : of the rows without loads, and with loads of a string that is not ``converged``, by index; lifts :
    that mud which flows takes off the load along the string of each row [N].
    """

    value: Array
    slopes: Array
    reasons: dict[int, str]
    doubts: dict[int, str]
    lifts: tuple[float, ...]


class Forward:
    """The readings of rows for values of the unknowns; solved strings are kept for other constants of the rig.

    progress : called with the number of rows solved so far, those of all trials together.
    Raises InputError for a string that does not fit its hole at a row's depth.
    """

    def __init__(
        self, rows: Sequence[Row], strings: Mapping[str, Case], unknowns: Sequence[Unknown], setup: Setup,
        progress: Callable[[int], None] | None = None,
    ) -> None:  # fmt: skip
        self.rows, self.unknowns, self.setup = tuple(rows), tuple(unknowns), setup
        self.strings = {name: case for name, case in strings.items() if any(row.string == name for row in rows)}
        self._solvers = {name: Solver(case) for name, case in self.strings.items()}
        self._laid: dict[tuple[str, float], LaidString] = {}
        for row in rows:
            key = row.string, row.bit_depth
            if row.has_string and key not in self._laid:
                try:
                    self._laid[key] = self._solvers[row.string].lay_out(row.bit_depth)
                except InputError as error:
                    file = self.strings[row.string].file
                    named = error if file is None else error.in_file(file)
                    at = quantity(row.bit_depth, "m")
                    raise InputError(f"a depth at which the string fits ({named})", key=row.id, value=at) from None
        for (name, _), laid in self._laid.items():  # one workspace for all strings of a case
            solver = self._solvers[name]
            if solver.work.segments < laid.string.segments:
                solver.work = Workspace(laid.string.segments)
        self.readings = tuple(self._readings())
        self.names = tuple(unknown.name for unknown in unknowns)
        self._by_string = [k for k, unknown in enumerate(unknowns) if unknown.changes_string]
        self._sizes = np.array([unknown.size for unknown in unknowns])
        self._count, self._progress = [0], progress
        self._kept: dict[bytes, list[StringLoads]] = {}

    def _readings(self) -> list[Reading]:
        """Both loads of every row, as far as the row can have them."""
        found = []
        for k, row in enumerate(self.rows):
            source = self.setup.source(row.source)
            read = _as_read(row.hookload, source.hookload_resolution)
            found.append(Reading(k, "hookload", read, source.hookload_noise))
            if row.operation != "in_slips":
                added, sd = self.setup.bit_torque.of(row.torque_read)
                read = _as_read(row.torque, source.torque_resolution)
                found.append(Reading(k, "torque", read, float(np.hypot(source.torque_noise, sd)), added))
        return found

    def of_rows(self, rows: Sequence[int]) -> "Forward":
        """The same for some of the rows, with the holes and strings that are laid out already."""
        other = copy(self)
        other.rows = tuple(self.rows[k] for k in rows)
        other.strings = {name: case for name, case in self.strings.items() if any(r.string == name for r in other.rows)}
        other.readings = tuple(other._readings())
        other._kept = {}
        return other

    def length_in_hole(self, name: str, row: Row) -> float:
        """Length of the components that an unknown ``mass.NAME`` names in the string of a row [m]."""
        string = self._laid[row.string, row.bit_depth].string
        named = [k for k, part in enumerate(string.parts) if f"mass.{part.component.name}" == name]
        return float(string.length[np.isin(string.component, named)].sum())

    def evaluate(self, values: Array) -> Evaluation:
        """The readings at values (k,) of the unknowns [SI]."""
        solved = self._solve(values)
        by_name = dict(zip(self.names, map(float, values), strict=True))
        rigs = {name: with_values(case, by_name).rig for name, case in self.strings.items()}
        value, slopes = np.empty(len(self.readings)), np.zeros((len(self.readings), len(values)))
        for i, reading in enumerate(self.readings):
            row, loads = self.rows[reading.row], solved[reading.row]
            read, slopes[i] = self._read(row, reading.load, rigs[row.string], by_name, loads)
            value[i] = read + reading.added
        reasons = {k: loads.reason for k, loads in enumerate(solved) if loads.reason}
        doubts = {k: loads.doubt for k, loads in enumerate(solved) if loads.doubt}
        return Evaluation(value, slopes, reasons, doubts, tuple(loads.lift for loads in solved))

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
        # The same value may differ by its rounding.
        key = (np.round(values / self._sizes, 12) + 0.0)[self._by_string].tobytes()
        if key not in self._kept:
            if len(self._kept) >= 16:
                self._kept.pop(next(iter(self._kept)))
            self._kept[key] = self._solve_rows(values)
        return self._kept[key]

    def _solve_rows(self, values: Array) -> list[StringLoads]:
        """The same at other values: the case and the hole of every string once, also for each unknown's step."""
        steps = _STEP * self._sizes
        beyond = values + steps > [unknown.high for unknown in self.unknowns]
        steps[beyond] *= -1
        moved = [values, *(values + steps[k] * np.eye(len(values))[k] for k in self._by_string)]
        solvers = {name: [self._solver(name, at) for at in moved] for name in self.strings}
        nothing = StringLoads(np.zeros(2), np.zeros((2, len(values))))
        found: dict[tuple[object, ...], StringLoads] = {}
        answers = []
        for row in self.rows:
            key = row.string, row.bit_depth, row.operation, row.rates
            if row.has_string and key not in found:
                found[key] = self._solve_row(row, solvers[row.string], steps)
                self._count[0] += 1
                if self._progress is not None:
                    self._progress(self._count[0])
            answers.append(found[key] if row.has_string else nothing)
        return answers

    def _solver(self, name: str, values: Array) -> Solver:
        """The solver of a string's case with values of the unknowns."""
        of = self._solvers[name]
        case = with_values(of.case, dict(zip(self.names, map(float, values), strict=True)))
        return Solver(case, of.hole.with_friction(table_of(case.wellbore.intervals)), of.work)

    def _solve_row(self, row: Row, solvers: Sequence[Solver], steps: Array) -> StringLoads:
        """Loads of a row's string; solvers : at the values, and at the step of each unknown that changes the string."""
        of_case = self._laid[row.string, row.bit_depth]
        strings: list[LaidString] = []
        for solver in solvers:
            components = solver.case.string.components
            parts = tuple(part._replace(component=components[part.origin]) for part in of_case.string.parts)
            sections = sections_of(parts, solver.case.mud.density)
            same = [laid for laid in (of_case, *strings[:1]) if laid.string.sections == sections]
            fluids = fluids_of(solver.case, row.bit_depth)
            other = replace(of_case.string, sections=sections, parts=parts, fluids=fluids)
            strings.append(same[0] if same else LaidString(solver.case, solver.hole, other, of_case.lie))
        changes = [Changed(solver, laid) for solver, laid in zip(solvers[1:], strings[1:], strict=True)]
        try:
            point, by = solve_with_changes(solvers[0], row.operation, row.rates, strings[0], changes)
        except InputError as error:  # as of a resolved string with too many segments
            return self._failed(error.message)
        if not point.answered:
            return self._failed(Message(f"{point.status}: {within(point.message)}"))
        slopes = np.zeros((2, len(steps)))
        slopes[:, self._by_string] = (by / steps[self._by_string][:, None]).T
        if not np.isfinite(slopes).all():
            return self._failed(f"{point.status}, and none with friction or mass a little larger")
        doubt = "" if point.status == SteadyStatus.CONVERGED else Message(f"{point.status}: {within(point.message)}")
        return StringLoads(np.array([point.hookload, point.surface_torque]), slopes, doubt=doubt, lift=point.lift)

    def gains(self, values: Array) -> Array:
        """What each reading gains from a weight at the hook (m,), 0 for torques."""
        by_name = dict(zip(self.names, map(float, values), strict=True))
        rigs = {name: with_values(case, by_name).rig for name, case in self.strings.items()}
        rows = [self.rows[reading.row] for reading in self.readings]
        return np.array(
            [
                rigs[row.string].sheave_efficiency ** -row.direction if reading.load == "hookload" else 0.0
                for row, reading in zip(rows, self.readings, strict=True)
            ]
        )

    def _failed(self, reason: str) -> StringLoads:
        return StringLoads(np.full(2, np.nan), np.full((2, len(self.unknowns)), np.nan), reason)


def _as_read(read: Range | None, resolution: float) -> Range:
    """The range that a reading stands for: a single one is rounded in steps of the resolution."""
    if read is None:
        return Range(float("nan"), float("nan"))
    return read if read.high > read.low else Range(read.low - 0.5 * resolution, read.high + 0.5 * resolution)
