"""A survey file of any kind as a checked survey."""

from os import PathLike
from pathlib import Path
from typing import Final

from fctd.arrays import Array
from fctd.case.errors import InputError, naming
from fctd.case.input_file import decode, read_bytes
from fctd.case.surveys.form import KEYS, SURVEY
from fctd.case.surveys.stations import Survey, Written, check
from fctd.case.surveys.witsml import read_witsml
from fctd.case.tables.headers import Choices
from fctd.case.tables.rows import GROUPED_BY_POINT, NOTHING, Numbers, Rows
from fctd.case.tables.text import read_text
from fctd.case.tables.workbook import OLD_EXCEL, ZIP, read_workbook

_LARGEST_FILE: Final = 32  # MiB: 100,000 stations with 40 other columns
_SHORTEST: Final = 50.0  # [m or ft]: depths up to this, all with three decimals, may be thousands
_WHICH_SHEET: Final = "the name of the sheet that holds the survey in wellbore.sheet (for init: --sheet)"
_KINDS: Final = "a survey: text in columns, an Excel workbook (xlsx) or a WITSML trajectory (XML)"


def read_survey(path: str | PathLike[str], columns: Choices | None = None, sheet: str | None = None) -> Survey:
    """The checked stations of a text in columns, a workbook (xlsx) or a WITSML trajectory; the content tells which.

    columns : header or unit of a quantity, where the file does not tell; sheet : name of a worksheet or a trajectory,
    where the file has several.  Raises InputError, which names file, row and column, for bad data.
    """
    path = Path(path)
    with naming(path):
        rows, rejected = _read(path, columns or {}, sheet)
        return check(_stations(rows, path.name, rejected))


def _read(path: Path, columns: Choices, sheet: str | None) -> tuple[Rows, list[int]]:
    """The rows of a file, and the numbers of those that it marks as rejected."""
    content = read_bytes(path, _LARGEST_FILE, "a survey file")
    if content.startswith(ZIP):
        return read_workbook(content, SURVEY, columns, sheet, _WHICH_SHEET), []
    if content.startswith(OLD_EXCEL):
        raise InputError("a workbook in the format xlsx, or a text: save it as one of them")
    text = decode(content, _KINDS)
    if text.lstrip().startswith("<"):
        if columns:
            said = {key: choice.header or choice.unit for key, choice in columns.items()}
            raise InputError("no columns, since WITSML names its elements", key="columns", value=said)
        return read_witsml(text, sheet)
    if sheet is not None:
        raise InputError("no sheet for a text in columns", key="sheet", value=sheet)
    try:
        return read_text(text, SURVEY, columns), []
    except InputError as error:
        if path.suffix.lower() != ".xlsx":
            raise
        raise InputError(f"a workbook, as the name says: the file is a text, and no survey ({error})") from error


def _stations(rows: Rows, file: str, rejected: list[int]) -> Written:
    """The stations of a table's rows.

    Raises InputError for depths such as "1.030" beside whole angles: 1.03 or 1030, and no other cell tells which.
    """
    values = Numbers().read(rows, KEYS, nothing=())
    depths, angles = rows.cells["md"], [*rows.cells["inc"], *rows.cells["azi"]]
    deep = values[:, 0].nonzero()[0].tolist()
    if (
        deep
        and values[:, 0].max() <= _SHORTEST
        and all(GROUPED_BY_POINT.fullmatch(depths[row]) for row in deep)
        and not any("." in cell for cell in angles)
    ):
        value = values[deep[0], 0]
        raise rows.error(deep[0], "md", f"a number whose dot has one meaning: this is {value:g} or {1e3 * value:g}")
    units = [str(rows.columns[key].unit) for key in KEYS]
    return Written(
        values, (units[0], units[1], units[2]), lambda row, column: rows.where(row, KEYS[column]), rows.numbers,
        rows.one, rows.several, file, rejected, _vertical(rows),
    )  # fmt: skip


def _vertical(rows: Rows) -> Array | None:
    """True vertical depths (n,) [m], NaN where there is none; None without such a column of numbers."""
    if "tvd" not in rows.columns:
        return None
    column = rows.columns["tvd" if rows.columns["tvd"].unit else "md"]
    try:
        return Numbers().read(rows, ["tvd"], nothing=("", "-", *NOTHING))[:, 0] * column.factor
    except InputError:  # it only checks the stations
        return None
