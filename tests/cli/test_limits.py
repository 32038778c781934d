"""``fctd limits``: the tables on the screen, the file, refusals, exit codes."""

import json
from pathlib import Path

import pandas as pd
import pytest

from fctd.cli.options import screen
from tests.commands import Command

WELL = """
name = "tiny"
[wellbore]
stations = [[0, 0, 0], [300, 0, 0], [700, 50, 30], [1000, 50, 30]]
[[wellbore.intervals]]
to_md = 1000
diameter = "8.5 in"
friction = 0.25
[string]
[[string.components]]
name = "pipe"
pipe = "5 in 19.5 S-135 NC50"
segment_length = "20 m"
[mud]
density = "1.2 sg"
[rig]
hoist_capacity = "900 kN"
largest_torque = "20 kN*m"
slip_length = "400 mm"
[limits]
design_factor = 1.2
overpull_margin = "2 MN"
"""


@pytest.fixture
def well(tmp_path: Path) -> Path:
    path = tmp_path / "well.toml"
    path.write_text(WELL)
    return path


def test_margins_stand_on_the_screen_and_in_a_file(cli: Command, well: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 100)
    out = well.with_suffix(".csv")
    said = cli("limits", well, "--out", out)
    for words in ("trip_out: pull on a stuck bit, kN", "hoist", "make up", "slack off", "weight in the slips"):
        assert words in said.out
    assert "turning bends the steel to and fro by ±" in said.out
    table = pd.read_csv(out)
    assert {"yield", "hoist", "make_up", "drive", "slips"} <= set(table["limit"])
    about = json.loads(Path(f"{out}.json").read_text())
    assert about["limits"]["hoist"] == "the hoist lifts no more"


def test_several_depths_and_field_units(cli: Command, well: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 100)
    said = cli("limits", well, "--operation", "trip_out", "--depths", "2000:3000:500", "--units", "field")
    assert "bit, klbf" in said.out
    assert [line.split()[1] for line in said.out.splitlines() if line.strip().startswith("yield")] == [
        "3000",
        "2500",
        "2000",
    ][::-1]


def test_a_string_beyond_its_limit_fails_only_where_strict(cli: Command, well: Path) -> None:
    weak = ("limits", well, "--operation", "trip_out", "--set", "rig.hoist_capacity=100 kN")
    cli(*weak)
    cli(*weak, "--strict", code=1)


def test_a_chart_draws_the_limits(cli: Command, well: Path) -> None:
    plot = well.with_suffix(".svg")
    cli("chart", well, "--operation", "trip_out", "--depths", "800:950:150", "--limits", "--plot", plot)
    assert all(f"limit: {name}" in plot.read_text() for name in ("yield", "hoist"))


@pytest.mark.slow
def test_stuck_pipe_is_loaded_at_its_stuck_point(cli: Command, well: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a straight hole what hangs below is missing there; the surface loads at the limit stay."""
    monkeypatch.setattr(screen, "_width", 100)
    out = well.with_suffix(".csv")
    said = cli("limits", well, "--stuck-at", "250 m", "--out", out)
    for words in (
        "trip_out: pull at the stuck point, kN",
        "at stuck point",
        "stuck at 250 m: what is left counts from",
    ):
        assert words in said.out
    assert "slips" not in said.out
    assert "bends the steel" not in said.out
    stuck = pd.read_csv(out).set_index("limit")
    cli("limits", well, "--out", out)
    whole = pd.read_csv(out).set_index("limit")
    assert stuck.loc["hoist", "hookload_left_N"] == pytest.approx(whole.loc["hoist", "hookload_left_N"], rel=1e-4)
    # The pipe above the stuck point weighs 250 m of 35 kg/m in mud of 1.2 sg.
    arrives = 900e3 - stuck.loc["hoist", "force_at_stuck_N"]
    assert arrives == pytest.approx(250 * 35.0 * 9.80665 * (1 - 1.2 / 7.85), rel=0.01)
