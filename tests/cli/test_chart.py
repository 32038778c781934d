"""The steady commands as a user meets them: tables, units, statuses, messages, exit codes."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

import fctd
from fctd.case.errors import InputError
from fctd.case.operations import KINDS
from fctd.cli.chart import MOST_DEPTHS, read_depths
from tests.cli.test_main import run
from tests.plots.made import well

CASE = """
name = "tiny"
[wellbore]
stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.2
[string]
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segment_length = "40 m"
[mud]
density = 0
"""
SHOD = well()
# Packages that a chart as CSV does without; each takes a tenth to half a second to import.
SPARED = {"pandas", "pyarrow", "pint", "matplotlib", "plotly"}
CHART_COLUMNS = [
    "operation", "friction", "friction_label", "bit_depth_m", "hookload_N", "surface_torque_N_m", "weight_indicator_N",
    "drive_torque_N_m", "total_contact_force_N", "buckling", "buckled_from_md_m", "buckled_to_md_m", "shape",
    "hookload_low_N", "hookload_high_N", "slack_off_spent_at", "locked_up_at", "status", "iterations", "notes",
    "reason",
]  # fmt: skip
# 5 inch pipe in a level hole, compressed to 2.6 times its sinusoidal limit.
LEVEL = """
name = "level"
[wellbore]
stations = [[0, 90, 0], [170, 90, 0]]
stiffness_per_length = 1e6
[[wellbore.intervals]]
to_md = "170 m"
diameter = "8.5 in"
friction = 0.5
[[string.components]]
name = "pipe"
outer_diameter = "127 mm"
inner_diameter = "108.6 mm"
segment_length = "10 m"
[mud]
density = "1200 kg/m^3"
[rig]
block_weight = "2 MN"
[bit]
weight_on_bit = "300 kN"
"""
# A pound-force and a foot in SI, exact by definition (NIST SP 811, appendix B.8).
LBF, FOOT = 4.4482216152605, 0.3048
# Below 600 m the wall is too soft to hold any string.
SOFT_BELOW = (
    "wellbore.intervals=[{to_md = 600, diameter = 0.2159, friction = 0.2},"
    "{to_md = 900, diameter = 0.2159, friction = 0.2, stiffness = 100}]"
)
# A string under compression that no wall holds.
UNHELD = ("wellbore.stations=[[0, 0, 0], [900, 0, 0]]", "contact.enabled=false", "bit.weight_on_bit=20 kN")


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    path = tmp_path / "tiny.toml"
    path.write_text(CASE)
    return path


def settings(*changes: str) -> list[str]:
    """The options that make these changes."""
    return [part for change in changes for part in ("--set", change)]


def test_a_chart_reads_its_survey_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the number of operations and friction factors, and with pictures and tables."""
    pytest.importorskip("matplotlib")
    survey, case_file = tmp_path / "survey.csv", tmp_path / "tiny.toml"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n100,0,0\n550,90,0\n900,90,0\n")
    stations = "stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]"
    case_file.write_text(CASE.replace(stations, 'survey = "survey.csv"'))
    reads, listening = 0, True

    def count(event: str, arguments: tuple[Any, ...]) -> None:  # stays in the process, and ends with this test
        nonlocal reads
        reads += listening and event == "open" and arguments[0] == str(survey)

    sys.addaudithook(count)
    kinds = ["trip_in", "trip_out", "rotate_off_bottom"]
    case = fctd.load_case(case_file)
    fctd.torque_drag(case, kinds, [600, 700], [0.1, 0.3])
    fctd.equilibrium(case, "trip_in", 700)
    assert reads == 1
    code = run(
        monkeypatch, "chart", case_file, *(word for kind in kinds for word in ("--operation", kind)),
        "--depths", "600:700:50", "--friction", "0.1", "--friction", "0.3", "--out", tmp_path / "chart.csv",
        "--plot-profile", tmp_path / "profile.svg", "--quiet",
    )  # fmt: skip
    assert code == 0
    assert reads == 2
    listening = False
    assert (tmp_path / "profile.svg").is_file()


