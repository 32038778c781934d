"""Tables as files: by their suffix, with what is known of them."""

import json
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd.case.errors import InputError
from fctd.results.table_files import write_table

TABLE = pd.DataFrame({"time_s": [1.0, 2.5], "operation": ["trip_in", "trip_in"]})


@pytest.mark.parametrize("name", ["chart.csv", "chart.CSV", "chart.parquet"])
def test_the_suffix_says_what_a_table_is_written_as(name: str, tmp_path: Path) -> None:
    path, beside = tmp_path / name, tmp_path / f"{name}.json"
    written = write_table(TABLE, path, {"rpm": [60, 90], "operation": "trip_in"})
    if name.lower().endswith("csv"):
        assert written == [path, beside]
        pd.testing.assert_frame_equal(pd.read_csv(path), TABLE)
        assert json.loads(beside.read_text(encoding="utf-8")) == {"rpm": [60, 90], "operation": "trip_in"}
        return
    assert written == [path]
    assert not beside.exists()
    kept = pq.read_schema(path).metadata
    assert (kept[b"rpm"], kept[b"operation"]) == (b"[60, 90]", b"trip_in")


@pytest.mark.parametrize("limit", [0, pytest.param(1000, marks=pytest.mark.slow)])
def test_a_workbook_on_a_full_disk_is_refused_in_a_line(limit: int, tmp_path: Path) -> None:
    """The size that a file may have stands for the room of a disk."""
    pytest.importorskip("resource")
    script = f"""
import resource, signal, pandas as pd
from pathlib import Path
from fctd.case.errors import InputError
from fctd.results.table_files import write_table
frame = pd.DataFrame({{"a": [k * 0.1 for k in range(20_000)]}})
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
try:
    write_table(frame, Path({str(tmp_path / "c.xlsx")!r}), {{}})
except Exception as error:
    print(type(error).__name__, error)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.stdout.startswith("InputError "), done.stdout
    assert "expected a file that can be written (File too large)" in done.stdout
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("earlier", [False, True])
@pytest.mark.parametrize("full", ["t.csv", "t.csv.json"])
def test_a_full_disk_leaves_table_and_metadata_as_they_were(full: str, earlier: bool, tmp_path: Path) -> None:
    """Both or neither, whichever of the two finds no room, and the message names that one."""
    resource = pytest.importorskip("resource")
    path, about = tmp_path / "t.csv", {"case": "x" * (2000 if full.endswith("json") else 10)}
    before = write_table(TABLE, path, {"case": "earlier"}) if earlier else []
    kept = {file: file.read_bytes() for file in before}
    rows = [{"time_s": float(number)} for number in range(2 if full.endswith("json") else 2000)]
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(InputError, match=rf'/{full}": expected a file that can be written \(File too large\)'):
            write_table(rows, path, about)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert {file: file.read_bytes() for file in tmp_path.iterdir()} == kept
