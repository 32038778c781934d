"""The ladder: which rung finds a string, in which order rungs are tried, and what the row then says."""

from dataclasses import replace

import pytest

import fctd
from fctd import torque_drag
from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady import ladder
from fctd.steady.equilibrium import Solver
from fctd.steady.findings import Findings
from fctd.steady.ladder import HELIX, LADDER, NEWTON, Rung
from fctd.steady.problem import Problem
from fctd.steady.steady_string import Equilibrium
from tests.steady.buckled import level_case, with_tables
from validation.cases import load


def solved(case: Case, length: float = 120.0) -> Equilibrium:
    return fctd.equilibrium(case, "drill_sliding", length)


def test_names_of_rungs_differ() -> None:
    names = [rung.name for rung in (*LADDER, HELIX)]
    assert len(set(names)) == len(names)


def test_a_row_has_the_name_of_the_rung_that_found_it() -> None:
    """The same string at less and at more than the onset of buckling, on long segments and on segments that follow."""
    straight, pushed = level_case(0.5, 120.0, 12.0, friction=0.2), level_case(1.6, 120.0, 12.0, friction=0.2)
    assert solved(straight).method == NEWTON
    assert solved(with_tables(straight, contact={"enabled": False})).method == "open"
    assert solved(pushed).method == "bisected"
    assert solved(with_tables(pushed, solver={"buckling": "resolve"})).method == "resolved"
    assert solved(with_tables(pushed, solver={"buckling": "feed"})).method == "fed"
    wound = with_tables(level_case(2.2, 120.0, 12.0, friction=0.2), contact={"helical_force": "analytic"})
    assert solved(wound).method == "analytic helix"


def test_a_string_that_small_loads_do_not_help_is_found_by_the_patient_rung() -> None:
    case = load("curved_chain", string__components__0__youngs_modulus=206.8e12, wellbore__stiffness=1e10)
    assert fctd.equilibrium(case, "rotate_off_bottom", 2450.0).method == "patient"


def test_a_chart_begins_with_the_shape_of_the_row_above() -> None:
    case = level_case(1.25, 150.0, 6.0, friction=0.1)
    case = with_tables(case, solver={"buckling": "resolve"}, rig={"block_weight": 1e6})
    solver, rates = Solver(case), steady_rates(case, "drill_sliding")
    above = solver.solve("drill_sliding", rates, 120.0)
    problem = solver.problem("drill_sliding", rates, solver.lay_out(130.0))
    assert (above.method, solver.solve_problem(problem, above.carried).method) == ("resolved", "carried")


def test_where_nothing_is_missing_of_a_helix_the_rung_before_has_found_it() -> None:
    case = with_tables(level_case(1.5, 40.0, 0.75, friction=0.1), contact={"helical_force": "analytic"})
    assert solved(case, 40.0).method != HELIX.name


def findings_of(case: Case) -> Findings:
    solver = Solver(case)
    problem = solver.problem("drill_sliding", steady_rates(case, "drill_sliding"), solver.lay_out(120.0))
    return Findings(case, problem, None, solver.problem, solver.answer)


def saying(tried: list[str], name: str, message: str | None, sentence: str = "{}", *, is_due: bool = True) -> Rung:
    """A rung that finds the string with a message, or nothing where that is None."""

    def attempt(problem: Problem, so_far: Findings) -> Equilibrium | None:
        tried.append(so_far.rung)
        point = so_far.answer(problem, 0, 1, 0)
        return None if message is None else replace(point, status=SteadyStatus.UNSTABLE, message=message)

    return Rung(name, lambda _: is_due, attempt, sentence)


@pytest.mark.parametrize(
    ("message", "sentence", "said"),
    [
        ("it ends", "{}", "it ends"),
        ("it ends", "it would leave, and {}", "it would leave, and it ends"),
        ("", "it would leave, and {}", ""),
    ],
)
def test_a_row_says_the_sentence_of_its_rung(
    monkeypatch: pytest.MonkeyPatch, message: str, sentence: str, said: str
) -> None:
    tried: list[str] = []
    rungs = (
        saying(tried, "not due", "never", is_due=False),
        saying(tried, "in vain", None),
        saying(tried, "found", message, sentence),
        saying(tried, "after", "never"),
    )
    monkeypatch.setattr(ladder, "LADDER", rungs)
    point = ladder.look_for(findings_of(level_case(0.5, 120.0, 12.0)))
    assert tried == ["in vain", "found"]
    assert (point.method, point.message) == ("found", said)


@pytest.mark.parametrize(("message", "said"), [("it ends", "too much; it ends"), ("", "too much; unstable")])
def test_a_row_says_the_sentence_of_a_rung_before_that_was_in_vain(
    monkeypatch: pytest.MonkeyPatch, message: str, said: str
) -> None:
    tried: list[str] = []
    rungs = saying(tried, "in vain", None, "too much; {}"), saying(tried, "next", None), saying(tried, "found", message)
    monkeypatch.setattr(ladder, "LADDER", rungs)
    assert ladder.look_for(findings_of(level_case(0.5, 120.0, 12.0))).message == said


def test_a_chart_has_no_other_columns_for_its_methods() -> None:
    chart = torque_drag(level_case(0.5, 120.0, 12.0), "drill_sliding", [120.0])
    assert "method" not in chart.columns
