"""Strings that the block feeds: drag, weight on bit, lock-up, and what does not matter."""

import numpy as np
import pytest

import fctd
from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.steady import feed
from fctd.steady.balance import ATTEMPTS, LARGEST_TURN
from fctd.steady.carried_shape import shape_of
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.equilibrium import Solver
from fctd.steady.feed import End, FedString, Start
from fctd.steady.problem import Problem, Share
from tests.cases import make_case, pipe
from tests.steady.buckled import level_case, onset

AT_REST = Share(0.0, 0.0)


def inclined(weight: float = 0.0, friction: float = 0.3) -> Case:
    """Pipe in a straight hole at 60 degrees, which does not buckle."""
    return make_case(
        [[0, 60, 0], [1000, 60, 0]], [pipe(None, None, segment_length=20.0)],
        wellbore={"geometry": "arcs", "intervals": [{"to_md": 1000, "diameter": 0.2159, "friction": friction}]},
        bit={"weight_on_bit": weight},
    )  # fmt: skip


def begun(case: Case, depth: float, kind: str, friction: float = 1.0) -> FedString:
    """The string of a case at rest off bottom."""
    solver = Solver(case)
    problem = solver.problem(kind, steady_rates(case, kind), solver.lay_out(depth))
    problem.at_axis = 1
    rest(problem)
    string = FedString(problem, friction)
    assert string.begin(Start(shape_of(problem, AT_REST), False))
    return string


def rest(problem: Problem) -> None:
    problem.lay_guess(AT_REST)
    pace = Pace(*ATTEMPTS[0], LARGEST_TURN, problem.allowed, problem.allowed)
    assert problem.iterate(pace, AT_REST)[0] == CONVERGED


def test_a_string_at_rest_has_no_friction_and_then_takes_up_all_of_it() -> None:
    """The hook load falls to that of a string that slides, and the bit begins to move."""
    case = inclined()
    string = begun(case, 900.0, "trip_in")
    frictionless = fctd.equilibrium(inclined(friction=0.0), "trip_in", 900.0).hookload
    assert -string.push == pytest.approx(frictionless, rel=1e-3)
    assert string.trip() == End.ARRIVED
    slides = fctd.equilibrium(case, "trip_in", 900.0).hookload
    assert -string.push == pytest.approx(slides, rel=2e-3)
    pushes = np.diff([of.push for of in string.path])
    assert (pushes > -100.0).all()
    assert string.snaps == 0


def test_feed_onto_bottom_gives_the_weight_on_bit_that_the_hook_loses() -> None:
    case = inclined(weight=30e3)
    string = begun(case, 900.0, "drill_sliding")
    assert string.trip() == End.ARRIVED
    off_bottom = string.push
    assert string.press(30e3) == End.ARRIVED
    assert string.path[-1].weight == pytest.approx(30e3, rel=feed.OVERSHOT)
    # In a straight hole all of it comes from the hook.
    assert string.push - off_bottom == pytest.approx(string.path[-1].weight, rel=0.01)
    string.let_go()
    assert string.problem.held is None
    slides = fctd.equilibrium(case, "drill_sliding", 900.0).hookload
    assert -string.push == pytest.approx(slides, rel=0.005)


def test_the_last_increment_does_not_run_past_the_weight_on_bit() -> None:
    for weight in (1e3, 12e3, 60e3):
        string = begun(inclined(weight), 900.0, "drill_sliding")
        string.trip()
        assert string.press(weight) == End.ARRIVED
        assert weight * (1 - feed.REACHED) <= string.path[-1].weight <= weight * (1 + feed.OVERSHOT)


@pytest.mark.parametrize(("friction", "end"), [(0.2, End.ARRIVED), (3.3, End.LOCKED)])
def test_a_level_string_that_winds_itself_up_locks(friction: float, end: End) -> None:
    case = level_case(3.0, 300.0, 1.5, friction)
    weight = 3.1 * onset(case)
    string = begun(case, 300.0, "drill_sliding")
    assert string.trip() == End.ARRIVED
    assert string.press(weight) == end
    if end == End.LOCKED:
        last = string.path[-1]
        then = next(of for of in reversed(string.path) if last.push - of.push >= feed.OVER * string.problem.weight)
        is_out = last.push > feed.LARGEST_PUSH * string.problem.weight
        assert is_out or last.weight - then.weight < feed.ARRIVING * (last.push - then.push)


def test_friction_that_falls_lets_more_of_the_push_arrive() -> None:
    """With the block at rest; fed on, a string that was locked up then arrives."""
    case = level_case(3.0, 300.0, 1.5, friction=3.3)
    weight = 3.1 * onset(case)
    string = begun(case, 300.0, "drill_sliding")
    assert string.trip() == End.ARRIVED
    assert string.press(weight) == End.LOCKED
    locked = string.path[-1]
    assert string.ease(0.1)
    eased = string.path[-1]
    assert (eased.feed, string.friction) == (locked.feed, 0.1)
    assert (eased.weight, -eased.push) > (locked.weight, -locked.push)
    assert eased.weight >= weight or string.feed_on(weight) == End.ARRIVED
