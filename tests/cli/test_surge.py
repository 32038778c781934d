"""``fctd surge``: tables on the screen and in files, pictures, refusals."""

import re
from pathlib import Path

import pandas as pd
import pytest

import fctd
from fctd.cli.options import screen
from tests.commands import Command

WELL = Path(__file__).parents[2] / "examples" / "pumped_well.toml"
GUIDE = WELL.parents[1] / "docs" / "hydraulics.md"


@pytest.fixture(autouse=True)
def wide(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 110)


def test_surges_and_the_fastest_trips(cli: Command, tmp_path: Path) -> None:
    """A closed end surges as it swabs; the time of the last row is that of the line."""
    out, trips = tmp_path / "surge.csv", tmp_path / "trips.csv"
    said = cli("surge", WELL, "--end", "closed", "--depths", "shoe:td:500", "--out", out, "--trips", trips)
    rows, fastest = pd.read_csv(out), pd.read_csv(trips)
    surge = rows.set_index(["operation", "bit_depth_m"])["surge_Pa"]
    assert surge["trip_in", 3000.0] == -surge["trip_out", 3000.0] > 0
    assert f"{surge['trip_in', 3000.0] / 1e5:.4g}" in said.out
    slow = fastest[fastest["operation"] == "trip_out"]
    assert slow["fastest_m_s"].is_monotonic_decreasing
    assert f"{slow['time_s'].iloc[-1] / 3600:.2f} h " in said.out


def test_the_guide_has_the_numbers_of_its_well() -> None:
    """Speeds of trips from the bottom, equivalent density, and the parts of the standpipe pressure."""
    guide, case = GUIDE.read_text(encoding="utf-8"), fctd.load_case(WELL)
    trips = fctd.fastest_trips(case, [3000.0], "trip_out", ["closed", "open"])["fastest_m_s"]
    lost = fctd.hydraulics_of(case, "2000 L/min").iloc[0]
    parts = [lost[f"{name}_drop_Pa"] for name in ("surface", "bore", "tool", "bit", "annulus")]
    for number in (*(f"{speed:.2f} m/s" for speed in trips), f"{lost['ecd_bit_kg_m3'] / 1e3:.3f} − 1.25"):
        assert number in guide
    table = guide[guide.index("| part | lost |") : guide.index("The annulus adds")]
    assert re.findall(r"([\d.]+) bar", table) == [f"{part / 1e5:.1f}" for part in parts]


def test_all_ends_in_field_units(cli: Command) -> None:
    asked = ("--end", "all", "--operation", "trip_in", "--speed", "90 ft/min", "--units", "field")
    said = cli("surge", WELL, *asked).out
    for words in ("trip_in, open end", "trip_in, closed end", "trip_in, float end", "psi", "ft/min", "ppg"):
        assert words in said
    assert "trip_out" not in said


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["png", "html"])
def test_pictures(cli: Command, tmp_path: Path, suffix: str) -> None:
    picture = tmp_path / f"surge.{suffix}"
    cli("surge", WELL, "--depths", "shoe:td:750", "--speed", "0.3 m/s,0.6 m/s", "--plot", picture)
    assert picture.stat().st_size > 10_000
