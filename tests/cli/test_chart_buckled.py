"""Charts of strings that buckle, lock up or would leave their balance: row, screen, picture and exit code."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from tests.cli.tiny import FOOT, LEVEL, settings
from tests.commands import Command

# A string under compression that no wall holds.
UNHELD = ("wellbore.stations=[[0, 0, 0], [900, 0, 0]]", "contact.enabled=false", "bit.weight_on_bit=20 kN")


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
    cli: Command,
) -> None:
    """Locked up is an answer and done; a balance that would not last is not."""
    out, profile = tmp_path / "chart.csv", tmp_path / "profile.csv"
    chart = ("chart", case_file, "--operation", kind, "--depths", "800:800:10", "--out", out)
    assert f"{status} at 800" in cli(*chart, *settings(*changes), code=code).err
    assert np.isfinite(pd.read_csv(out)["hookload_N"]).all()
    point = ("equilibrium", case_file, "--operation", kind, "--bit-depth", "800", "--out", profile)
    assert f"{status}:" in cli(*point, *settings(*changes), code=code).err
    assert profile.exists()


@pytest.mark.slow
@pytest.mark.parametrize(("units", "foot"), [("si", 1.0), ("field", FOOT)])
def test_a_buckled_string_shows_in_row_screen_and_picture(
    units: str, foot: float, case_file: Path, tmp_path: Path, cli: Command,
) -> None:  # fmt: skip
    out, picture = tmp_path / "chart.csv", tmp_path / "chart.svg"
    screen = cli(
        "chart", case_file, "--operation", "drill_sliding", "--operation", "trip_out",
        "--depths", "800:800:1", *settings("bit.weight_on_bit=120 kN", "rig.block_weight=500 kN"), "--out", out,
        "--plot", picture, "--units", units, code=1,
    ).out  # fmt: skip
    table = pd.read_csv(out)
    unit = "m" if units == "si" else "ft"
    first, last = (table[f"buckled_{end}_md_{unit}"] for end in ("from", "to"))
    assert table["buckling"].tolist() == ["helical", "none"]
    assert 0 <= first[0] * foot < last[0] * foot <= 800
    assert np.isnan([first[1], last[1]]).all()
    assert "buckled" in screen
    assert "helical" in screen
    assert f"{first[0]:.0f}–{last[0]:.0f}" in screen
    assert picture.exists()


def test_a_buckled_string_is_resolved_where_that_is_asked_for(tmp_path: Path, cli: Command) -> None:
    case_file, out, picture = tmp_path / "level.toml", tmp_path / "chart.csv", tmp_path / "chart.svg"
    case_file.write_text(LEVEL)
    chart = ("chart", case_file, "--operation", "drill_sliding", "--depths", "150:150:1", "--out", out, "--quiet")
    cli(*chart, code=1)
    assert pd.read_csv(out)["status"].tolist() == ["under_resolved"]
    cli(*chart, "--resolve-buckling", "--plot", picture)
    (row,) = pd.read_csv(out).to_dict("records")
    assert (row["status"], row["shape"]) == ("converged", "helix")
    assert row["hookload_low_N"] < row["hookload_high_N"]
    assert json.loads((tmp_path / "chart.csv.json").read_text())["case"]["solver"]["buckling"] == "resolve"
    assert picture.exists()
    asked = (*chart, "--set", "solver.buckling=resolve")
    cli(*asked, "--no-resolve-buckling", code=1)
    assert pd.read_csv(out)["shape"].tolist() == ["none"]


@pytest.mark.slow
def test_a_string_that_no_push_moves_is_an_answer_without_loads(tmp_path: Path, cli: Command) -> None:
    case_file, out, picture = tmp_path / "level.toml", tmp_path / "chart.csv", tmp_path / "chart.svg"
    case_file.write_text(LEVEL)
    assert "locked_up at 80" in cli(
        "chart", case_file, "--operation", "drill_sliding", "--depths", "80:80:1", "--friction", "4",
        "--set", "rig.block_weight=350 kN", "--resolve-buckling", "--out", out, "--plot", picture, "--quiet",
    ).err  # fmt: skip
    (row,) = pd.read_csv(out).to_dict("records")
    assert np.isnan(row["hookload_N"])
    assert 0 < row["slack_off_spent_at"] < row["locked_up_at"] < 1
    assert picture.exists()
