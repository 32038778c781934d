"""Faults of disk, clock, environment and users, and SIGKILL: nothing is lost beyond a chunk, and a message says why.

The faults are those of the study ``faults``.  Only the study tries those that take seconds or compile everything, and
kills commands at random moments; a home that does not exist is tried here with a few functions.
"""

import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

pytest.importorskip("resource")

from validation.harness.study import ROOT
from validation.parts import faults
from validation.parts.faults import FAULTS, SLOW, Ground, at_once, environment_of

# A command in a fork of the tests, which have several threads from Python 3.12 on.
pytestmark = pytest.mark.filterwarnings("ignore:.*multi-threaded, use of fork:DeprecationWarning")
SECONDS = {"disk full at the end", "clock that jumps", "locale C"}
POINTS = """
import numpy as np, fctd
case = fctd.load_case("case.toml")
print(fctd.find_contacts(fctd.build_wellbore(case), np.array([[0.0, 0.05, 100.0]]), np.array([0.02])).md)
"""


@pytest.fixture(scope="module")
def wanted(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, bytes]:
    """The tables of the undisturbed run."""
    return Ground(tmp_path_factory.mktemp("undisturbed")).wanted


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in FAULTS if name not in {*SLOW, *SECONDS}])
def test_a_fault_is_told_and_loses_nothing(name: str, tmp_path: Path, wanted: Mapping[str, bytes]) -> None:
    tried = FAULTS[name](Ground(tmp_path / "ground", wanted=wanted))
    assert (tried.fault, tried.wrong) == (name, "")


@pytest.mark.slow
def test_runs_at_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As many as a test has time for, with the user's compiled code."""
    monkeypatch.setattr(faults, "AT_ONCE", 2)
    assert at_once(tmp_path, "runs at once", None).wrong == ""


@pytest.mark.slow
def test_no_home(tmp_path: Path) -> None:
    Ground(tmp_path, wanted={})
    done = subprocess.run(
        [sys.executable, "-c", POINTS], cwd=tmp_path, capture_output=True, text=True,
        env=environment_of(faults.NO_HOME) | {"PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "[100.]\n")
    assert "compiled code is not kept" in done.stderr
    assert "Traceback" not in done.stderr
