"""The steady commands as a user meets them: tables, units, statuses, messages, exit codes."""

import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

import fctd
from tests.cli.tiny import CASE, FOOT, LBF, SOFT_BELOW, settings
from tests.commands import Command

CHART_COLUMNS = [
    "operation", "friction", "rotational_friction", "friction_label", "bit_depth_m", "speed_m_s", "rpm", "flow_m3_s",
    "weight_on_bit_N", "hookload_N", "surface_torque_N_m", "weight_indicator_N",
    "drive_torque_N_m", "total_contact_force_N", "buckling", "buckled_from_md_m", "buckled_to_md_m", "shape",
    "hookload_low_N", "hookload_high_N", "slack_off_spent_at", "locked_up_at", "status", "iterations", "notes",
    "reason",
]  # fmt: skip


@pytest.mark.slow
def test_a_chart_reads_its_survey_once(tmp_path: Path, cli: Command) -> None:
    """Whatever the number of operations and friction factors, and with pictures and tables."""
    survey, case_file = tmp_path / "survey.csv", tmp_path / "tiny.toml"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n100,0,0\n550,90,0\n900,90,0\n")
    stations = "stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]"
    case_file.write_text(CASE.replace(stations, 'survey = "survey.csv"'))
    reads, listening = 0, True

    def count(event: str, arguments: tuple[Any, ...]) -> None:  # stays in the process, and ends with this test
        nonlocal reads
        reads += listening and event == "open" and arguments[0] == str(survey)

    sys.addaudithook(count)
    kinds = ["trip_in", "rotate_off_bottom"]
    case = fctd.load_case(case_file)
    fctd.torque_drag(case, kinds, [600, 700], [0.1, 0.3])
    fctd.equilibrium(case, "trip_in", 700)
    assert reads == 1
    cli(
        "chart", case_file, *(word for kind in kinds for word in ("--operation", kind)),
        "--depths", "600:700:50", "--friction", "0.1", "--friction", "0.3", "--out", tmp_path / "chart.csv",
        "--plot-profile", tmp_path / "profile.svg", "--quiet",
    )  # fmt: skip
    assert reads == 2
    listening = False
    assert (tmp_path / "profile.svg").is_file()


def test_a_chart_is_the_one_of_the_library_with_its_origin_beside_it(
    case_file: Path, tmp_path: Path, cli: Command
) -> None:
    out = tmp_path / "new" / "chart.csv"
    given = ("--operation", "trip_in, rotate_off_bottom", "--operation", "trip_in")
    factors = ("--friction", "0.1", "--friction", "0.3")
    said = cli("chart", case_file, *given, *factors, "--depths", "700:850:50", "--rpm", "80", "--out", out).out
    assert "16 rows: 16 converged\n" in said
    assert said.splitlines()[:2] == ["tiny", "mud none (air); slacking off 0.3 m/s; rotating off bottom 80 rev/min"]
    table = pd.read_csv(out, dtype={"friction_label": str})
    assert list(table.columns) == CHART_COLUMNS
    kinds, depths = ["trip_in", "rotate_off_bottom"], [700, 750, 800, 850]
    expected = fctd.torque_drag(fctd.load_case(case_file), kinds, depths, [0.1, 0.3], rpm=80)
    pd.testing.assert_frame_equal(table, expected, check_dtype=False)
    origin = json.loads((tmp_path / "new" / "chart.csv.json").read_text())
    assert origin["case"]["name"] == "tiny"
    assert origin["rates"] == {
        "trip_in": {"speed_m_s": 0.3, "spin_rad_s": 0.0, "flow_m3_s": 0.0},
        "rotate_off_bottom": {"speed_m_s": 0.0, "spin_rad_s": pytest.approx(80 * np.pi / 30), "flow_m3_s": 0.0},
    }
    assert {"fctd", "numpy", "numba", "python"} <= origin["versions"].keys()


