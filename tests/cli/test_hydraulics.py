"""``fctd hydraulics``: tables on the screen and in files, field units, pictures, refusals."""

from pathlib import Path

import pandas as pd
import pytest

from fctd.cli.options import screen
from tests.commands import Command

WELL = Path(__file__).parents[2] / "examples" / "pumped_well.toml"


@pytest.fixture(autouse=True)
def wide(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 110)


def test_parts_stand_on_the_screen_and_in_a_file(cli: Command, tmp_path: Path) -> None:
    """What all parts lose is the standpipe pressure that the line above says."""
    out = tmp_path / "parts.csv"
    said = cli("hydraulics", WELL, "--penetration", "20 m/h", "--parts", out)
    rows = pd.read_csv(out)
    total = rows["pressure_drop_Pa"].sum() / 1e5
    assert f"{total:.4g} bar" in said.out
    assert {"surface", "bore", "tool", "bit", "annulus"} == set(rows["part"])
    for words in ("flow curve of the mud", "tool MWD", "laminar", "% of the standpipe pressure", "hook load less by"):
        assert words in said.out


def test_depths_and_flows_in_field_units(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "losses.parquet"
    asked = ("--flow", "400 gpm,500 gpm", "--depths", "shoe:td:1000", "--units", "field", "--out", out)
    said = cli("hydraulics", WELL, *asked)
    rows = pd.read_parquet(out)
    assert rows["flow_gpm"].unique() == pytest.approx([400, 500])
    assert {"standpipe_psi", "ecd_bit_ppg", "bit_power_hp", "jet_speed_ft_s"} <= set(rows)
    assert "400 gpm" in said.out
    assert f"{rows['standpipe_psi'].iloc[0]:.0f}" in said.out


@pytest.mark.slow
@pytest.mark.parametrize(("depths", "suffix"), [("td", "html"), ("shoe:td:500", "png")])
def test_pictures(cli: Command, tmp_path: Path, depths: str, suffix: str) -> None:
    picture = tmp_path / f"flow.{suffix}"
    cli("hydraulics", WELL, "--depths", depths, "--plot", picture)
    assert picture.stat().st_size > 10_000


def test_the_names_of_a_case_are_no_formulas(cli: Command, tmp_path: Path) -> None:
    parts = tmp_path / "parts.csv"
    cli("hydraulics", WELL, "--set", 'string.components[0].name="=1+1"', "--parts", parts)
    assert {"'=1+1"} == {name for name in pd.read_csv(parts)["name"].dropna() if "=" in name}


def test_two_tables_are_two_files(cli: Command, tmp_path: Path) -> None:
    one = tmp_path / "t.csv"
    for command, other in (("hydraulics", "--parts"), ("surge", "--trips")):
        assert "a file of its own for each table" in cli(command, WELL, "--out", one, other, one, code=2).err
    assert not one.exists()
