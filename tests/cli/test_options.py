"""Values of options: shares, and files that may be written."""

from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.cli.options import changes_of, check_target, read_share


@pytest.mark.parametrize(("text", "share"), [("1%", 0.01), ("1 %", 0.01), ("0.01", 0.01), (" 2.5% ", 0.025)])
def test_a_share_is_read_with_and_without_percent(text: str, share: float) -> None:
    assert read_share(text, "--tolerance") == pytest.approx(share)


@pytest.mark.parametrize("text", ["", "%", "one", "nan", "inf", "1", "100%", "0%", "1%%"])
def test_what_is_no_share_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="--tolerance"):
        read_share(text, "--tolerance")


def test_one_set_of_friction_factors_is_an_override() -> None:
    assert changes_of(["mud.density=1200"], "0.25") == {"mud.density": 1200, "friction": 0.25}
    assert changes_of([], "cased=0.2,open=0.3") == {"friction": {"cased": 0.2, "open": 0.3}}
    with pytest.raises(InputError, match="one set of friction factors"):
        changes_of([], "0.1,0.2")


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
