"""``fctd wear``: rows on the screen and in files, pictures, exit codes and refusals."""

import json
from pathlib import Path

import pandas as pd
import pytest

from fctd.cli.options import screen
from tests.commands import Command

WELL = Path(__file__).parents[2] / "examples" / "my_well.toml"
CASED = ("wear", WELL, "--set", "wellbore.intervals[0].casing=9 5/8 in 47 N-80")
DRILLED = (*CASED, "--depths", "shoe:td:750", "--penetration", "20", "--rpm", "120")


def test_drilling_wears_the_casing_above(cli: Command, tmp_path: Path) -> None:
    out = tmp_path / "wear.csv"
    said = cli(*DRILLED, "--out", out, "--wear-factor", "5").out
    table = pd.read_csv(out)
    deepest = table.iloc[table["high_groove_m"].idxmax()]
    assert f"deepest groove at {deepest['md_m']:.0f} m, {1e3 * deepest['high_groove_m']:.3g} mm" in said
    assert f"{deepest['low_burst_Pa'] / 1e5:.0f} bar of 473.4 bar" in said
    about = json.loads(Path(f"{out}.json").read_text())
    assert (about["turns"], about["wear_factors"]) == (pytest.approx(540_000), [5.0, 5.0])


def test_field_units_and_a_range(cli: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 80)
    said = cli(*CASED, "--hours", "100", "--rpm", "60", "--units", "field", "--step", "100").out
    assert "360000 turns" in said
    assert all(word in said for word in ("klbf", "psi", "ft", " in"))
    assert max(map(len, said.split("turns")[0].splitlines()[2:])) <= 80


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["png", "html"])
def test_pictures(cli: Command, tmp_path: Path, suffix: str) -> None:
    picture = tmp_path / f"wear.{suffix}"
    cli(*DRILLED, "--plot", picture)
    assert picture.stat().st_size > 10_000


def test_a_wall_that_is_worn_through_fails_only_where_strict(cli: Command) -> None:
    worn = (*CASED, "--hours", "1e5", "--wear-factor", "1000")
    cli(*worn)
    assert "(worn_through)" in cli(*worn, "--strict", code=1).err
