"""Values of options: shares, quantities, and files that may be written."""

from pathlib import Path

import pytest

from fctd.case import units
from fctd.case.errors import InputError
from fctd.cli.options import check_target, read_quantity, read_share


@pytest.mark.parametrize(("text", "share"), [("1%", 0.01), ("1 %", 0.01), ("0.01", 0.01), (" 2.5% ", 0.025)])
def test_a_share_is_read_with_and_without_percent(text: str, share: float) -> None:
    assert read_share(text, "--tolerance") == pytest.approx(share)


@pytest.mark.parametrize("text", ["", "%", "one", "nan", "inf", "1", "100%", "0%", "1%%"])
def test_what_is_no_share_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--tolerance"):
        read_share(text, "--tolerance")


def test_a_quantity_is_a_number_in_si_or_one_with_a_unit() -> None:
    assert read_quantity("1750", units.LENGTH, "--bit-depth") == 1750.0
    assert read_quantity("1750 m", units.LENGTH, "--bit-depth") == 1750.0
    assert read_quantity("30 ft", units.LENGTH, "--bit-depth") == pytest.approx(9.144, rel=1e-14)
    assert read_quantity("0", units.SPEED, "--speed") == 0.0


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
