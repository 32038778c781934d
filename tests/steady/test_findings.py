"""What the rungs share: the problem on the case's segments and on finer ones, and when the string is to be resolved."""

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.attempts import newton
from fctd.steady.bisection import bisect
from fctd.steady.climb import Climb
from fctd.steady.equilibrium import Solver
from fctd.steady.findings import Findings
from tests.steady.buckled import level_case


def findings_of(times_onset: float, buckling: str = "detect") -> Findings:
    case = level_case(times_onset, 60.0, 6.0, friction=0.2)
    case = case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": buckling})})
    solver = Solver(case)
    problem = solver.problem("drill_sliding", steady_rates(case, "drill_sliding"), solver.lay_out(60.0))
    return Findings(case, problem, None, solver.problem, solver.answer)


def halved(case: Case) -> Case:
    (pipe,) = case.string.components
    components = (pipe.model_copy(update={"segment_length": 3.0}),)
    return case.model_copy(update={"string": case.string.model_copy(update={"components": components})})


def test_finer_segments_share_the_allowance_of_the_row() -> None:
    so_far = findings_of(1.5)
    finer = so_far.lay_finer(halved(so_far.case))
    assert finer.n == 2 * so_far.problem.n
    assert finer.allowance is so_far.problem.allowance
    assert finer.at_axis == 1


def test_the_segments_of_the_case_are_laid_anew_with_all_of_the_allowance() -> None:
    so_far = findings_of(1.5)
    own, left = so_far.problem, so_far.problem.allowance.left
    so_far.lay_finer(halved(so_far.case)).allowance.left = 0.0
    anew = so_far.lay_anew()
    assert so_far.problem is anew is not own
    assert (anew.n, anew.at_axis, anew.allowance.left) == (own.n, 0, left)


def test_a_string_is_resolved_where_the_case_asks_for_it_and_it_buckles() -> None:
    for times_onset, buckling, expected in ((0.5, "resolve", False), (1.5, "detect", False), (1.5, "resolve", True)):
        so_far = findings_of(times_onset, buckling)
        newton(so_far.problem, so_far)
        assert so_far.is_to_be_resolved == expected


def test_the_end_of_a_path_has_loads_where_the_path_reaches_those_of_the_operation() -> None:
    so_far = findings_of(0.5)
    path = bisect(so_far.problem)
    reached = so_far.end_of(so_far.problem, path)
    assert reached.answered
    assert reached.iterations == path.iterations
    ended = so_far.end_of(so_far.problem, Climb(balances=path.balances, is_cut=True))
    assert (ended.status, ended.answered) == (SteadyStatus.MAX_ITERATIONS, False)


def test_no_end_is_known_before_a_path() -> None:
    so_far = findings_of(0.5)
    assert so_far.has_no_balance
    assert not any((so_far.is_locked_up, so_far.is_too_coarse, so_far.lacks_segments))
