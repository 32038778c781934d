"""The same numbers everywhere: loads of the examples in other processes, and as compiled for other processors.

What is the same to the last bit on one machine is held where it is made: rows on threads and alone
(``tests/steady/test_torque_drag.py``, ``test_laid_string.py``), sweeps (``tests/sweep/test_run.py``), and runs that go
on (``tests/store/test_saver.py``).
"""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests import same_numbers
from tests.same_numbers import LOADS
from validation.harness import targets

ROOT = Path(__file__).parents[1]
TARGET = targets.NO_FMA
# What docs/conventions.md says, of the largest load of a chart or a run.
STEADY = {"hookload_N": 1e-11, "surface_torque_N_m": 1e-11, "total_contact_force_N": 1e-9}
IN_TIME = dict.fromkeys(LOADS, 1e-9)


@pytest.fixture(scope="module")
def here() -> dict[str, list[dict[str, object]]]:
    """The loads that this process finds."""
    return same_numbers.loads()


def elsewhere(environment: dict[str, str]) -> dict[str, list[dict[str, object]]]:
    """The loads that a process with more variables finds."""
    command = [sys.executable, "-m", "tests.same_numbers"]
    done = subprocess.run(command, env=os.environ | environment, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found: dict[str, list[dict[str, object]]] = json.loads(done.stdout)
    return found


@pytest.mark.slow(seconds=60)
def test_another_process_has_them_to_the_last_bit(here: dict[str, list[dict[str, object]]]) -> None:
    assert json.dumps(elsewhere({})) == json.dumps(here)  # as text, where no number equals itself


@pytest.mark.compiles
@pytest.mark.skipif(bool(targets.lacking(TARGET)), reason=f"{TARGET}: {targets.lacking(TARGET)}")
def test_another_processor_has_them_to_the_stated_digits(here: dict[str, list[dict[str, object]]]) -> None:
    there = elsewhere(targets.environment(TARGET))
    assert there.keys() == here.keys()
    assert json.dumps(there) != json.dumps(here)  # other code ran
    for name, rows in here.items():
        limits = IN_TIME if name == same_numbers.RUN else STEADY
        assert [row.get("status") for row in rows] == [row.get("status") for row in there[name]]
        for load in LOADS:
            ours, theirs = (np.array([row[load] for row in each], float) for each in (rows, there[name]))
            np.testing.assert_allclose(
                theirs, ours, rtol=0, atol=limits[load] * np.nanmax(np.abs(ours)), err_msg=f"{name} {load}"
            )
