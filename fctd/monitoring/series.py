"""A series of the rig's readings from a file of any kind; the content tells which."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Final

import pandas as pd

from fctd.case.errors import naming
from fctd.case.input_file import decode, read_bytes
from fctd.case.tables.headers import Choice
from fctd.monitoring.log_files import read_las, read_parquet, read_witsml_log
from fctd.monitoring.text_series import KINDS, read_text

_LARGEST: Final = 512  # MiB: some four million rows
_PARQUET: Final = b"PAR1"


def read_series(
    path: str | PathLike[str], columns: Mapping[str, tuple[str | None, str | None]] | None = None
) -> pd.DataFrame:
    """The rows of a text in columns, a Parquet table, a LAS file or a WITSML log, in SI units.

    A series over time has the columns time_s, bit_depth_m, weight_indicator_N (the reading, with the block),
    drive_torque_N_m, rpm, block_position_m, and where the file has them hole_depth_m, flow_m3_s and weight_on_bit_N; a
    series by depth has operation in place of time_s, rpm and block_position_m.  The index is the row in the file.
    columns : header and unit, each may be None, of quantities (``quantities.SERIES``) that the headers do not tell.
    Raises InputError, which names file, row and column.
    """
    path, said = Path(path), {key: Choice(*choice) for key, choice in (columns or {}).items()}
    with naming(path):
        content = read_bytes(path, _LARGEST, "a series")
        if content.startswith(_PARQUET):
            return read_parquet(path, said)
        text = decode(content, KINDS)
        begins = text.lstrip()[:20]
        if begins.startswith("<"):
            return read_witsml_log(text, said)
        if begins.startswith("~") or "\n~V" in text[:2000]:
            return read_las(text, said)
        return read_text(text, said)
