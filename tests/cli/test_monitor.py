"""``fctd monitor``: tables, alarms, growing files, refusals."""

from pathlib import Path

import pandas as pd
import pytest

from fctd.cli import monitor
from tests.commands import Command
from tests.monitoring.made import readings, series, shared_chart

# That of tests.monitoring.made, whose chart the tests share.
CASE = """
name = "inclined"
[wellbore]
stations = [[0, 0, 0], [200, 0, 0], [500, 60, 0], [1000, 60, 0]]
geometry = "arcs"
stiffness = "5e7 N/m"
[[wellbore.intervals]]
kind = "cased"
to_md = 600
diameter = 0.22
friction = 0.2
[[wellbore.intervals]]
kind = "open"
to_md = 1000
diameter = 0.2159
friction = 0.3
[[string.components]]
name = "pipe"
outer_diameter = "5 in"
inner_diameter = 0.1086
segment_length = "25 m"
[rig]
block_weight = "200 kN"
torque_offset = "500 N*m"
"""


@pytest.fixture
def case_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)
    path = tmp_path / "inclined.toml"
    path.write_text(CASE)
    return path


@pytest.fixture
def series_file(tmp_path: Path) -> Path:
    path = tmp_path / "series.csv"
    readings().to_csv(path, index=False)
    return path


@pytest.mark.slow
def test_a_table_a_picture_and_an_alarm(case_file: Path, series_file: Path, cli: Command) -> None:
    out, plot = case_file.with_name("found.csv"), case_file.with_name("found.png")
    printed = cli("monitor", case_file, series_file, "--out", out, "--plot", plot, "--units", "field").out
    assert printed.count("alarm: from 2") == 1  # of feet
    assert "friction factor of open hole" in printed
    table = pd.read_csv(out)
    assert len(table) == len(readings())
    assert table["bit_depth_ft"].iloc[0] == pytest.approx(readings()["bit_depth_m"].iloc[0] / 0.3048)
    assert plot.stat().st_size > 10_000


def test_strict_makes_an_alarm_an_error(case_file: Path, series_file: Path, cli: Command) -> None:
    cli("monitor", case_file, series_file, "--quiet", "--strict", code=1)


def test_without_a_factor_the_exit_code_is_1(case_file: Path, cli: Command) -> None:
    path = case_file.with_name("drilling.csv")
    series().head(50).to_csv(path, index=False)
    cli("monitor", case_file, path, code=1)


@pytest.mark.parametrize(
    ("text", "options", "expected"),
    [
        ("", [], "the file is empty"),
        ("a,b\n1,2\n", [], "a row of headers"),
        ("time_s,bit_depth_m\n0,1\n", [], "column block_position_m is missing"),
        ("bit_depth_m,operation,hook_load,torque_kN_m\n1,trip_in,2,3\n", [], "with its unit"),
        ("bit_depth_m,operation,hook_load_kN,torque_kN_m\n1,trip_in,2,x\n", [], 'row 2, torque_kN_m = "x"'),
        (None, ["--columns", "torque=TQ"], "one of the headers"),
        (None, ["--fit", "liner"], "liner"),
        (None, ["--step", "0"], "--step"),
        (None, ["--false-alarm-in", "0"], "--false-alarm-in"),
        (None, ["--uncertainty", "torque=x"], "--uncertainty"),
        (None, ["--poll", "0"], "--poll"),
        (None, ["--poll", "nan"], "--poll"),
        (None, ["--uncertainty", "torque=0%"], "--uncertainty torque"),
        (None, ["--plot", "found.html"], "--plot"),
    ],
)
def test_wrong_input_is_named(
    text: str | None, options: list[str], expected: str, case_file: Path, series_file: Path, cli: Command,
) -> None:  # fmt: skip
    if text is not None:
        series_file.write_text(text)
    message = cli("monitor", case_file, series_file, *options, code=2).err
    assert expected in message
    assert "Traceback" not in message


def test_the_series_is_not_overwritten(case_file: Path, series_file: Path, cli: Command) -> None:
    before = series_file.read_bytes()
    cli("monitor", case_file, series_file, "--out", series_file, code=2)
    assert series_file.read_bytes() == before


def test_a_growing_file_is_followed_until_ctrl_c(
    case_file: Path, series_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """The file grows by half a line more than a third at every look; the table is that of the whole file."""
    whole = series_file.read_text()
    parts = [whole[: len(whole) // 3], whole[len(whole) // 3 : 2 * len(whole) // 3], whole[2 * len(whole) // 3 :]]
    series_file.write_text("")

    def grow(seconds: float) -> None:
        if not parts:
            raise KeyboardInterrupt
        with series_file.open("a") as file:
            file.write(parts.pop(0))

    monkeypatch.setattr(monitor, "sleep", grow)
    followed, read = case_file.with_name("followed.csv"), case_file.with_name("read.csv")
    alarms = cli(
        "monitor", case_file, series_file, "--follow", "--out", followed, "--quiet", code=130
    ).out.splitlines()[0]
    assert cli("monitor", case_file, series_file, "--out", read, "--quiet").out.splitlines()[0] == alarms
    pd.testing.assert_frame_equal(pd.read_csv(followed), pd.read_csv(read))
    assert pd.read_csv(read)["friction"].notna().sum() > 30
