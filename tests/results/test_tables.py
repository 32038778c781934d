"""Files of results: their names, formats and contents."""

import json
import platform
from importlib.metadata import version
from pathlib import Path

import numba
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd import SimulationResult
from fctd.results.tables import versions, write_table
from tests.cases import make_case, rotation

TABLE = pd.DataFrame({"time_s": [1.0, 2.5], "operation": ["trip_in", "trip_in"]})


@pytest.mark.parametrize("csv", [False, True])
def test_a_result_is_a_table_per_file_with_its_case(csv: bool, tmp_path: Path) -> None:
    case = make_case(operations=[rotation(1000, 1)])
    result = SimulationResult(case, "completed", "a word", TABLE, TABLE * 2, TABLE[:1], {"steps": 7, "step_s": 0.5})
    written = result.save(tmp_path, csv=csv)
    frames = {"history": TABLE, "profile": TABLE * 2, "energy": TABLE[:1]}
    suffixes = ("parquet", "csv") if csv else ("parquet",)
    assert written == [tmp_path / f"{name}.{suffix}" for name in frames for suffix in suffixes]
    assert sorted(written) == sorted(tmp_path.iterdir())
    for name, frame in frames.items():
        pd.testing.assert_frame_equal(pd.read_parquet(tmp_path / f"{name}.parquet"), frame)
        if csv:
            pd.testing.assert_frame_equal(pd.read_csv(tmp_path / f"{name}.csv"), frame)
        kept = pq.read_schema(tmp_path / f"{name}.parquet").metadata
        assert set(kept) == {
            b"pandas",
            b"case",
            b"status",
            b"message",
            b"run",
            b"versions",
            b"notes",
            b"identity",
            b"csv",
        }
        assert type(case).model_validate_json(kept[b"case"]) == case
        assert (kept[b"status"], kept[b"message"]) == (b"completed", b"a word")  # texts as they are
        assert json.loads(kept[b"run"]) == {"steps": 7, "step_s": 0.5}
        assert json.loads(kept[b"versions"]) == versions()


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


def test_versions_name_engine_language_and_libraries() -> None:
    found = versions()
    assert found.pop("commit", "0" * 7).isalnum()
    assert found == {
        "fctd": version("fctd"), "python": platform.python_version(), "numpy": np.__version__,
        "numba": numba.__version__,
    }  # fmt: skip
