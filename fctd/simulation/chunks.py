"""The records of a run in chunks: what has been recorded since the chunk before, as Parquet tables in memory.

Read back, the records are those that were written, bit by bit.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from fctd.simulation.recorder import Recorder
from fctd.simulation.series import KEPT
from fctd.store.parquet import read_table

if TYPE_CHECKING:
    import pandas as pd

NAMES = ("history", "energy", "profile", "segments")
# Added columns: the time of the record to which a profile belongs [s], and the number of a record of the segments.
RECORDED_AT, NUMBER = "recorded_at_s", "number"


@dataclass
class Cursor:
    """How much of a recorder has been written: records, profiles, and records of its segments."""

    records: int = 0
    profiles: int = 0
    seen: int = 0


def chunk_since(recorder: Recorder, cursor: Cursor) -> dict[str, bytes]:
    """The records since a cursor, which moves on; by the names of ``NAMES``, empty tables left out."""
    import pyarrow as pa

    found: dict[str, Any] = {}
    for name, rows in (("history", recorder.history), ("energy", recorder.ledger)):
        if new := rows[cursor.records :]:
            found[name] = pa.table({key: [row[key] for row in new] for key in new[0]})
    profiles = list(recorder.profiles.items())[cursor.profiles :]
    if profiles:
        import pandas as pd

        parts = [table.assign(**{RECORDED_AT: time}) for time, table in profiles]
        found["profile"] = pa.Table.from_pandas(pd.concat(parts, ignore_index=True), preserve_index=False)
    if series := recorder.series.since(cursor.seen):
        numbers = np.repeat(np.array([number for number, _ in series], np.int64), [len(rows) for _, rows in series])
        values = np.concatenate([rows for _, rows in series])
        columns = {name: values[:, k] for k, name in enumerate(KEPT)}
        found["segments"] = pa.table({NUMBER: numbers, **columns})
    cursor.records, cursor.profiles = len(recorder.history), len(recorder.profiles)
    cursor.seen = recorder.series.seen
    return {name: _packed(table) for name, table in found.items()}


def read_chunk(chunk: Mapping[str, bytes]) -> dict[str, Any]:
    """The tables of a chunk; raises OSError or ValueError for one that cannot be read."""
    return {name: read_table(io.BytesIO(data), checksums=True) for name, data in chunk.items()}


def size_of(chunks: Iterable[Mapping[str, Any]]) -> tuple[int, int, int]:
    """Number of records in history, in ledger and in profiles of the tables of chunks."""
    sizes = [0, 0, 0]
    for chunk in chunks:
        for k, name in enumerate(("history", "energy")):
            sizes[k] += chunk[name].num_rows if name in chunk else 0
        sizes[2] += len(chunk["profile"].column(RECORDED_AT).unique()) if "profile" in chunk else 0
    return sizes[0], sizes[1], sizes[2]


def add_chunk(recorder: Recorder, chunk: Mapping[str, Any]) -> None:
    """Add the records of a chunk's tables to a recorder."""
    for name, rows in (("history", recorder.history), ("energy", recorder.ledger)):
        if name in chunk:
            rows.extend(chunk[name].to_pylist())
    if "profile" in chunk:
        table: pd.DataFrame = chunk["profile"].to_pandas()
        for time, part in table.groupby(RECORDED_AT, sort=False):
            recorder.profiles[float(str(time))] = part.drop(columns=RECORDED_AT).reset_index(drop=True)
    if "segments" in chunk:
        read = chunk["segments"]
        numbers = read.column(NUMBER).to_numpy()
        values = np.stack([read.column(name).to_numpy() for name in KEPT], axis=1)
        edges = np.flatnonzero(np.diff(numbers)) + 1
        for record, first in zip(np.split(values, edges), [0, *edges], strict=True):
            recorder.series.put_back(int(numbers[first]), record)


def warm_up() -> None:
    """Load what writes chunks.

    The first one would otherwise look a hundred times as expensive as the next, which would be put off for minutes.
    """
    import pandas as pd
    import pyarrow as pa

    frame = pd.DataFrame({"text": ["x"], "number": [0.0]})
    read_chunk({"table": _packed(pa.Table.from_pandas(frame, preserve_index=False))})


def _packed(table: Any) -> bytes:
    import pyarrow.parquet as pq

    sink = io.BytesIO()
    # Numbers that hardly repeat: dictionaries of them take three quarters of the time, and make the file no smaller.
    pq.write_table(table, sink, write_page_checksum=True, use_dictionary=False, write_statistics=False)
    return sink.getvalue()
