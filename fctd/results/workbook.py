"""Tables as sheets of Excel's workbooks: numbers with the digits of their text, texts that stay texts."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fctd.results.shown_tables import Cell, Table, short, shown_table, written_table

if TYPE_CHECKING:
    import pandas as pd

# A text is a text, also where it looks like a formula or an address.
OPTIONS: Final = {
    "strings_to_formulas": False,
    "strings_to_urls": False,
    "strings_to_numbers": False,
    "in_memory": True,
}
_NARROWEST, _WIDEST = 12, 60  # characters of a column
_MOST: Final = 40  # items of a list that are written out
_KEPT: Final = 10  # digits of a number of the metadata


class Styles:
    """The formats of a workbook, each made once."""

    def __init__(self, book: Any) -> None:
        self._book, self._numbers = book, dict[str, Any]()
        self.large = book.add_format({"bold": True, "font_size": 16})
        self.title = book.add_format({"bold": True, "font_size": 12})
        self.head = book.add_format({"bold": True, "text_wrap": True, "valign": "top", "bottom": 1})
        self.text = book.add_format({"text_wrap": True, "valign": "top"})

    def of(self, cell: Cell) -> Any:
        """The format that shows a number with the digits of its text."""
        mantissa, _, power = cell.text.partition("e")
        digits = "0." + "0" * len(mantissa.partition(".")[2])
        name = digits.removesuffix(".") + ("E+00" if power else "")
        if name not in self._numbers:
            self._numbers[name] = self._book.add_format({"num_format": name, "valign": "top"})
        return self._numbers[name]


def write_table(sheet: Any, table: Table, styles: Styles, row: int, widths: dict[int, int]) -> int:
    """Write a table from a row on, and its columns' widths in characters; returns the row below it."""
    if table.title:
        sheet.write_string(row, 0, table.title, styles.title)
        row += 1
    for k, head in enumerate(map(str, table.heads)):
        sheet.write_string(row, k, head, styles.head)
        widths[k] = max(widths.get(k, _NARROWEST), max(map(len, head.split(" ")), default=0))
    row += bool(table.heads)
    for cells in table.rows:
        for k, cell in enumerate(cells):
            if cell.number is not None:
                sheet.write_number(row, k, cell.number, styles.of(cell))
            elif cell.text:
                sheet.write_string(row, k, cell.text, styles.text)
            widths[k] = max(widths.get(k, _NARROWEST), len(cell.text))
        row += 1
    for note in table.notes:
        sheet.write_string(row, 0, note)
        row += 1
    return row


def set_widths(sheet: Any, widths: Mapping[int, int]) -> None:
    """Make columns as wide as their cells, within reason."""
    for k, width in widths.items():
        sheet.set_column(k, k, min(width, _WIDEST) + 2)


def to_workbook(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write a table as the first sheet of a workbook and its metadata as the second; needs xlsxwriter.

    The row of heads stays in sight.  Of a path in the metadata stands the name alone.
    """
    import xlsxwriter

    # The package packs a file while it writes it: a disk that becomes full meanwhile would leave it in the middle.
    content = io.BytesIO()
    with xlsxwriter.Workbook(content, OPTIONS) as book:
        styles = Styles(book)
        about = shown_table(["key", "value, in SI units"], _flat(metadata))
        for name, table in (("table", written_table(frame)), ("about", about)):
            sheet, widths = book.add_worksheet(name), dict[int, int]()
            write_table(sheet, table, styles, 0, widths)
            set_widths(sheet, widths)
            sheet.freeze_panes(1, 0)
    path.write_bytes(content.getvalue())


def _flat(value: Any, key: str = "") -> Iterator[tuple[str, Any]]:
    """Nested metadata as rows of a dotted key and a value, without empty ones; a long list is counted."""
    if isinstance(value, Mapping):
        for name, inner in value.items():
            yield from _flat(inner, f"{key}.{name}" if key else str(name))
    elif not isinstance(value, list | tuple):
        if isinstance(value, bool) or not isinstance(value, Real):
            yield from [] if value is None else [(key, _plain(value))]
        else:
            yield key, short(float(value), _KEPT, none="")
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
