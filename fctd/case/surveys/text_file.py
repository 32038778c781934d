"""Text files of columns: their encoding, their separator, and their rows of cells."""

import csv
import io
import re
from collections.abc import Mapping
from itertools import islice
from typing import Final

from fctd.case.errors import InputError
from fctd.case.input_file import encoding_of
from fctd.case.surveys.headers import COMMENT, KEYS, TITLES, Row, Wanted, find_header, is_comment
from fctd.case.surveys.stations import MOST_STATIONS, StationKey, Written
from fctd.case.surveys.table import read_table

KINDS: Final = "a survey: text in columns, an Excel workbook (xlsx) or a WITSML trajectory (XML)"
_BINARY: Final = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")
# Columns apart by blanks: a row of headers is split at two blanks or more, "Measured Depth  Inclination", or at every
# blank, except before a bracket, which holds the unit: "MD (m) Inc (deg)".
_WIDE: Final = "  "
_NARROW: Final = " "
_SEPARATORS: Final = ("\t", ";", ",", "|", _WIDE, _NARROW)
_BREAK: Final = re.compile(r" (?![(\[])|(?<=[)\]]) ")
_LONGEST: Final = MOST_STATIONS + TITLES + 2  # rows: enough to refuse a survey that is too long


def decode(content: bytes) -> str:
    """The text of a file in UTF-8, UTF-16 or Latin-1 (Windows 1252), with every line end as a newline.

    Raises InputError for a file that is not text.
    """
    try:
        text = content.decode(encoding_of(content)).removesuffix("\x1a")  # the mark of DOS at the end of a text
    except UnicodeDecodeError as error:
        raise InputError(KINDS) from error
    if _BINARY.search(text):
        raise InputError(KINDS)
    return io.StringIO(text, newline=None).read()


def read_text(text: str, columns: Mapping[StationKey, Wanted]) -> Written:
    """The stations of a text in columns, apart by the separator that gives all three: tab, ; , | or blanks.

    Raises InputError for a text that cannot be read.
    """
    try:
        start = "\n".join(text.split("\n", 4 * TITLES)[: 4 * TITLES])
        separator = max(_SEPARATORS, key=lambda separator: _likelihood(start, separator, columns))
        if separator in (_WIDE, _NARROW):
            return read_table(_blanks(text, separator, columns), columns, decimal_commas=True)
        return read_table(_separated(text, separator), columns, decimal_commas=separator != ",", cut=True)
    except csv.Error as error:
        raise InputError(f"a text in columns ({error})") from error


def _likelihood(start: str, separator: str, columns: Mapping[StationKey, Wanted]) -> tuple[int, int]:
    """How many of the three columns a separator gives; without any, how many columns at all."""
    blanks = separator in (_WIDE, _NARROW)
    rows = _split(_lines(start), separator) if blanks else _separated(start, separator)
    if not rows:
        return 0, 0
    index, score = find_header(rows, columns)
    return score, 0 if score or blanks else len(rows[index][1])


def _separated(text: str, separator: str) -> list[Row]:
    """The rows that are not blank, of cells that may stand in quotes."""
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    rows = ((reader.line_num, [cell.strip() for cell in cells]) for cells in reader)
    return list(islice((row for row in rows if any(row[1])), _LONGEST))


def _lines(text: str) -> list[tuple[int, str]]:
    """The lines that are not blank and their numbers."""
    lines = ((number, line.strip()) for number, line in enumerate(text.split("\n"), start=1))
    return list(islice((line for line in lines if line[1]), _LONGEST))


def _split(lines: list[tuple[int, str]], separator: str) -> list[Row]:
    """Headers may stand in a comment, "# MD Inc Azi": its sign belongs to the first cell."""
    rows = []
    for number, line in lines:
        text = COMMENT + line.lstrip(COMMENT).lstrip() if line.startswith(COMMENT) else line
        rows.append((number, re.split(r"\s{2,}", text) if separator == _WIDE else _BREAK.split(" ".join(text.split()))))
    return rows


def _blanks(text: str, separator: str, columns: Mapping[StationKey, Wanted]) -> list[Row]:
    """Rows of columns apart by blanks: below the headers a row has as many cells as they have, or InputError."""
    lines = _lines(text)
    rows = _split(lines, separator)
    top, score = find_header(rows, columns)
    if score < len(KEYS):
        return rows  # refused with the headers
    count = len(rows[top][1])
    for index in range(top + 1, len(rows)):
        number, line = lines[index]
        cells = line.split()
        if is_comment(rows[index][1]):
            if len(cells) == count and not is_comment(rows[top][1]):  # units, below the header of station numbers
                rows[index] = (number, cells)
            continue
        if len(rows[index][1]) == count:
            continue
        if len(cells) != count:
            raise InputError(
                f"{count} columns, as many as headers (separate columns by commas or tabs where cells are empty)",
                key=f"row {number}",
                value=line,
            )
        rows[index] = (number, cells)
    return rows
