"""A report as a workbook: a sheet for each section, its tables below each other, its pictures below them."""

from __future__ import annotations

import io
from typing import Any, Final

from fctd.report.parts import Picture, Report, Section, Text
from fctd.results.shown_tables import Cell, Table

_NARROWEST, _WIDEST = 11, 60  # characters of a column
_DPI: Final = 110  # of pictures
_ROW: Final = 0.208  # height of a row [in]
_LETTERS: Final = 31  # of the name of a sheet


def to_xlsx(report: Report) -> bytes:
    """The workbook; a text is a text, also where it looks like a formula or an address.  Needs xlsxwriter."""
    import xlsxwriter

    content = io.BytesIO()
    options = {"strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False, "in_memory": True}
    with xlsxwriter.Workbook(content, options) as book:
        book.set_properties({"title": report.title, "author": report.by, "company": report.company})
        styles = _Styles(book)
        for k, section in enumerate(report.sections):
            sheet = book.add_worksheet(section.title[:_LETTERS])
            row = _write_cover(sheet, report, styles) if k == 0 else 0
            _write(sheet, section, styles, row)
    return content.getvalue()


class _Styles:
    """The formats of a workbook."""

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


def _write_cover(sheet: Any, report: Report, styles: _Styles) -> int:
    """Title and logo; returns the row below them."""
    sheet.write_string(0, 0, report.title, styles.large)
    if report.logo is None:
        return 2
    sheet.insert_image(1, 0, "logo.png", {"image_data": io.BytesIO(report.logo), "x_scale": 0.25, "y_scale": 0.25})
    return 10


def _write(sheet: Any, section: Section, styles: _Styles, row: int) -> None:
    """Write a section from a row on; pictures stand below its tables, where none of them covers a cell."""
    widths: dict[int, int] = {}
    for part in section.parts:
        if isinstance(part, Text):
            sheet.write_string(row, 0, part.text)
            row += 2
        elif isinstance(part, Table):
            row = _write_table(sheet, part, styles, row, widths) + 1
    for k, width in widths.items():
        sheet.set_column(k, k, min(width, _WIDEST) + 2)
    for picture in section.parts:
        if isinstance(picture, Picture):
            sheet.write_string(row, 0, picture.caption, styles.title)
            image = {"image_data": io.BytesIO(picture.drawn(".png", dpi=_DPI)), "object_position": 1}
            sheet.insert_image(row + 1, 0, "picture.png", image)
            row += int(picture.size[1] / _ROW) + 4


def _write_table(sheet: Any, table: Table, styles: _Styles, row: int, widths: dict[int, int]) -> int:
    """Write a table from a row on, and its columns' widths in characters; returns the row below it."""
    sheet.write_string(row, 0, table.title, styles.title)
    row += bool(table.title)
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
