"""Measured hook loads and torques from a CSV file, to be drawn over the curves of a chart."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from fctd.case.errors import InputError, nearest
from fctd.case.input_file import read_text
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.units import FORCE, LENGTH, TORQUE, Dimension, Quantity
from fctd.results.columns import COLUMNS

if TYPE_CHECKING:
    import pandas as pd

_LARGEST_FILE: Final = 8  # MiB
_BELOW: Final = 30.0  # m: a measured depth may exceed the last station of the survey by a joint or two


class _Field(NamedTuple):
    """A quantity of a file: stem and unit of its columns in the table, names in headers, unit of an example."""

    stem: str
    unit: str
    dimension: Dimension
    names: str
    example: str


_DEPTH: Final = _Field("bit_depth", "m", LENGTH, r"bit[ _]depth|depth|md", "m")
_LOADS: Final = (
    _Field("hookload", "N", FORCE, r"hook[ _]?load|string[ _]load", "kN"),
    _Field("weight_indicator", "N", FORCE, r"weight[ _]indicator|indicator", "kN"),
    _Field("surface_torque", "N_m", TORQUE, r"(?:surface[ _])?torque", "kN_m"),
)
_ENDS: Final = ("", "_low", "_high")
_LOAD_COLUMNS: Final = tuple(f"{field.stem}{end}_{field.unit}" for field in _LOADS for end in _ENDS)
_HEADERS: Final = "such as bit_depth_m, operation, hookload_kN, hookload_low_kN, hookload_high_kN, torque_kN_m"
# A unit in brackets, or after an underscore as in the columns of tables.
_UNIT: Final = r"(?:[ _]*[(\[]\s*(?P<inside>[^)\]]+?)\s*[)\]]|_(?P<after>\w+))?"


def measured_column(column: str, end: str) -> str:
    """Column of an end of a range, "low" or "high", beside a column such as ``hookload_N``."""
    stem = COLUMNS[column].stem
    return f"{stem}_{end}{column.removeprefix(stem)}"


def read_measured(path: Path, case: Case) -> pd.DataFrame:
    """Measured rows of a CSV file, SI: operation, bit_depth_m, and loads with the low and high ends of their ranges.

    Headers name their units as those of surveys do: ``depth_ft``, ``Hook load (klbf)``, ``torque_low_kN_m``; loads that
    the file does not have are NaN.  Hook loads are those of the string; a weight indicator's reading is converted by
    the block weight of the case, and the other way round.  Raises InputError, which names file, row and column.
    """
    try:
        table = _table(_rows(path), case.depths[1])
    except InputError as error:
        raise error.in_file(path) from error.__cause__
    rig = case.rig
    gain = table["operation"].map(lambda kind: rig.sheave_efficiency ** -KINDS[kind].direction)
    for end in _ENDS:
        string, indicator = f"hookload{end}_N", f"weight_indicator{end}_N"
        known = table[string].copy()
        table[string] = known.fillna(table[indicator] / gain - rig.block_weight)
        table[indicator] = table[indicator].fillna((known + rig.block_weight) * gain)
    return table


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Line number and stripped cells of every row that is not blank."""
    try:
        reader = csv.reader(io.StringIO(read_text(path, _LARGEST_FILE)))
        return [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if any(map(str.strip, cells))]
    except OSError as error:
        raise InputError(f"a file of measured rows that can be read ({error.strerror})") from error
    except InputError:
        raise
    except (ValueError, csv.Error) as error:
        raise InputError(f"a CSV file of text ({error})") from error


def _table(rows: Sequence[tuple[int, list[str]]], deepest: float) -> pd.DataFrame:
    """The measured rows; deepest [m] : end of the hole."""
    import pandas as pd

    if len(rows) < 2:
        raise InputError("a row of headers and a row for each measurement")
    (first, headers), *body = rows
    found = [_column_of(header, f"row {first}") for header in headers]
    names = [column for column, _, _ in found]
    for k, name in enumerate(names):
        if name and name in names[:k]:
            expected = f"one column of {name} (another is {headers[names.index(name)]})"
            raise InputError(expected, key=f"row {first}", value=headers[k])
    needed = {"bit depth": {"bit_depth_m"}, "operation": {"operation"}, "load or torque": set(_LOAD_COLUMNS)}
    for what, columns in needed.items():
        if not columns & set(names):
            expected = f"a column of {what} among the headers, {_HEADERS}"
            raise InputError(expected, key=f"row {first}", value=", ".join(headers))
    records = []
    for line, cells in body:
        record: dict[str, object] = {}
        for k, (name, quantity, unit) in enumerate(found):
            cell = cells[k] if k < len(cells) else ""
            if name:
                try:
                    record[name] = value = _cell(cell, name, quantity, unit)
                    if name == "bit_depth_m" and isinstance(value, float) and value > deepest + _BELOW:
                        raise InputError(f"a depth in the hole, which ends at {deepest:g} m")
                except InputError as error:
                    raise InputError(error.expected, key=f"row {line}, {headers[k]}", value=cell) from error
        _check_ranges(record, line)
        records.append(record)
    return pd.DataFrame(records).reindex(columns=["operation", "bit_depth_m", *_LOAD_COLUMNS])


def _column_of(header: str, row: str) -> tuple[str, Quantity | None, str]:
    """Column of the table, quantity and unit of a header; no name for another column."""
    if header.lower() in ("operation", "kind"):
        return "operation", None, ""
    for field in (_DEPTH, *_LOADS):
        ends = "" if field is _DEPTH else "(?:[ _](?P<end>low|high))?"
        match = re.fullmatch(f"(?:{field.names}){ends}{_UNIT}", header, re.IGNORECASE)
        if match is None:
            continue
        unit = match["inside"] or (match["after"] or "").replace("_", "*")
        quantity = Quantity(dimension=field.dimension, at_least=0.0 if field is _DEPTH else None)
        end = f"_{match['end'].lower()}" if "end" in match.groupdict() and match["end"] else ""
        try:
            quantity.parse(f"1 {unit}")
        except InputError as error:
            expected = f"a header that ends in its unit, such as {field.stem}{end}_{field.example}"
            raise InputError(expected, key=row, value=header) from error
        return f"{field.stem}{end}_{field.unit}", quantity, unit
    return "", None, ""


def _cell(cell: str, column: str, quantity: Quantity | None, unit: str) -> object:
    """The value of a cell [SI]; NaN for an empty one."""
    if quantity is None:
        if cell not in KINDS:
            raise InputError(nearest(cell, KINDS, "kind"))
        return cell
    if not cell and column != "bit_depth_m":
        return np.nan
    try:
        float(cell)
    except ValueError as error:
        raise InputError("a number") from error
    return quantity.parse(f"{cell} {unit}")


def _check_ranges(record: dict[str, object], line: int) -> None:
    """Raise InputError for a range with one end, or one that does not hold its value."""
    for field in _LOADS:
        value, low, high = (float(str(record.get(f"{field.stem}{end}_{field.unit}", np.nan))) for end in _ENDS)
        key = f"row {line}, {field.stem}"
        if np.isnan(low) != np.isnan(high):
            raise InputError("both ends of a range, low and high", key=key)
        if low > high or value < low or value > high:
            raise InputError(
                "a low end, a value and a high end that rise", key=key, value=f"{low:g}, {value:g}, {high:g} in SI"
            )
