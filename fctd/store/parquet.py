"""Parquet tables, read on the thread that asks for them.

pyarrow's own ``read_table`` leaves the source, where Python opened it, to threads that may outlive the interpreter:
one process in twenty-five then ends with SIGABRT on a busy machine, although its work is done.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import IO, TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa


def read_table(source: str | os.PathLike[str] | IO[bytes], columns: Sequence[str] | None = None) -> pa.Table:
    """The table of a file, with all or some of its columns.

    Raises OSError or ValueError for a source that cannot be read.
    """
    from pyarrow.parquet import ParquetFile  # slow to import, and most commands need none

    with ParquetFile(source, pre_buffer=False) as file:
        return file.read(columns=None if columns is None else list(columns), use_threads=False)


def read_frame(source: str | os.PathLike[str] | IO[bytes]) -> pd.DataFrame:
    """The table of a file as a data frame; raises as ``read_table``."""
    frame: pd.DataFrame = read_table(source).to_pandas(use_threads=False)
    return frame
