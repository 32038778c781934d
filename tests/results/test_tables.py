"""Files of results: their names, formats and contents."""

import json
import os
from pathlib import Path
from types import SimpleNamespace

import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd import InputError, SimulationResult, open_result
from fctd.results import tables
from fctd.results.tables import check_result_folder, own_files
from fctd.store.origin import versions
from tests.cases import make_case, rotation
from tests.left_over import left_folders

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
    left, _ = left_folders(tmp_path / "out")
    left.mkdir()
    check_result_folder(tmp_path / "out", csv=False)
    assert not left.exists()
    (tmp_path / "out" / "energy.csv").mkdir(parents=True)
    check_result_folder(tmp_path / "out", csv=False)
    with pytest.raises(InputError, match=r"energy\.csv.*a regular file"):
        check_result_folder(tmp_path / "out", csv=True)
