"""``fctd simulate``: tables with metadata, and what its results never replace."""

import json
import os
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from fctd import open_result
from fctd.case.load import Case
from fctd.cli import simulate
from fctd.results.tables import TABLES, SimulationResult
from fctd.simulation.simulate import Simulation
from tests.cli.tiny import SMALL
from tests.commands import Command
from tests.left_over import left_folders


def test_simulate_writes_tables_with_metadata(small_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "out"
    printed = cli("simulate", small_file, "--out", out, "--csv", "--quiet", "--friction", "0.3").out
    assert "small: rotate_off_bottom" in printed
    assert "32 segments" in printed
    assert "mean ± swing" in printed
    for name in TABLES:
        table = pd.read_parquet(out / f"{name}.parquet")
        assert len(table) > 3 or name == "operations"
        pd.testing.assert_frame_equal(table, pd.read_csv(out / f"{name}.csv"), check_dtype=False)
    metadata = pq.read_schema(out / "history.parquet").metadata
    assert json.loads(metadata[b"case"])["wellbore"]["intervals"][0]["friction"] == 0.3
    assert {"fctd", "numpy", "numba", "python"} <= json.loads(metadata[b"versions"]).keys()
    assert json.loads(metadata[b"run"])["segments"] == 32
    assert metadata[b"status"] == b"completed"


def test_simulate_in_field_units(small_file: Path, tmp_path: Path, cli: Command) -> None:
    """Screen and CSV files are in field units, what ``open_result`` reads is SI."""
    out = tmp_path / "out"
    printed = cli("simulate", small_file, "--out", out, "--csv", "--quiet", "--units", "field").out
    assert "2624.7 ft" in printed
    assert "klbf" in printed
    history, table = open_result(out).history, pd.read_csv(out / "history.csv")
    np.testing.assert_allclose(table["bit_depth_ft"], history["bit_depth_m"] / 0.3048)
    np.testing.assert_allclose(table["hookload_klbf"], history["hookload_N"] / 4448.2216152605)
    assert "hookload_N" not in table


def test_a_run_without_work_has_no_energy_error(
    small_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """Interrupted before the first record, the run has turned over no energy, and took no time."""

    def interrupted(case: Case, **_: object) -> SimulationResult:
        return Simulation(case).result()

    monkeypatch.setattr(simulate, "simulate", interrupted)
    printed = cli("simulate", small_file, "--out", tmp_path / "out", "--quiet", code=130).out
    assert "32 segments" in printed
    assert "nan" not in printed


def test_an_unfinished_run_is_exit_code_1_and_keeps_its_rows(small_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "out"
    push = (
        "operations=[{kind = 'trip_in', from_md = 800, to_md = 880, speed = 2.0, ramp_time = 2}]",
        "wellbore.intervals[0].friction=3.0",
        "string.components[0].length=",
        "wellbore.stiffness=2e5",
        "record.interval=0.2",
    )
    changes = [part for change in push for part in ("--set", change)]
    assert "unstable: at" in cli("simulate", small_file, *changes, "--out", out, "--quiet", code=1).err
    assert len(pd.read_parquet(out / "history.parquet")) > 0


def test_results_never_take_the_place_of_the_survey(small_file: Path, tmp_path: Path, cli: Command) -> None:
    survey = tmp_path / "history.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n1000,0,0\n")
    read = ("--set", "wellbore.stations=", "--set", f"wellbore.survey={survey}")
    assert (
        f'--out = "{survey}"' in cli("simulate", small_file, *read, "--out", tmp_path, "--csv", "--quiet", code=2).err
    )
    assert "1000,0,0" in survey.read_text()


@pytest.mark.parametrize("name", ["energy.parquet", "profile.csv", "history.csv"])
def test_results_never_take_the_place_of_the_case(name: str, small_file: Path, cli: Command) -> None:
    out = small_file.with_name("out")
    out.mkdir()
    case = small_file.rename(out / name)
    assert f'--out = "{case}"' in cli("simulate", case, "--out", out, "--csv", "--quiet", code=2).err
    assert case.read_text() == SMALL


def test_a_case_in_its_own_result_folder_stays(small_file: Path, cli: Command) -> None:
    """Also where a run was killed between its two renames, with the case in neither place."""
    out = small_file.with_name("out")
    out.mkdir()
    case = small_file.rename(out / "energy.toml")
    cli("simulate", case, "--out", out, "--csv", "--quiet")
    first = open_result(out)
    new, old = left_folders(out)
    out.rename(old)
    first.save(new)
    cli("simulate", case, "--out", out, "--quiet")
    assert case.read_text() == SMALL
    assert open_result(out).identity != first.identity
    assert {path.name for path in out.iterdir()} == {
        "energy.toml", "history.parquet", "profile.parquet", "energy.parquet", "operations.parquet",
        "segments.parquet",
    }  # fmt: skip
    assert [path.name for path in out.parent.iterdir()] == ["out"]


@pytest.mark.parametrize(
    ("out", "expected"),
    [
        (".", "a folder for the results alone, such as result"),
        ("x" * 250, "a folder that can be written (File name too long)"),
        ("small.toml", "a folder that can be written (this is a file)"),
        ("small.toml/out", "a folder that can be written"),
        ("taken", "a regular file that can be written, no folder, pipe or device"),
    ],
)
def test_a_folder_that_cannot_be_replaced_is_refused_before(
    out: str, expected: str, small_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.chdir(small_file.parent)
    monkeypatch.setattr(simulate, "simulate", lambda *_, **__: pytest.fail("the case was computed"))
    (small_file.parent / "taken").mkdir()
    os.mkfifo(small_file.parent / "taken" / "profile.parquet")
    message = cli("simulate", small_file.name, "--out", out, "--quiet", code=2).err
    assert message.startswith("--out = ")
    assert f"expected {expected}" in message


def test_a_picture_of_the_run(small_file: Path, tmp_path: Path, cli: Command) -> None:
    picture = tmp_path / "run.png"
    cli("simulate", small_file, "--out", tmp_path / "out", "--quiet", "--plot", picture)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_a_picture_of_another_kind_is_refused_before(
    small_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.setattr(simulate, "simulate", lambda *_, **__: pytest.fail("the case was computed"))
    assert "--plot" in cli("simulate", small_file, "--plot", "run.html", "--quiet", code=2).err
