"""Series in Parquet tables, LAS files and WITSML logs."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from fctd.case.errors import InputError
from fctd.case.tables import las
from fctd.case.tables.headers import Choices, find_columns, with_units
from fctd.case.tables.rows import Rows
from fctd.case.xml_file import child, read_xml, tag, text_of
from fctd.monitoring.quantities import SERIES
from fctd.monitoring.rows import Converter
from fctd.store.parquet import read_frame


def read_parquet(path: Path, choices: Choices) -> pd.DataFrame:
    """The rows [SI] of a Parquet table, whose columns are named as the headers of a text are."""
    try:
        table = read_frame(path)
    except (OSError, ValueError) as error:
        raise InputError(f"a Parquet table ({error})") from error
    return _convert(table.set_axis(range(table.shape[1]), axis=1), list(map(str, table.columns)), (), choices)


def read_las(text: str, choices: Choices) -> pd.DataFrame:
    """The rows [SI] of a LAS file; see ``fctd.case.tables.las``."""
    return Converter().take(las.read_las(text, SERIES, choices))


def read_witsml_log(text: str, choices: Choices) -> pd.DataFrame:
    """The rows [SI] of the first log of a WITSML 1.3.1 or 1.4.1 file."""
    root = read_xml(text, "a WITSML log")
    log = next((element for element in root.iter() if tag(element) == "log"), None)
    if log is None:
        raise InputError(f"a WITSML log, found the element {tag(root)}")
    stated = {}
    for info in log:
        if tag(info) == "logCurveInfo":
            stated[text_of(child(info, "mnemonic"))] = text_of(child(info, "unit"))
    data = [element for element in log if tag(element) == "logData"]
    if not data:
        raise InputError("a WITSML log with logData")
    listed = text_of(child(data[0], "mnemonicList"))
    headers = [name.strip() for name in listed.split(",")] if listed else list(stated)
    units = [name.strip() for name in text_of(child(data[0], "unitList")).split(",")]
    if len(units) != len(headers):
        units = [stated.get(header, "") for header in headers]
    rows = [text_of(row).split(",") for part in data for row in part if tag(row) == "data"]
    for number, row in enumerate(rows, start=1):
        if len(row) != len(headers):
            raise InputError(f"{len(headers)} values, as many as mnemonics", key=f"data {number}", value=",".join(row))
    return _convert(pd.DataFrame(rows, columns=range(len(headers)), dtype=str), headers, units, choices)


def _convert(table: pd.DataFrame, headers: Sequence[str], units: Sequence[str], choices: Choices) -> pd.DataFrame:
    """Rows [SI] of cells of any type, a column for each header."""
    columns = find_columns((0, list(headers)), SERIES, choices)
    columns = with_units(columns, [(0, list(units))], (), SERIES, choices)
    cells = {
        key: ["" if pd.isna(value) else str(value).strip() for value in table[column.place]]
        for key, column in columns.items()
    }
    return Converter().take(Rows(columns, range(1, len(table) + 1), cells))
