"""``fctd freepoint``: readings in words, the table, exit codes and refusals."""

from pathlib import Path

import pandas as pd

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
