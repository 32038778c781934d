"""Values of options: shares, quantities, and files that may be written."""

from pathlib import Path
from typing import Any

import pytest

from fctd.case import units
from fctd.case.errors import InputError
from fctd.cli.options import changes_of, check_target, read_quantity, read_share


@pytest.mark.parametrize(("text", "share"), [("1%", 0.01), ("1 %", 0.01), ("0.01", 0.01), (" 2.5% ", 0.025)])
def test_a_share_is_read_with_and_without_percent(text: str, share: float) -> None:
    assert read_share(text, "--tolerance") == pytest.approx(share)


@pytest.mark.parametrize("text", ["", "%", "one", "nan", "inf", "1", "100%", "0%", "1%%"])
def test_what_is_no_share_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--tolerance"):
        read_share(text, "--tolerance")


@pytest.mark.parametrize(
    ("text", "dimension", "system", "expected"),
    [
        ("1750", units.LENGTH, "si", 1750.0),
        ("1750 m", units.LENGTH, "si", 1750.0),
        ("30 ft", units.LENGTH, "si", pytest.approx(9.144, rel=1e-14)),
        ("0", units.SPEED, "si", 0.0),
        # A bare number is in the units asked for.
        ("1000", units.LENGTH, "field", 304.8),
        ("1000 m", units.LENGTH, "field", 1000.0),
        ("60", units.SPEED, "field", pytest.approx(0.3048, rel=1e-14)),
        ("60", units.ROTATION, "field", 60.0),
    ],
)
def test_a_quantity_is_a_bare_number_or_one_with_a_unit(
    text: str, dimension: units.Dimension, system: Any, expected: float
) -> None:
    assert read_quantity(text, dimension, "--option", system) == expected


def test_a_bad_quantity_is_refused() -> None:
    with pytest.raises(InputError, match='"-5": expected a length'):
        read_quantity("-5", units.LENGTH, "--bit-depth", "field")


def test_one_set_of_friction_factors_is_an_override() -> None:
    assert changes_of(["mud.density=1200"], "0.25") == {"mud.density": 1200, "friction": 0.25}
    assert changes_of([], "cased=0.2,open=0.3") == {"friction": {"cased": 0.2, "open": 0.3}}
    with pytest.raises(InputError, match="one set of friction factors"):
        changes_of([], "0.1,0.2")


@pytest.mark.parametrize("text", ["-1 m", "-1", "deep", "3 kg", "nan", "inf", ""])
def test_what_is_no_quantity_is_named_with_its_option(text: str) -> None:
    with pytest.raises(InputError, match="expected a length") as caught:
        read_quantity(text, units.LENGTH, "--bit-depth")
    assert (caught.value.key, caught.value.value) == ("--bit-depth", text)


def test_a_target_is_a_file_that_can_be_written(tmp_path: Path) -> None:
    check_target(None, "--out", (".csv",))
    check_target(tmp_path / "chart.CSV", "--out", (".csv", ".parquet"))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("chart.txt", "a file name that ends in .csv or .parquet"),
        ("chart", "a file name that ends in .csv or .parquet"),
        ("file/chart.csv", "can be written"),
        ("folder.csv", "no folder, pipe or device"),
        ("side.csv", "no folder, pipe or device"),
    ],
)
def test_a_target_that_cannot_be_written_is_refused(name: str, expected: str, tmp_path: Path) -> None:
    """Nor one whose metadata file could not be written beside it."""
    (tmp_path / "file").touch()
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "side.csv.json").mkdir()
    with pytest.raises(InputError) as caught:
        check_target(tmp_path / name, "--out", (".csv", ".parquet"))
    assert caught.value.key == "--out"
    assert expected in caught.value.expected
