"""Texts of columns, and sheets: their separator, their headers, and their rows of cells."""

import csv
import io
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Final

from fctd.case.errors import InputError
from fctd.case.tables import headers
from fctd.case.tables.fields import Column
from fctd.case.tables.headers import COMMENT, TITLES, Choices, Line, TableForm, cell_of, is_comment
from fctd.case.tables.rows import Rows, read_number

# Columns apart by blanks: a row of headers is split at two blanks or more, "Measured Depth  Inclination", or at every
# blank, except before a bracket, which holds the unit: "MD (m) Inc (deg)".
_WIDE: Final = "  "
_NARROW: Final = " "
_SEPARATORS: Final = ("\t", ";", ",", "|", _WIDE, _NARROW)
_BREAK: Final = re.compile(r" (?![(\[])|(?<=[)\]]) ")
_START: Final = 4 * TITLES  # lines in which the headers are looked for
_PIECE: Final = 50_000  # rows


@dataclass(frozen=True)
class Layout:
    """Where a table has its columns.

    top : the row of headers; columns : by key; repeated : cells of the columns in rows that may come again, headers and
    units; index : of the row below them among those of the table.  separator : of the cells of a text, "" of a sheet.
    """

    form: TableForm
    top: Line
    columns: dict[str, Column]
    repeated: Sequence[Sequence[str]]
    index: int
    separator: str = ""

    def rows(self, rows: Iterable[Line]) -> Rows:
        """Those of the rows below the headers that have a cell of the columns, without comments and what is repeated.

        Raises InputError for too many of them, and for a row of a text with more cells than headers, since the
        separator stood in a number.
        """
        places, most = [column.place for column in self.columns.values()], self.form.most
        padding = [""] * (max(places) + 1)
        count = max(place for place, name in enumerate(self.top[1], start=1) if name)
        numbers: list[int] = []
        found: list[list[str]] = []
        for number, row in rows:
            padded = [*row, *padding]
            cells = [padded[place].strip() for place in places]
            if not any(cells) or is_comment(row) or cells in self.repeated:
                continue
            if self.separator and "".join(row[count:]).strip():
                expected = f"at most {count} cells, as many as headers (the column separator cannot be a decimal comma)"
                raise InputError(expected, key=f"row {number}", value=", ".join(row))
            numbers.append(number)
            found.append(cells)
            if most is not None and len(numbers) > most:
                raise InputError(f"at most {most} {self.form.row}s")
        by_column = map(list, zip(*found, strict=True)) if found else ([] for _ in places)
        return Rows(self.columns, numbers, dict(zip(self.columns, by_column, strict=True)))

    def below(self, text: str, first: int = 0) -> Iterator[Line]:
        """The rows of a whole text below its headers, or of later lines, the first of which has this number."""
        rows = _cut(text, self.separator, first) if first else islice(_cut(text, self.separator), self.index, None)
        return ((number, _split(cells, self.separator, number, len(self.top[1]))) for number, cells in rows)

    def pieces(self, text: str) -> Iterator[Rows]:
        """The rows of a long text in pieces, of which there is one or more."""
        rows = self.below(text)
        yield self.rows(islice(rows, _PIECE))
        for row in rows:
            yield self.rows([row, *islice(rows, _PIECE)])


def read_text(text: str, form: TableForm, choices: Choices) -> Rows:
    """The rows of a text in columns; raises InputError, which names row and column, for one that is no such table."""
    layout = find_layout(text, form, choices)
    return layout.rows(layout.below(text))


def read_sheet(rows: Sequence[Line], form: TableForm, choices: Choices) -> Rows:
    """The rows of a sheet; raises InputError as `read_text` does."""
    layout = _lay_out(rows, rows, form, choices, "")
    return layout.rows(rows[layout.index :])


def find_layout(text: str, form: TableForm, choices: Choices) -> Layout:
    """Where a text has its columns, which the separator separates that gives most of them: tab ; , | or blanks.

    Raises InputError for a text without headers, without a column that it needs, or without a unit.
    """
    start = "\n".join(text.split("\n", _START)[:_START])
    best: tuple[tuple[bool, int, int], str, list[Line], list[Line]] | None = None
    unnamed: list[Line] = []
    for separator in _SEPARATORS:
        rows = list(_cut(start, separator))
        heads = [(number, [cell.strip() for cell in _split(cells, separator)]) for number, cells in rows]
        index, found = headers.find_header(heads, form, choices)
        unnamed += _above_numbers(heads)
        blanks, lacking = separator in (_WIDE, _NARROW), bool(form.lacking(found))
        # Blanks separate words, too, each of which may be a name: they count where nothing else gives what is needed.
        columns = 0 if blanks or not rows else len(heads[index][1])
        columns = min(columns, 2) if found else columns  # one cell that names a field may be a whole row
        rank = not lacking, len(found) if lacking or not blanks else 0, columns
        if best is None or rank > best[0]:
            best = rank, separator, heads, rows
    assert best is not None
    if unnamed and best[0][:2] == (False, 0):
        raise _other_words(form, unnamed[0])
    return _lay_out(best[2], best[3], form, choices, best[1])


