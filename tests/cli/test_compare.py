"""``fctd compare``: its curves are those of ``fctd chart``, what differs stands first, and wrong input is named."""

import json
from pathlib import Path

import pandas as pd
import pytest

from tests.cli.tiny import CASE
from tests.commands import Command

OPTIONS = ["--operation", "trip_in,rotating", "--depths", "500:800:100", "--quiet"]
HEAVY = "mud.density=1.4 sg"


@pytest.fixture
def other_file(tmp_path: Path) -> Path:
    """The tiny case of a shorter hole, with a name of its own."""
    path = tmp_path / "short.toml"
    path.write_text(CASE.replace('"tiny"', '"short"').replace("[900, 90, 0]", "[650, 90, 0]").replace("900 m", "650 m"))
    return path


def test_the_numbers_are_those_of_the_charts_bit_for_bit(case_file: Path, cli: Command) -> None:
    """Also under changes of one case, shared changes and a fan of friction factors."""
    fan = ["--friction", "0.2,0.3", "--set", "bit.weight_on_bit=10 kN", "--units", "field"]
    both, one = case_file.with_name("both.csv"), case_file.with_name("one.csv")
    depths = ["--operation", "trip_in,drill_rotating", "--depths", "2000:2600:300", "--quiet"]
    printed = cli("compare", case_file, case_file, HEAVY, *depths, *fan, "--out", both)
    table = pd.read_csv(both, dtype=str)
    for name, own in (("tiny 1", []), ("tiny 2", ["--set", HEAVY])):
        cli("chart", case_file, *depths, *fan, *own, "--out", one)
        chart = pd.read_csv(one, dtype=str)
        own_rows = table[table["case"] == name].drop(columns="case").reset_index(drop=True)
        pd.testing.assert_frame_equal(own_rows, chart)
    about = json.loads(both.with_name("both.csv.json").read_text())
    assert about["differences"] == printed.out.splitlines()[:1]
    assert about["cases"]["tiny 2"]["case"]["mud"]["density"] == 1400.0


def test_cases_of_another_depth_end_there(case_file: Path, other_file: Path, cli: Command) -> None:
    out = case_file.with_name("both.parquet")
    cli("compare", case_file, other_file, *OPTIONS, "--out", out)
    deepest = pd.read_parquet(out).groupby("case")["bit_depth_m"].max()
    assert deepest.to_dict() == {"short": 600.0, "tiny": 800.0}


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["png", "html", "xlsx"])
def test_a_file_of_each_kind(suffix: str, case_file: Path, cli: Command) -> None:
    out = case_file.with_name(f"both.{suffix}")
    cli("compare", case_file, case_file, "friction=0.3", *OPTIONS, "--out", out)
    assert out.stat().st_size > 5_000


def test_the_same_case_twice_differs_in_no_key(case_file: Path, cli: Command) -> None:
    """Comments and other spellings do not count; factors of the option stand in place of the cases' own."""
    copy = case_file.with_name("copy.toml")
    copy.write_text(
        CASE.replace('"8.5 in"', '"215.9 mm"  # another spelling').replace("friction = 0.2", "friction = 0.4")
    )
    printed = cli("compare", case_file, copy, *OPTIONS, "--friction", "0.25").out
    assert printed.startswith("no key")
    assert "tiny (tiny)" in printed
    assert "tiny (copy)" in printed


def test_warnings_of_a_file_are_told_once_and_strict_ends(case_file: Path, cli: Command) -> None:
    options = [*OPTIONS, "--load", "indicator"]
    told = cli("compare", case_file, case_file, "friction=0.3", *options).err
    assert told.count("block_weight") == 1
    cli("compare", case_file, case_file, *options, "--strict", code=1)
