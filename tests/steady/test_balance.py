"""The first balance of a string: stable where there is one, and counted as unstable where it would leave it."""

import pytest

from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import equilibrium
from tests.steady.buckled import level_case, problem_of
from validation.cases import load


def test_a_string_below_its_limit_needs_the_first_attempt_alone() -> None:
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    code, iterations, negative = balance(problem, ATTEMPTS)
    assert (code, negative) == (CONVERGED, 0)
    assert iterations <= ATTEMPTS[0][0]
    assert problem.reactions().imbalance <= problem.allowed


def test_a_balance_is_that_of_the_pose_that_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where every attempt ends unstable, the first of them is put back."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    first = balance(problem, ATTEMPTS)[1]
    monkeypatch.setattr(problem, "unstable_modes", lambda share: 2)
    code, iterations, negative = balance(problem, ATTEMPTS)
    assert (code, negative) == (CONVERGED, 2)
    assert iterations > first
    assert problem.reactions().imbalance <= problem.allowed


def test_a_string_a_thousand_times_as_stiff_as_steel_has_loads() -> None:
    """It has no balance under small loads either, and is found by more patient attempts; its pull is its own weight."""
    case = load("curved_chain", string__components__0__youngs_modulus=206.8e12, wellbore__stiffness=1e10)
    stiff = equilibrium(case, "rotate_off_bottom", 2450.0)
    steel = equilibrium(load("curved_chain", wellbore__stiffness=1e10), "rotate_off_bottom", 2450.0)
    assert stiff.status == "converged"
    assert stiff.surface_torque == pytest.approx(stiff.sum_r_ft, rel=1e-4)
    assert stiff.hookload == pytest.approx(steel.hookload, rel=1e-3)
    assert stiff.surface_torque > steel.surface_torque
