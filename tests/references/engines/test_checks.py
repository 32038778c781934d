"""The checks of an engine's run: each detects the fault that it is for, and vibration is none."""

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd
import pytest

from fctd.mechanics import state, topdrive
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from references import engines
from references.engines import Window
from references.engines.checks import axial_period, drift
from references.engines.run import run_window
from tests.cases import pipe
from tests.references.engines.faulty import Faulty, through_the_wall
from tests.references.engines.turning import WINDOW, begun, turning


@pytest.mark.parametrize(
    ("name", "options", "failed"),
    [
        ("bullet", {"step": "12 ms"}, "finite state"),
        pytest.param("mujoco", {"stiffness": "1e3 N/m"}, "end points inside the hole", marks=pytest.mark.slow),
        pytest.param("elastica", {"step": "8 ms"}, "energy", marks=pytest.mark.slow),
        pytest.param("elastica", {"step": "8 ms"}, "chain length", marks=pytest.mark.slow),
    ],
)
def test_a_bad_option_fails_the_check_for_its_error(name: str, options: dict[str, str], failed: str) -> None:
    run = engines.build(name, **options).run(turning(), Window(5.0, 0.5))
    assert run.status == "invalid"
    assert re.search(rf"{failed} \(.*, at most", run.message)
    assert not run.checks.set_index("check").loc[failed, "passed"]


def gained_energy(run: Run) -> None:
    for row in (state.VX, state.VY, state.VZ, state.WZ):
        state.row(run.S, row, run.segments)[:] *= 1.2


def longer(run: Run) -> None:
    n = run.segments
    for place, axis in ((state.X, state.AX), (state.Y, state.AY), (state.Z, state.AZ)):
        run.S[place + n] += 0.2 * run.S[axis + n]


def not_finite(run: Run) -> None:
    run.top[topdrive.SUM_HOOKLOAD] = np.nan


def drifting(run: Run) -> None:
    run.top[topdrive.SUM_HOOKLOAD] *= 1 + 0.05 * (float(run.top[topdrive.TOP_TIME]) - WINDOW.start)


@pytest.mark.parametrize(
    ("fault", "failed"),
    [
        (through_the_wall, "end points inside the hole"),
        (gained_energy, "energy"),
        (longer, "chain length"),
        (not_finite, "finite state"),
        (drifting, "settled hook load"),
    ],
)
def test_a_fault_fails_the_check_for_it(fault: Callable[[Run], None], failed: str) -> None:
    run = run_window(turning(), WINDOW, Faulty(fault))
    assert run.status == "invalid"
    assert failed in run.message
    assert not run.checks.set_index("check").loc[failed, "passed"]


def test_an_engine_that_is_unstable_at_once_is_invalid_with_a_message() -> None:
    """With a step above the stability limit, before the first record."""
    case = turning(wellbore={"geometry": "arcs"})
    run = engines.build("fctd", step=3 * prepare(case)[0].step).run(case, Window(0.0, 1.0))
    assert run.status == "invalid"
    assert "a position or velocity is not finite" in run.message
    assert not run.checks.set_index("check").loc[["finite state", "energy"], "passed"].any()


@pytest.mark.parametrize("bit", [[], [pipe(0.3, 1, outer=0.2159)]], ids=["pipe alone", "a bit as wide as its hole"])
def test_the_same_engine_without_a_fault_is_valid(bit: list[dict[str, Any]]) -> None:
    run = run_window(turning(components=[*bit, pipe(500, 16)]), WINDOW, Faulty())
    assert run.status == "valid", run.message


def test_a_string_rings_with_the_period_of_its_stretch() -> None:
    """A uniform rod held at one end: four times the length over the speed of sound."""
    run = begun(turning([[0, 0, 0], [600, 0, 0]]), Window(0.0, 1.0))
    assert axial_period(run) == pytest.approx(4 * 500 / np.sqrt(206.8e9 / 7850), rel=1e-3)


@pytest.mark.parametrize(("duration", "expected"), [(4.0, 0.0), (6.1, 0.0), (2.5, 0.03054), (1.0, 0.06366)])
def test_vibration_is_no_drift_in_a_window_of_two_periods(duration: float, expected: float) -> None:
    """Exact row means of a sine about 1 with a period of 2 s; a window below two periods is compared in halves."""
    time = np.arange(1, round(duration / 0.05) + 1) * 0.05
    ring = (np.cos(np.pi * (time - 0.05)) - np.cos(np.pi * time)) / np.pi
    history = pd.DataFrame({"time_s": 7 + time, "hookload_N": 1 + ring, "total_contact_force_N": 0.0})
    if duration == 1.0:
        history["hookload_N"] = 1 + (np.sin(np.pi * time) - np.sin(np.pi * (time - 0.05))) / np.pi
    assert drift(7.0, history, 2.0) == pytest.approx(expected, abs=1e-4)
    rising = history.assign(hookload_N=1 + 0.02 * time)
    assert drift(7.0, rising, 2.0) > 0.009
