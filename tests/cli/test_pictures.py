"""Pictures and pages of the steady commands, by the suffix of their file."""

from pathlib import Path

import pytest

from fctd.cli.pictures import PICTURES
from tests.commands import Command

START = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF", ".html": b"<!doctype html>"}


@pytest.mark.parametrize(
    "suffix",
    [pytest.param(suffix, marks=pytest.mark.slow if suffix in {".svg", ".pdf"} else ()) for suffix in PICTURES],
)
def test_a_picture_is_as_its_suffix_says(suffix: str, case_file: Path, tmp_path: Path, cli: Command) -> None:
    rows = tmp_path / "rows.csv"
    rows.write_text("depth_m,operation,hookload_kN\n550,trip_in,100\n")
    chart, profile = tmp_path / f"chart{suffix}", tmp_path / f"profile{suffix.upper()}"
    cli(
        "chart", case_file, "--operation", "trip_in", "--depths", "500:td:300", "--load", "indicator",
        "--side-force", "joint", "--measured", rows, "--plot", chart, "--plot-profile", profile, "--quiet",
    )  # fmt: skip
    for path in (chart, profile):
        assert path.read_bytes().startswith(START[suffix])


def test_out_is_a_picture_where_its_suffix_says_so(case_file: Path, tmp_path: Path, cli: Command) -> None:
    given = ("equilibrium", case_file, "--operation", "trip_in", "--bit-depth", "500", "--quiet")
    picture = tmp_path / "profile.png"
    cli(*given, "--out", picture)
    assert picture.read_bytes().startswith(START[".png"])
    cli(*given, "--out", picture, "--plot", tmp_path / "other.png", code=2)
