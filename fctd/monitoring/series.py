"""A series of the rig's readings from a file of any kind; the content tells which."""

from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Final

import pandas as pd

from fctd.case.errors import InputError
from fctd.case.input_file import read_bytes
from fctd.monitoring.log_files import read_las, read_parquet, read_witsml_log
from fctd.monitoring.text_series import decode, read_text

_LARGEST: Final = 512  # MiB: some four million rows
_PARQUET: Final = b"PAR1"


def read_series(path: str | PathLike[str], columns: Mapping[str, tuple[str, str | None]] | None = None) -> pd.DataFrame:
    """The rows of a text in columns, a Parquet table, a LAS file or a WITSML log, in SI units.

    A series over time has the columns time_s, bit_depth_m, weight_indicator_N (the reading, with the block),
    drive_torque_N_m, rpm, block_position_m, and where the file has them hole_depth_m, flow_m3_s and weight_on_bit_N; a
    series by depth has operation in place of time_s, rpm and block_position_m.  The index is the row in the file.
    columns : header and unit of quantities (``quantities.QUANTITIES``) that the headers do not tell.  Raises
    InputError, which names file, row and column.
    """
    path, said = Path(path), columns or {}
    try:
        content = read_bytes(path, _LARGEST)
        if content.startswith(_PARQUET):
            return read_parquet(path, said)
        text = decode(content)
        begins = text.lstrip()[:20]
        if begins.startswith("<"):
            return read_witsml_log(text, said)
        if begins.startswith("~") or "\n~V" in text[:2000]:
            return read_las(text, said)
        return read_text(text, said)
    except OSError as error:
        raise InputError(f"a series that can be read ({error.strerror})", file=path) from error
    except InputError as error:
        raise error.in_file(path) from error.__cause__
