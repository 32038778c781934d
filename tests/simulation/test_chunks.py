"""Chunks of records: what is read back is what was recorded."""

import pandas as pd

from fctd.simulation.chunks import Cursor, add_chunk, chunk_since, read_chunk, size_of
from fctd.simulation.recorder import Recorder
from fctd.simulation.simulate import Simulation
from tests.simulation.kept import tripping


def test_chunks_hold_every_record_once() -> None:
    """History, ledger, profiles and segments, also where segments were dropped since they were written."""
    simulation, cursor, chunks = Simulation(tripping()), Cursor(), []
    simulation.start()
    simulation.recorder.series._most = 200  # rows: every second record is dropped again and again
    for k, _ in enumerate(simulation, start=1):
        if k % 5 == 0:
            chunks.append(read_chunk(chunk_since(simulation.recorder, cursor)))
    chunks.append(read_chunk(chunk_since(simulation.recorder, cursor)))
    written = simulation.recorder
    assert written.series.every > 4
    read = Recorder(simulation.run)
    read.series.every = written.series.every
    for chunk in chunks:
        add_chunk(read, chunk)
    # As text, in which NaN equals NaN and no digit is lost.
    assert repr(read.history) == repr([{k: _plain(v) for k, v in row.items()} for row in written.history])
    assert repr(read.ledger) == repr([{k: _plain(v) for k, v in row.items()} for row in written.ledger])
    assert list(read.profiles) == list(written.profiles)
    assert len(written.profiles) == 2
    for at, table in written.profiles.items():
        pd.testing.assert_frame_equal(read.profiles[at], table, check_exact=True)
    tables = (series.table(simulation.run.hole) for series in (read.series, written.series))
    pd.testing.assert_frame_equal(*tables, check_exact=True)
    assert size_of(chunks) == (cursor.records, cursor.records, cursor.profiles)


def _plain(value: object) -> object:
    """A number of numpy as one of Python."""
    return value.item() if hasattr(value, "item") else value


def test_a_chunk_without_news_is_empty() -> None:
    simulation, cursor = Simulation(tripping()), Cursor()
    next(simulation)
    assert set(chunk_since(simulation.recorder, cursor)) == {"history", "energy", "segments"}
    assert chunk_since(simulation.recorder, cursor) == {}
