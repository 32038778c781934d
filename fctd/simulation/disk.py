"""How much disk a run will need, before it starts."""

import math
import shutil
from pathlib import Path

from fctd.case.errors import InputError
from fctd.simulation.run import Run
from fctd.simulation.series import MOST_ROWS

# Bytes of a record in history and ledger, of a row of the segments and of a profile, as Parquet that hardly shrinks;
# as CSV a number takes two and a half times as much.
RECORD, SEGMENT_ROW, PROFILE_ROW, AS_CSV = 350, 48, 160, 2.5
# Of a checkpoint: a column of the state, and all else.
COLUMN, REST = 92 * 8, 100_000


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


def check_disk(place: Path, needed: float, key: str) -> None:
    """Raise InputError, which names ``key``, where the disk of a folder has less than ``needed`` [bytes]."""
    folder = next(parent for parent in (place, *place.parents) if parent.exists())
    free = shutil.disk_usage(folder).free
    if free < needed:
        expected = (
            f"a disk with {needed / 1e6:.0f} MB free (this one has {free / 1e6:.0f} MB), a longer record.interval or "
            "fewer depths of record.profile_at"
        )
        raise InputError(expected, key=key, value=place)
