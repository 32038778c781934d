"""A survey file of any kind as a checked survey."""

from collections.abc import Mapping
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Final

from fctd.case.errors import InputError
from fctd.case.input_file import read_bytes
from fctd.case.surveys.headers import Wanted
from fctd.case.surveys.stations import StationKey, Survey, Written, check
from fctd.case.surveys.text_file import decode, read_text
from fctd.case.surveys.witsml import read_witsml
from fctd.case.surveys.workbook import OLD_EXCEL, ZIP, read_workbook

_LARGEST_FILE: Final = 32  # MiB: 100,000 stations with 40 other columns


def read_survey(
    path: str | PathLike[str], columns: Mapping[StationKey, Wanted] | None = None, sheet: str | None = None
) -> Survey:
    """The checked stations of a text in columns, a workbook (xlsx) or a WITSML trajectory; the content tells which.

    columns : header or unit of a quantity, where the file does not tell; sheet : name of a worksheet or a trajectory,
    where the file has several.  Raises InputError, which names file, row and column, for bad data.
    """
    try:
        return check(replace(_read(Path(path), columns or {}, sheet), file=Path(path).name))
    except InputError as error:
        raise error.in_file(path) from error.__cause__


def _read(path: Path, columns: Mapping[StationKey, Wanted], sheet: str | None) -> Written:
    try:
        content = read_bytes(path, _LARGEST_FILE)
    except OSError as error:
        raise InputError(f"a survey file that can be read ({error.strerror})") from error
    if content.startswith(ZIP):
        return read_workbook(content, sheet, columns)
    if content.startswith(OLD_EXCEL):
        raise InputError("a workbook in the format xlsx, or a text: save it as one of them")
    text = decode(content)
    if text.lstrip().startswith("<"):
        if columns:
            said = {key: wanted.header or wanted.unit for key, wanted in columns.items()}
            raise InputError("no columns, since WITSML names its elements", key="columns", value=said)
        return read_witsml(text, sheet)
    if sheet is not None:
        raise InputError("no sheet for a text in columns", key="sheet", value=sheet)
    try:
        return read_text(text, columns)
    except InputError as error:
        if path.suffix.lower() != ".xlsx":
            raise
        raise InputError(f"a workbook, as the name says: the file is a text, and no survey ({error})") from error
