"""Tables as CSV and Parquet, with what is known of them as metadata."""

from __future__ import annotations

import csv
import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    import pandas as pd

Rows = list[dict[str, Any]]
# Where a spreadsheet takes a text for a formula: at its start, and behind what separates columns in some language.
_FORMULA: Final = re.compile(r"(?:^|(?<=[;,\t\r\n]))(?=[=+\-@\t\r])")


def table_files(path: Path) -> list[Path]:
    """The files of a table with its metadata: beside a CSV they have a file of their own."""
    return [path, path.with_name(path.name + ".json")] if path.suffix.lower() == ".csv" else [path]


def to_csv(table: pd.DataFrame | Rows, path: Path) -> None:
    """Write a table with one row of headers; NaN is an empty cell.

    A text that a spreadsheet would take for a formula, such as the name of a component, has ' before it.
    """
    if not isinstance(table, list):
        texts = table.select_dtypes(exclude=["number", "bool"])
        table.assign(**{str(name): texts[name].map(_plain) for name in texts}).to_csv(path, index=False)
        return
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(table[0]), lineterminator=os.linesep)
        writer.writeheader()
        for row in table:
            writer.writerow({name: "" if value != value else _plain(value) for name, value in row.items()})


def _plain(value: Any) -> Any:
    """A cell that a spreadsheet shows as it is; numbers as text, such as -3.5, stay."""
    if not isinstance(value, str) or not _FORMULA.search(value):
        return value
    try:
        float(value)
    except ValueError:
        return _FORMULA.sub("'", value)
    return value


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
