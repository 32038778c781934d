"""Rows of cells, from a text or a sheet, to stations as they are written."""

import math
import re
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from fctd.case.errors import InputError
from fctd.case.surveys import headers
from fctd.case.surveys.headers import (
    TITLES,
    NoUnitError,
    Row,
    Wanted,
    cell_of,
    find_columns,
    find_header,
    find_units,
    is_comment,
)
from fctd.case.surveys.stations import MOST_STATIONS, StationKey, Where, Written

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d*(?:[eE][+-]?\d+)?", re.ASCII)
# Digits in groups of three: of "1,234" nobody can say whether the comma is one of decimals or of thousands.
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+", re.ASCII)
_THOUSANDS_BY_DOT = re.compile(r"[+-]?[1-9]\d{0,2}\.\d{3}", re.ASCII)
_SHORTEST = 50.0  # [m or ft]: depths up to this, all with three decimals, may be thousands
_BLANK_IN_NUMBER = re.compile(r"(?<=\d)[ \u00a0\u2009\u202f](?=\d{3}(?!\d))")


def read_table(
    rows: Sequence[Row], columns: Mapping[StationKey, Wanted], *, decimal_commas: bool, cut: bool = False
) -> Written:
    """The stations below the row of headers; title lines, comments, repeated headers and rows without a cell of the
    three are left out.

    decimal_commas : whether a comma in a cell may be a decimal comma; in a file whose cells are separated by commas it
    is not.  cut : whether the cells were cut out of lines at a separator: a row of more cells than headers is refused,
    since the separator stood in a number or a text.  Raises InputError, which names row and column, for what cannot be
    read.
    """
    if not rows:
        raise InputError("a row of headers and a row for each station, the file is empty")
    top, score = find_header(rows, columns)
    if score == 0 and read_number(rows[top][1][0]) is not None:
        key, written = f"row {rows[top][0]}", ", ".join(rows[top][1])
        raise InputError("a row of headers above the numbers, such as md_m, inc_deg, azi_deg", key=key, value=written)
    if score == 0:  # whatever file this is, its text is not quoted: a case may be someone else's
        raise InputError(f"a row of headers such as md_m, inc_deg, azi_deg in the first {TITLES} rows")
    found = find_columns(rows[top], columns)
    stated = find_units(rows[top + 1 :], found)
    try:
        units = headers.units(rows[top], found, stated, columns)
    except NoUnitError as error:
        title = headers.unit_in_titles(rows[:top])
        if title is None:
            raise
        raise InputError(error.expected, key=f"row {title[0]}, a title", value=title[1][0]) from None
    known = [cells for _, cells in (rows[top], *stated)]
    below = [
        (number, cells)
        for number, cells in rows[top + 1 :]
        if not is_comment(cells) and cells not in known and any(cell_of((number, cells), c) for c in found)
    ]
    if len(below) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")
    if cut:
        _refuse_excess(rows[top][1], below)

    def where(row: int, column: int) -> tuple[str, object]:
        return f"row {below[row][0]}, {found[column].header}", cell_of(below[row], found[column])

    comma = _find_decimal_comma(below, found) if decimal_commas else None
    values = np.empty((len(below), len(found)))
    for row, column in np.ndindex(values.shape):
        text = cell_of(below[row], found[column])
        number = read_number(text.replace(",", ".") if comma else text)
        if number is None or (comma and "." in text):
            key, cell = where(row, column)
            thousands = " without separators of thousands" if "," in text else ""
            dot = f" with a decimal comma, as in row {comma}" if comma and "." in text else ""
            raise InputError(f"a number{thousands}{dot}", key=key, value=cell)
        values[row, column] = number
    if not comma:
        _refuse_thousands_by_dots(values, where)
    return Written(values, (units[0], units[1], units[2]), where, [number for number, _ in below])


def _refuse_excess(names: Sequence[str], rows: Sequence[Row]) -> None:
    """Raise InputError for a row with a cell to the right of the last header."""
    count = max(place for place, name in enumerate(names, start=1) if name)
    for number, cells in rows:
        if any(cells[count:]):
            raise InputError(
                f"at most {count} cells, as many as headers (what separates columns is no decimal comma)",
                key=f"row {number}",
                value=", ".join(cells),
            )


def _refuse_thousands_by_dots(values: NDArray[np.float64], where: Where) -> None:
    """Raise InputError for depths such as "1.030" beside whole angles: 1.03 or 1030, and no other cell tells which."""
    texts = [[str(where(row, column)[1]) for column in range(3)] for row in range(len(values))]
    deep = [row for row in range(len(values)) if values[row, 0] != 0.0]
    doubtful = (
        bool(deep)
        and values[deep, 0].max() <= _SHORTEST
        and all(_THOUSANDS_BY_DOT.fullmatch(texts[row][0]) for row in deep)
        and not any("." in cell for row in texts for cell in row[1:])
    )
    if doubtful:
        key, text = where(deep[0], 0)
        raise InputError(
            f"a number whose dot has one meaning: this is {values[deep[0], 0]:g} or {1e3 * values[deep[0], 0]:g}",
            key=key,
            value=text,
        )


def _find_decimal_comma(rows: Sequence[Row], found: Sequence[headers.Column]) -> int | None:
    """The first row with a decimal comma, or None; InputError where "1,234" may be read in two ways."""
    doubtful: tuple[str, str] | None = None
    for row in rows:
        for column in found:
            text = _BLANK_IN_NUMBER.sub("", cell_of(row, column))
            if "," not in text:
                continue
            if _DECIMAL_COMMA.fullmatch(text) and not _GROUPED.fullmatch(text):
                return row[0]
            doubtful = doubtful or (f"row {row[0]}, {column.header}", text)
    if doubtful is not None and _GROUPED.fullmatch(doubtful[1]):
        key, text = doubtful
        raise InputError(
            f"a number whose comma has one meaning: this is {text.replace(',', '.', 1)} or {text.replace(',', '')}",
            key=key,
            value=text,
        )
    return None


def read_number(text: str) -> float | None:
    """A number of plain digits; None for another text."""
    text = _BLANK_IN_NUMBER.sub("", text.replace("\N{MINUS SIGN}", "-"))
    if _NUMBER.fullmatch(text):
        return float(text)
    return math.nan if _NOT_FINITE.fullmatch(text) else None
