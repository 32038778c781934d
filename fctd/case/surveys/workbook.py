"""Worksheets of Excel's workbooks (xlsx); the extra `excel` brings the package that reads them."""

import io
import re
import zipfile
import zlib
from collections.abc import Mapping
from typing import Final

from fctd.case.errors import InputError, nearest, show
from fctd.case.surveys.headers import KEYS, Row, Wanted, find_header
from fctd.case.surveys.stations import StationKey, Written
from fctd.case.surveys.table import read_table

ZIP: Final = b"PK\x03\x04"
OLD_EXCEL: Final = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_LARGEST: Final = 256  # MiB: the parts of a workbook, which are packed some ten times smaller in the file
_MOST_CELLS: Final = 20_000_000  # from the first row and column to the last ones with a cell
_REFERENCE: Final = re.compile(rb"<(?:\w+:)?c\b[^<>]*?\br\s*=\s*[\"']([A-Z]{1,9})([0-9]{1,9})")
_UNREADABLE: Final = "a workbook (xlsx) that can be read"


def read_workbook(content: bytes, sheet: str | None, columns: Mapping[StationKey, Wanted]) -> Written:
    """The stations of the named sheet, else of the only one with the headers of a survey.

    Raises InputError for a file that is no workbook, a sheet that it does not have, bad cells, and where the package
    is not installed.
    """
    sheets = _sheets(content)
    if sheet is not None:
        if sheet not in sheets:
            raise InputError(nearest(sheet, sheets, "sheet"), key="sheet", value=sheet)
        return read_table(sheets[sheet], columns, decimal_commas=True)
    filled = {name: rows for name, rows in sheets.items() if rows}
    surveys = {name: rows for name, rows in filled.items() if find_header(rows, columns)[1] == len(KEYS)} or filled
    if len(surveys) > 1:
        names = ", ".join(map(show, surveys))
        raise InputError(f"the name of the sheet that holds the survey in wellbore.sheet: {names}", key="sheet")
    return read_table(next(iter(surveys.values()), []), columns, decimal_commas=True)


def _sheets(content: bytes) -> dict[str, list[Row]]:
    """The rows that are not blank of each worksheet, with the numbers that Excel shows."""
    try:
        from python_calamine import CalamineError, CalamineWorkbook, SheetTypeEnum
    except ImportError as error:
        raise InputError("a text file, or the package that reads workbooks: pip install 'fctd[excel]'") from error
    _check_size(content)
    try:
        with CalamineWorkbook.from_filelike(io.BytesIO(content)) as workbook:
            names = [sheet.name for sheet in workbook.sheets_metadata if sheet.typ == SheetTypeEnum.WorkSheet]
            tables = {name: workbook.get_sheet_by_name(name).to_python(skip_empty_area=False) for name in names}
    except (CalamineError, OSError, ValueError) as error:
        raise InputError(f"{_UNREADABLE} ({error})") from error
    rows = {name: [[_text(cell) for cell in cells] for cells in table] for name, table in tables.items()}
    return {
        name: [(number, cells) for number, cells in enumerate(table, start=1) if any(cells)]
        for name, table in rows.items()
    }


def _check_size(content: bytes) -> None:
    """Raise InputError for a workbook that would fill the memory: the package ends the process where it does.

    It keeps every cell of the rectangle between the first and the last one, so that one stray cell may be too much.
    """
    room = _LARGEST * 2**20
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as parts:
            if "xl/workbook.xml" not in parts.namelist():
                raise InputError("a workbook of Excel (xlsx), or a text file")
            for part in parts.infolist():
                if part.file_size > room:
                    raise InputError(f"a workbook of at most {_LARGEST} MiB when unpacked")
                room -= part.file_size
                if part.filename.endswith(".xml"):
                    _check_cells(parts.read(part))
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{_UNREADABLE} ({error})") from error


def _check_cells(part: bytes) -> None:
    columns, rows = 0, 0
    for column, row in _REFERENCE.findall(part):
        rows = max(rows, int(row))
        place = 0
        for letter in column:
            place = 26 * place + letter - ord("A") + 1
        columns = max(columns, place)
    if rows * columns > _MOST_CELLS:
        raise InputError(f"at most {_MOST_CELLS} cells up to the last one, which is in row {rows} or column {columns}")


def _text(cell: object) -> str:
    """A cell as text; Excel's numbers have 15 digits."""
    return f"{cell:.15g}" if isinstance(cell, float) else str(cell).strip()