def _above_numbers(rows: Sequence[Line]) -> list[Line]:
    """The row of words that stands above the first row of numbers, and above one of units; none without both."""
    for k, (_, cells) in enumerate(rows):
        if len(cells) > 1 and all(read_number(cell.replace(",", ".")) is not None for cell in cells):
            return [row for row in rows[max(k - 2, 0) : k] if len(row[1]) == len(cells) and all(row[1])][:1]
    return []


def _other_words(form: TableForm, row: Line | None = None) -> InputError:
    """The error of a table whose headers are in other words: of the row, or of one that was not found.

    A row above numbers is shown.  Another is not, whatever file this is: a case may be someone else's.
    """
    remedy = form.remedy(form.needed(())[0][0], ["HEADER" if row is None else row[1][0]], "")
    other = f", or headers in other words {remedy}" if remedy else ""
    expected = f"a row of headers such as {form.example}"
    if row is None:
        return InputError(f"{expected} in the first {TITLES} rows{other}")
    return InputError(f"{expected}{other}", key=f"row {row[0]}", value=", ".join(row[1]))


def _lay_out(heads: Sequence[Line], rows: Sequence[Line], form: TableForm, choices: Choices, separator: str) -> Layout:
    """Where a table has its columns; heads : its first rows, cut as headers are."""
    if not heads:
        raise InputError(f"a row of headers and a row for each {form.row}, the file is empty")
    index, named = headers.find_header(heads, form, choices)
    top = heads[index]
    if not named and read_number(top[1][0]) is not None:
        expected = f"a row of headers above the numbers, such as {form.example}"
        raise InputError(expected, key=f"row {top[0]}", value=", ".join(top[1]))
    if not named:
        raise _other_words(form)
    found = headers.find_columns(top, form, choices)
    below = [(number, _split(cells, separator, number, len(top[1]))) for number, cells in rows[index + 1 :]]
    stated = headers.find_units(below, found.values())
    last = max([top, *stated])[0]
    first = next((cells for number, cells in below if number > last and not is_comment(cells)), ())
    columns = headers.with_units(found, stated, heads[:index], form, choices, first)
    repeated = [[cell_of(cells, column) for column in columns.values()] for _, cells in (top, *stated)]
    return Layout(form, top, columns, repeated, sum(number <= last for number, _ in rows), separator)


def _cut(text: str, separator: str, first: int = 1) -> Iterator[Line]:
    """The rows of a text that are not blank, of cells that may stand in quotes; of a line where blanks separate cells.

    first : number of the first line.
    """
    if separator in (_WIDE, _NARROW):
        lines = ((number, line.strip()) for number, line in enumerate(text.split("\n"), start=first))
        yield from ((number, [line]) for number, line in lines if line)
        return
    reader = csv.reader(io.StringIO(text), delimiter=separator, skipinitialspace=True)
    try:
        yield from ((reader.line_num + first - 1, cells) for cells in reader if any(cells))
    except csv.Error as error:
        raise InputError(f"a text in columns ({error})") from error


def _split(row: list[str], separator: str, number: int = 0, count: int | None = None) -> list[str]:
    """The cells of a row, which is a line where blanks separate them.

    count : of the headers, None for a row of headers, which may stand in a comment, "# MD Inc Azi": its sign belongs to
    the first cell.  Raises InputError for a row below the headers with another number of cells.
    """
    if separator not in (_WIDE, _NARROW):
        return row
    line = COMMENT + row[0].lstrip(COMMENT).lstrip() if is_comment(row) else row[0]
    heads = re.split(r"\s{2,}", line) if separator == _WIDE else _BREAK.split(" ".join(line.split()))
    cells = row[0].split()
    if count is None or len(heads) == count or (len(cells) != count and is_comment(row)):
        return heads
    if len(cells) != count:
        expected = f"{count} columns, as many as headers (separate columns by commas or tabs where cells are empty)"
        raise InputError(expected, key=f"row {number}", value=row[0])
    return cells
