"""Tables as CSV and Parquet."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd.store.tables import to_csv, to_parquet


def test_rows_are_written_as_their_table(tmp_path: Path) -> None:
    """To the last character, also of a missing value, a text with a comma and numbers at the ends of the range."""
    rows: list[dict[str, Any]] = [
        {"depth_m": 0.1 + 0.2, "status": "converged", "iterations": 7, "reason": 'none, or "none"'},
        {"depth_m": float("nan"), "status": "unstable", "iterations": 0, "reason": "ä\nb"},
        {"depth_m": 1e22, "status": "converged", "iterations": 3, "reason": "none"},
        {"depth_m": np.float64(-1.5e-7), "status": "converged", "iterations": 3, "reason": ""},
        {"depth_m": -0.0, "status": "converged", "iterations": 3, "reason": " "},
    ]
    to_csv(rows, tmp_path / "rows.csv")
    to_csv(pd.DataFrame(rows), tmp_path / "table.csv")
    assert (tmp_path / "rows.csv").read_bytes() == (tmp_path / "table.csv").read_bytes()
    to_parquet(pd.DataFrame(rows), tmp_path / "rows.parquet", {})
    pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / "rows.parquet"), pd.DataFrame(rows))


def test_the_rows_of_a_part_of_a_table_have_no_numbers_of_their_own(tmp_path: Path) -> None:
    table = pd.DataFrame({"time_s": [1.0, 2.5], "operation": ["trip_in", "trip_in"]})
    to_parquet(table[1:], tmp_path / "part.parquet", {})
    assert pq.read_schema(tmp_path / "part.parquet").names == list(table.columns)


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("=cmd|' /C calc'!A0", "'=cmd|' /C calc'!A0"), ("+1+1", "'+1+1"), ("-1+1", "'-1+1"), ("@SUM(A1)", "'@SUM(A1)"),
        ("\t=1", "'\t'=1"), ("pipe;=1+1", "pipe;'=1+1"), ("-3.5", "-3.5"), ("5-inch pipe", "5-inch pipe"),
        ("9 5/8 = casing", "9 5/8 = casing"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("form", [pd.DataFrame, list])
def test_a_text_is_no_formula_of_a_spreadsheet(text: str, written: str, form: Any, tmp_path: Path) -> None:
    """Also behind what separates the columns of another language's Excel; numbers stay, with their signs."""
    rows = [{"part": text, "load_N": -3.5}]
    to_csv(form(rows), tmp_path / "t.csv")
    assert pd.read_csv(tmp_path / "t.csv", dtype={"part": str}).to_dict("records") == [
        {"part": written, "load_N": -3.5}
    ]
    assert rows == [{"part": text, "load_N": -3.5}]
