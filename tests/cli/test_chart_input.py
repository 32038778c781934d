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
        ("chart", {"--operation": "drill"}, ["operation", "drill"]),
        ("chart", {"--depths": "500:nan:10"}, ["--depths", "nan", "a length"]),
        ("chart", {"--load": "hook"}, ["--load", "hook", "indicator"]),
        ("chart", {"--side-force": "stand"}, ["--side-force", "stand", "joint"]),
        ("chart", {"--measured": "rows.csv", "--plot": "a.png"}, ["rows.csv", "can be read"]),
        ("chart", {"--plot": "tiny.toml/chart.png"}, ["--plot", "tiny.toml/chart.png", "can be written"]),
        ("chart", {"--out": 300 * "a" + ".csv"}, ["--out", 'aaa.csv": expected', "can be written"]),
        ("chart", {"--units": "miles"}, ["--units", "metric", "field"]),
        ("equilibrium", {"--bit-depth": "deep"}, ["--bit-depth", "deep", "a length"]),
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