def test_a_pair_of_friction_factors(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "chart.csv"
    given = ("--operation", "trip_out", "--depths", "800:850:50", "--friction", "0.1,0.3/0.1")
    assert "0.3/0.1" in cli("chart", case_file, *given, "--out", out, "--plot", tmp_path / "chart.png").out
    table = pd.read_csv(out, dtype={"friction_label": str})
    assert table[["friction", "rotational_friction"]].to_numpy().tolist() == [
        [0.1, 0.1],
        [0.1, 0.1],
        [0.3, 0.1],
        [0.3, 0.1],
    ]
    expected = fctd.torque_drag(fctd.load_case(case_file), "trip_out", [800, 850], [0.1, "0.3/0.1"])
    pd.testing.assert_frame_equal(table, expected, check_dtype=False)
    point = fctd.equilibrium(fctd.load_case(case_file, {"friction": "0.3/0.1"}), "trip_out", 850)
    assert point.hookload == table["hookload_N"].iloc[3]


def test_the_screen_says_how_many_rows_it_leaves_out(case_file: Path, cli: Command) -> None:
    printed = cli("chart", case_file, "--operation", "trip_in", "--depths", "600:636:1").out
    assert "37 rows: 37 converged; 36 of them above, all of them in a file by --out" in printed
    assert "636.0" in printed


def test_field_units_in_columns_and_names(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "chart.parquet"
    screen = cli(
        "chart", case_file, "--operation", "all", "--depths", "2000 ft:2600 ft:300 ft",
        "--units", "field", "--out", out, "--quiet",
    ).out  # fmt: skip
    assert "klbf" in screen
    assert "2600.0" in screen
    table = pd.read_parquet(out)
    si = fctd.torque_drag(fctd.load_case(case_file), list(table["operation"].unique()), [609.6, 701.04, 792.48])
    assert table["bit_depth_ft"].tolist() == [2000, 2300, 2600] * 7
    for field, column, factor in (
        ("hookload_klbf", "hookload_N", 1000 * LBF),
        ("total_contact_force_klbf", "total_contact_force_N", 1000 * LBF),
        ("surface_torque_kft_lbf", "surface_torque_N_m", 1000 * FOOT * LBF),
    ):
        np.testing.assert_allclose(table[field] * factor, si[column], rtol=1e-12, atol=1e-12)
    assert not [name for name in table.columns if name.endswith(("_N", "_m"))]
    metadata = pq.read_schema(out).metadata
    assert metadata[b"units"] == b"field"
    assert json.loads(metadata[b"case"])["name"] == "tiny"


def test_a_row_without_an_answer_shows_in_row_screen_and_exit_code(
    case_file: Path, tmp_path: Path, cli: Command
) -> None:
    out, picture = tmp_path / "chart.csv", tmp_path / "chart.svg"
    screen, errors = cli(
        "chart", case_file, "--operation", "trip_out", "--depths", "500:800:150",
        *settings(SOFT_BELOW), "--out", out, "--plot", picture, code=1,
    )  # fmt: skip
    assert "diverged" in screen
    assert "trip_out: diverged at 650 to 800 m (2 of 3)" in errors
    table = pd.read_csv(out)
    assert table["status"].tolist() == ["converged", "diverged", "diverged"]
    assert table["hookload_N"].isna().tolist() == [False, True, True]
    assert picture.exists()


def test_a_chart_goes_on_below_the_hole(case_file: Path, tmp_path: Path, cli: Command) -> None:
    """Depths at which string and hole do not fit have rows of their own; the profile is that of the last that does."""
    out, pictures = tmp_path / "chart.csv", [tmp_path / "chart.svg", tmp_path / "profile.svg"]
    screen = cli(
        "chart", case_file, "--operation", "trip_out", "--depths", "800:1000:100", "--out", out,
        "--plot", pictures[0], "--plot-profile", pictures[1], code=1,
    ).out  # fmt: skip
    assert "not_possible" in screen
    table = pd.read_csv(out)
    assert table["status"].tolist() == ["converged", "converged", "not_possible"]
    assert table["hookload_N"].isna().tolist() == [False, False, True]
    assert table["reason"].str.contains("within survey").tolist() == [False, False, True]
    assert all(picture.exists() for picture in pictures)


@pytest.mark.slow
def test_a_warning_is_on_screen_once_in_the_files_and_on_the_picture(
    case_file: Path, tmp_path: Path, cli: Command
) -> None:
    files = {"--out": tmp_path / "chart.csv", "--plot": tmp_path / "chart.svg", "--plot-profile": tmp_path / "p.svg"}
    chart = ("chart", case_file, "--operation", "trip_in", "--depths", "500:800:300", "--quiet")
    given = (*chart, *(part for pair in files.items() for part in pair), "--set", "mud.density=10.4")
    assert cli(*given).err.count("warning: ") == 1
    (kept,) = json.loads((tmp_path / "chart.csv.json").read_text())["warnings"]
    assert (kept["code"], kept["key"]) == ("mud_density", "mud.density")
    for name in ("chart.svg", "p.svg"):
        assert "<!-- warning mud.density: a mud of 10.4 kg/m^3" in (tmp_path / name).read_text()

    for file in tmp_path.glob("*.svg"):
        file.unlink()
    cli(*given, "--strict", code=1)
    assert not list(tmp_path.glob("*.svg"))


@pytest.mark.parametrize("units", ["si", "field"])
def test_factors_that_differ_along_the_hole_leave_the_table_its_width(
    units: str, case_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """On a terminal of 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")
    intervals = "[{to_md = 600, diameter = 0.3, friction = 0.1}, {to_md = 900, diameter = 0.2159, friction = 0.25}]"
    given = ("chart", case_file, "--operation", "trip_out", *settings(f"wellbore.intervals={intervals}"))
    printed = cli(*given, "--depths", "td:td:1", "--quiet", "--units", units).out
    shoe = "600 m" if units == "si" else "1969 ft"
    assert f"to {shoe}, 0.25" in printed
    assert re.search(r"^ trip_out +[\d.]+( +-?[\d.]+){3} .*converged", printed, re.MULTILINE)


def test_friction_by_kind_is_a_line_of_its_own(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out = tmp_path / "chart.csv"
    intervals = (
        'wellbore.intervals=[{to_md = 600, diameter = 0.3, friction = 0.1, kind = "cased"},'
        '{to_md = 900, diameter = 0.2159, friction = 0.1, kind = "open"}]'
    )
    assert "cased 0.20, open 0.30" in cli(
        "chart", case_file, "--operation", "trip_out", "--depths", "800:800:1", "--quiet", "--out", out,
        "--friction", "cased=0.2,open=0.3", "--friction", "0.2,0.3", *settings(intervals),
    ).out  # fmt: skip
    table = pd.read_csv(out).set_index("friction_label")["hookload_N"]
    assert table["0.2"] < table["cased 0.20, open 0.30"] < table["0.3"]


@pytest.mark.slow
def test_rates_go_to_the_operations_that_have_them(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out, picture = tmp_path / "chart.csv", tmp_path / "profiles.svg"
    rates = ("--speed", "0.7 m/s", "--rpm", "80", "--plot-profile", picture)
    chart = (
        "chart",
        case_file,
        "--operation",
        "rotate_off_bottom,drill_sliding",
        "--depths",
        "800",
        "--out",
        out,
        "--quiet",
    )
    cli(*chart, *rates)
    found = json.loads((tmp_path / "chart.csv.json").read_text())["rates"]
    speeds = {kind: abs(rate["speed_m_s"]) for kind, rate in found.items()}
    spins = {kind: rate["spin_rad_s"] for kind, rate in found.items()}
    assert speeds == {"rotate_off_bottom": 0.0, "drill_sliding": 0.7}
    assert spins == pytest.approx({"rotate_off_bottom": 80 * np.pi / 30, "drill_sliding": 0.0})
    assert picture.exists()


def test_measured_rows_that_the_picture_does_not_show_are_told(
    case_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.chdir(case_file.parent)
    rows = "bit_depth_m,operation,hookload_kN\n700,trip_in,90\n700,trip_out,100\n800,rotate_off_bottom,95\n"
    Path("rows.csv").write_text(rows, encoding="utf-8")
    options = ["--operation", "trip_out", "--depths", "700:800:100", "--measured", "rows.csv", "--plot", "a.png"]
    errors = " ".join(cli("chart", case_file, *options).err.split())
    assert "2 of 3 measured rows are not drawn, of operations that are not asked for: trip_in, rotate" in errors
    before = Path("rows.csv").read_bytes()
    cli("chart", case_file, *options, "--out", "rows.csv", code=2)
    assert Path("rows.csv").read_bytes() == before
