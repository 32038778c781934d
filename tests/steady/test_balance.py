"""The first balance of a string: stable where there is one, and counted as unstable where it would leave it."""

import pytest

from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.continuation import CONVERGED
from tests.steady.buckled import level_case, problem_of


def test_a_string_below_its_limit_needs_the_first_attempt_alone() -> None:
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    code, iterations, negative = balance(problem)
    assert (code, negative) == (CONVERGED, 0)
    assert iterations <= ATTEMPTS[0][0]
    assert problem.reactions().imbalance <= problem.allowed


def test_a_balance_is_that_of_the_pose_that_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where every attempt ends unstable, the first of them is put back."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    first = balance(problem)[1]
    monkeypatch.setattr(problem, "unstable_modes", lambda: 2)
    code, iterations, negative = balance(problem)
    assert (code, negative) == (CONVERGED, 2)
    assert iterations > first
    assert problem.reactions().imbalance <= problem.allowed
