"""Runs with other rounding: what they are called, where they are kept, which processes they are."""

import os
import sys
from pathlib import Path

import pytest

from fctd.case.solver import PERTURBED
from validation.harness import targets, variation
from validation.harness.variation import Variation


@pytest.fixture(autouse=True)
def plain(monkeypatch: pytest.MonkeyPatch) -> None:
    """An environment without noise and target, and a processor that has the targets."""
    for name in (PERTURBED, *targets.VARIABLES):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(targets, "environment", lambda name: {"NUMBA_CPU_NAME": name, "OPENBLAS_CORETYPE": "Nehalem"})


def test_each_has_a_folder_of_its_own_beside_the_plain_results(tmp_path: Path) -> None:
    assert Variation().folder(tmp_path) == tmp_path
    asked = [Variation(3), Variation(0), Variation(None, "no-fma"), Variation(3, "no-fma")]
    folders = [each.folder(tmp_path).relative_to(tmp_path) for each in asked]
    assert [folder.name for folder in folders] == ["noise-3", "noise-0", "no-fma", "no-fma-noise-3"]
    assert {folder.parent.name for folder in folders} == {".perturbed"}


def test_a_process_has_one_where_it_began_with_it(monkeypatch: pytest.MonkeyPatch) -> None:
    assert Variation().is_here
    assert not Variation(0).is_here
    monkeypatch.setenv(PERTURBED, "0")
    assert Variation(0).is_here
    assert not Variation(1).is_here
    assert not Variation(0, "no-fma").is_here
    monkeypatch.setenv("NUMBA_CPU_NAME", "no-fma")
    assert Variation(0, "no-fma").is_here


def test_each_runs_in_a_process_that_begins_with_its_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    begun, codes = [], iter([0, 1, 0])
    monkeypatch.setattr(
        variation, "_wait", lambda command, environment: begun.append((command, environment)) or next(codes)
    )
    asked = [Variation(0), Variation(1, "no-fma"), Variation(None, "no-fma")]
    assert variation.in_processes(asked, ["toy", "--quick"]) == 1
    assert [command[3:] for command, _ in begun] == [
        ["toy", "--quick", "--perturbed", "0"],
        ["toy", "--quick", "--perturbed", "1", "--target", "no-fma"],
        ["toy", "--quick", "--target", "no-fma"],
    ]
    assert [environment.get(PERTURBED) for _, environment in begun] == ["0", "1", None]
    assert [environment.get("NUMBA_CPU_NAME") for _, environment in begun] == [None, "no-fma", "no-fma"]
    assert begun[0][1]["PATH"] == os.environ["PATH"]


def test_an_interruption_and_bad_usage_end_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(variation, "_wait", lambda command, environment: 130)
    assert variation.in_processes([Variation(0), Variation(1)], []) == 130


def test_the_process_gives_its_exit_code() -> None:
    program = f"import os, sys; sys.exit(int(os.environ['{PERTURBED}']))"
    assert variation._wait([sys.executable, "-c", program], os.environ | Variation(7).environment) == 7


def test_an_interruption_is_handed_on(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process began another one: it ends, and is waited for."""
    begun = []

    class Process:
        def __init__(self, command, env):
            begun.append(self)
            self.told = self.left = False

        def wait(self):
            if not self.told:
                raise KeyboardInterrupt
            self.left = True
            return 130

        def terminate(self):
            self.told = True

    monkeypatch.setattr(variation.subprocess, "Popen", Process)
    with pytest.raises(KeyboardInterrupt):
        variation._wait(["python"], {})
    assert begun[0].left
