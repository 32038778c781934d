"""Tables as Excel's workbooks, for people: units in the headers, numbers with their digits, metadata a row each."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Mapping, Sequence
from numbers import Integral, Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from fctd.results.columns import COLUMNS
from fctd.results.unit_systems import MEASURES, measure_of, shown

if TYPE_CHECKING:
    import pandas as pd

# Digits after the point by unit; of other numbers, such as friction factors and shares.
_DIGITS: Final = {
    "kN*m": 2, "kft*lbf": 2, "MPa": 1, "ksi": 1, "kN": 1, "klbf": 1, "m": 2, "ft": 1, "mm": 1, "in": 3, "deg": 1,
    "bar": 1, "psi": 0, "kg/m^3": 0, "ppg": 2, "L/min": 0, "gpm": 0, "kW": 1, "hp": 1, "ft/min": 1, "ft/s": 1, "s": 1,
}  # fmt: skip
_OTHERS: Final = 3
_NARROWEST, _WIDEST = 12, 60  # characters of a column
_MOST: Final = 40  # items of a list that are written out


class Heading(NamedTuple):
    """How a workbook has a column: its header, factor of its numbers, and their format."""

    text: str
    factor: float
    format: str


def _ending(unit: str) -> str:
    return "_" + unit.replace("*", "_").replace("/", "_").replace("^", "")


# Units at the end of a name, the longer ones first.
_MEASURED: Final = {unit for measure in MEASURES for unit in (measure.table, measure.field)}
_UNITS: Final = sorted({*_MEASURED, *_DIGITS, "m/s", "m^3/s", "rad/s"}, key=len, reverse=True)


def heading_of(column: str) -> Heading:
    """The heading of a column of a table, in SI or in field units: ``hookload_N`` is "hook load (kN)", in kN."""
    unit = next((unit for unit in _UNITS if column.endswith(_ending(unit))), "")
    stem, measure = column.removesuffix(_ending(unit)) if unit else column, measure_of(column)
    known = COLUMNS.get(column) or next((of for of in COLUMNS.values() if unit and of.stem == stem), None)
    label = stem.replace("hookload", "hook_load").replace("_", " ") if known is None else known.label
    factor = 1.0
    if measure is not None and unit == measure.table:
        factor, unit = shown(column, "si").factor, measure.si
    sign = unit.replace("*", "·").replace("^3", "³").replace("deg", "°")
    digits = "0" * _DIGITS.get(unit, _OTHERS)
    return Heading(label + (f" ({sign})" if sign else ""), factor, f"0.{digits}".removesuffix("."))


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
