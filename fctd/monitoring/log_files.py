"""Series in Parquet tables, LAS files and WITSML logs."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from fctd.case.errors import InputError
from fctd.case.xml_file import child, read_xml, tag, text_of
from fctd.monitoring.quantities import QUANTITIES, check_columns, find_columns
from fctd.monitoring.rows import to_si
from fctd.store.parquet import read_frame

Said = Mapping[str, tuple[str, str | None]]


def read_parquet(path: Path, said: Said) -> pd.DataFrame:
    """The rows [SI] of a Parquet table, whose columns are named as the headers of a text are."""
    try:
        table = read_frame(path)
    except (OSError, ValueError) as error:
        raise InputError(f"a Parquet table ({error})") from error
    return _convert(table.set_axis(range(table.shape[1]), axis=1), list(map(str, table.columns)), (), said)


def read_las(text: str, said: Said) -> pd.DataFrame:
    """The rows [SI] of a LAS file.  Raises InputError where the package lasio is missing."""
    try:
        import lasio
    except ModuleNotFoundError as error:
        raise InputError("the package lasio for LAS files (pip install lasio, or the extra fctd[las])") from error
    try:
        las = lasio.read(io.StringIO(text))
    except Exception as error:  # lasio raises errors of many kinds
        raise InputError(f"a LAS file that lasio can read ({error})") from error
    cells = pd.DataFrame({k: curve.data for k, curve in enumerate(las.curves)})
    return _convert(cells, [c.mnemonic for c in las.curves], [c.unit for c in las.curves], said)


def read_witsml_log(text: str, said: Said) -> pd.DataFrame:
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
    return _convert(pd.DataFrame(rows, columns=range(len(headers)), dtype=str), headers, units, said)


def _convert(cells: pd.DataFrame, headers: Sequence[str], units: Sequence[str], said: Said) -> pd.DataFrame:
    """Rows [SI] of cells of any type, a column for each header."""
    columns = find_columns(headers, units, said)
    text_time = False
    if "time" in columns:
        times: pd.Series[Any] = cells[columns["time"].place].dropna().astype(str)
        text_time = bool(len(times)) and bool(times.iloc[:1].str.contains(r"\d[-/:T]\d").any())
        if text_time:
            columns["time"] = columns["time"].__class__(columns["time"].place, columns["time"].header, None)
    check_columns(columns, headers, text_time=text_time)
    ordered = {key: columns[key] for key in QUANTITIES if key in columns}
    texts = cells[[c.place for c in ordered.values()]].map(lambda v: "" if pd.isna(v) else str(v))
    return to_si(texts, range(1, len(cells) + 1), ordered, decimal_comma=False)
