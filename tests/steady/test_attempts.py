"""The attempts of the rungs: what each of them finds, and what it leaves to the next."""

from collections.abc import Callable

import numpy as np
import pytest

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady import attempts
from fctd.steady.equilibrium import Solver
from fctd.steady.findings import Findings
from fctd.steady.problem import Problem
from fctd.steady.steady_string import Equilibrium
from tests.cases import make_case, pipe
from tests.steady.buckled import level_case


def findings_of(case: Case, length: float = 60.0) -> Findings:
    solver = Solver(case)
    problem = solver.problem("drill_sliding", steady_rates(case, "drill_sliding"), solver.lay_out(length))
    return Findings(case, problem, None, solver.problem, solver.answer)


def after_newton(case: Case) -> Findings:
    so_far = findings_of(case)
    attempts.newton(so_far.problem, so_far)
    return so_far


def test_newton_leaves_a_string_that_would_not_stay_to_the_next_rung() -> None:
    straight = findings_of(level_case(0.5, 60.0, 3.0))
    assert attempts.newton(straight.problem, straight) is straight.first
    pushed = findings_of(level_case(1.5, 60.0, 3.0))
    assert attempts.newton(pushed.problem, pushed) is None
    assert not pushed.is_stable


def test_a_bisected_string_counts_the_iterations_of_newton() -> None:
    so_far = after_newton(level_case(1.5, 60.0, 3.0))
    point = attempts.bisected(so_far.problem, so_far)
    assert point is not None
    assert point.iterations == so_far.path.iterations > so_far.first.iterations


@pytest.mark.parametrize("attempt", [attempts.bisected, attempts.climbed])
def test_a_string_that_is_not_buckled_has_the_loads_of_newton(
    attempt: Callable[[Problem, Findings], Equilibrium | None],
) -> None:
    """Friction acts at its surface, whichever rung finds it; at its axis the contact force is off by 1e-4."""
    bent = [[0.0, 0.0, 0.0], [100.0, 0.0, 0.0], [300.0, 50.0, 0.0], [400.0, 50.0, 0.0]]
    so_far = findings_of(make_case(bent, [pipe(400.0, 40)], bit={"weight_on_bit": 5e3}), 380.0)
    newton = attempts.newton(so_far.problem, so_far)
    so_far.problem.at_axis = 1  # as a rung before leaves it
    found = attempt(so_far.problem, so_far)
    assert newton is not None
    assert found is not None
    assert (found.status, found.buckling.mode) == (newton.status, "none")
    for load in ("hookload", "total_contact_force"):
        assert getattr(found, load) == pytest.approx(getattr(newton, load), abs=1e-6 * so_far.problem.weight)


def test_a_string_without_a_balance_goes_on_to_the_climb(monkeypatch: pytest.MonkeyPatch) -> None:
    """No relaxation and no iteration comes to rest: no rung has a path, and the last one says so."""
    so_far = after_newton(level_case(1.5, 60.0, 3.0))
    for method in ("relax", "iterate"):
        monkeypatch.setattr(so_far.problem, method, lambda *_: (1, 1))
    for attempt in (attempts.bisected, attempts.patient, attempts.climbed):
        assert attempt(so_far.problem, so_far) is None
    assert so_far.has_no_balance is False  # it has been followed
    ended = attempts.as_ended(so_far.problem, so_far)
    assert ended is so_far.ended
    assert ended is not None
    assert ended.message.startswith("the continuation found no steady shape")


def test_an_unstable_balance_keeps_its_loads_and_says_how_its_path_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    so_far = after_newton(level_case(1.5, 60.0, 3.0))
    monkeypatch.setattr(so_far.problem, "relax", lambda *_: (1, 1))
    monkeypatch.setattr(so_far.problem, "iterate", lambda *_: (1, 1))
    attempts.bisected(so_far.problem, so_far)
    attempts.climbed(so_far.problem, so_far)
    point = attempts.as_unstable(so_far.problem, so_far)
    assert point is not None
    assert so_far.ended is not None
    assert (point.status, point.hookload) == (SteadyStatus.UNSTABLE, so_far.first.hookload)
    assert point.message == so_far.ended.message


def test_resolving_lays_out_finer_segments_and_the_case_is_laid_anew_after_it() -> None:
    case = level_case(1.5, 60.0, 6.0, friction=0.2)
    so_far = after_newton(case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": "resolve"})}))
    point = attempts.resolved(so_far.problem, so_far)
    assert point is so_far.resolved
    assert point is not None
    assert len(point.profile) > so_far.problem.n
    assert attempts.as_cut(so_far.problem, so_far) is None  # its balance on the segments of the case is not stable
    so_far.is_stable = True
    assert attempts.as_cut(so_far.problem, so_far) is so_far.first


def test_the_helix_of_segments_that_can_bend_needs_no_force() -> None:
    case = level_case(1.2, 60.0, 0.75, friction=0.1)
    case = case.model_copy(update={"contact": case.contact.model_copy(update={"helical_force": "analytic"})})
    so_far = after_newton(case)
    so_far.found = so_far.first
    assert attempts.with_helix(so_far.problem, so_far) is None
    assert not so_far.problem.given.wall.any()
    assert np.isclose(so_far.found.hookload, so_far.first.hookload)
