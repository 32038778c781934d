"""Files of results: their names, formats and contents."""

import json
import os
import platform
import shutil
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numba
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

import fctd
from fctd import InputError, SimulationResult, open_result
from fctd.results import tables
from fctd.results.tables import check_result_folder, own_files, versions, write_table
from tests.cases import make_case, rotation

TABLE = pd.DataFrame({"time_s": [1.0, 2.5], "operation": ["trip_in", "trip_in"]})


@pytest.mark.parametrize("csv", [False, True])
def test_a_result_is_a_table_per_file_with_its_case(csv: bool, tmp_path: Path) -> None:
    case = make_case(operations=[rotation(1000, 1)])
    frames = {
        "history": TABLE, "profile": TABLE * 2, "energy": TABLE[:1], "operations": TABLE * 3, "segments": TABLE * 4,
    }  # fmt: skip
    result = SimulationResult(case, "completed", "a word", **frames, run={"steps": 7, "step_s": 0.5})
    written = result.save(tmp_path, csv=csv)
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
            b"warnings",
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
from fctd.results.tables import write_table
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


def test_a_result_names_the_survey_of_its_case(tmp_path: Path) -> None:
    survey = tmp_path / "survey.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n1000,0,0\n")
    case = make_case(wellbore={"stations": None, "survey": survey})
    SimulationResult(case, "completed", "", TABLE, TABLE, TABLE, {}).save(tmp_path / "out")
    assert open_result(tmp_path / "out").case.wellbore.survey == survey


def test_a_result_keeps_the_warnings_of_its_case(tmp_path: Path) -> None:
    case = make_case()
    SimulationResult(case, "completed", "", TABLE, TABLE, TABLE, {}, warnings=case.warnings).save(tmp_path)
    found = open_result(tmp_path)
    assert [warning.code for warning in found.warnings] == ["no_mud"]
    assert found.warnings == case.warnings
    assert found.case.warnings == ()  # the density of 0 is written out there


def test_a_result_is_opened_and_closed(tmp_path: Path) -> None:
    SimulationResult(make_case(), "completed", "", TABLE, TABLE, TABLE, {}).save(tmp_path)
    before = len(os.listdir("/dev/fd"))
    open_result(tmp_path)
    assert len(os.listdir("/dev/fd")) == before


def test_a_folder_without_a_whole_result_is_read_again_for_a_fifth_of_a_second(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pauses: list[float] = []
    monkeypatch.setattr(tables, "time", SimpleNamespace(sleep=pauses.append))
    with pytest.raises(InputError, match="a folder that fctd simulate wrote"):
        open_result(tmp_path / "out")
    assert sum(pauses) == pytest.approx(0.19)
    result = SimulationResult(make_case(), "completed", "", TABLE, TABLE, TABLE, {})
    monkeypatch.setattr(tables, "time", SimpleNamespace(sleep=lambda _: result.save(tmp_path / "out")))
    assert open_result(tmp_path / "out").identity == result.identity


def test_own_files_are_those_that_a_run_wrote(tmp_path: Path) -> None:
    """A CSV file alone is the user's; a damaged table is replaced."""
    (tmp_path / "profile.csv").write_text("my own")
    assert own_files(tmp_path) == set()
    (tmp_path / "history.parquet").write_text("damaged")
    assert own_files(tmp_path) == {"history.parquet"}


def test_a_folder_for_results_is_repaired_or_refused_before(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"--out = .*this is a file"):
        check_result_folder(tmp_path / "file", csv=False, key="--out")
    left = tmp_path / ".out-run-4194304"  # of a process that has ended
    left.mkdir()
    check_result_folder(tmp_path / "out", csv=False)
    assert not left.exists()
    (tmp_path / "out" / "energy.csv").mkdir(parents=True)
    check_result_folder(tmp_path / "out", csv=False)
    with pytest.raises(InputError, match=r"energy\.csv.*a regular file"):
        check_result_folder(tmp_path / "out", csv=True)


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_versions_name_the_commit_of_a_checkout_and_of_nothing_else() -> None:
    asked = ["git", "rev-parse", "--short", "HEAD"]
    done = subprocess.run(asked, cwd=Path(fctd.__file__).parent, capture_output=True, text=True)
    assert versions().get("commit", "") == done.stdout.strip()


def test_versions_name_engine_language_and_libraries() -> None:
    found = versions()
    found.pop("commit", None)
    assert found == {
        "fctd": version("fctd"), "python": platform.python_version(), "numpy": np.__version__,
        "numba": numba.__version__,
    }  # fmt: skip
