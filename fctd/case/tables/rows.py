"""The rows of a table below its headers, and the numbers in them."""

import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Final

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import MISSING, InputError
from fctd.case.tables.fields import Column

# Values that stand for none in LAS and WITSML logs.
NULLS: Final = (-999.25, -999.0, -9999.0, -9999.25, -99999.0)
NOTHING: Final = ("", "nan", "null", "n/a", "inf", "-inf")
_PLAIN: Final = re.compile(r"[-+.\deE]*", re.ASCII)
_NUMBER: Final = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE: Final = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_DECIMAL_COMMA: Final = re.compile(r"[+-]?\d*,\d*(?:[eE][+-]?\d+)?", re.ASCII)
# Digits in groups of three: of "1,234" nobody can say whether the comma is one of decimals or of thousands, and beside
# decimal commas the point of "1.234" may be one of thousands.
_GROUPED: Final = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+", re.ASCII)
GROUPED_BY_POINT: Final = re.compile(r"[+-]?[1-9]\d{0,2}\.\d{3}", re.ASCII)
_APOSTROPHES: Final = re.compile(r"[+-]?\d{1,3}(?:['\u2019]\d{3})+(?:[.,]\d*)?")
# Angles of a quadrant, N38E, and with minutes, 12°30'.
_BEARING: Final = re.compile(r"[NS]\W*\d.*[EW]|\d+\s*°\s*\d.*", re.IGNORECASE)
_BLANK_IN_NUMBER: Final = re.compile(r"(?<=\d)[ \u00a0\u2009\u202f](?=\d{3}(?!\d))")


@dataclass(frozen=True)
class Rows:
    """Rows of a table.

    columns : by key; numbers : of the rows in their file; cells : texts of each column; one, several : names of a row
    and of a range of rows, to be filled with numbers.
    """

    columns: Mapping[str, Column]
    numbers: Sequence[int]
    cells: Mapping[str, list[str]]
    one: str = "row {}"
    several: str = "rows {} to {}"

    def __len__(self) -> int:
        return len(self.numbers)

    def where(self, row: int, key: str) -> tuple[str, object]:
        """The name of a cell, and its text; that is MISSING where the table does not have the column."""
        column, name = self.columns.get(key), self.one.format(self.numbers[row])
        return (f"{name}, {key}", MISSING) if column is None else (f"{name}, {column.header}", self.cells[key][row])

    def error(self, row: int, key: str, expected: str) -> InputError:
        """The error of a cell, which names row, column and value."""
        place, value = self.where(row, key)
        return InputError(expected, key=place, value=value)

    def texts(self, key: str) -> list[str]:
        """The cells of a column, empty ones where the table has none."""
        return self.cells[key] if key in self.columns else [""] * len(self)


class Numbers:
    """Reads cells as numbers.  The first decimal comma decides for all rows, those of the next call too."""

    def __init__(self) -> None:
        self._comma: int | None = None

    def read(self, rows: Rows, keys: Collection[str], nothing: Collection[str] = ("",)) -> Array:
        """The numbers of columns (n, k), in the units of the columns.

        nothing : texts in lower case that stand for no number, NaN.  Raises InputError, which names the first cell that
        is neither, and where "1,234" may be read in two ways.
        """
        if self._comma is None:
            self._comma = _find_decimal_comma(rows, keys)
        values = np.full((len(rows), len(keys)), np.nan)
        bad: list[tuple[int, str]] = []
        for k, key in enumerate(keys):
            found = self._column(rows.cells[key], nothing)
            bad += [(row, key) for row, value in enumerate(found) if value is None]
            values[:, k] = [math.nan if value is None else value for value in found]
        if bad:
            raise self._refused(rows, min(bad, key=lambda cell: cell[0]), len(bad))
        return values

    def _column(self, cells: list[str], nothing: Collection[str]) -> Sequence[float | None]:
        if self._comma is not None:
            cells = ["?" if GROUPED_BY_POINT.fullmatch(cell) else cell.replace(",", ".") for cell in cells]
        if _PLAIN.fullmatch("".join(cells)) and ("" in nothing or all(cells)):
            with suppress(ValueError):  # one of them is no number: which one is found below
                return [float(cell) if cell else math.nan for cell in cells]
        return [math.nan if cell.casefold() in nothing else read_number(cell) for cell in cells]

    def _refused(self, rows: Rows, cell: tuple[int, str], count: int) -> InputError:
        text = rows.cells[cell[1]][cell[0]]
        thousands = " without separators of thousands" if "," in text or _APOSTROPHES.fullmatch(text) else ""
        angle = " of degrees with decimals" if _BEARING.fullmatch(text) else ""
        comma = f" with a decimal comma, as in row {self._comma}" if self._comma and "." in text else ""
        more = f" ({count} such cells)" if count > 1 else ""
        number = "a finite number" if _NOT_FINITE.fullmatch(text) else "a number"
        return rows.error(*cell, f"{number}{angle}{thousands}{comma}{more}")


def read_number(text: str) -> float | None:
    """A finite number of plain digits; None for another text."""
    text = _BLANK_IN_NUMBER.sub("", text.replace("\N{MINUS SIGN}", "-"))
    return float(text) if _NUMBER.fullmatch(text) else None


def _find_decimal_comma(rows: Rows, keys: Iterable[str]) -> int | None:
    """The first row with a decimal comma, or None; InputError where "1,234" may be read in two ways."""
    written = [key for key in keys if "," in "".join(rows.cells[key])]
    commas = [(row, key) for key in written for row, cell in enumerate(rows.cells[key]) if "," in cell]
    doubtful: tuple[int, str] | None = None
    for row, key in sorted(commas, key=lambda cell: cell[0]):
        text = _BLANK_IN_NUMBER.sub("", rows.cells[key][row])
        if _DECIMAL_COMMA.fullmatch(text) and not (_GROUPED.fullmatch(text) and rows.columns[key].may_be(text)):
            return rows.numbers[row]
        doubtful = doubtful or (row, key)
    if doubtful is not None and _GROUPED.fullmatch(text := rows.cells[doubtful[1]][doubtful[0]]):
        once = f"a number whose comma has one meaning: this is {text.replace(',', '.', 1)} or {text.replace(',', '')}"
        raise rows.error(*doubtful, once)
    return None
