"""CSV files of measurements: columns whose headers name their units, loads as values or ranges.

Cells are separated by commas, or as a spreadsheet copies and saves them by tabs or semicolons.
Headers name their units as those of surveys do: ``depth_ft``, ``Hook load (klbf)``, ``torque_low_kN_m``, ``speed_m/s``.
"""

import csv
import io
import re
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from fctd.case.errors import InputError
from fctd.case.input_file import read_office_text
from fctd.case.text import counted
from fctd.case.units import Dimension, Quantity

LARGEST_FILE: Final = 8  # MiB
MOST_ROWS: Final = 10_000  # a string is solved for each
# Readings beyond these, [N] and [N*m], are no rig's: a hundred times what the strongest hoists and drives do.
LARGEST_FORCE, LARGEST_TORQUE = 1e9, 1e8
ENDS: Final = ("", "_low", "_high")
# A unit in brackets, or after an underscore as in the columns of tables.
_UNIT: Final = r"(?:[ _]*[(\[]\s*(?P<inside>[^)\]]+?)\s*[)\]]|_(?P<after>[\w/]+))?"
# Before three digits a comma may also part thousands: such a cell is refused.
_DECIMAL_COMMA: Final = re.compile(r"([+-]?\d+),(\d{1,2}|\d{4,})")


class Field(NamedTuple):
    """A quantity of a file.

    stem, unit : of its column in the table; names : in headers, a regular expression; example : a unit; ranged :
    whether it has columns of a low and a high end; at_least, at_most : smallest and largest value [SI]; bare :
    the unit of a header without one.
    """

    stem: str
    unit: str
    dimension: Dimension
    names: str
    example: str
    ranged: bool = False
    at_least: float | None = None
    at_most: float | None = None
    bare: str = ""

    def column(self, end: str = "") -> str:
        """The name of its column in the table; end : one of ``ENDS``."""
        return "_".join(filter(None, (f"{self.stem}{end}", self.unit)))


class Text(NamedTuple):
    """A column of texts: its name in the table, its names in headers, and how a cell is read."""

    stem: str
    names: str
    read: Callable[[str], object] = str


class Line(NamedTuple):
    """A row of a file: its line, the names of its columns as the headers write them, and its cells by column, SI."""

    number: int
    headers: Mapping[str, str]
    cells: dict[str, object]
    written: Mapping[str, str]

    def error(self, column: str, expected: str) -> InputError:
        """The error of a cell, which names row, column and value."""
        key = f"row {self.number}, {self.headers.get(column, column)}"
        if column not in self.headers:
            return InputError(expected, key=key)
        return InputError(expected, key=key, value=self.written.get(column, ""))

    def number_of(self, column: str) -> float:
        """A number of the row, NaN where there is none."""
        return float(str(self.cells.get(column, np.nan)))


class _Column(NamedTuple):
    """A column of a file: its name in the table ("" for one that is not read), and how a cell is read."""

    name: str
    read: Callable[[str], object]


def read_lines(path: Path, fields: Sequence[Field], texts: Sequence[Text], headers: str) -> list[Line]:
    """The rows of a CSV file that are not blank.  headers : an example of them, for messages.

    Numbers are SI, and NaN where a cell is empty.  Raises InputError, which names row and column, for headers without a
    unit, cells that cannot be read, rows with more cells than headers, and ranges whose ends do not rise.
    """
    rows = _rows(path)
    if len(rows) < 2:
        raise InputError("a row of headers and a row for each measurement")
    if len(rows) > MOST_ROWS + 1:
        raise InputError(f"at most {MOST_ROWS} rows", value=len(rows) - 1)
    (first, names), *body = rows
    columns = [_column_of(name, fields, texts, f"row {first}") for name in names]
    found = [column.name for column in columns]
    for k, name in enumerate(found):
        if name and name in found[:k]:
            expected = f"one column of {name} (another is {names[found.index(name)]})"
            raise InputError(expected, key=f"row {first}", value=names[k])
    by_name = {column.name: header for column, header in zip(columns, names, strict=True) if column.name}
    if not by_name:
        raise InputError(f"headers {headers}", key=f"row {first}", value=", ".join(names))
    lines = []
    for number, cells in body:
        if any(cells[len(columns) :]):
            raise InputError(
                f"{counted(len(columns), 'cell')}, as many as headers", key=f"row {number}", value=", ".join(cells)
            )
        padded = [*cells, *[""] * len(columns)]
        written = {column.name: cell for column, cell in zip(columns, padded, strict=False) if column.name}
        line = Line(number, by_name, {}, written)
        for column in columns:
            if column.name:
                try:
                    line.cells[column.name] = column.read(written[column.name])
                except InputError as error:
                    raise line.error(column.name, error.expected) from error
        for field in fields:
            if field.ranged:
                _check_range(line, field)
        lines.append(line)
    return lines


