"""What an answer amounts to: its status, and the reason for it."""

import re

import numpy as np
import pytest

from fctd import equilibrium
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS, NOT_FINITE
from fctd.steady.steady_string import Equilibrium, steady_string
from tests.cases import make_case
from tests.steady.buckled import level_case, problem_of


def judged(times_onset: float, segment: float, code: int = CONVERGED, negative: int = 0) -> Equilibrium:
    """The answer of a level string, with the code of an iteration and a number of unstable modes."""
    case = level_case(times_onset, length=60.0, segment=segment)
    problem = problem_of(case.model_copy(update={"rig": case.rig.model_copy(update={"block_weight": 1e6})}))
    balance(problem, ATTEMPTS)
    return steady_string(
        problem.case,
        problem.hole,
        problem.operation,
        problem.rates,
        problem.laid,
        problem.answer(1),
        code,
        negative,
        "newton",
    )


def test_a_balance_with_an_unstable_mode_is_not_converged() -> None:
    assert judged(0.3, 3.0).status == "converged"
    unstable = judged(0.3, 3.0, negative=2)
    assert (unstable.status, unstable.answered) == ("unstable", True)
    assert unstable.message == "without friction the balance is unstable in 2 modes"


def test_segments_that_cannot_bend_come_before_modes() -> None:
    coarse = judged(1.5, 6.0, negative=1)
    assert coarse.status == "under_resolved"
    assert "segments of 6 m cannot bend that way" in coarse.message


@pytest.mark.parametrize(("code", "status"), [(MAX_ITERATIONS, "max_iterations"), (NOT_FINITE, "not_finite")])
def test_an_iteration_that_found_no_balance_has_no_loads(code: int, status: str) -> None:
    lost = judged(0.3, 3.0, code)
    assert (lost.status, lost.answered) == (status, False)
    # It says how the iterations ended, and nothing of what the string may do.
    assert "may" not in lost.message
    assert np.isnan(lost.without_loads().hookload)


def test_a_pull_of_the_mud_that_is_mostly_yield_stress_is_noted() -> None:
    """Where the law may make it too large by more than a hundredth of the string's weight."""
    found = {}
    for least in (2.0, 30.0):
        mud = {"density": 1200.0, "rheology": {"plastic_viscosity": 0.03, "yield_point": least}}
        case = make_case([[0, 0, 0], [1000, 0, 0]], mud=mud, bit={"end": "closed"})
        found[least] = equilibrium(case, "trip_in", 900.0, speed=0.2)
    assert not found[2.0].notes
    (note,) = found[30.0].notes
    assert note.code == "flow_law"
    (text,) = re.findall(r"the pull of the mud along the string may be (\d+) kN too large", note.text)
    assert 0.03 * found[30.0].lift < 1e3 * float(text) < 0.5 * found[30.0].lift
