"""Measured rows of a calibration or a prediction: a CSV file with a hook load or a torque in each row."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import InputError, nearest
from fctd.case.load import Case, load_case
from fctd.case.operations import KINDS
from fctd.case.units import FLOW, FORCE, LENGTH, ROTATION, SPEED, TORQUE
from fctd.model.operations import SteadyRates, rad_per_s, steady_rates
from fctd.results.measured import DEPTH, GAUGE, STRINGLESS
from fctd.results.measured_file import LARGEST_FORCE, LARGEST_TORQUE, Field, Line, Text, read_lines, require

Load = Literal["hookload", "torque"]

MOST_WEIGHT: Final = 1e6  # of a row: beyond it the squares of its residuals overflow long before it says more
OPERATIONS: Final = (*KINDS, *STRINGLESS)
# Whether a bit on bottom adds to the torque of a row, and whether the pumps run.
TORQUES: Final = ("off_bottom", "on_bottom", "unknown")
PUMPS: Final = ("on", "off")
_HOOKLOAD: Final = Field("hookload", "N", FORCE, GAUGE, "kN", ranged=True, at_least=0.0, at_most=LARGEST_FORCE)
_TORQUE: Final = Field(
    "torque", "N_m", TORQUE, r"(?:surface[ _]|drive[ _])?torque", "kN_m", ranged=True, at_most=LARGEST_TORQUE
)
_SPEED: Final = Field("speed", "m_s", SPEED, "speed|velocity", "m_s", at_least=0.0)
_ROTATION: Final = Field("rpm", "", ROTATION, r"rpm|rotation|rotary(?:[ _]speed)?", "rpm", at_least=0.0, bare="rpm")
_FLOW: Final = Field("flow", "m3_s", FLOW, r"flow(?:[ _]rate)?", "L_min", at_least=0.0)
_STROKE: Final = Field("stroke", "m", LENGTH, "stroke", "m", at_least=0.0)
_LOCKED: Final = Field("locked_torque", "N_m", TORQUE, r"locked[ _]torque", "kN_m", at_most=LARGEST_TORQUE)
_FIELDS: Final = (DEPTH, _HOOKLOAD, _TORQUE, _SPEED, _ROTATION, _FLOW, _STROKE, _LOCKED)
_HEADERS: Final = "such as id, bit_depth_m, operation, hookload_kN, torque_low_kN_m, torque_high_kN_m, rpm, source"


class Range(NamedTuple):
    """A reading, or the range of readings that was recorded: low, high [SI], equal for a single value."""

    low: float
    high: float

    @property
    def middle(self) -> float:
        """The middle of the range."""
        return 0.5 * (self.low + self.high)


@dataclass(frozen=True)
class Row:
    """A measured row, SI.

    id : its name; string : of the case or override set, "" for the case itself; operation : a kind, ``in_slips`` or
    ``tare``; bit_depth [m], NaN without a string.  rates : speed downwards [m/s] and rotation [rad/s].  hookload [N] :
    of the weight indicator, block included; torque [N m]; weight : of its residuals; source : of its readings.
    flow [m³/s] : recorded, and used by nothing; stroke [m], NaN where not given; locked_torque [N m] : left in the
    string at the end of the stroke.  day : of the reading; rows of a day, a run or a report share their scatter, and
    one without a name is a day of its own.  torque_read : one of ``TORQUES``; pumps : one of ``PUMPS`` or "", used by
    nothing.
    """

    id: str
    string: str
    bit_depth: float
    operation: str
    rates: SteadyRates
    hookload: Range | None = None
    torque: Range | None = None
    weight: float = 1.0
    source: str = ""
    flow: float = float("nan")
    stroke: float = float("nan")
    locked_torque: float = 0.0
    day: str = ""
    torque_read: str = "off_bottom"
    pumps: str = ""

    @property
    def direction(self) -> int:
        """Of the block: 1 down, −1 up, 0 at rest."""
        return KINDS[self.operation].direction if self.operation in KINDS else 0

    def with_reading(self, load: Load, reading: Range | None) -> "Row":
        """The row with another reading."""
        return replace(self, hookload=reading) if load == "hookload" else replace(self, torque=reading)

    def reading(self, load: Load) -> Range | None:
        """A reading of the row."""
        return self.hookload if load == "hookload" else self.torque

    @property
    def has_string(self) -> bool:
        """Whether the reading carries the string."""
        return self.operation in KINDS


def days_of(rows: Sequence[Row]) -> tuple[tuple[str, ...], NDArray[np.int64]]:
    """Names of the days of rows, in the order of the rows, and the day of each row (n,).

    A row without a day is a day of its own, with the row's name.
    """
    keys = [("day", row.day) if row.day else ("row", row.id) for row in rows]
    order = list(dict.fromkeys(keys))
    return tuple(name for _, name in order), np.array([order.index(key) for key in keys], np.int64)


def read_rows(path: Path, case: Case, sets: Mapping[str, Case], *, measured: bool) -> tuple[list[Row], dict[str, Case]]:
    """The rows of a CSV file, and the case of each string that they name.

    sets : cases of override sets by name.  Another string is the path of a case file, relative to the CSV file.
    measured : whether every row needs a hook load or a torque.  Raises InputError, which names file, row and column.
    """
    strings = {"": case}
    try:
        texts = [
            Text("id", "id|name|row"),
            Text("string", "string"),
            Text("operation", "operation|kind", _operation),
            Text("source", "source"),
            Text("weight", "weight", _weight),
            Text("day", "day|run|report"),
            Text("torque_read", r"torque[ _]read", partial(_one_of, TORQUES)),
            Text("pumps", "pumps?", partial(_one_of, PUMPS)),
        ]
        lines = read_lines(path, _FIELDS, texts, _HEADERS)
        require(lines, "operation", ["operation"], _HEADERS)
        if measured:
            loads = [field.column(end) for field in (_HOOKLOAD, _TORQUE) for end in ("", "_low")]
            require(lines, "hook load or torque", loads, _HEADERS)
        rows: list[Row] = []
        known: set[str] = set()
        for line in lines:
            name = str(line.cells.get("string", ""))
            if name not in strings:
                strings[name] = _string(line, name, path, sets)
            row = _row(line, name, strings[name], measured=measured)
            if row.id in known:
                raise line.error("id", "a name that no row above has")
            known.add(row.id)
            rows.append(row)
    except InputError as error:
        raise error.in_file(path) from error.__cause__
    return rows, strings


def _string(line: Line, name: str, path: Path, sets: Mapping[str, Case]) -> Case:
    """The case of a string's name."""
    if name in sets:
        return sets[name]
    file = path.parent / name
    if not name.endswith(".toml") or not file.is_file():
        known = f" or one of the sets {', '.join(sets)}" if sets else ""
        raise line.error("string", f"nothing for the case itself, a case file that exists (looked for {file}){known}")
    return load_case(file)


