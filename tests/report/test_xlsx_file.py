"""The workbook of a report: its cells are those of the tables, numbers as numbers, texts as texts."""

import io
import re
import zipfile
from collections.abc import Callable
from typing import Any

import pytest

from fctd.report.parts import Report
from fctd.results.shown_tables import Cell, Table
from fctd.results.unit_systems import System
from tests.report.conftest import UNITS

calamine = pytest.importorskip("python_calamine")


def same(row: list[Any], cells: tuple[Cell, ...]) -> bool:
    """Whether a row of a sheet is that of a table; files keep 16 digits."""
    expected = [
        cell.text if cell.number is None else pytest.approx(cell.number, rel=1e-15) for cell in cells if cell.text
    ]
    return [cell for cell in row if cell != ""] == expected


@pytest.mark.slow
@pytest.mark.parametrize("units", UNITS)
def test_every_cell_is_that_of_its_table(
    units: System, made: Callable[[System], Report], files: Callable[[System, str], bytes]
) -> None:
    """Numbers to 16 digits, in the order of the tables, on the sheet of their section."""
    book, compared = calamine.CalamineWorkbook.from_filelike(io.BytesIO(files(units, ".xlsx"))), 0
    report = made(units)
    assert book.sheet_names == [section.title for section in report.sections]
    for section in report.sections:
        rows = iter(book.get_sheet_by_name(section.title).to_python())
        for table in (part for part in section.parts if isinstance(part, Table)):
            for cells in table.rows:
                assert any(same(row, cells) for row in rows), [cell.text for cell in cells]
                compared += 1
    assert compared > 100


def test_numbers_are_shown_as_in_the_other_files_and_texts_are_no_formulae(
    files: Callable[[System, str], bytes],
) -> None:
    with zipfile.ZipFile(io.BytesIO(files("si", ".xlsx"))) as parts:
        sheets = [parts.read(name).decode() for name in parts.namelist() if "worksheets/sheet" in name]
        formats = re.findall('formatCode="([^"]*)"', parts.read("xl/styles.xml").decode())
        names = parts.namelist()
    assert not any("<f>" in sheet or "<hyperlink" in sheet for sheet in sheets)
    assert {"0.0", "0.00", "0.000"} <= set(formats)
    assert sum(name.startswith("xl/media/") for name in names) == 3
