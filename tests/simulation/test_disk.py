"""The disk that a run needs: an upper bound that is not far off, and the refusal."""

import shutil
from collections import namedtuple
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.simulation import disk
from fctd.simulation.chunks import Cursor, chunk_since
from fctd.simulation.disk import bytes_needed, check_disk
from fctd.simulation.simulate import Simulation
from tests.simulation.kept import tripping

Usage = namedtuple("Usage", ["total", "used", "free"])


def test_the_estimate_is_above_what_a_run_writes(tmp_path: Path) -> None:
    """Chunks of 30 records, whose Parquet headers weigh little, and the result."""
    simulation, cursor, written = Simulation(tripping()), Cursor(), 0
    records = len(simulation.intervals)
    needed = bytes_needed(simulation.run, records, csv=True)
    for k, _ in enumerate(simulation, start=1):
        if k % 30 == 0:
            written += sum(map(len, chunk_since(simulation.recorder, cursor).values()))
    simulation.result().save(tmp_path / "out", csv=True)
    written += sum(path.stat().st_size for path in (tmp_path / "out").iterdir())
    assert written < needed < 4 * written


def test_a_disk_that_is_too_small_is_refused_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: Usage(1e9, 9e8, 1e8))
    check_disk(tmp_path / "not" / "yet", 0.9e8, "--out")
    with pytest.raises(InputError, match=r"150 MB free \(this one has 100 MB\)") as refused:
        check_disk(tmp_path / "not" / "yet", 1.5e8, "--out")
    assert refused.value.key == "--out"


def test_rows_of_segments_are_bounded() -> None:
    """A hundred times the records need less than a hundred times the disk: most segments' rows are dropped."""
    run = Simulation(tripping()).run
    assert bytes_needed(run, 1_000_000, csv=False) < 1_000_000 * 2.5 * disk.RECORD + 4e7 * disk.SEGMENT_ROW / 10