def _row(line: Line, name: str, case: Case, *, measured: bool) -> Row:
    """A row of the file, checked against its case."""
    operation = str(line.cells["operation"])
    loads = {field: _range(line, field) for field in (_HOOKLOAD, _TORQUE)}
    if measured and not any(loads.values()):
        raise InputError("a hook load or a torque", key=f"row {line.number}")
    if operation == "in_slips" and loads[_TORQUE]:
        raise line.error(_TORQUE.column(), "no torque for in_slips, where nothing turns")
    depth, speed, rpm = (line.number_of(field.column()) for field in (DEPTH, _SPEED, _ROTATION))
    if operation in KINDS:
        top, bottom = case.depths
        if not top < depth <= bottom:
            raise line.error(DEPTH.column(), f"a depth in the well, below {top:g} m and down to {bottom:g} m")
        try:
            rates = steady_rates(case, operation, _given(speed), _given(rpm))
        except InputError as error:
            column = {"speed": _SPEED, "rpm": _ROTATION}[error.key].column()
            raise line.error(column, error.expected) from None
    else:
        rates = SteadyRates(0.0, 0.0 if np.isnan(rpm) else rad_per_s(rpm))
    return Row(
        id=str(line.cells.get("id") or f"row {line.number}"),
        string=name, bit_depth=depth, operation=operation, rates=rates,
        hookload=loads[_HOOKLOAD], torque=loads[_TORQUE],
        weight=float(str(line.cells.get("weight", 1.0))), source=str(line.cells.get("source", "")),
        flow=line.number_of(_FLOW.column()), stroke=line.number_of(_STROKE.column()),
        locked_torque=float(np.nan_to_num(line.number_of(_LOCKED.column()))),
        day=str(line.cells.get("day", "")), torque_read=str(line.cells.get("torque_read") or TORQUES[0]),
        pumps=str(line.cells.get("pumps", "")),
    )  # fmt: skip


def _range(line: Line, field: Field) -> Range | None:
    """The range of a load; where a value stands beside it, the range is what was recorded."""
    value, low, high = (line.number_of(field.column(end)) for end in ("", "_low", "_high"))
    if not np.isnan(low):
        return Range(low, high)
    return None if np.isnan(value) else Range(value, value)


def _given(number: float) -> float | None:
    return None if np.isnan(number) else number


def _operation(cell: str) -> str:
    if cell not in OPERATIONS:
        raise InputError(nearest(cell, OPERATIONS, "operation"))
    return cell


def _one_of(words: Sequence[str], cell: str) -> str:
    """A word of a cell, "" for an empty one."""
    if cell and cell not in words:
        raise InputError(f"{', '.join(words[:-1])} or {words[-1]}, or nothing")
    return cell


def _weight(cell: str) -> float:
    try:
        weight = float(cell or 1.0)
    except ValueError:
        raise InputError("a weight of the row, a number above 0") from None
    if not 0 < weight <= MOST_WEIGHT:
        raise InputError(f"a weight of the row, a number above 0 and at most {MOST_WEIGHT:g}")
    return weight
