"""After any failure a file is the complete old one or the complete new one."""

import os
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.results.whole_file import whole_file


def test_the_new_file_takes_the_place_of_the_old(tmp_path: Path) -> None:
    path = tmp_path / "new" / "chart.csv"
    for text in ("first", "second"):
        with whole_file(path) as scratch:
            assert scratch.suffix == ".csv"
            scratch.write_text(text)
        assert path.read_text() == text
    assert list(path.parent.iterdir()) == [path]
    os.link(path, tmp_path / "reader")  # whoever reads the old file meanwhile
    with whole_file(path) as scratch:
        scratch.write_text("third")
    assert (tmp_path / "reader").read_text() == "second"


@pytest.mark.parametrize("failure", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_failure_leaves_the_old_file(failure: BaseException, tmp_path: Path) -> None:
    path = tmp_path / "chart.csv"
    path.write_text("old")

    def fail() -> None:
        with whole_file(path) as scratch:
            scratch.write_text("half")
            raise failure

    with pytest.raises((InputError, KeyboardInterrupt)) as caught:
        fail()
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
    if isinstance(failure, OSError):
        assert str(caught.value) == f'"{path}": expected a file that can be written (No space left on device)'


def test_a_symlink_stays_one(tmp_path: Path) -> None:
    (tmp_path / "link.csv").symlink_to("new/chart.csv")
    with whole_file(tmp_path / "link.csv") as scratch:
        scratch.write_text("text")
    assert (tmp_path / "link.csv").readlink() == Path("new/chart.csv")
    assert (tmp_path / "new" / "chart.csv").read_text() == "text"


def test_what_a_killed_process_left_is_removed(tmp_path: Path) -> None:
    """Only where that process has ended, and the name is one that ``whole_file`` gives."""
    ended = 4_194_304  # beyond the ids that Linux gives
    ours = tmp_path / f".chart-{ended}.csv"
    others = [f".chart-{os.getppid()}.csv", f".chart-{ended}.parquet", f".Chart-{ended}.csv", f"chart-{ended}.csv",
              f".chart-0{ended}.csv", ".chart-0.csv", f".my.chart-{ended}.csv", f".chart-{10**30}.csv"]  # fmt: skip
    for path in (ours, *(tmp_path / name for name in others)):
        path.touch()
    with whole_file(tmp_path / "chart.csv") as scratch:
        scratch.write_text("text")
    assert {path.name for path in tmp_path.iterdir()} == {*others, "chart.csv"}


def test_no_folder_can_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="a file that can be written"), whole_file(tmp_path / "file" / "a.csv"):
        pass
