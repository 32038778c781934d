"""After any failure a file is the complete old one or the complete new one."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.store import whole_file as whole_file_module
from fctd.store.whole_file import check_file, whole_file
from tests.left_over import left_beside


def test_the_new_file_takes_the_place_of_the_old(tmp_path: Path) -> None:
    path = tmp_path / "new" / "deep" / "chart.csv"
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
    """Only the file that was to become this one."""
    left_beside(tmp_path / "chart.csv")
    others = [left_beside(tmp_path / name).name for name in ("chart.parquet", "Chart.csv", "my.chart.csv", "chart")]
    with whole_file(tmp_path / "chart.csv") as scratch:
        scratch.write_text("text")
    assert {path.name for path in tmp_path.iterdir()} == {*others, "chart.csv"}


def test_what_a_killed_process_left_may_be_gone_meanwhile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another process that writes the same file removes it too."""
    monkeypatch.setattr(whole_file_module, "left_over", lambda path: [path.with_name("gone")])
    with whole_file(tmp_path / "chart.csv") as scratch:
        scratch.write_text("text")
    assert [path.name for path in tmp_path.iterdir()] == ["chart.csv"]


def is_folder(path: Path) -> None:
    path.mkdir()


@pytest.mark.parametrize("make", [is_folder, os.mkfifo])
def test_a_folder_or_a_pipe_is_refused_before(make: Callable[[Path], None], tmp_path: Path) -> None:
    path = tmp_path / "chart.csv"
    check_file(path, "--out")
    make(path)
    with pytest.raises(InputError) as caught:
        check_file(path, "--out")
    expected = "a regular file that can be written, no folder, pipe or device"
    assert str(caught.value) == f'--out = "{path}": expected {expected}'


@pytest.mark.parametrize(
    ("name", "reason"),
    [("file/a.csv", "Not a directory"), ("x" * 250 + ".csv", "File name too long"), ("a/" + "x" * 300, "File name")],
)
def test_a_file_that_cannot_be_made_is_refused_before(name: str, reason: str, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=rf"--out = .*a file that can be written \({reason}"):
        check_file(tmp_path / name, "--out")


def test_a_path_too_long_only_as_a_whole_is_refused_before(tmp_path: Path) -> None:
    """Linux takes 255 bytes for a name and 4096 for a path."""
    folder = tmp_path
    while len(str(folder)) < 3850:
        folder /= "x" * 200
    check_file(folder / "a.csv")
    with pytest.raises(InputError, match="File name too long"):
        check_file(folder / ("y" * 245))


@pytest.mark.parametrize("there", [True, False])
def test_what_may_not_be_written_is_refused_before(
    there: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An existing file, or the folder of a new one: files are made where a folder may be written and searched."""
    path = tmp_path / "chart.csv"
    if there:
        path.touch()
    refused = (path, os.W_OK) if there else (tmp_path, os.W_OK | os.X_OK)
    monkeypatch.setattr(os, "access", lambda place, mode: (place, mode) != refused)
    with pytest.raises(InputError, match=r"a file that can be written \(Permission denied\)"):
        check_file(path)


def test_no_folder_can_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="a file that can be written"), whole_file(tmp_path / "file" / "a.csv"):
        pass
