"""Parquet tables are read without threads that outlive the interpreter."""

import io
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fctd.store.parquet import read_frame, read_table

THREADS = """
import os, sys
from fctd.store.parquet import read_frame, read_table
import pyarrow.parquet
before = set(os.listdir("/proc/self/task"))
with open(sys.argv[1], "rb") as source:
    read_table(source, ["status"])
read_frame(sys.argv[1])
print(len(set(os.listdir("/proc/self/task")) - before))
"""


def frame(rows: int) -> pd.DataFrame:
    return pd.DataFrame(
        {"sample": range(rows), "status": ["converged"] * rows, "hook_N": [0.1 * k for k in range(rows)]}
    )


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=20, deadline=None)
@given(rows=st.integers(0, 3000), columns=st.sets(st.sampled_from(["sample", "status", "hook_N"]), min_size=1))
def test_what_is_read_is_what_was_written(rows: int, columns: set[str], tmp_path: Path) -> None:
    written, path = frame(rows), tmp_path / "table.parquet"
    written.to_parquet(path)
    pd.testing.assert_frame_equal(read_frame(path), written, check_index_type=False)
    with path.open("rb") as source:
        found = read_table(source, sorted(columns))
        assert not source.closed
    assert found.to_pydict() == written[sorted(columns)].to_dict("list")


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="the system does not list threads")
def test_reading_starts_no_thread(tmp_path: Path) -> None:
    """A thread of pyarrow that takes the interpreter's lock while that ends aborts the process."""
    frame(100).to_parquet(tmp_path / "table.parquet")
    command = [sys.executable, "-c", THREADS, str(tmp_path / "table.parquet")]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout.split() == ["0"]


@pytest.mark.parametrize("text", [b"", b"PAR1", b"a,b\n1,2\n"])
def test_what_is_no_table_is_an_error(text: bytes) -> None:
    with pytest.raises((OSError, ValueError)):
        read_table(io.BytesIO(text))
