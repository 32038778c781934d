"""The sources of a release from the checkout's history, or the reason why there are none."""

import subprocess
from pathlib import Path

import pytest

from benchmarks import history
from benchmarks.history import Record
from benchmarks.release import FOLDERS, NoSourcesError, check_out
from tests.benchmarks.test_history import a_record


def git(root: Path, *arguments: str) -> str:
    who = ("-c", "user.name=n", "-c", "user.email=e", "-c", "commit.gpgsign=false")
    done = subprocess.run(["git", "-C", str(root), *who, *arguments], capture_output=True, text=True, check=True)
    return done.stdout.strip()


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Record, Path]:
    """A checkout whose engine changed after a release; the record and its file."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    root = tmp_path / "project"
    for folder in FOLDERS:
        (root / folder).mkdir(parents=True)
        (root / folder / "one.py").write_text("released")
    git(root.parent, "init", "--quiet", str(root))
    git(root, "add", ".")
    git(root, "commit", "--quiet", "-m", "release")
    record = a_record(commit=git(root, "rev-parse", "--short", "HEAD"), sources=history.sources_of(root))
    file = history.write(record, root / "benchmarks" / "history")
    git(root, "add", ".")
    git(root, "commit", "--quiet", "-m", "its record")
    (root / "fctd" / "one.py").write_text("changed")
    git(root, "commit", "--quiet", "-am", "change")
    return root, record, file


def released(folder: Path) -> str:
    return (folder / "fctd" / "one.py").read_text()


def test_sources_are_found_by_the_commit_of_the_record(checkout: tuple[Path, Record, Path]) -> None:
    root, record, file = checkout
    folder = check_out(record, file, root)
    assert released(folder) == "released"
    assert all((folder / name / "one.py").exists() for name in FOLDERS)


def test_sources_are_found_by_the_commit_that_added_the_record(checkout: tuple[Path, Record, Path]) -> None:
    """On a rebased branch the recorded commit no longer exists."""
    root, record, file = checkout
    assert released(check_out(record.model_copy(update={"commit": "0123abc"}), file, root)) == "released"


def test_a_record_may_be_in_another_folder(
    checkout: tuple[Path, Record, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    root, record, file = checkout
    other = tmp_path / "other.json"
    other.write_bytes(file.read_bytes())
    assert released(check_out(record, other, root)) == "released"
    monkeypatch.chdir(root)
    gone = record.model_copy(update={"commit": "0123abc"})
    assert released(check_out(gone, file.relative_to(root), root)) == "released"
    with pytest.raises(NoSourcesError, match="does not hold"):
        check_out(gone, other, root)


def test_a_commit_with_other_sources_is_refused(checkout: tuple[Path, Record, Path]) -> None:
    root, record, file = checkout
    with pytest.raises(NoSourcesError, match="does not hold"):
        check_out(record.model_copy(update={"sources": "others"}), file, root)


def test_a_shallow_clone_is_reported(checkout: tuple[Path, Record, Path], tmp_path: Path) -> None:
    root, record, file = checkout
    clone = tmp_path / "clone"
    git(tmp_path, "clone", "--quiet", "--depth", "1", root.as_uri(), str(clone))
    with pytest.raises(NoSourcesError, match="shallow clone does not hold commit"):
        check_out(record, clone / file.relative_to(root), clone)


def test_a_folder_that_is_no_checkout_is_reported(checkout: tuple[Path, Record, Path], tmp_path: Path) -> None:
    root, record, file = checkout
    with pytest.raises(NoSourcesError, match="not the top of a checkout"):
        check_out(record, file, root / "benchmarks")
    with pytest.raises(NoSourcesError, match="not a git repository"):
        check_out(record, file, tmp_path)
