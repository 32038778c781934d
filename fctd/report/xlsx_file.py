"""A report as a workbook: a sheet for each section, its tables below each other, its pictures below them."""

from __future__ import annotations

import io
from typing import Any, Final

from fctd.report.parts import Picture, Report, Section, Text
from fctd.results.shown_tables import Table
from fctd.results.workbook import OPTIONS, Styles, set_widths, write_table

_DPI: Final = 110  # of pictures
_ROW: Final = 0.208  # height of a row [in]
_LETTERS: Final = 31  # of the name of a sheet


def to_xlsx(report: Report) -> bytes:
    """The workbook; a text is a text, also where it looks like a formula or an address.  Needs xlsxwriter."""
    import xlsxwriter

    content = io.BytesIO()
    with xlsxwriter.Workbook(content, OPTIONS) as book:
        book.set_properties({"title": report.title, "author": report.by, "company": report.company})
        styles = Styles(book)
        for k, section in enumerate(report.sections):
            sheet = book.add_worksheet(section.title[:_LETTERS])
            row = _write_cover(sheet, report, styles) if k == 0 else 0
            _write(sheet, section, styles, row)
    return content.getvalue()


def _write_cover(sheet: Any, report: Report, styles: Styles) -> int:
    """Title and logo; returns the row below them."""
    sheet.write_string(0, 0, report.title, styles.large)
    if report.logo is None:
        return 2
    sheet.insert_image(1, 0, "logo.png", {"image_data": io.BytesIO(report.logo), "x_scale": 0.25, "y_scale": 0.25})
    return 10


def _write(sheet: Any, section: Section, styles: Styles, row: int) -> None:
    """Write a section from a row on; pictures stand below its tables, where none of them covers a cell."""
    widths: dict[int, int] = {}
    for part in section.parts:
        if isinstance(part, Text):
            sheet.write_string(row, 0, part.text)
            row += 2
        elif isinstance(part, Table):
            row = write_table(sheet, part, styles, row, widths) + 1
    set_widths(sheet, widths)
    for picture in section.parts:
        if isinstance(picture, Picture):
            sheet.write_string(row, 0, picture.caption, styles.title)
            image = {"image_data": io.BytesIO(picture.drawn(".png", dpi=_DPI)), "object_position": 1}
            sheet.insert_image(row + 1, 0, "picture.png", image)
            row += int(picture.size[1] / _ROW) + 4
