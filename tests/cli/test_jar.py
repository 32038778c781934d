"""``fctd jar``: the table on the screen and in a file, exit codes and refusals."""

from pathlib import Path

import pandas as pd
import pytest

from tests.commands import Command

WELL = Path(__file__).parents[2] / "examples" / "my_well.toml"
STUCK = ("jar", WELL, "--stuck-at", "2950 m")


def test_forces_and_hook_loads(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "jar.csv"
    asked = ("--up", "200 kN,400 kN", "--down", "100 kN", "--hookload", "1100 kN", "--set", "rig.hoist_capacity=2 MN")
    said = cli(*STUCK, "--jar", "heavy-weight pipe", *asked, "--out", out).out
    table = pd.read_csv(out)
    assert table["direction"].tolist() == ["up", "up", "down", "up"]
    assert table["force_at_jar_N"].to_numpy()[:3] == pytest.approx([2e5, 4e5, -1e5], abs=10.0)
    for load in table["hookload_N"]:
        assert f"{load / 1e3:.1f}" in said
    assert max(map(len, said.split("a force")[0].splitlines())) < 80


def test_a_share_above_one_fails_only_where_strict(cli: Command) -> None:
    weak = (*STUCK, "--jar", "2800 m", "--up", "400 kN", "--set", "rig.hoist_capacity=1 MN")
    cli(*weak)
    assert "(hoist)" in cli(*weak, "--strict", code=1).err
