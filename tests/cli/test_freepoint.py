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


def test_quiet_prints_nothing(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "free.csv"
    assert cli("freepoint", WELL, "--pull", "200 kN", "--stretch", "0.6 m", "--out", out, "--quiet").out == ""
    assert len(pd.read_csv(out)) == 1
