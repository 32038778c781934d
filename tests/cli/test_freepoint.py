"""``fctd freepoint``: readings in words, the table, exit codes and refusals."""

from pathlib import Path

import pandas as pd
import pytest

from tests.commands import Command

WELL = Path(__file__).parents[2] / "examples" / "my_well.toml"
GUIDE = WELL.parents[1] / "docs" / "stuck.md"


def test_both_readings_and_the_numbers_of_the_guide(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "free.csv"
    said = cli("freepoint", WELL, "--pull", "200 kN", "--stretch", "0.6 m", "--torque", "15 kN*m", "--turns", "4",
               "--out", out).out  # fmt: skip
    table = pd.read_csv(out)
    assert table["by"].tolist() == ["stretch", "twist"]
    for name in ("free_point_md_m", "straight_md_m"):
        for depth in table[name]:
            assert f"{depth:.0f} m" in said
        assert f"{table[name].iloc[0]:.0f} m" in GUIDE.read_text(encoding="utf-8")
    assert "stretch: 0.6 m by 200 kN more than 932 kN, bit at 3000 m" in said
    assert "twist: 4 turns by 15 kN·m more than 0 kN·m" in said


def test_field_units_and_a_reading_of_no_depth(cli: Command) -> None:
    said = cli("freepoint", WELL, "--pull", "40 klbf", "--stretch", "60 in", "--units", "field", code=1).out
    assert "stretch: 5 ft by 40 klbf more than" in said
    assert "no free point: a string that is stuck at its bit moves less, by a factor of 2.37" in said


def test_quiet_prints_nothing(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "free.csv"
    assert cli("freepoint", WELL, "--pull", "200 kN", "--stretch", "0.6 m", "--out", out, "--quiet").out == ""
    assert len(pd.read_csv(out)) == 1


def test_another_first_reading(cli: Command) -> None:
    said = cli("freepoint", WELL, "--pull", "200 kN", "--stretch", "0.6 m", "--first-hookload", "1000 kN").out
    assert "0.6 m by 200 kN more than 1000 kN" in said


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ([], "--pull is missing: expected pull and stretch, or torque and turns"),
        (["--pull", "100 kN"], "--stretch is missing: expected pull and stretch together"),
        (["--pull", "100 m", "--stretch", "1 m"], '--pull = "100 m": expected a force'),
        (["--pull", "100", "--stretch", "1 m"], '--pull = "100": expected a force with its unit'),
        (["--pull", "0 kN", "--stretch", "1 m"], "--pull = 0.0: expected a force above 0"),
        (["--torque", "1 kN*m", "--turns", "-2"], "--turns = -2.0: expected a number of turns above 0"),
        (["--pull", "1 kN", "--stretch", "1 m", "--bit-depth", "4 km"], "--bit-depth"),
        (["--pull", "1 kN", "--stretch", "1 m", "--out", "x.png"], "--out"),
    ],
)
def test_wrong_readings_are_refused_in_a_line(cli: Command, options: list[str], told: str) -> None:
    said = cli("freepoint", WELL, *options, code=2).err
    assert told in said
    assert "Traceback" not in said