def require(lines: Sequence[Line], what: str, columns: Sequence[str], headers: str) -> None:
    """Raise InputError unless the file has one of these columns; headers : an example of them."""
    if not set(columns) & set(lines[0].headers):
        expected = f"a column of {what} among the headers, {headers}"
        raise InputError(expected, key="row 1", value=", ".join(lines[0].headers.values()))


def _rows(path: Path) -> list[tuple[int, list[str]]]:
    """Line number and stripped cells of every row that is not blank."""
    try:
        text = read_office_text(path, LARGEST_FILE)
        reader = csv.reader(io.StringIO(text), delimiter=_separator(text))
        return [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if any(map(str.strip, cells))]
    except OSError as error:
        raise InputError(f"a file of measured rows that can be read ({error.strerror})") from error
    except InputError:
        raise
    except (ValueError, csv.Error) as error:
        raise InputError(f"a CSV file of text ({error})") from error


def _separator(text: str) -> str:
    """What separates the cells of a text: a comma, or the tab or the semicolon of a spreadsheet's headers."""
    headers = next((line for line in text.splitlines() if line.strip()), "")
    return "\t" if "\t" in headers else ";" if ";" in headers and "," not in headers else ","


def _column_of(header: str, fields: Sequence[Field], texts: Sequence[Text], row: str) -> _Column:
    """The column that a header names."""
    for text in texts:
        if re.fullmatch(text.names, header, re.IGNORECASE):
            return _Column(text.stem, text.read)
    for field in fields:
        ends = "(?:[ _](?P<end>low|high))?" if field.ranged else ""
        match = re.fullmatch(f"(?:{field.names}){ends}{_UNIT}", header, re.IGNORECASE)
        if match is None:
            continue
        end = f"_{match['end'].lower()}" if field.ranged and match["end"] else ""
        quantity = Quantity(dimension=field.dimension, at_least=field.at_least, at_most=field.at_most)
        for unit in _units(match["inside"], match["after"], field.bare):
            try:
                quantity.parse(f"1 {unit}")
            except InputError:
                continue
            return _Column(field.column(end), partial(_number, quantity=quantity, unit=unit))
        expected = f"a header that ends in its unit, such as {field.stem}{end}_{field.example}"
        raise InputError(expected, key=row, value=header)
    return _Column("", str)


def _units(inside: str | None, after: str | None, bare: str) -> list[str]:
    """The unit of a header as people write it: ``kN_m`` is a product and ``m_s`` a quotient."""
    if inside is not None:
        return [inside]
    if after is None:
        return [bare] if bare else []
    return [after.replace("_", "*"), "/".join(after.rsplit("_", 1))]


def _number(cell: str, quantity: Quantity, unit: str) -> float:
    """The value of a cell [SI]; NaN for an empty one."""
    if not cell:
        return float("nan")
    comma = _DECIMAL_COMMA.fullmatch(cell)
    number = f"{comma[1]}.{comma[2]}" if comma else cell
    try:
        float(number)
    except ValueError as error:
        raise InputError("a number") from error
    return quantity.parse(f"{number} {unit}")


def _check_range(line: Line, field: Field) -> None:
    """Raise InputError for a range with one end, or one that does not hold its value."""
    value, low, high = (line.number_of(field.column(end)) for end in ENDS)
    key = f"row {line.number}, {field.stem}"
    if np.isnan(low) != np.isnan(high):
        raise InputError("both ends of a range, low and high", key=key)
    if low > high or value < low or value > high:
        shown = f"{low:g}, {value:g}, {high:g} in SI"
        raise InputError("a low end, a value and a high end that rise", key=key, value=shown)
