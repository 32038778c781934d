"""What kept numbers come from, and what has changed since."""

import platform
import shutil
import subprocess
from importlib.metadata import version
from pathlib import Path

import llvmlite.binding as llvm
import numba
import numpy as np
import pytest

import fctd
from fctd.store import origin
from fctd.store.origin import changes, origin_of, versions

WHO = ("-c", "user.name=they", "-c", "user.email=they@example.org")


def test_each_change_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    survey = tmp_path / "survey.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,0,0\n")
    path = tmp_path / "small.toml"
    path.write_text("")
    files = {"case file": path, "survey": survey}
    before = origin_of(files, "ours")
    assert list(changes(before, origin_of(files, "ours"))) == []
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,1,0\n")
    path.unlink()
    monkeypatch.setattr(origin, "versions", lambda: {"fctd": "9.9", "numpy": "1.0", "commit": "abc"})
    monkeypatch.setattr(llvm, "get_host_cpu_name", lambda: "abacus")
    found = list(changes(before, origin_of(files, "other")))
    assert f"the case file {path} is gone" in found
    assert f"the survey {survey} has changed" in found
    assert "the sources of fctd has changed" not in found
    assert "the sources of fctd have changed" in found
    assert any(line.startswith("numpy was") and line.endswith("is 1.0") for line in found)
    assert any(line.startswith("processor was") and "abacus" in line for line in found)
    assert not any("commit" in line for line in found)


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_versions_name_the_commit_of_a_checkout_and_of_nothing_else() -> None:
    asked = ["git", "rev-parse", "--short", "HEAD"]
    done = subprocess.run(asked, cwd=Path(fctd.__file__).parent, capture_output=True, text=True)
    assert versions().get("commit", "") == done.stdout.strip()


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_the_commit_of_another_checkout_is_not_ours(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of one that a hook of git names, and of one in whose folder an environment of Python lies."""
    ours = versions().get("commit")
    for command in (["init", "-q"], [*WHO, "commit", "-q", "--allow-empty", "-m", "theirs"]):
        subprocess.run(["git", "-C", str(tmp_path), *command], check=True)
    with monkeypatch.context() as hook:
        hook.setenv("GIT_DIR", str(tmp_path / ".git"))
        assert versions().get("commit") == ours
    installed = tmp_path / "lib" / "fctd" / "store" / "origin.py"
    installed.parent.mkdir(parents=True)
    monkeypatch.setattr(origin, "__file__", str(installed))
    assert "commit" not in versions()


def test_versions_name_engine_language_and_libraries() -> None:
    found = versions()
    found.pop("commit", None)
    assert found == {
        "fctd": version("fctd"), "python": platform.python_version(), "numpy": np.__version__,
        "numba": numba.__version__,
    }  # fmt: skip
