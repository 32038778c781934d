"""Tables as files, CSV, Parquet or Excel's workbook, with what is known of them as metadata."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fctd.store.whole_file import whole_file

if TYPE_CHECKING:
    import pandas as pd

Rows = list[dict[str, Any]]


def write_table(table: pd.DataFrame | Rows, path: Path, metadata: Mapping[str, Any]) -> list[Path]:
    """Write a table as CSV, Parquet or Excel's workbook, whichever the suffix says; returns the files written.

    table : a data frame, or rows that have the same columns; rows as CSV need no pandas, which is slow to import.
    Parquet and workbook carry the metadata themselves; beside a CSV, which any reader must find a plain table, it goes
    into a JSON file of its own: ``chart.csv.json``.  Raises InputError where a file cannot be written.
    """
    files = table_files(path)
    with whole_file(path) as scratch:
        if path.suffix.lower() == ".csv":
            to_csv(table, scratch)
        else:
            import pandas as pd

            _WRITERS[path.suffix.lower()](pd.DataFrame(table), scratch, metadata)
    for beside in files[1:]:
        with whole_file(beside) as scratch:
            scratch.write_text(json.dumps(metadata, indent=1), encoding="utf-8")
    return files


def table_files(path: Path) -> list[Path]:
    """The files that ``write_table`` writes for a path."""
    return [path, path.with_name(path.name + ".json")] if path.suffix.lower() == ".csv" else [path]


def to_csv(table: pd.DataFrame | Rows, path: Path) -> None:
    """Write a table with one row of headers; NaN is an empty cell."""
    if not isinstance(table, list):
        table.to_csv(path, index=False)
        return
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(table[0]), lineterminator=os.linesep)
        writer.writeheader()
        for row in table:
            writer.writerow({name: "" if value != value else value for name, value in row.items()})


def to_parquet(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write a table; the metadata are added to those of pandas, texts as they are and other values as JSON."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    table = pa.Table.from_pandas(frame, preserve_index=False)
    kept = dict(table.schema.metadata or {})
    for key, value in metadata.items():
        kept[key.encode()] = (value if isinstance(value, str) else json.dumps(value)).encode()
    with path.open("wb") as sink:  # pyarrow opens only names in UTF-8
        pq.write_table(table.replace_schema_metadata(kept), sink)


def _to_workbook(frame: pd.DataFrame, path: Path, metadata: Mapping[str, Any]) -> None:
    """Write a table as the first sheet of a workbook and its metadata as the second; needs xlsxwriter."""
    import pandas as pd

    about = pd.DataFrame(
        [(key, value if isinstance(value, str) else json.dumps(value)) for key, value in metadata.items()],
        columns=["key", "value"],
    )
    # A text is a text, also where it looks like a formula or an address.  The package packs a file while it writes it:
    # a disk that becomes full meanwhile would leave it in the middle.
    options = {"strings_to_formulas": False, "strings_to_urls": False, "in_memory": True}
    content = io.BytesIO()
    with pd.ExcelWriter(content, engine="xlsxwriter", engine_kwargs={"options": options}) as book:
        for name, table in (("table", frame), ("about", about)):
            table.to_excel(book, sheet_name=name, index=False, freeze_panes=(1, 0))
            book.sheets[name].autofit()
    path.write_bytes(content.getvalue())


_WRITERS: Final[dict[str, Callable[[pd.DataFrame, Path, Mapping[str, Any]], None]]] = {
    ".parquet": to_parquet,
    ".xlsx": _to_workbook,
}