def test_a_chart_is_the_one_of_the_library_with_its_origin_beside_it(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "new" / "chart.csv"
    given = ("--operation", "trip_in, rotate_off_bottom", "--operation", "trip_in")
    factors = ("--friction", "0.1", "--friction", "0.3")
    code = run(monkeypatch, "chart", case_file, *given, *factors, "--depths", "700:850:50", "--rpm", "80", "--out", out)
    assert code == 0
    assert "16 rows: 16 converged\n" in capsys.readouterr().out
    table = pd.read_csv(out, dtype={"friction_label": str})
    assert list(table.columns) == CHART_COLUMNS
    kinds, depths = ["trip_in", "rotate_off_bottom"], [700, 750, 800, 850]
    expected = fctd.torque_drag(fctd.load_case(case_file), kinds, depths, [0.1, 0.3], rpm=80)
    pd.testing.assert_frame_equal(table, expected, check_dtype=False)
    origin = json.loads((tmp_path / "new" / "chart.csv.json").read_text())
    assert origin["case"]["name"] == "tiny"
    assert origin["rates"]["trip_in"] == {"speed_m_s": 0.3, "spin_rad_s": pytest.approx(80 * np.pi / 30)}
    assert {"fctd", "numpy", "numba", "python"} <= origin["versions"].keys()


def test_the_screen_says_how_many_rows_it_leaves_out(
    case_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "chart", case_file, "--operation", "trip_in", "--depths", "600:636:1") == 0
    printed = capsys.readouterr().out
    assert "37 rows: 37 converged; 36 of them above, all of them in a file by --out" in printed
    assert "636.0" in printed


def test_field_units_in_columns_and_names(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "chart.parquet"
    code = run(
        monkeypatch, "chart", case_file, "--operation", "all", "--depths", "2000 ft:2600 ft:300 ft",
        "--units", "field", "--out", out, "--quiet",
    )  # fmt: skip
    assert code == 0
    screen = capsys.readouterr().out
    assert "klbf" in screen
    assert "2600.0" in screen
    table = pd.read_parquet(out)
    si = fctd.torque_drag(fctd.load_case(case_file), list(table["operation"].unique()), [609.6, 701.04, 792.48])
    assert table["bit_depth_ft"].tolist() == [2000, 2300, 2600] * 6
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
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    out, picture = tmp_path / "chart.csv", tmp_path / "chart.svg"
    code = run(
        monkeypatch, "chart", case_file, "--operation", "trip_out", "--depths", "500:800:150",
        *settings(SOFT_BELOW), "--out", out, "--plot", picture,
    )  # fmt: skip
    assert code == 1
    screen, errors = capsys.readouterr()
    assert "diverged" in screen
    assert "trip_out: diverged at 650 to 800 m (2 of 3)" in errors
    table = pd.read_csv(out)
    assert table["status"].tolist() == ["converged", "diverged", "diverged"]
    assert table["hookload_N"].isna().tolist() == [False, True, True]
    assert picture.exists()


def test_a_chart_goes_on_below_the_hole(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Depths at which string and hole do not fit have rows of their own; the profile is that of the last that does."""
    pytest.importorskip("matplotlib")
    out, pictures = tmp_path / "chart.csv", [tmp_path / "chart.svg", tmp_path / "profile.svg"]
    code = run(
        monkeypatch, "chart", case_file, "--operation", "trip_out", "--depths", "800:1000:100", "--out", out,
        "--plot", pictures[0], "--plot-profile", pictures[1],
    )  # fmt: skip
    assert code == 1
    screen, errors = capsys.readouterr()
    assert "not_possible" in screen
    assert 'trip_out: not_possible at 1000 m (1 of 3): bit_depth = "1000 m": expected a depth' in errors
    table = pd.read_csv(out)
    assert table["status"].tolist() == ["converged", "converged", "not_possible"]
    assert table["hookload_N"].isna().tolist() == [False, False, True]
    assert table["reason"].str.contains("within survey and intervals, 900 m").tolist() == [False, False, True]
    assert all(picture.exists() for picture in pictures)


def test_a_warning_is_on_screen_once_in_the_files_and_on_the_picture(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    files = {"--out": tmp_path / "chart.csv", "--plot": tmp_path / "chart.svg", "--plot-profile": tmp_path / "p.svg"}
    chart = ("chart", case_file, "--operation", "trip_in", "--depths", "500:800:300", "--quiet")
    given = (*chart, *(part for pair in files.items() for part in pair), "--set", "mud.density=10.4")
    assert run(monkeypatch, *given) == 0
    text = "a mud of 10.4 kg/m^3 (10.4 looks like '10.4 ppg'): write it with its unit; usual is 0.6 to 2.6 sg"
    assert capsys.readouterr().err == f"warning: {case_file}: mud.density: {text}\n"
    (kept,) = json.loads((tmp_path / "chart.csv.json").read_text())["warnings"]
    assert (kept["code"], kept["key"]) == ("mud_density", "mud.density")
    for name in ("chart.svg", "p.svg"):
        assert "<!-- warning mud.density: a mud of 10.4 kg/m^3" in (tmp_path / name).read_text()

    for file in tmp_path.glob("*.svg"):
        file.unlink()
    assert run(monkeypatch, *given, "--strict") == 1
    assert "strict: warnings are errors (mud_density); nothing is computed" in capsys.readouterr().err
    assert not list(tmp_path.glob("*.svg"))


@pytest.mark.parametrize("units", ["si", "field"])
def test_factors_that_differ_along_the_hole_leave_the_table_its_width(
    units: str, case_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On a terminal of 80 columns."""
    monkeypatch.setenv("COLUMNS", "80")
    intervals = "[{to_md = 600, diameter = 0.3, friction = 0.1}, {to_md = 900, diameter = 0.2159, friction = 0.25}]"
    given = ("chart", case_file, "--operation", "trip_out", *settings(f"wellbore.intervals={intervals}"))
    assert run(monkeypatch, *given, "--depths", "td:td:1", "--quiet", "--units", units) == 0
    printed = capsys.readouterr().out
    shoe = "600 m" if units == "si" else "1969 ft"
    assert f"; friction factors: case's own: 0.1 down to {shoe}, 0.25 below\n" in printed
    assert re.search(r"^ trip_out +[\d.]+( +-?[\d.]+){3} .*converged", printed, re.MULTILINE)


def test_friction_by_kind_is_a_line_of_its_own(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "chart.csv"
    intervals = (
        'wellbore.intervals=[{to_md = 600, diameter = 0.3, friction = 0.1, kind = "cased"},'
        '{to_md = 900, diameter = 0.2159, friction = 0.1, kind = "open"}]'
    )
    code = run(
        monkeypatch, "chart", case_file, "--operation", "trip_out", "--depths", "800:800:1", "--quiet", "--out", out,
        "--friction", "cased=0.2,open=0.3", "--friction", "0.2,0.3", *settings(intervals),
    )  # fmt: skip
    assert code == 0
    assert "cased 0.20, open 0.30" in capsys.readouterr().out
    table = pd.read_csv(out).set_index("friction_label")["hookload_N"]
    assert table["0.2"] < table["cased 0.20, open 0.30"] < table["0.3"]


@pytest.mark.parametrize(
    ("changes", "kind", "status", "code"),
    [
        (["wellbore.intervals[0].friction=0.6"], "trip_in", "locked_up", 0),
        (UNHELD, "drill_sliding", "unstable", 1),
        (["bit.weight_on_bit=120 kN", "rig.block_weight=500 kN"], "drill_sliding", "under_resolved", 1),
    ],
)
def test_exit_code_of_a_legal_answer(
    changes: list[str],
    kind: str,
    status: str,
    code: int,
    case_file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Locked up is an answer and done; a balance that would not last is not."""
    out, profile = tmp_path / "chart.csv", tmp_path / "profile.csv"
    chart = ("chart", case_file, "--operation", kind, "--depths", "800:800:10", "--out", out)
    assert run(monkeypatch, *chart, *settings(*changes)) == code
    assert f"{status} at 800 m (1 of 1)" in capsys.readouterr().err
    assert np.isfinite(pd.read_csv(out)["hookload_N"]).all()
    point = ("equilibrium", case_file, "--operation", kind, "--bit-depth", "800", "--out", profile)
    assert run(monkeypatch, *point, *settings(*changes)) == code
    assert f"{status}:" in capsys.readouterr().err
    assert profile.exists()


@pytest.mark.parametrize(("units", "foot"), [("si", 1.0), ("field", FOOT)])
def test_a_buckled_string_shows_in_row_screen_and_picture(
    units: str, foot: float, case_file: Path, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    pytest.importorskip("matplotlib")
    out, picture = tmp_path / "chart.csv", tmp_path / "chart.svg"
    code = run(
        monkeypatch, "chart", case_file, "--operation", "drill_sliding", "--operation", "trip_out",
        "--depths", "800:800:1", *settings("bit.weight_on_bit=120 kN", "rig.block_weight=500 kN"), "--out", out,
        "--plot", picture, "--units", units,
    )  # fmt: skip
    assert code == 1
    table = pd.read_csv(out)
    unit = "m" if units == "si" else "ft"
    first, last = (table[f"buckled_{end}_md_{unit}"] for end in ("from", "to"))
    assert table["buckling"].tolist() == ["helical", "none"]
    assert 0 <= first[0] * foot < last[0] * foot <= 800
    assert np.isnan([first[1], last[1]]).all()
    screen, errors = capsys.readouterr()
    assert "buckled" in screen
    assert "helical" in screen
    assert f"{first[0]:.0f}–{last[0]:.0f}" in screen
    assert "use segments of at most" in errors
    assert picture.exists()


def test_a_buckled_string_is_resolved_where_that_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    case_file, out, picture = tmp_path / "level.toml", tmp_path / "chart.csv", tmp_path / "chart.svg"
    case_file.write_text(LEVEL)
    chart = ("chart", case_file, "--operation", "drill_sliding", "--depths", "150:150:1", "--out", out, "--quiet")
    assert run(monkeypatch, *chart) == 1
    assert 'or solver.buckling = "resolve" (--resolve-buckling)' in capsys.readouterr().err
    assert pd.read_csv(out)["status"].tolist() == ["under_resolved"]
    assert run(monkeypatch, *chart, "--resolve-buckling", "--plot", picture) == 0
    (row,) = pd.read_csv(out).to_dict("records")
    assert (row["status"], row["shape"]) == ("converged", "helix")
    assert row["hookload_low_N"] < row["hookload_high_N"]
    assert json.loads((tmp_path / "chart.csv.json").read_text())["case"]["solver"]["buckling"] == "resolve"
    assert picture.exists()
    asked = (*chart, "--set", "solver.buckling=resolve")
    assert run(monkeypatch, *asked, "--no-resolve-buckling") == 1
    assert pd.read_csv(out)["shape"].tolist() == ["none"]


@pytest.mark.slow
def test_a_string_that_no_push_moves_is_an_answer_without_loads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    case_file, out, picture = tmp_path / "level.toml", tmp_path / "chart.csv", tmp_path / "chart.svg"
    case_file.write_text(LEVEL)
    code = run(
        monkeypatch, "chart", case_file, "--operation", "drill_sliding", "--depths", "80:80:1", "--friction", "4",
        "--set", "rig.block_weight=350 kN", "--resolve-buckling", "--out", out, "--plot", picture, "--quiet",
    )  # fmt: skip
    assert code == 0
    assert "locked_up at 80 m (1 of 1): slack-off is spent at" in capsys.readouterr().err
    (row,) = pd.read_csv(out).to_dict("records")
    assert np.isnan(row["hookload_N"])
    assert 0 < row["slack_off_spent_at"] < row["locked_up_at"] < 1
    assert picture.exists()


CHART = {"--operation": "trip_in", "--depths": "500:800:100", "--out": "chart.csv"}
POINT = {"--operation": "trip_in", "--bit-depth": "800 m", "--out": "profile.csv"}


@pytest.mark.parametrize(
    ("command", "options", "expected"),
    [
        ("chart", {"--operation": "trip_inn"}, ["--operation", "trip_inn", "the kind trip_in"]),
        ("chart", {"--operation": "drill"}, ["operation", "drill"]),
        ("chart", {"--depths": "1000:1200:100"}, ["tiny.toml", '--depths = "1000 m"', "900 m"]),
        ("chart", {"--depths": "800:500:100"}, ["--depths", "800:500:100", "rise"]),
        ("chart", {"--depths": "500:800:0"}, ["--depths", "500:800:0", "STEP above 0"]),
        ("chart", {"--depths": "500:800:-10"}, ["--depths", "-10", "a length"]),
        ("chart", {"--depths": "500:800"}, ["--depths", "500:800", "FROM:TO:STEP"]),
        ("chart", {"--depths": "shoe:td:100"}, ["--depths", "shoe:td:100", "one interval and no shoe"]),
        ("chart", {"--depths": "500:bottom:100"}, ["--depths", "bottom", "a length"]),
        ("chart", {"--depths": "500:800:td"}, ["--depths", "td", "a length"]),
        ("chart", {"--depths": "500:800 kg:10"}, ["--depths", "800 kg", "a length"]),
        ("chart", {"--depths": "500:nan:10"}, ["--depths", "nan", "a length"]),
        ("chart", {"--depths": "500:800:1e-9"}, ["--depths", "1e-9", "at most 10000 depths"]),
        ("chart", {"--friction": "-0.1"}, ["--friction", "-0.1", "at least 0"]),
        ("chart", {"--operation": "rotate_off_bottom", "--speed": "1"}, ["--speed = 1.0", "of 0 for rotate_off"]),
        ("chart", {"--speed": "3 kg"}, ["--speed", "3 kg", "a speed"]),
        ("chart", {"--rpm": "-5"}, ["--rpm", "-5", "a rotation"]),
        ("chart", {"--out": "chart.xls"}, ["--out", "chart.xls", ".csv or .parquet or .xlsx"]),
        ("chart", {"--plot": "chart.gif"}, ["--plot", "chart.gif", ".png or .svg or .pdf or .html"]),
        ("chart", {"--load": "hook"}, ["--load", "hook", "indicator"]),
        ("chart", {"--side-force": "stand"}, ["--side-force", "stand", "joint"]),
        ("chart", {"--measured": "rows.csv"}, ["--measured", "rows.csv", "--plot beside it"]),
        ("chart", {"--measured": "rows.csv", "--plot": "a.png"}, ["rows.csv", "can be read"]),
        ("chart", {"--plot-profile": "chart"}, ["--plot-profile", ".png or .svg"]),
        ("chart", {"--out": "tiny.toml/chart.csv"}, ["--out", "tiny.toml/chart.csv", "can be written"]),
        ("chart", {"--plot": "tiny.toml/chart.png"}, ["--plot", "tiny.toml/chart.png", "can be written"]),
        ("chart", {"--plot": "a.png", "--plot-profile": "./a.png"}, ["--plot-profile", "a.png", "of its own"]),
        ("chart", {"--out": 300 * "a" + ".csv"}, ["--out", 'aaa.csv": expected', "can be written"]),
        ("chart", {"--units": "metric"}, ["--units", "metric", "field"]),
        ("equilibrium", {"--operation": "rotate"}, ["--operation", "rotate", "kind"]),
        ("equilibrium", {"--bit-depth": "950 m"}, ["tiny.toml", "--bit-depth", "950 m", "900 m"]),
        ("equilibrium", {"--bit-depth": "deep"}, ["--bit-depth", "deep", "a length"]),
        ("equilibrium", {"--friction": "-0.1"}, ["--friction", "-0.1"]),
        ("equilibrium", {"--plot": "profile.gif"}, ["--plot", "profile.gif", ".png or .svg"]),
        ("equilibrium", {"--out": "folder.csv"}, ["--out", "folder.csv", "can be written"]),
    ],
)
def test_bad_input_is_one_message_and_exit_code_2(
    command: str,
    options: dict[str, str],
    expected: list[str],
    case_file: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.csv").mkdir()
    before = sorted(tmp_path.rglob("*"))
    given = (CHART if command == "chart" else POINT) | options
    code = run(monkeypatch, command, case_file.name, *(part for pair in given.items() for part in pair))
    assert code == 2
    message = capsys.readouterr().err
    assert "Traceback" not in message
    for part in expected:
        assert part in message
    assert sorted(tmp_path.rglob("*")) == before


def test_all_operations_do_not_hide_a_wrong_one(
    case_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    kinds = ("--operation", "all", "--operation", "wiggle")
    assert run(monkeypatch, "chart", case_file, *kinds, "--depths", "500:800:100") == 2
    assert "wiggle" in capsys.readouterr().err


def test_rates_go_to_the_operations_that_have_them(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    out, picture = tmp_path / "chart.csv", tmp_path / "profiles.svg"
    rates = ("--speed", "0.7 m/s", "--rpm", "80", "--plot-profile", picture)
    chart = ("chart", case_file, "--operation", "all", "--depths", "800:800:10", "--out", out, "--quiet")
    assert run(monkeypatch, *chart, *rates) == 0
    found = json.loads((tmp_path / "chart.csv.json").read_text())["rates"]
    speeds = {kind: abs(rate["speed_m_s"]) for kind, rate in found.items()}
    spins = {kind: rate["spin_rad_s"] for kind, rate in found.items()}
    assert speeds == {kind: 0.0 if kind == "rotate_off_bottom" else 0.7 for kind in KINDS}
    assert spins == pytest.approx({kind: 0.0 if kind == "drill_sliding" else 80 * np.pi / 30 for kind in KINDS})
    assert picture.exists()


@given(
    first=st.integers(1, 50_000), step=st.integers(1, 400), count=st.integers(0, 300), beyond=st.integers(0, 399),
    unit=st.sampled_from([("", 1.0), (" m", 1.0), (" ft", FOOT), (" cm", 0.01)]),
)  # fmt: skip
def test_depths_rise_from_first_to_last_in_equal_steps(
    first: int, step: int, count: int, beyond: int, unit: tuple[str, float]
) -> None:
    """The last step may be shorter: the end is always in."""
    name, metres = unit
    last = first + count * step + beyond % step
    depths = read_depths(f"{first}{name}:{last}{name}:{step}{name}", SHOD)
    expected = metres * np.unique(np.append(first + step * np.arange(count + 1), last))
    np.testing.assert_allclose(depths, expected, rtol=0, atol=1e-6)


def test_the_grid_has_a_limit() -> None:
    assert len(read_depths(f"1:{MOST_DEPTHS}:1", SHOD)) == MOST_DEPTHS
    with pytest.raises(InputError):
        read_depths(f"1:{MOST_DEPTHS + 1}:1", SHOD)


def test_words_stand_for_the_shoe_and_the_end_of_the_hole() -> None:
    """A shoe at 1,500 m in a hole of 2,000 m."""
    assert read_depths("shoe:td:200", SHOD) == [1500, 1700, 1900, 2000]
    assert read_depths("1400: shoe :100", SHOD) == [1400, 1500]
    assert read_depths("td:td:1", SHOD) == [2000]


def test_a_chart_as_csv_imports_no_package_that_it_does_not_use(tmp_path: Path) -> None:
    case_file, out = tmp_path / "tiny.toml", tmp_path / "chart.csv"
    case_file.write_text(CASE)
    command = ["chart", str(case_file), "--operation", "trip_in", "--depths", "500:600:50", "--out", str(out)]
    program = (
        f"import sys\nfrom fctd.cli.main import app\napp({command}, standalone_mode=False)\n"
        f"print(sorted({SPARED} & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
    assert len(pd.read_csv(out)) == 3


def test_measured_rows_that_the_picture_does_not_show_are_told(
    case_file: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("matplotlib")
    monkeypatch.chdir(case_file.parent)
    rows = "bit_depth_m,operation,hookload_kN\n700,trip_in,90\n700,trip_out,100\n800,rotate_off_bottom,95\n"
    Path("rows.csv").write_text(rows, encoding="utf-8")
    options = ["--operation", "trip_out", "--depths", "700:800:100", "--measured", "rows.csv", "--plot", "a.png"]
    assert run(monkeypatch, "chart", case_file, *options) == 0
    errors = " ".join(capsys.readouterr().err.split())
    assert "2 of 3 measured rows are not drawn, of operations that are not asked for: trip_in, rotate" in errors
