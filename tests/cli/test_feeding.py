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


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (
            ("--operation", "trip_out", "--set", "solver.buckling=feed"),
            "a string that slides down without rotation (trip_in or drill_sliding), which the block feeds",
        ),
        (
            ("--operation", "trip_in", "--rpm", "60", "--set", "solver.buckling=feed"),
            "a string without rotation: one that turns is not fed from rest (--rpm 0)",
        ),
        (
            (*RESOLVED, "--friction", "0"),
            "a hole with friction: a string that slides without it is not fed from rest",
        ),
        (
            ("--operation", "drill_sliding"),
            'solver.buckling = "feed" (--set solver.buckling=feed): else no string is fed from rest',
        ),
    ],
)
def test_what_is_never_fed_is_refused_before_it_is_solved(
    options: tuple[str, ...], expected: str, level: Path, cli: Command, tmp_path: Path
) -> None:
    picture = tmp_path / "feeding.png"
    printed = cli("equilibrium", level, *options, "--bit-depth", "150", "--plot-feeding", picture, code=2)
    assert printed.err == f'--plot-feeding = "{picture}": expected {expected}\n'
    assert printed.out == ""
    assert not picture.exists()


def test_a_page_or_the_file_of_another_picture_is_refused(level: Path, cli: Command) -> None:
    given = ("equilibrium", level, *RESOLVED, "--bit-depth", "150")
    assert "ends in .png or .svg or .pdf" in cli(*given, "--plot-feeding", "feeding.html", code=2).err
    same = cli(*given, "--plot", "a.png", "--plot-feeding", "./a.png", code=2).err
    assert same == '--plot-feeding = "a.png": expected a file of its own for each picture\n'


def test_a_string_that_does_not_buckle_is_not_fed(case_file: Path, tmp_path: Path, cli: Command) -> None:
    """Its loads are printed, and the other files written."""
    picture, out = tmp_path / "feeding.png", tmp_path / "profile.csv"
    files = ("--out", out, "--plot-feeding", picture)
    printed = cli("equilibrium", case_file, *RESOLVED, "--bit-depth", "150", *files, code=2)
    assert "converged" in printed.out
    assert printed.err.endswith(
        f'--plot-feeding = "{picture}": expected a string that buckles, which alone is fed from rest: this one is '
        "compressed beyond no limit, so look at a larger weight on bit, more friction or a larger depth\n"
    )
    assert out.exists()
    assert not picture.exists()


def test_a_string_that_another_method_found_says_so(level: Path, tmp_path: Path, cli: Command) -> None:
    picture = tmp_path / "feeding.png"
    little = settings("solver.resolve_work=1e3")
    printed = cli("equilibrium", level, *RESOLVED, "--bit-depth", "150", *little, "--plot-feeding", picture, code=2)
    assert "resolving takes more work or segments than a row may have" in printed.err
    assert "by another method, as its line above explains, so try a larger solver.resolve_work (it is 1000)" in (
        printed.err
    )
    assert not picture.exists()


@pytest.mark.slow
def test_a_fed_string_is_drawn_also_where_no_push_suffices(level: Path, tmp_path: Path, cli: Command) -> None:
    picture, profile = tmp_path / "feeding.svg", tmp_path / "profile.csv"
    files = ("--plot-feeding", picture, "--units", "field")
    assert str(picture) in cli("equilibrium", level, *RESOLVED, "--bit-depth", "150 m", *files).out
    assert "feed of the block, ft" in picture.read_text()
    picture.unlink()

    printed = cli("equilibrium", level, *RESOLVED, *LOCKED, *files[:2], "--out", profile, code=1)
    assert "No profile is written" in printed.err
    assert picture.exists()
    assert not profile.exists()
