"""Input of a chart: what is refused in one message, and how depths are read."""

from pathlib import Path

import pytest

from tests.cli.tiny import CHART, POINT
from tests.commands import Command
from tests.plots.made import well

SHOD = well()


@pytest.mark.parametrize(
    ("command", "options", "expected"),
    [
        ("chart", {"--operation": "trip_inn"}, ["--operation", "trip_inn", "the kind trip_in"]),
        ("chart", {"--operation": "drill"}, ["operation", "drill"]),
        ("chart", {"--depths": "1000:1200:100"}, ["tiny.toml", '--depths = "1000 m"', "900 m"]),
        ("chart", {"--depths": "800:500:100"}, ["--depths", "800:500:100", "rise"]),
        ("chart", {"--depths": "500:800:0"}, ["--depths", "500:800:0", "STEP above 0"]),
        ("chart", {"--depths": "500:800:-10"}, ["--depths", "-10", "depths that rise"]),
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
        ("chart", {"--units": "miles"}, ["--units", "metric", "field"]),
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
    cli: Command,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder.csv").mkdir()
    before = sorted(tmp_path.rglob("*"))
    given = (CHART if command == "chart" else POINT) | options
    message = cli(command, case_file.name, *(part for pair in given.items() for part in pair), code=2).err
    assert "Traceback" not in message
    for part in expected:
        assert part in message
    assert sorted(tmp_path.rglob("*")) == before


def test_all_operations_do_not_hide_a_wrong_one(case_file: Path, cli: Command) -> None:
    kinds = ("--operation", "all", "--operation", "wiggle")
    assert "wiggle" in cli("chart", case_file, *kinds, "--depths", "500:800:100", code=2).err
