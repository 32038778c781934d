"""Set-up: the locks against pyproject.toml and rivals, their check for every Python, and what make says."""

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from types import ModuleType

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from references.registry import RIVAL_PACKAGES

ROOT = Path(__file__).parents[1]
LOCK = (ROOT / "requirements.lock").read_text()
RIVALS = (ROOT / "rivals.lock").read_text()
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]


@pytest.fixture(scope="module")
def resolve() -> ModuleType:
    """The script that CI runs."""
    spec = importlib.util.spec_from_file_location("resolve", ROOT / ".ci" / "resolve.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_python_has_all_packages_but_pybullet(resolve: ModuleType) -> None:
    """The lock has the markers of pyproject.toml; requires-python and the check name the same Pythons."""
    asked = [*PROJECT["dependencies"], *(text for extra in PROJECT["optional-dependencies"].values() for text in extra)]
    names = {canonicalize_name(Requirement(text).name) for text in asked}
    for python in resolve.PYTHONS:
        locked = {canonicalize_name(each.name) for each in resolve.wanted(LOCK, python)}
        assert names - locked == (set() if python == "3.11" else {"pybullet"})
    specifier = Requirement(f"fctd{PROJECT['requires-python']}").specifier
    assert tuple(f"3.{minor}" for minor in range(9, 18) if f"3.{minor}.0" in specifier) == resolve.PYTHONS


def test_rivals_are_locked_beside_the_suite_for_every_python(resolve: ModuleType) -> None:
    """The names are those of the registry; no package is pinned twice."""
    assert tuple(Requirement(line).name for line in resolve.pins(RIVALS)) == RIVAL_PACKAGES
    for python in resolve.PYTHONS:
        both = [canonicalize_name(each.name) for each in resolve.wanted(f"{LOCK}\n{RIVALS}", python)]
        assert set(RIVAL_PACKAGES) < set(both)
        assert len(both) == len(set(both))


def test_what_a_package_needs_on_another_python_has_to_be_in_the_lock(resolve: ModuleType) -> None:
    locked = resolve.wanted("old==1.0\nnewer==2.0  # via old\n", "3.13")
    needs = ["newer>=1", "absent; python_version >= '3.13'", "extra; extra == 'test'", "old>1; python_version < '3.12'"]
    packages = [{"metadata": {"name": "old", "requires_dist": needs}}, {"metadata": {"name": "newer"}}]
    (found,) = resolve.unmet(packages, locked, "3.13")
    assert found.startswith("old needs absent")
    assert resolve.unmet(packages, locked, "3.12") == []
    (found,) = resolve.unmet(packages, locked, "3.11")
    assert found.startswith("old needs old>1")
    assert found.endswith("the lock has old==1.0")


def test_the_suite_needs_nothing_that_the_lock_of_rivals_alone_has(resolve: ModuleType) -> None:
    packages = [
        {"metadata": {"name": "own", "requires_dist": ["rival"]}},
        {"metadata": {"name": "rival", "requires_dist": ["own>=1"]}},
    ]
    (found,) = resolve.lacking(packages, "own==1.0", "rival==2.0", "3.12")
    assert found == "own needs rival, the lock has none"
    packages[0]["metadata"]["requires_dist"] = []
    assert resolve.lacking(packages, "own==1.0", "rival==2.0", "3.12") == []


def test_a_lock_that_does_not_resolve_is_exit_code_1_and_leaves_no_record(
    resolve: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    asked: list[str] = []

    def answer(suite: str, rivals: str, python: str) -> list[str]:
        asked.append(python)
        return ["ERROR: no wheel"] if "a==1" in (suite, rivals) and python == "3.14" else []

    monkeypatch.setattr(resolve, "LOCK", tmp_path / "requirements.lock")
    monkeypatch.setattr(resolve, "RIVALS", tmp_path / "rivals.lock")
    monkeypatch.setattr(resolve, "RECORD", tmp_path / "resolved")
    monkeypatch.setattr(resolve, "resolve", answer)
    resolve.RIVALS.write_text("b==1")
    resolve.LOCK.write_text("a==1")
    assert resolve.main() == 1
    assert "Python 3.14: ERROR: no wheel" in capsys.readouterr().out
    assert not resolve.RECORD.exists()
    resolve.LOCK.write_text("a==2")
    assert [resolve.main(), resolve.main()] == [0, 0]
    assert len(asked) == 8  # the second time it was recorded
    for lock, pin in ((resolve.LOCK, "a==3"), (resolve.RIVALS, "b==2")):
        lock.write_text(pin)
        assert resolve.main() == 0
    assert len(asked) == 16
    resolve.RIVALS.write_text("a==1")
    assert resolve.main() == 1


@pytest.mark.parametrize("version", [(3, 10), (3, 15)])
def test_set_up_with_another_python_is_one_clear_message(version: tuple[int, int], tmp_path: Path) -> None:
    if shutil.which("make") is None:
        pytest.skip("make is not installed")
    for name in ("Makefile", "requirements.lock", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    python = tmp_path / "python"
    program = f"import sys; sys.version_info = {version}; exec(sys.argv[1])"
    python.write_text(f"#!/bin/sh\nexec {shlex.quote(sys.executable)} -c '{program}' \"$2\"\n")
    python.chmod(0o755)
    command = ["make", f"PYTHON={python}", ".venv/installed"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode != 0
    assert "error: Python 3.11 to 3.14 is needed" in done.stderr
    assert f"is {version[0]}.{version[1]} (make PYTHON=... names another)" in done.stderr
    assert not (tmp_path / ".venv").exists()


@pytest.mark.parametrize(
    ("command", "said", "in_the_readme"),
    [
        (("test",), "tests: about {} minutes", r"The tests take (\d+) minutes"),
        (("test", "BROWSER=0"), "tests: about {} minutes", r"\(`BROWSER=0`: (\d+)\)"),
        (("reproduce",), "studies and report: about {} minutes", r"studies and report (\d+) minutes"),
        (("reproduce", "QUICK=1"), "studies and report: about {} minutes", r"\(`QUICK=1`: (\d+)\)"),
    ],
    ids=["test", "test without a browser", "reproduce", "reproduce the short way"],
)
def test_make_says_how_long_it_takes_before_it_begins(
    command: tuple[str, ...], said: str, in_the_readme: str, tmp_path: Path
) -> None:
    """The numbers are those of the README; set-up is named only where it is needed."""
    if shutil.which("make") is None:
        pytest.skip("make is not installed")
    for name in ("Makefile", "requirements.lock", "pyproject.toml"):
        shutil.copy(ROOT / name, tmp_path)
    python = tmp_path / "python"
    python.write_text('#!/bin/sh\necho "works: $*"\n[ "$2" != venv ] || { mkdir -p .venv/bin && cp "$0" .venv/bin; }\n')
    python.chmod(0o755)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    minutes = re.search(in_the_readme, readme)
    set_up = re.search(r"set-up takes (\d+) minutes", readme)
    assert minutes
    assert set_up
    expected = [f"set-up first: about {set_up[1]} minutes", said.format(minutes[1])]
    for first in (True, False):
        text = subprocess.run(
            ["make", f"PYTHON={python}", *command], cwd=tmp_path, capture_output=True, text=True, check=True
        ).stdout
        before = text[: text.index("works: -m")]
        assert [each in before for each in expected] == [first, True]


def test_what_cannot_be_kept_at_home_is_kept_in_the_checkout(tmp_path: Path) -> None:
    """Else each process of a test run would compile all code."""
    if shutil.which("make") is None:
        pytest.skip("make is not installed")
    shutil.copy(ROOT / "Makefile", tmp_path)
    (tmp_path / "file").touch()
    clean = {k: v for k, v in os.environ.items() if k != "XDG_CACHE_HOME"}
    for home, kept in ((tmp_path, ""), (tmp_path / "file", f"{tmp_path}/.cache")):
        done = subprocess.run(
            ["make", "--silent", "--eval=show:;@echo $$XDG_CACHE_HOME", "show"],
            cwd=tmp_path, env=clean | {"HOME": str(home)}, capture_output=True, text=True, check=True,
        )  # fmt: skip
        assert done.stdout.strip() == kept
