"""The records of a run in chunks: what has been recorded since the chunk before, as Parquet tables in memory.

Read back, the records are those that were written, bit by bit.
"""

from __future__ import annotations

import io
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from fctd.simulation.recorder import Recorder
from fctd.simulation.run import Run
from fctd.simulation.series import KEPT, MOST_ROWS
from fctd.store.parquet import read_table

if TYPE_CHECKING:
    import pandas as pd

HISTORY, ENERGY, PROFILE, SEGMENTS = (f"{name}.parquet" for name in ("history", "energy", "profile", "segments"))
# Added columns: the time of the record to which a profile belongs [s], and the number of a record of the segments.
RECORDED_AT, NUMBER = "recorded_at_s", "number"
# Bytes of a record in history and ledger, of a row of the segments and of a profile, as Parquet that hardly shrinks;
# as CSV a number takes two and a half times as much.
RECORD, SEGMENT_ROW, PROFILE_ROW, AS_CSV = 350, 48, 160, 2.5
# Of a checkpoint: a column of the state, and all else.
COLUMN, REST = 92 * 8, 100_000


class Cursor(NamedTuple):
    """How much of a recorder has been written: records, profiles, and records of its segments."""

    records: int = 0
    profiles: int = 0
    seen: int = 0

    @classmethod
    def at_end(cls, recorder: Recorder) -> Cursor:
        """All that has been recorded."""
        return cls(len(recorder.history), len(recorder.profiles), recorder.series.seen)


def chunk_since(recorder: Recorder, cursor: Cursor) -> dict[str, bytes]:
    """The records since a cursor, a table for each name above, empty ones left out."""
    import pyarrow as pa

    found: dict[str, Any] = {}
    for name, rows in ((HISTORY, recorder.history), (ENERGY, recorder.ledger)):
        if new := rows[cursor.records :]:
            found[name] = pa.table({key: [row[key] for row in new] for key in new[0]})
    profiles = list(recorder.profiles.items())[cursor.profiles :]
    if profiles:
        import pandas as pd

        parts = [table.assign(**{RECORDED_AT: time}) for time, table in profiles]
        found[PROFILE] = pa.Table.from_pandas(pd.concat(parts, ignore_index=True), preserve_index=False)
    if series := recorder.series.since(cursor.seen):
        numbers = np.repeat(np.array([number for number, _ in series], np.int64), [len(rows) for _, rows in series])
        values = np.concatenate([rows for _, rows in series])
        columns = {name: values[:, k] for k, name in enumerate(KEPT)}
        found[SEGMENTS] = pa.table({NUMBER: numbers, **columns})
    return {name: _packed(table) for name, table in found.items()}


def read_chunk(chunk: Mapping[str, bytes]) -> dict[str, Any]:
    """The tables of a chunk; raises OSError or ValueError for one that cannot be read."""
    return {name: read_table(io.BytesIO(data)) for name, data in chunk.items()}


def add_chunk(recorder: Recorder, chunk: Mapping[str, Any]) -> None:
    """Add the records of a chunk's tables to a recorder."""
    for name, rows in ((HISTORY, recorder.history), (ENERGY, recorder.ledger)):
        if name in chunk:
            rows.extend(chunk[name].to_pylist())
    if PROFILE in chunk:
        table: pd.DataFrame = chunk[PROFILE].to_pandas()
        for time, part in table.groupby(RECORDED_AT, sort=False):
            recorder.profiles[float(str(time))] = part.drop(columns=RECORDED_AT).reset_index(drop=True)
    if SEGMENTS in chunk:
        read = chunk[SEGMENTS]
        numbers = read.column(NUMBER).to_numpy()
        values = np.stack([read.column(name).to_numpy() for name in KEPT], axis=1)
        edges = np.flatnonzero(np.diff(numbers)) + 1
        for record, first in zip(np.split(values, edges), [0, *edges], strict=True):
            recorder.series.put_back(int(numbers[first]), record)


def bytes_needed(run: Run, records: int, csv: bool) -> float:
    """The disk that a run of so many records needs until it has ended: its chunks, two checkpoints and its result."""
    n = len(run.owner) - 2
    rows = records * n
    kept = min(rows, MOST_ROWS)
    # Chunks keep what is dropped afterwards, half of the rows each time.
    written = kept * (1 + 0.5 * max(math.log2(rows / kept), 0.0)) if kept else 0.0
    profiles = len(run.case.record.profile_at) * (n + 1) * PROFILE_ROW
    chunks = records * RECORD + written * SEGMENT_ROW + profiles
    result = (records * RECORD + kept * SEGMENT_ROW + profiles) * (1 + (AS_CSV if csv else 0))
    return chunks + result + 2 * (n * COLUMN + REST)


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
    pq.write_table(table, sink, use_dictionary=False, write_statistics=False)
    return sink.getvalue()
