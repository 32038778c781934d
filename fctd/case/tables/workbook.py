"""Worksheets of Excel's workbooks (xlsx); the extra `excel` brings the package that reads them."""

import io
import re
import zipfile
import zlib
from typing import Final

from fctd.case.errors import InputError, nearest, show
from fctd.case.tables.headers import Choices, Line, TableForm, find_header
from fctd.case.tables.rows import Rows
from fctd.case.tables.text import read_sheet
from fctd.case.xml_file import has_doctype

ZIP: Final = b"PK\x03\x04"
OLD_EXCEL: Final = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_LARGEST: Final = 256  # MiB: the parts of a workbook, which are packed some ten times smaller in the file
_MOST_CELLS: Final = 20_000_000  # from the first row and column to the last ones with a cell
_REFERENCE: Final = re.compile(rb"<(?:\w+:)?c\b[^<>]*?\br\s*=\s*[\"']([A-Z]{1,9})([0-9]{1,9})")
_UNREADABLE: Final = "a workbook (xlsx) that can be read"


def read_workbook(content: bytes, form: TableForm, columns: Choices, sheet: str | None = None, which: str = "") -> Rows:
    """The rows of the named sheet, else of the only one with the headers that the form needs.

    which : how to say which one, where several have them.  Raises InputError for a file that is no workbook, a sheet
    that it does not have, bad headers, and where the package is not installed.
    """
    sheets = _sheets(content)
    if sheet is not None and sheet not in sheets:
        raise InputError(nearest(sheet, sheets, "sheet"), key="sheet", value=sheet)
    filled = {name: rows for name, rows in sheets.items() if rows and sheet in (None, name)}
    named = {name: find_header(rows, form, columns)[1] for name, rows in filled.items()}
    most = max(map(len, named.values()), default=0)
    fitting = {name: rows for name, rows in filled.items() if not form.lacking(named[name])}
    # Where no sheet has all, the one that has most of the headers says what it lacks.
    fitting = fitting or {name: rows for name, rows in filled.items() if len(named[name]) == most}
    if len(fitting) > 1:
        raise InputError(f"{which}: {', '.join(map(show, fitting))}", key="sheet")
    return read_sheet(next(iter(fitting.values()), []), form, columns)


def _sheets(content: bytes) -> dict[str, list[Line]]:
    """The rows that are not blank of each worksheet, with the numbers that Excel shows."""
    try:
        from python_calamine import CalamineError, CalamineWorkbook, SheetTypeEnum
    except ImportError as error:
        raise InputError("a text file, or the package that reads workbooks: pip install 'fctd[excel]'") from error
    check_workbook(content, _LARGEST * 2**20)
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


def check_workbook(content: bytes, most: int) -> None:
    """Raise InputError for a workbook that would fill the memory: the package ends the process where it does.

    most : bytes of its parts when they are unpacked, which may be more than they say.  The package keeps every cell of
    the rectangle between the first and the last one, so that one stray cell may be too much, and so may entities.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as parts:
            room = most
            for part in parts.infolist():
                with parts.open(part) as unpacked:
                    inside = unpacked.read(room + 1)
                room -= len(inside)
                if room < 0:
                    raise InputError(f"a workbook of at most {most >> 20} MiB when unpacked")
                if part.filename.endswith((".xml", ".rels")) and has_doctype(inside):
                    raise InputError("a workbook whose parts have no document type (DOCTYPE)")
                if part.filename.endswith(".xml"):
                    _check_cells(inside)
            if "xl/workbook.xml" not in parts.namelist():
                raise InputError("a workbook of Excel (xlsx), or a text file")
    except InputError:
        raise
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError, EOFError, OSError, ValueError) as error:
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
