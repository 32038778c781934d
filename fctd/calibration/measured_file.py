"""Files of measured rows: loads as values or ranges, with the operation and the depth at which they were read."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.calibration.wide_sheet import WEIGHTS, is_wide, unfolded
from fctd.case.errors import InputError, show
from fctd.case.input_file import decode, read_bytes
from fctd.case.operation_names import read_kind
from fctd.case.operations import KINDS
from fctd.case.tables.fields import Field
from fctd.case.tables.headers import RIG_UNITS, TableForm
from fctd.case.tables.readings import BIT_DEPTH, HOOK_LOAD
from fctd.case.tables.rows import Numbers, Rows
from fctd.case.tables.text import read_text
from fctd.case.tables.workbook import ZIP, read_workbook
from fctd.case.units import DEEPEST, FORCE, LENGTH, TORQUE, Quantity
from fctd.results.unit_systems import System

_LARGEST_FILE: Final = 8  # MiB
MOST_ROWS: Final = 10_000  # a string is solved for each
ENDS: Final = ("", "_low", "_high")
# Readings without a string in the hole's grip: in slips the hook carries the block alone; a tare turns the free drive.
STRINGLESS: Final = ("in_slips", "tare")
# As legends have them, too.
_STRINGLESS_NAMES: Final = {word.replace("_", " "): word for word in STRINGLESS} | {"free drive": "tare"}
OPERATIONS: Final = (*KINDS, *STRINGLESS)
_NOTHING: Final = ("", "-", "–", "—", "n/a")  # what people write where they have read nothing
# Readings beyond these, [N] and [N*m], are no rig's: a hundred times what the strongest hoists and drives do.
LARGEST_FORCE, LARGEST_TORQUE = 1e9, 1e8
ANY_FORCE: Final = Quantity(dimension=FORCE, at_most=LARGEST_FORCE)
ANY_TORQUE: Final = Quantity(dimension=TORQUE, at_most=LARGEST_TORQUE)
DEPTH: Final = replace(
    BIT_DEPTH,
    names=f"{BIT_DEPTH.names}; measured depth, depth, md",
    quantity=Quantity(dimension=LENGTH, at_least=0.0, at_most=DEEPEST),
)
HOOKLOAD: Final = replace(HOOK_LOAD, key="hookload", quantity=ANY_FORCE)
TORQUE_WORDS: Final = "rotating rot rob free off bottom btm"  # that may stand beside the name of a torque
OPERATION: Final = Field("operation", "operation, kind")
NAME: Final = Field("id", "id, name, row")


class Measured(NamedTuple):
    """Measured rows as they are written, and their numbers by field [SI], NaN where a cell is empty."""

    rows: Rows
    numbers: dict[str, Array]

    def number(self, row: int, key: str) -> float:
        """A number of a row; NaN where the file does not have it."""
        return float(self.numbers[key][row]) if key in self.numbers else np.nan


def measured_form(
    example: str, loads: Sequence[Field], others: Sequence[Field], needed: Sequence[str], units: System | None
) -> TableForm:
    """The tables with these fields, operation and depth; a load is a value or a range, "hookload_low_kN".

    In place of operation and hook load stand the weights of a sheet (wide_sheet.py).  example : headers for messages;
    needed : keys of fields that must be there; with loads in place of "load" one.  units : of a table that names none.
    """
    ranged = [_end(load, end) for end in ENDS for load in loads]
    of_key = {"load": [field.key for field in ranged], OPERATION.key: [OPERATION.key, *WEIGHTS]}

    def groups(found: Collection[str]) -> list[list[str]]:
        return [[DEPTH.key]] if is_wide(found) else [of_key.get(key, [key]) for key in needed]

    weights = (field for field, _ in WEIGHTS.values())
    fields = (DEPTH, OPERATION, NAME, *weights, *ranged, *others)
    return TableForm(fields, example, groups, most=MOST_ROWS, assumed=None if units is None else RIG_UNITS[units])


def _end(load: Field, end: str) -> Field:
    word = end.replace("_", " ")
    return replace(load, key=f"{load.key}{end}", names=", ".join(f"{name}{word}" for name in load.names.split(",")))


def read_measured_file(
    path: Path,
    form: TableForm,
    loads: Collection[Field],
    tell: Callable[[str], None] | None = None,
    *,
    empty: bool = False,
) -> Measured:
    """The rows of a text in columns, or of a sheet of a workbook.

    tell : called with a sentence where units were assumed; empty : whether weights of a sheet that were not read are
    rows, too.  Raises InputError, which names row and column, for a file that is no such table, numbers out of bounds,
    ranges whose ends do not rise, and operations that nobody knows.
    """
    content = read_bytes(path, _LARGEST_FILE, "a file of measured rows")
    if content.startswith(ZIP):
        rows = read_workbook(content, form, {}, which="one sheet of measured rows: save it as CSV")
    else:
        rows = read_text(decode(content, "measured rows: text in columns, such as CSV, or a workbook (xlsx)"), form, {})
    if not len(rows):
        raise InputError("a row of headers and a row for each measurement")
    keys = [key for key, column in rows.columns.items() if column.field.quantity is not None]
    written = Numbers().read(rows, keys, _NOTHING)
    numbers = {key: np.full(len(rows), np.nan) for key in keys}
    for row, values in enumerate(written):
        for key, value in zip(keys, values.tolist(), strict=True):
            if not np.isnan(value):
                numbers[key][row] = _si(rows, row, key, value)
    found = Measured(*unfolded(rows, numbers, HOOKLOAD.key, OPERATION, NAME, empty=empty))
    if not len(found.rows):
        raise InputError("a row with a reading")
    for row in range(len(found.rows)):
        for load in loads:
            _check_range(found, row, load.key)
    if tell is not None and (assumed := [column for column in rows.columns.values() if column.assumed]):
        units = ", ".join(f"{show(column.header)} in {column.unit}" for column in assumed)
        tell(f"headers without units are read as: {units}; write the units into them if they are others")
    kinds = [_kind(found.rows, row) for row in range(len(found.rows))]
    return found._replace(rows=replace(found.rows, cells={**found.rows.cells, OPERATION.key: kinds}))


def _kind(rows: Rows, row: int) -> str:
    """The kind of operation of a row, by whichever name."""
    name = rows.texts(OPERATION.key)[row]
    try:
        return _STRINGLESS_NAMES.get(name.casefold()) or read_kind(name, STRINGLESS)
    except InputError as error:
        raise rows.error(row, OPERATION.key, error.expected) from None


def _si(rows: Rows, row: int, key: str, value: float) -> float:
    """A number in SI, in decimals and within its bounds."""
    column = rows.columns[key]
    assert column.field.quantity is not None
    try:
        return column.field.quantity.parse(f"{value!r} {column.unit}")
    except InputError as error:
        raise rows.error(row, key, error.expected) from error


def _check_range(found: Measured, row: int, load: str) -> None:
    """Raise InputError for a range with one end, or one that does not hold its value."""
    value, low, high = (found.number(row, f"{load}{end}") for end in ENDS)
    key = f"row {found.rows.numbers[row]}, {load}"
    if np.isnan(low) != np.isnan(high):
        raise InputError("both ends of a range, low and high", key=key)
    if low > high or value < low or value > high:
        shown = f"{low:g}, {value:g}, {high:g} in SI"
        raise InputError("a low end, a value and a high end that rise", key=key, value=shown)
