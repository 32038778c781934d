"""Chunks of records: what is read back is what was recorded, and the disk that they need."""

from pathlib import Path

import pandas as pd

from fctd.simulation import chunks
from fctd.simulation.chunks import Cursor, add_chunk, bytes_needed, chunk_since, read_chunk
from fctd.simulation.recorder import Recorder
from fctd.simulation.simulate import Simulation
from tests.simulation.kept import stopped, tripping


def test_chunks_hold_every_record_once() -> None:
    """History, ledger, profiles and segments, also where segments were dropped since they were written."""
    simulation = Simulation(tripping())
    simulation.start()
    simulation.recorder.series._most = 200  # rows: every second record is dropped again and again
    _, written_chunks = stopped(simulation, len(simulation.intervals), chunk=5)
    written = simulation.recorder
    assert written.series.every > 4
    read = Recorder(simulation.run)
    read.series.every = written.series.every
    for chunk in written_chunks:
        add_chunk(read, read_chunk(chunk))
    # As text, in which NaN equals NaN and no digit is lost.
    assert repr(read.history) == repr([{k: _plain(v) for k, v in row.items()} for row in written.history])
    assert repr(read.ledger) == repr([{k: _plain(v) for k, v in row.items()} for row in written.ledger])
    assert list(read.profiles) == list(written.profiles)
    assert len(written.profiles) == 2
    for at, table in written.profiles.items():
        pd.testing.assert_frame_equal(read.profiles[at], table, check_exact=True)
    tables = (series.table(simulation.run.hole) for series in (read.series, written.series))
    pd.testing.assert_frame_equal(*tables, check_exact=True)
    assert chunk_since(written, Cursor.at_end(written)) == {}


def _plain(value: object) -> object:
    """A number of numpy as one of Python."""
    return value.item() if hasattr(value, "item") else value


def test_the_estimate_is_above_what_a_run_writes(tmp_path: Path) -> None:
    """Chunks of 30 records, whose Parquet headers weigh little, and the result."""
    simulation = Simulation(tripping())
    needed = bytes_needed(simulation.run, len(simulation.intervals), csv=True)
    _, written = stopped(simulation, len(simulation.intervals), chunk=30)
    simulation.result().save(tmp_path / "out", csv=True)
    size = sum(sum(map(len, chunk.values())) for chunk in written)
    size += sum(path.stat().st_size for path in (tmp_path / "out").iterdir())
    assert size < needed < 4 * size


def test_rows_of_segments_are_bounded() -> None:
    """A hundred times the records need less than a hundred times the disk: most segments' rows are dropped."""
    run = Simulation(tripping()).run
    assert bytes_needed(run, 1_000_000, csv=False) < 1_000_000 * 2.5 * chunks.RECORD + 4e7 * chunks.SEGMENT_ROW / 10
