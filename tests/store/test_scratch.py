"""A temporary file is nobody else's, and is removed only where its writer has been killed on this machine."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fctd.store import scratch as scratch_module
from fctd.store.scratch import left_over, scratch_file
from fctd.store.whole_file import whole_file
from tests.left_over import left_beside

pytest.importorskip("fcntl")
ROOT = Path(__file__).parents[2]
WRITING = (
    "import sys, time; from pathlib import Path; from fctd.store.whole_file import whole_file\n"
    "with whole_file(Path(sys.argv[1])) as scratch:\n"
    "    print(scratch.name, flush=True); input(); scratch.write_text('other')\n"
)


@pytest.mark.parametrize("name", [".keep-2024.csv", ".keep-1.csv", ".keep-4194304.csv", ".keep-fctd-12-34.csv"])
def test_a_hidden_file_of_the_users_stays(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text("mine")
    for text in ("first", "second"):
        with whole_file(tmp_path / "keep.csv") as scratch:
            scratch.write_text(text)
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {name: "mine", "keep.csv": "second"}


# An ordinary user may make no namespace: CI's slow tests can.
CONTAINER = pytest.param(["unshare", "--pid", "--fork", "--kill-child"], id="container", marks=pytest.mark.slow)


@pytest.mark.parametrize("apart", [pytest.param([], id="beside"), CONTAINER])
def test_a_writer_elsewhere_keeps_its_file(apart: list[str], tmp_path: Path) -> None:
    """Also one in a container, whose number no process here has."""
    if apart and (shutil.which(apart[0]) is None or subprocess.run([*apart, "true"], capture_output=True).returncode):
        pytest.skip("this system makes no namespace of processes")
    command = [*apart, sys.executable, "-c", WRITING, str(tmp_path / "keep.csv")]
    other = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=ROOT, text=True)
    assert other.stdin is not None
    assert other.stdout is not None
    name = other.stdout.readline().strip()
    with whole_file(tmp_path / "keep.csv") as scratch:
        scratch.write_text("ours")
    assert {path.name for path in tmp_path.iterdir()} == {name, "keep.csv"}
    other.communicate("\n")
    assert other.returncode == 0
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"keep.csv": "other"}


def test_what_another_machine_left_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its locks may not be seen here."""
    with monkeypatch.context() as elsewhere:
        elsewhere.setattr(scratch_module, "_mark", lambda: "fctd-0badcafe")
        theirs = left_beside(tmp_path / "keep.csv")
    ours = left_beside(tmp_path / "keep.csv")
    assert list(left_over(tmp_path / "keep.csv")) == [ours]
    with whole_file(tmp_path / "keep.csv") as scratch:
        scratch.write_text("text")
    assert {path.name for path in tmp_path.iterdir()} == {theirs.name, "keep.csv"}


def test_without_locks_nothing_is_left_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(file: int, how: int) -> None:
        raise OSError(37, "No locks available")

    monkeypatch.setattr("fcntl.flock", refuse)
    with scratch_file(tmp_path / "keep.csv") as scratch:
        scratch.write_text("text")
    assert list(left_over(tmp_path / "keep.csv")) == []
    assert scratch.exists()


def test_a_file_taken_for_left_over_as_it_is_made_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between its making and its lock another process may sweep."""
    real, opened = os.open, []

    def swept(path: Path, flags: int, mode: int = 0o777) -> int:
        file = real(path, flags, mode)
        if not opened:
            os.unlink(path)
        opened.append(path)
        return file

    monkeypatch.setattr(os, "open", swept)
    with scratch_file(tmp_path / "keep.csv") as scratch:
        assert [path.exists() for path in opened] == [False, True]
        assert scratch == opened[1]
