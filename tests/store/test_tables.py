"""Tables as files: by their suffix, with what is known of them."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd.store.tables import write_table

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


def test_rows_are_written_as_their_table(tmp_path: Path) -> None:
    """To the last character, also of a missing value, a text with a comma and numbers at the ends of the range."""
    rows: list[dict[str, Any]] = [
        {"depth_m": 0.1 + 0.2, "status": "converged", "iterations": 7, "reason": 'none, or "none"'},
        {"depth_m": float("nan"), "status": "unstable", "iterations": 0, "reason": "ä\nb"},
        {"depth_m": 1e22, "status": "converged", "iterations": 3, "reason": "none"},
        {"depth_m": np.float64(-1.5e-7), "status": "converged", "iterations": 3, "reason": ""},
        {"depth_m": -0.0, "status": "converged", "iterations": 3, "reason": " "},
    ]
    write_table(rows, tmp_path / "rows.csv", {})
    write_table(pd.DataFrame(rows), tmp_path / "table.csv", {})
    assert (tmp_path / "rows.csv").read_bytes() == (tmp_path / "table.csv").read_bytes()
    write_table(rows, tmp_path / "rows.parquet", {})
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "rows.parquet"), pd.DataFrame(rows))


def test_a_workbook_has_a_sheet_of_the_table_and_one_of_its_origin(tmp_path: Path) -> None:
    """Numbers are numbers, a missing one is an empty cell, and a text that looks like a formula is a text."""
    pytest.importorskip("xlsxwriter")
    calamine = pytest.importorskip("python_calamine")
    path = tmp_path / "chart.XLSX"
    table = pd.DataFrame({"hookload_N": [1.5, float("nan")], "reason": ["=1+1", "https://localhost"]})
    assert write_table(table, path, {"rpm": [60, 90], "operation": "trip_in"}) == [path]
    book = calamine.CalamineWorkbook.from_path(path)
    assert book.get_sheet_by_name("table").to_python() == [
        ["hookload_N", "reason"], [1.5, "=1+1"], ["", "https://localhost"],
    ]  # fmt: skip
    about = dict(book.get_sheet_by_name("about").to_python())
    assert about == {"key": "value", "rpm": "[60, 90]", "operation": "trip_in"}


@pytest.mark.parametrize("limit", [0, pytest.param(1000, marks=pytest.mark.slow)])
def test_a_workbook_on_a_full_disk_is_refused_in_a_line(limit: int, tmp_path: Path) -> None:
    """The size that a file may have stands for the room of a disk."""
    pytest.importorskip("resource")
    script = f"""
import resource, signal, pandas as pd
from pathlib import Path
from fctd.store.tables import write_table
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


def test_the_rows_of_a_part_of_a_table_have_no_numbers_of_their_own(tmp_path: Path) -> None:
    write_table(TABLE[1:], tmp_path / "part.parquet", {})
    assert pq.read_schema(tmp_path / "part.parquet").names == list(TABLE.columns)
