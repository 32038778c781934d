"""Measured rows of a calibration or a prediction: a CSV file with a hook load or a torque in each row."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.calibration.measured_file import (
    ANY_FORCE,
    ANY_TORQUE,
    DEPTH,
    ENDS,
    HOOKLOAD,
    NAME,
    OPERATION,
    TORQUE_WORDS,
    Measured,
    measured_form,
    read_measured_file,
)
from fctd.case.errors import InputError, naming
from fctd.case.load import Case, load_case
from fctd.case.message import quantity
from fctd.case.operations import KINDS
from fctd.case.tables.fields import Field
from fctd.case.tables.readings import FLOW_IN, ROTATION_OF_DRIVE, TORQUE_OF_DRIVE
from fctd.case.tables.rows import read_number
from fctd.case.units import FLOW, LENGTH, MOST_RPM, ROTATION, SPEED, Quantity
from fctd.hydraulics.channel import has_flow_curve
from fctd.model.operations import SteadyRates, flow_of, rad_per_s, steady_rates
from fctd.results.doing import does
from fctd.results.unit_systems import System

Load = Literal["hookload", "torque"]

MOST_WEIGHT: Final = 1e6  # of a row: beyond it the squares of its residuals overflow long before it says more
# Whether a bit on bottom adds to the torque of a row, and whether the pumps run.
TORQUES: Final = ("off_bottom", "on_bottom", "unknown")
PUMPS: Final = ("on", "off")
_LOADS: Final = (
    replace(HOOKLOAD, quantity=replace(ANY_FORCE, at_least=0.0)),
    replace(TORQUE_OF_DRIVE, quantity=ANY_TORQUE, beside=f"{TORQUE_OF_DRIVE.beside} {TORQUE_WORDS}"),
)
_ROTATION: Final = replace(
    ROTATION_OF_DRIVE, names=f"{ROTATION_OF_DRIVE.names}, rotation, rotary",
    quantity=Quantity(dimension=ROTATION, at_least=0.0, at_most=MOST_RPM),
)  # fmt: skip
_OTHERS: Final = (
    Field("speed", "speed, velocity", Quantity(dimension=SPEED, at_least=0.0), example="m_s"),
    _ROTATION,
    replace(FLOW_IN, quantity=Quantity(dimension=FLOW, at_least=0.0)),
    Field("stroke", "stroke", Quantity(dimension=LENGTH, at_least=0.0), example="m"),
    Field("locked_torque", "locked torque", ANY_TORQUE, example="kN_m"),
    Field("string", "string"),
    Field("source", "source"),
    Field("weight", "weight"),
    Field("day", "day, run, report"),
    Field("torque_read", "torque read"),
    Field("pumps", "pump, pumps"),
)
_EXAMPLE: Final = "id, bit_depth_m, operation, hookload_kN, torque_low_kN_m, torque_high_kN_m, rpm, source"


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
    flow [m³/s] : recorded, which acts where the case has a flow curve; stroke [m], NaN where not given; locked_torque
    [N m] : left in the string at the end of the stroke.  day : of the reading; rows of a day, a run or a report share
    their scatter, and one without a name is a day of its own.  torque_read : one of ``TORQUES``; pumps : one of
    ``PUMPS`` or "", used where no flow is given.
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

    def does(self, case: Case) -> dict[str, float]:
        """What the string of a case does in the row, as columns; a recorded flow also where it does not act."""
        return does(case, self.operation, self.rates) | ({} if np.isnan(self.flow) else {"flow_m3_s": self.flow})

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


def read_rows(
    path: Path,
    case: Case,
    sets: Mapping[str, Case],
    *,
    measured: bool,
    units: System | None = None,
    tell: Callable[[str], None] | None = None,
) -> tuple[list[Row], dict[str, Case]]:
    """The rows of a text in columns or a workbook, and the case of each string that they name.

    sets : cases of override sets by name.  Another string is the path of a case file, relative to the file of rows.
    measured : whether every row needs a hook load or a torque.  units : of a file whose headers name none, None to
    refuse it; tell : called with a sentence that says so.  Raises InputError, which names file, row and column.
    """
    strings = {"": case}
    with naming(path):
        form = measured_form(_EXAMPLE, _LOADS, _OTHERS, (OPERATION.key, *(["load"] if measured else [])), units)
        found = read_measured_file(path, form, _LOADS, tell, empty=not measured)
        rows: list[Row] = []
        known: set[str] = set()
        for k, name in enumerate(found.rows.texts("string")):
            if name not in strings:
                strings[name] = _string(found, k, name, path, sets)
            row = _row(found, k, name, strings[name], measured=measured)
            if row.id in known:
                raise found.rows.error(k, "id", "a name that no row above has")
            known.add(row.id)
            rows.append(row)
    return rows, strings


def _string(found: Measured, row: int, name: str, path: Path, sets: Mapping[str, Case]) -> Case:
    """The case of a string's name."""
    if name in sets:
        return sets[name]
    file = path.parent / name
    if not name.endswith(".toml") or not file.is_file():
        known = f" or one of the sets {', '.join(sets)}" if sets else ""
        expected = f"nothing for the case itself, a case file that exists (looked for {file}){known}"
        raise found.rows.error(row, "string", expected)
    return load_case(file)


