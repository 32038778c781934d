"""``fctd equilibrium``: loads, profile and what is refused."""

import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.cli.equilibrium import stretches
from tests.cli.tiny import FOOT, LBF, LEVEL, SOFT_BELOW, settings
from tests.commands import Command


def test_equilibrium_prints_the_loads_and_writes_the_profile(case_file: Path, tmp_path: Path, cli: Command) -> None:
    out, picture = tmp_path / "profile.csv", tmp_path / "profile.svg"
    arguments = ("--operation", "trip_out", "--bit-depth", "850 m", "--friction", "0.3")
    printed = cli("equilibrium", case_file, *arguments, "--out", out, "--plot", picture)
    point = fctd.equilibrium(fctd.load_case(case_file, {"friction": 0.3}), "trip_out", 850)
    screen = printed.out
    assert f"{point.hookload / 1e3:.3f}" in screen
    assert f"{point.profile['von_mises_Pa'].max() / 1e6:.3f}" in screen
    pd.testing.assert_frame_equal(pd.read_csv(out), point.profile, check_dtype=False)
    origin = json.loads((tmp_path / "profile.csv.json").read_text())
    assert origin["status"] == "converged"
    assert origin["hookload_N"] == point.hookload
    assert picture.read_text().startswith("<?xml")

    field = tmp_path / "profile.parquet"
    cli("equilibrium", case_file, *arguments, "--units", "field", "--out", field)
    table = pd.read_parquet(field)
    for name, column, factor in (
        ("von_mises_ksi", "von_mises_Pa", 1000 * LBF / (FOOT / 12) ** 2),
        ("offset_high_in", "offset_high_m", FOOT / 12),
        ("md_ft", "md_m", FOOT),
    ):
        np.testing.assert_allclose(table[name] * factor, point.profile[column], rtol=1e-12, atol=1e-15)


def test_equilibrium_without_an_answer_writes_nothing(case_file: Path, tmp_path: Path, cli: Command) -> None:
    files = [tmp_path / "p.csv", tmp_path / "p.png"]
    assert "diverged: segment" in cli(
        "equilibrium", case_file, "--operation", "trip_out", "--bit-depth", "800", *settings(SOFT_BELOW),
        "--out", files[0], "--plot", files[1], code=1,
    ).err  # fmt: skip
    assert not any(file.exists() for file in files)


@pytest.mark.slow
def test_a_resolved_string_shows_its_shapes_and_its_limits(tmp_path: Path, cli: Command) -> None:
    case_file, out = tmp_path / "level.toml", tmp_path / "profile.csv"
    case_file.write_text(LEVEL)
    point = ("equilibrium", case_file, "--operation", "drill_sliding", "--resolve-buckling", "--out", out)
    screen = " ".join(cli(*point, "--bit-depth", "150").out.split())
    origin = json.loads((tmp_path / "profile.csv.json").read_text())
    assert origin["shape"] == "helix"
    assert "locked_up_at" not in origin
    assert "shape helix" in screen
    for end, word in (("low", "lower"), ("high", "higher")):
        assert f"hook load, {word} of both shapes {origin[f'hookload_{end}_N'] / 1e3:.3f} kN" in screen

    out.unlink()
    stuck = ("--bit-depth", "80", "--friction", "4", *settings("rig.block_weight=350 kN"))
    printed = cli(*point, *stuck, code=1)  # the file that was asked for is not there
    assert not out.exists()
    printed = printed
    assert "No profile" in printed.err
    screen = " ".join(printed.out.split())
    for label, words in (
        ("slack-off spent at", "slack-off is spent at"),
        ("locked up at", "the string is locked up at"),
    ):
        (share,) = re.findall(rf"{words} ([\d.]+) %", printed.err)
        assert f"{label} {share} % of the friction" in screen


def test_buckled_stretches_are_told_apart() -> None:
    modes = ["none", "helical", "helical", "sinusoidal", "none", "helical", "none"]
    profile = pd.DataFrame({"md_m": 100.0 * np.arange(7), "buckling": modes})
    assert stretches(profile, "helical") == [(100.0, 200.0), (500.0, 500.0)]
    assert stretches(profile, "sinusoidal") == [(300.0, 300.0)]
    assert stretches(profile.iloc[:1], "helical") == []
