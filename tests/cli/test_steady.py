"""Files of the steady commands: what cannot be written or would be lost is refused before computing."""

import os
import sys
from pathlib import Path
from unittest.mock import Mock

import pandas as pd
import pytest

from tests.cli.tiny import CHART, POINT, settings
from tests.commands import Command


def test_a_file_that_fails_to_be_written_is_one_message(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """The disk fills up after the target was looked at: the loads are on the screen, the file is the one before."""

    def full(frame: pd.DataFrame, path: Path, **_: object) -> None:
        path.write_text("half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(pd.DataFrame, "to_csv", full)
    out = tmp_path / "profile.csv"
    out.write_text("old")
    options = POINT | {"--out": str(out)}
    captured = cli("equilibrium", case_file, *(part for pair in options.items() for part in pair), code=2)
    assert "expected a file that can be written (No space left on device)" in captured.err
    assert "hook load" in captured.out
    assert out.read_text() == "old"


@pytest.mark.parametrize("command", ["chart", "equilibrium"])
def test_files_are_written_also_when_nobody_reads_the_screen(
    command: str, case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """``fctd chart … | head -1``: rich ends the program when its pipe is closed."""
    monkeypatch.setattr("fctd.cli.options.screen.print", Mock(side_effect=SystemExit(1)))
    options = (CHART if command == "chart" else POINT) | {"--out": str(tmp_path / "out.csv")}
    cli(command, case_file, *(part for pair in options.items() for part in pair), code=1)
    assert len(pd.read_csv(tmp_path / "out.csv")) > 0


@pytest.mark.parametrize("command", ["chart", "equilibrium"])
def test_the_survey_is_not_written_over(command: str, case_file: Path, tmp_path: Path, cli: Command) -> None:
    survey = tmp_path / "hole.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,0,0\n")
    options = (CHART if command == "chart" else POINT) | {"--out": str(tmp_path / "." / "hole.csv")}
    given = [*(part for pair in options.items() for part in pair), *settings("wellbore.stations=")]
    cli(command, case_file, *given, *settings(f"wellbore.survey={survey}"), code=2)
    assert survey.read_text().startswith("md_m")


@pytest.mark.parametrize("command", ["chart", "equilibrium"])
@pytest.mark.parametrize("option", ["--out", "--plot"])
def test_nor_by_a_side_file_or_a_picture(
    option: str, command: str, case_file: Path, tmp_path: Path, cli: Command,
) -> None:  # fmt: skip
    """``chart.csv.json`` goes beside ``chart.csv``."""
    survey = tmp_path / {"--out": "hole.csv.json", "--plot": "hole.png"}[option]
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,0,0\n")
    options = (CHART if command == "chart" else POINT) | {"--out": str(tmp_path / "hole.csv")}
    options |= {"--plot": str(tmp_path / "hole.png")} if option == "--plot" else {}
    given = [*(part for pair in options.items() for part in pair), *settings("wellbore.stations=")]
    assert (
        f'{option} = "{survey}"' in cli(command, case_file, *given, *settings(f"wellbore.survey={survey}"), code=2).err
    )
    assert survey.read_text().startswith("md_m")


@pytest.mark.parametrize("command", ["chart", "equilibrium"])
@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("x" * 248 + ".csv", "a file that can be written (File name too long)"),  # with the process beside it
        ("new/" + "x" * 248 + ".csv", "a file that can be written (File name too long)"),
        ("x" * 243 + ".csv", "a file that can be written (File name too long)"),  # the side file's
        ("pipe.csv", "a regular file that can be written, no folder, pipe or device"),
        ("device.csv", "a regular file that can be written, no folder, pipe or device"),
        ("taken.csv", "a regular file that can be written, no folder, pipe or device"),  # the side file
    ],
)
def test_a_target_that_cannot_be_written_is_refused_before(
    name: str, expected: str, command: str, case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    cli: Command,
) -> None:  # fmt: skip
    os.mkfifo(tmp_path / "pipe.csv")
    os.mkfifo(tmp_path / "taken.csv.json")
    (tmp_path / "device.csv").symlink_to("/dev/null")
    for compute in ("chart.chart_rows", "equilibrium.equilibrium"):
        monkeypatch.setattr(f"fctd.cli.{compute}", lambda *_, **__: pytest.fail("the case was computed"))
    options = (CHART if command == "chart" else POINT) | {"--out": str(tmp_path / name)}
    message = cli(command, case_file, *(part for pair in options.items() for part in pair), code=2).err
    assert message.startswith("--out = ")
    assert f"expected {expected}" in message


@pytest.mark.parametrize(
    ("option", "file", "package", "extra"),
    [
        ("--plot", "chart.png", "matplotlib", "fctd[plot]"),
        ("--plot", "chart.html", "plotly", "fctd[html]"),
        ("--out", "table.xlsx", "xlsxwriter", "fctd[excel]"),
    ],
)
@pytest.mark.parametrize("command", ["chart", "equilibrium"])
def test_without_its_package_a_file_is_refused_before_computing(
    option: str, file: str, package: str, extra: str, command: str, case_file: Path, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, cli: Command,
) -> None:  # fmt: skip
    monkeypatch.setitem(sys.modules, package, None)
    out = tmp_path / "chart.csv"
    options = (CHART if command == "chart" else POINT) | {"--out": str(out), option: str(tmp_path / file)}
    message = cli(command, case_file, *(part for pair in options.items() for part in pair), code=2).err
    assert package in message
    assert extra in message
    assert not list(tmp_path.glob("chart*"))


@pytest.mark.parametrize("command", ["chart", "equilibrium"])
def test_a_workbook_has_the_table_and_its_origin(command: str, case_file: Path, tmp_path: Path, cli: Command) -> None:
    import python_calamine as calamine

    out = tmp_path / "table.xlsx"
    options = (CHART if command == "chart" else POINT) | {"--out": str(out), "--units": "field"}
    cli(command, case_file, *(part for pair in options.items() for part in pair))
    book = calamine.CalamineWorkbook.from_path(out)
    headers, *rows = book.get_sheet_by_name("table").to_python()
    assert {"chart": "hook load (klbf)", "equilibrium": "effective tension (klbf)"}[command] in headers
    assert len(rows) > 1
    assert dict(book.get_sheet_by_name("about").to_python())["units"] == "field"
