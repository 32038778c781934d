"""Tables as files for people and programs: CSV, Parquet or Excel's workbook, whichever the suffix says."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fctd.results.workbook import to_workbook
from fctd.store.tables import Rows, table_files, to_csv, to_parquet
from fctd.store.whole_file import whole_file, writing

if TYPE_CHECKING:
    import pandas as pd


def write_table(table: pd.DataFrame | Rows, path: Path, metadata: Mapping[str, Any]) -> list[Path]:
    """Write a table as CSV, Parquet or Excel's workbook, whichever the suffix says; returns the files written.

    table : a data frame, or rows that have the same columns; rows as CSV need no pandas, which is slow to import.
    Parquet and workbook carry the metadata themselves; beside a CSV, which any reader must find a plain table, it goes
    into a JSON file of its own: ``chart.csv.json``.  Raises InputError where a file cannot be written; both files then
    are as they were.
    """
    files = table_files(path)
    with ExitStack() as written:
        scratch, *beside = [written.enter_context(whole_file(file)) for file in files]
        with writing(path):
            if path.suffix.lower() == ".csv":
                to_csv(table, scratch)
            else:
                import pandas as pd

                _WRITERS[path.suffix.lower()](pd.DataFrame(table), scratch, metadata)
        for file in beside:
            with writing(files[1]):
                file.write_text(json.dumps(metadata, indent=1), encoding="utf-8")
    return files


_WRITERS: Final[dict[str, Callable[[pd.DataFrame, Path, Mapping[str, Any]], None]]] = {
    ".parquet": to_parquet,
    ".xlsx": to_workbook,
}
