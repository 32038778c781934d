"""Series in text files of columns, whole or growing."""

import csv
import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.surveys import text_file
from fctd.monitoring.quantities import QUANTITIES, Column, check_columns, count_quantities, find_columns
from fctd.monitoring.rows import to_si

_TITLES: Final = 100  # lines that may stand above the headers
_SEPARATORS: Final = ("\t", ";", ",", "|")
_TIME_OF_DAY: Final = re.compile(r"\d{1,2}:\d{2}")
KINDS: Final = "a series: text in columns, Parquet, LAS or a WITSML log (XML)"


@dataclass(frozen=True)
class Form:
    """How a text is written: separator, headers with their columns, the number of the first line of data.

    clock : place of a column with the time of day, where dates stand in a column of their own.
    """

    separator: str
    headers: tuple[str, ...]
    columns: dict[str, Column]
    first: int
    clock: int | None = None

    def read(self, lines: str, number: int) -> pd.DataFrame:
        """The rows [SI] of whole lines of data, the first of which has this number in the file."""
        count = len(self.headers)
        for offset, line in enumerate(lines.split("\n")):
            if line.count(self.separator) >= count and len([c for c in _cells(line, self.separator) if c]) > count:
                raise InputError(f"{count} cells, as many as headers", key=f"row {number + offset}", value=line)
        try:
            cells = pd.read_csv(
                io.StringIO(lines), sep=self.separator, header=None, names=range(count), usecols=range(count),
                dtype=str, skip_blank_lines=False, skipinitialspace=True, index_col=False, keep_default_na=False,
            )  # fmt: skip
        except pd.errors.EmptyDataError:
            cells = pd.DataFrame(columns=range(count), dtype=str)
        except (pd.errors.ParserError, csv.Error) as error:
            raise InputError(f"rows with {count} cells, as many as headers ({error})") from error
        numbers = np.arange(number, number + len(cells))
        empty = (cells.isna() | (cells == "")).all(axis=1)
        cells, numbers = cells[~empty], numbers[~empty.to_numpy()]
        if self.clock is not None and "time" in self.columns:
            place = self.columns["time"].place
            both = (cells[place] != "") & (cells[self.clock] != "")
            cells[place] = (cells[place] + " " + cells[self.clock].astype(str)).where(both, "")
        return to_si(cells, numbers.tolist(), self.columns, decimal_comma=self.separator != ",")


def decode(content: bytes) -> str:
    """The text of a file; InputError for one that is not text."""
    try:
        return text_file.decode(content)
    except InputError as error:
        raise InputError(KINDS) from error


def find_form(start: str, said: Mapping[str, tuple[str, str | None]]) -> Form:
    """How a text is written, from its first lines.

    Raises InputError for a text without headers of a series and for one whose columns lack a quantity or a unit.
    """
    lines = start.split("\n")[: _TITLES + 3]
    if not any(line.strip() for line in lines):
        raise InputError("a row of headers and rows of data, the file is empty")
    best: tuple[int, int, str, list[str]] | None = None
    for index, line in enumerate(lines[:_TITLES]):
        for separator in _SEPARATORS:
            cells = _cells(line, separator)
            score = count_quantities(cells, said)
            if score and (best is None or score > best[0]):
                best = score, index, separator, cells
    if best is None:
        shown = next(line for line in lines if line.strip())
        raise InputError("a row of headers such as time, bit_depth_m, hook_load_kN, torque_kN_m, rpm, block_position_m",
                         key="headers", value=shown[:80])  # fmt: skip
    _, index, separator, headers = best
    below = _cells(lines[index + 1], separator) if index + 1 < len(lines) else []
    units = below if below and not any(re.search(r"\d", cell) for cell in below) and any(below) else []
    columns = find_columns(headers, units, said)
    data = _cells(lines[index + 1 + bool(units)], separator) if len(lines) > index + 1 + bool(units) else []
    written = data[columns["time"].place] if "time" in columns and columns["time"].place < len(data) else ""
    text_time = bool(re.search(r"\d[-/:T]\d", written))
    if text_time:
        columns["time"] = replace(columns["time"], unit=None)
    check_columns(columns, headers, text_time=text_time or not written)
    clock = None
    if text_time and not _TIME_OF_DAY.search(written):
        clock = next((k for k, cell in enumerate(data[: len(headers)]) if _TIME_OF_DAY.match(cell)), None)
    ordered = {key: columns[key] for key in QUANTITIES if key in columns}
    return Form(separator, tuple(headers), ordered, index + 2 + bool(units), clock)


def read_text(text: str, said: Mapping[str, tuple[str, str | None]]) -> pd.DataFrame:
    """The rows [SI] of a whole text."""
    form = find_form(text[:200_000], said)
    body = text.split("\n", form.first - 1)
    return form.read(body[-1] if len(body) == form.first else "", form.first)


class Tail:
    """The rows of a text file that grows; a last line without its end waits for the rest of it."""

    def __init__(self, path: Path, said: Mapping[str, tuple[str, str | None]]) -> None:
        self.path, self.said = path, said
        self.form: Form | None = None
        self._read = 0
        self._waiting = b""
        self._number = 1

    def rows(self) -> pd.DataFrame | None:
        """The rows [SI] that have come since the last call; None while there are none."""
        try:
            with self.path.open("rb") as file:
                if self.path.stat().st_size < self._read:
                    raise InputError("a file that grows (it has become shorter)", value=self.path)
                file.seek(self._read)
                new = file.read()
        except OSError as error:
            raise InputError(f"a series that can be read ({error.strerror})", value=self.path) from error
        self._read += len(new)
        whole, end, rest = (self._waiting + new).rpartition(b"\n")
        self._waiting = rest
        if not end:
            return None
        lines = decode(whole + end)
        if self.form is None:
            self.form = self._form(lines)
            if self.form is None:  # headers alone: the row below tells how times are written
                self._waiting = whole + end + rest
                return None
            lines = lines.split("\n", self.form.first - 1)[-1]
            self._number = self.form.first
        number, self._number = self._number, self._number + lines.count("\n")
        table = self.form.read(lines, number)
        return table if len(table) else None

    def _form(self, lines: str) -> Form | None:
        form_of = find_form(lines, self.said) if lines.strip() else None
        return None if form_of is None or lines.count("\n") < form_of.first else form_of


def _cells(line: str, separator: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([line.lstrip("#")], delimiter=separator), [])]
    except csv.Error:
        return []
