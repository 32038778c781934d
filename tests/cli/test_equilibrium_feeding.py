"""``fctd equilibrium --plot-feeding``: the picture of a fed string, and a sentence for one that was not fed."""

from pathlib import Path

import pytest

from tests.cli.tiny import LEVEL, settings
from tests.commands import Command

RESOLVED = ("--operation", "drill_sliding", "--set", "solver.buckling=feed")
LOCKED = ("--bit-depth", "80", "--friction", "4", *settings("rig.block_weight=350 kN"))


@pytest.fixture
def level(tmp_path: Path) -> Path:
    """A level hole, whose string snakes."""
    file = tmp_path / "level.toml"
    file.write_text(LEVEL)
    return file


def test_a_string_that_does_not_buckle_is_not_fed(case_file: Path, tmp_path: Path, cli: Command) -> None:
    """Its loads are printed, and the other files written."""
    picture, out = tmp_path / "feeding.png", tmp_path / "profile.csv"
    files = ("--out", out, "--plot-feeding", picture)
    printed = cli("equilibrium", case_file, *RESOLVED, "--bit-depth", "150", *files, code=2)
    assert "converged" in printed.out
    assert out.exists()
    assert not picture.exists()


def test_a_string_that_another_method_found_says_so(level: Path, tmp_path: Path, cli: Command) -> None:
    picture = tmp_path / "feeding.png"
    little = settings("solver.resolve_work=1e3")
    printed = cli("equilibrium", level, *RESOLVED, "--bit-depth", "150", *little, "--plot-feeding", picture, code=2)
    assert "(it is 1000)" in printed.err
    assert not picture.exists()


@pytest.mark.slow
def test_a_fed_string_is_drawn_also_where_no_push_suffices(level: Path, tmp_path: Path, cli: Command) -> None:
    picture, profile = tmp_path / "feeding.svg", tmp_path / "profile.csv"
    files = ("--plot-feeding", picture, "--units", "field")
    assert str(picture) in cli("equilibrium", level, *RESOLVED, "--bit-depth", "150 m", *files).out
    assert "block, ft" in picture.read_text()
    picture.unlink()

    printed = cli("equilibrium", level, *RESOLVED, *LOCKED, *files[:2], "--out", profile, code=1)
    assert "No profile" in printed.err
    assert picture.exists()
    assert not profile.exists()
