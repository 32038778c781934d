"""The sources of a commit from the checkout's history, or the reason why there are none."""

import subprocess
from pathlib import Path

import pytest

from benchmarks import checkout
from benchmarks.checkout import FOLDERS, SUBJECTS, check_out
from fctd.case.errors import InputError


def git(root: Path, *arguments: str) -> str:
    who = ("-c", "user.name=n", "-c", "user.email=e", "-c", "commit.gpgsign=false")
    done = subprocess.run(["git", "-C", str(root), *who, *arguments], capture_output=True, text=True, check=True)
    return done.stdout.strip()


def commit(root: Path, text: str) -> str:
    (root / "fctd" / "one.py").write_text(text)
    git(root, "add", ".")
    git(root, "commit", "--quiet", "-m", text)
    return git(root, "rev-parse", "HEAD")


@pytest.fixture
def clone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, str]:
    """A clone whose engine changed after a baseline, and the commit of the baseline."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    root = tmp_path / "project"
    for folder in FOLDERS:
        (root / folder).mkdir(parents=True)
        (root / folder / "one.py").write_text("same")
    (root / SUBJECTS).write_text('{"old": 1}')
    git(root.parent, "init", "--quiet", str(root))
    baseline = commit(root, "baseline")
    (root / SUBJECTS).write_text('{"old": 1, "fresh": 2}')
    commit(root, "changed")
    return root, baseline


def test_sources_are_those_of_the_commit(clone: tuple[Path, str]) -> None:
    root, baseline = clone
    for name in (baseline, baseline[:8], "HEAD^"):
        folder = check_out(name, root)
        assert (folder / "fctd" / "one.py").read_text() == "baseline"
        assert all((folder / name / "one.py").exists() for name in FOLDERS)


def test_sources_stay_in_the_cache_since_numba_compiles_new_files_anew(clone: tuple[Path, str]) -> None:
    root, baseline = clone
    file = check_out(baseline, root) / "fctd" / "one.py"
    first = file.stat().st_mtime_ns
    assert check_out(baseline, root) / "fctd" / "one.py" == file
    assert file.stat().st_mtime_ns == first
    assert len(list(file.parents[2].iterdir())) == 1  # nothing half written beside it


def test_a_subject_is_new_in_the_change_that_brings_it_and_no_longer(clone: tuple[Path, str]) -> None:
    root, _ = clone
    assert checkout.brought("fresh", root)
    assert not checkout.brought("old", root)
    commit(root, "a later change")
    assert not checkout.brought("fresh", root)


@pytest.mark.parametrize("name", ["0123abc", "--output=here", "nobranch"])
def test_a_commit_that_the_clone_does_not_hold_is_named(clone: tuple[Path, str], name: str) -> None:
    with pytest.raises(InputError, match="a commit of this clone") as caught:
        check_out(name, clone[0])
    assert caught.value.value == name


def test_a_shallow_clone_says_how_to_deepen_it(clone: tuple[Path, str], tmp_path: Path) -> None:
    root, baseline = clone
    shallow = tmp_path / "shallow"
    git(tmp_path, "clone", "--quiet", "--depth", "1", root.as_uri(), str(shallow))
    with pytest.raises(InputError, match="git fetch --unshallow"):
        check_out(baseline, shallow)


def test_a_folder_that_is_no_clone_is_reported(clone: tuple[Path, str], tmp_path: Path) -> None:
    root, baseline = clone
    with pytest.raises(InputError, match="a clone, so that the gate can race"):
        check_out(baseline, root / "benchmarks")
    with pytest.raises(InputError, match="a clone with its history"):
        check_out(baseline, tmp_path)


def test_uncommitted_changes_are_told(clone: tuple[Path, str]) -> None:
    root, _ = clone
    assert checkout.uncommitted(root) == ""
    (root / "fctd" / "one.py").write_text("edited")
    assert "fctd/one.py" in checkout.uncommitted(root)
