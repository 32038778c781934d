"""Input of a chart: what is refused in one message, and how depths are read."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.cli.chart import MOST_DEPTHS, read_depths
from tests.cli.test_main import run
from tests.cli.tiny import CHART, FOOT, POINT
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
