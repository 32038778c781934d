"""Tables as Excel's workbooks, for people: units in the headers, numbers with their digits, metadata a row each."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from fctd.case.systems import KINDS, SHOWN_APART, ending, signed
from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import kind_of

if TYPE_CHECKING:
    import pandas as pd

# Units at the end of a name, the longer ones first, and the digits after the point of the first kind with each.
_DIGITS: Final = {
    unit: number for kind in reversed(KINDS) for unit, number in zip(kind.units, kind.digits, strict=True)
}
_UNITS: Final = sorted(
    {*_DIGITS, *(kind.dimension.unit for kind in SHOWN_APART), "rad/s"}, key=lambda unit: (-len(unit), unit)
)
_NARROWEST, _WIDEST = 12, 60  # characters of a column
_MOST: Final = 40  # items of a list that are written out


class Heading(NamedTuple):
    """How a workbook has a column: words and unit of its header, factor of its numbers, and their format."""

    words: str
    unit: str
    factor: float
    format: str

    @property
    def text(self) -> str:
        """The header."""
        return f"{self.words} ({self.unit})" if self.unit else self.words


def heading_of(column: str) -> Heading:
    """The heading of a column of a table, in SI or in field units: ``hookload_N`` is "hook load (kN)", in kN."""
    unit = next((unit for unit in _UNITS if column.endswith(ending(unit))), "")
    stem, kind = column.removesuffix(ending(unit)) if unit else column, kind_of(column)
    known = COLUMNS.get(column) or next((of for of in COLUMNS.values() if unit and of.stem == stem), None)
    label = stem.replace("hookload", "hook_load").replace("_", " ") if known is None else known.label
    factor, digits = 1.0, _DIGITS.get(unit, 3)
    if kind is not None and unit == kind.dimension.unit:
        factor, unit, digits = kind.shown("si").factor, kind.unit("si"), kind.digits_in("si")
    digits = digits if known is None or known.digits is None else known.digits
    sign = signed(unit).replace("deg", "°")
    return Heading(label, sign, factor, f"0.{'0' * digits}".removesuffix("."))


def to_workbook(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write a table as the first sheet of a workbook and its metadata as the second; needs xlsxwriter.

    A text is a text, also where it looks like a formula or an address; of a path stands the name alone.
    """
    import xlsxwriter

    # The package packs a file while it writes it: a disk that becomes full meanwhile would leave it in the middle.
    content = io.BytesIO()
    options = {"strings_to_formulas": False, "strings_to_urls": False, "in_memory": True}
    with xlsxwriter.Workbook(content, options) as book:
        headings = [heading_of(str(name)) for name in frame.columns]
        rows = zip(*(_cells(frame.iloc[:, k], heading.factor) for k, heading in enumerate(headings)), strict=True)
        _write(book, "table", [heading.text for heading in headings], rows, [heading.format for heading in headings])
        _write(book, "about", ["key", "value, in SI units"], _flat(metadata), ["", ""])
    path.write_bytes(content.getvalue())


def _cells(column: pd.Series[Any], factor: float) -> Iterator[Any]:
    for value in column:
        counted = isinstance(value, bool | Integral | str) or not isinstance(value, Real)
        yield value if counted else float(value) * factor


def _write(book: Any, name: str, headers: Sequence[str], rows: Iterator[Sequence[Any]], formats: Sequence[str]) -> None:
    """Write a sheet, whose row of headers stays in sight."""
    sheet = book.add_worksheet(name)
    head = book.add_format({"bold": True, "text_wrap": True, "valign": "top", "bottom": 1})
    looks = [book.add_format({"num_format": text or "General"}) for text in formats]
    whole = book.add_format({"num_format": "0"})
    sheet.freeze_panes(1, 0)
    widths = [_NARROWEST] * len(headers)
    for k, header in enumerate(headers):
        sheet.write_string(0, k, header, head)
    for number, row in enumerate(rows, start=1):
        for k, value in enumerate(row):
            if isinstance(value, bool) or not isinstance(value, Real):
                sheet.write_string(number, k, str(value))
                widths[k] = max(widths[k], len(str(value)))
            elif math.isfinite(value):
                sheet.write_number(number, k, float(value), whole if isinstance(value, Integral) else looks[k])
    for k, width in enumerate(widths):
        sheet.set_column(k, k, min(width, _WIDEST) + 2)


def _flat(value: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Nested metadata as rows of a dotted key and a value, without empty ones; a long list is counted."""
    if isinstance(value, Mapping):
        for name, inner in value.items():
            yield from _flat(inner, f"{key}.{name}" if key else str(name))
    elif not isinstance(value, list | tuple):
        if value is not None:
            yield key, _plain(value) if isinstance(value, bool) or not isinstance(value, Real) else value
    elif len(value) > _MOST:
        yield key, f"{len(value)} rows"
    elif any(isinstance(item, Mapping | list | tuple) for item in value):
        for k, item in enumerate(value):
            yield from _flat(item, f"{key}[{k}]")
    elif value:
        yield key, ", ".join(map(_plain, value))


def _plain(value: Any) -> str:
    """A value as text, a path as its name."""
    text = str(value)
    return Path(text).name if Path(text).is_absolute() else text
