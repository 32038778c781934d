"""Rows in time: a string that stands stays, one that its rotation rolls round the hole moves."""

from typing import Any

import pytest

from fctd import Case, equilibrium
from validation.parts.plausible_rows import drawn
from validation.parts.stepped_rows import MOVING, damped, step


def case_of(index: int) -> tuple[Case, Any]:
    """A plausible string."""
    string = drawn(14, index)
    return Case.model_validate(string.case), string


@pytest.mark.slow
def test_a_steady_string_stays_and_has_the_loads_of_the_solver() -> None:
    case, string = case_of(134)
    kind = "rotate_off_bottom"
    found = step(case, kind, string.bit_depth, string.rates[kind])
    point = equilibrium(case, operation=kind, bit_depth=string.bit_depth, **string.rates[kind])
    assert point.status == "converged"
    assert found.status == "completed"
    assert not found.moves
    assert found.hookload == pytest.approx(point.hookload, rel=1e-3)


@pytest.mark.slow
def test_a_string_without_a_steady_shape_moves() -> None:
    case, string = case_of(62)
    kind = "drill_rotating"
    point = equilibrium(case, operation=kind, bit_depth=string.bit_depth, **string.rates[kind])
    assert point.status == "unstable"
    assert step(case, kind, string.bit_depth, string.rates[kind]).moves


@pytest.mark.slow
def test_a_string_that_rolls_slowly_goes_round_in_time_as_the_solver_says() -> None:
    case, string = case_of(930)
    kind = "drill_rotating"
    found = step(case, kind, string.bit_depth, string.rates[kind])
    point = equilibrium(damped(case), kind, string.bit_depth, **string.rates[kind])
    assert point.status == "rolling"
    assert found.moves
    assert found.sideways < MOVING
    assert found.hookload == pytest.approx(point.hookload, rel=1e-3)
    assert found.round_it == pytest.approx(point.roll_rate, rel=0.1)


@pytest.mark.slow
def test_a_row_that_cannot_run_says_why() -> None:
    _, string = case_of(62)
    heavy = Case.model_validate(string.case | {"bit": {"weight_on_bit": 1e7, "torque": 1.0}})
    found = step(heavy, "drill_rotating", string.bit_depth, string.rates["drill_rotating"])
    assert found.status.startswith("not run: ")
    assert "weight_on_bit" in found.status
    assert not found.moves