def _row(found: Measured, k: int, name: str, case: Case, *, measured: bool) -> Row:
    """A row of the file, checked against its case."""
    texts = found.rows.texts
    operation = texts(OPERATION.key)[k]
    hookload, torque = (_range(found, k, load.key) for load in _LOADS)
    if measured and hookload is None and torque is None:
        raise InputError("a hook load or a torque", key=f"row {found.rows.numbers[k]}")
    if operation == "in_slips" and torque is not None:
        raise found.rows.error(k, "torque", "no torque for in_slips, where nothing turns")
    depth, speed, rpm = (found.number(k, key) for key in (DEPTH.key, "speed", "rpm"))
    if operation in KINDS:
        top, bottom = case.depths
        if not top < depth <= bottom:
            raise found.rows.error(
                k, DEPTH.key, f"a depth in the well, below {quantity(top, 'm')} and down to {quantity(bottom, 'm')}"
            )
        try:
            rates = steady_rates(case, operation, _given(speed), _given(rpm), _pumped(found, k, case))
        except InputError as error:
            raise found.rows.error(k, error.key, error.expected) from None
    else:
        rates = SteadyRates(0.0, 0.0 if np.isnan(rpm) else rad_per_s(rpm))
    return Row(
        id=texts(NAME.key)[k] or f"row {found.rows.numbers[k]}", string=name, bit_depth=depth, operation=operation,
        rates=rates, hookload=hookload, torque=torque, weight=_weight(found, k), source=texts("source")[k],
        flow=found.number(k, "flow"), stroke=found.number(k, "stroke"),
        locked_torque=float(np.nan_to_num(found.number(k, "locked_torque"))),
        day=texts("day")[k], torque_read=_one_of(TORQUES, found, k, "torque_read") or TORQUES[0],
        pumps=_one_of(PUMPS, found, k, "pumps"),
    )  # fmt: skip


def _pumped(found: Measured, k: int, case: Case) -> float | None:
    """The flow of a row [m³/s]: as recorded, that of the case where the pumps are on, None where neither is said.

    Without a flow curve it is 0: nozzles alone would take less off the hook load than what they leave out.
    """
    if not has_flow_curve(case):
        return 0.0
    flow, pumps = found.number(k, "flow"), found.rows.texts("pumps")[k]
    if np.isnan(flow) and pumps:
        return flow_of(case) if pumps == "on" else 0.0
    return _given(flow)


def _range(found: Measured, row: int, load: str) -> Range | None:
    """The range of a load; where a value stands beside it, the range is what was recorded."""
    value, low, high = (found.number(row, f"{load}{end}") for end in ENDS)
    if not np.isnan(low):
        return Range(low, high)
    return None if np.isnan(value) else Range(value, value)


def _given(number: float) -> float | None:
    return None if np.isnan(number) else number


def _one_of(words: Sequence[str], found: Measured, row: int, key: str) -> str:
    """A word of a cell, "" for an empty one."""
    cell = found.rows.texts(key)[row]
    if cell and cell not in words:
        raise found.rows.error(row, key, f"{', '.join(words[:-1])} or {words[-1]}, or nothing")
    return cell


def _weight(found: Measured, row: int) -> float:
    cell = found.rows.texts("weight")[row] or "1"
    weight = read_number(cell)
    if weight is None or not 0 < weight <= MOST_WEIGHT:
        raise found.rows.error(row, "weight", f"a weight of the row, a number above 0 and at most {MOST_WEIGHT:g}")
    return weight
