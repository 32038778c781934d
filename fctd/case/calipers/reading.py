"""A caliper file, a text in columns or LAS, as measured rows."""

from collections.abc import Callable
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.case.calipers.form import ARMS, CALIPER
from fctd.case.errors import InputError, naming
from fctd.case.input_file import decode, read_bytes
from fctd.case.tables.headers import Choices
from fctd.case.tables.las import read_las
from fctd.case.tables.rows import NOTHING, NULLS, Numbers
from fctd.case.tables.text import read_text

_LARGEST_FILE: Final = 64  # MiB: 200,000 rows with 30 curves
_KINDS: Final = "a caliper log: text in columns or a LAS file"


class Measured(NamedTuple):
    """Rows of a caliper: measured depths (k,) [m], values of the arms (k, arms) [m], NaN where missing, angles (k,) of
    the first arm [rad]; the name of a cell of a row and a key in messages."""

    md: Array
    values: Array
    orientation: Array
    where: Callable[[int, str], str]


def read_caliper(path: Path, choices: Choices) -> Measured:
    """The rows of a caliper file.

    choices : header or unit of a column, where the file does not tell.  Raises InputError, which names file, row and
    column, for bad data.
    """
    with naming(path):
        text = decode(read_bytes(path, _LARGEST_FILE, "a caliper file"), _KINDS)
        rows = (read_las if text.lstrip().startswith("~") else read_text)(text, CALIPER, choices)
        if len(rows) < 2:
            raise InputError("two rows or more below the headers", key="rows", value=len(rows))
        keys = [key for key in ("md", "orientation", *ARMS) if key in rows.columns]
        arms = [key for key in ARMS if key in keys]
        if arms != list(ARMS[: len(arms)]):
            first = next(a for a, b in zip(ARMS, arms, strict=False) if a != b)
            raise InputError("it beside the arms after it", key=f"column {first}")
        values = Numbers().read(rows, keys, NOTHING)
        values[np.isin(values, NULLS)] = np.nan
        values *= [rows.columns[key].factor for key in keys]
        table = dict(zip(keys, values.T, strict=True))
        if np.isnan(table["md"]).any():
            raise rows.error(int(np.isnan(table["md"]).argmax()), "md", "a number")
        orientation = np.nan_to_num(table.get("orientation", np.zeros(len(values))))
        # A tool logs on its way up, and files keep that order.
        order = np.arange(len(values))[:: -1 if (np.diff(table["md"]) < 0).all() else 1]
        return Measured(
            table["md"][order], np.column_stack([table[arm] for arm in arms])[order], orientation[order],
            lambda row, key: rows.where(int(order[row]), key)[0],
        )  # fmt: skip
