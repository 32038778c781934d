"""Rows of cells, from a text or a sheet, to stations as they are written."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence

import numpy as np

from fctd.case.errors import InputError
from fctd.case.surveys import headers
from fctd.case.surveys.headers import Row, Wanted, cell_of, find_columns, find_header, is_comment, is_units
from fctd.case.surveys.stations import MOST_STATIONS, StationKey, Written

_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?", re.ASCII)
_NOT_FINITE = re.compile(r"[+-]?(?:nan|inf|infinity)", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d*(?:[eE][+-]?\d+)?", re.ASCII)
# Digits in groups of three: of "1,234" nobody can say whether the comma is one of decimals or of thousands.
_GROUPED = re.compile(r"[+-]?[1-9]\d{0,2}(?:,\d{3})+", re.ASCII)
_BLANK_IN_NUMBER = re.compile(r"(?<=\d)[ \u00a0\u2009\u202f](?=\d{3}(?!\d))")


def read_table(rows: Sequence[Row], columns: Mapping[StationKey, Wanted], *, decimal_commas: bool) -> Written:
    """The stations below the row of headers; title lines, comments and rows without a cell of the three are left out.

    decimal_commas : whether a comma in a cell may be a decimal comma; in a file whose cells are separated by commas it
    is not.  Raises InputError, which names row and column, for what cannot be read.
    """
    if not rows:
        raise InputError("a row of headers and a row for each station, the file is empty")
    top, score = find_header(rows, columns)
    if score == 0 and read_number(rows[top][1][0]) is not None:
        key, written = f"row {rows[top][0]}", ", ".join(rows[top][1])
        raise InputError("a row of headers above the numbers, such as md_m, inc_deg, azi_deg", key=key, value=written)
    found = find_columns(rows[top], columns)
    below = [row for row in rows[top + 1 :] if not is_comment(row[1]) and any(cell_of(row, c) for c in found)]
    stated = below.pop(0) if below and is_units(below[0], found) else None
    units = headers.units(rows[top], found, stated, columns)
    if len(below) > MOST_STATIONS:
        raise InputError(f"at most {MOST_STATIONS} stations")

    def where(row: int, column: int) -> tuple[str, object]:
        return f"row {below[row][0]}, {found[column].header}", cell_of(below[row], found[column])

    with_comma = _find_decimal_comma(below, found) if decimal_commas else False
    values = np.empty((len(below), len(found)))
    for row, column in np.ndindex(values.shape):
        text = cell_of(below[row], found[column])
        number = read_number(text.replace(",", ".") if with_comma and "." not in text else text)
        if number is None:
            key, cell = where(row, column)
            thousands = " without separators of thousands" if "," in text else ""
            raise InputError(f"a number{thousands}", key=key, value=cell)
        values[row, column] = number
    return Written(values, (units[0], units[1], units[2]), where, [number for number, _ in below])


def _find_decimal_comma(rows: Sequence[Row], found: Sequence[headers.Column]) -> bool:
    """Whether the commas in the cells are decimal commas; InputError where "1,234" may be read in two ways."""
    doubtful: tuple[str, str] | None = None
    for row in rows:
        for column in found:
            text = _BLANK_IN_NUMBER.sub("", cell_of(row, column))
            if "," not in text:
                continue
            if _DECIMAL_COMMA.fullmatch(text) and not _GROUPED.fullmatch(text):
                return True
            doubtful = doubtful or (f"row {row[0]}, {column.header}", text)
    if doubtful is not None and _GROUPED.fullmatch(doubtful[1]):
        key, text = doubtful
        raise InputError(
            f"a number whose comma has one meaning: this is {text.replace(',', '.', 1)} or {text.replace(',', '')}",
            key=key,
            value=text,
        )
    return False


def read_number(text: str) -> float | None:
    """A number of plain digits; None for another text."""
    text = _BLANK_IN_NUMBER.sub("", text.replace("\N{MINUS SIGN}", "-"))
    if _NUMBER.fullmatch(text):
        return float(text)
    return math.nan if _NOT_FINITE.fullmatch(text) else None
