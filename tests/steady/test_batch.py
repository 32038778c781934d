"""Many rows in one compiled call: each is what it is alone, whatever the batch, the order and the threads."""

import numpy as np
import pytest

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.steady.batch import Batches, Row, on_threads, solve_batch
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.laws import hole_of
from fctd.steady.problem import Workspace
from fctd.steady.reading import HOOKLOAD, SHAPE, SOLVED, STEPS, SUM_NORMAL, Answer
from tests.cases import make_case, pipe

KINDS = ["trip_in", "trip_out", "drill_rotating"]
DEPTHS = [550.0, 700.0, 810.0, 900.0]


def case_of(**bend: str) -> Case:
    """A build to 60 degrees; the upper component reaches the surface."""
    components = [pipe(20.0, 2, **bend), pipe(100.0, 5, outer=0.16), pipe(None, None, segment_length=20.0)]
    return make_case([[0, 0, 0], [300, 0, 0], [900, 60, 0]], components, bit={"weight_on_bit": 2e4, "torque": 1e3})


def rows_of(case: Case) -> tuple[Solver, list[Row]]:
    solver = Solver(case)
    rates = {kind: steady_rates(case, kind) for kind in KINDS}
    strings = [solver.lay_out(depth) for depth in DEPTHS]
    return solver, [Row(laid, k, kind, rates[kind]) for laid in strings for kind in KINDS for k in range(2)]


def same(first: Answer, second: Answer) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(first, second, strict=True))


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_row_is_the_same_in_any_batch_on_any_number_of_threads(threads: int) -> None:
    solver, rows = rows_of(case_of())
    holes = [solver.hole, solver.hole.with_friction(0.4)]
    whole = solve_batch(solver.case, hole_of(solver.case, holes), rows, Workspace(60))
    assert all(answer.numbers[SOLVED] for answer in whole)
    parts = [range(k, min(k + 5, len(rows))) for k in range(0, len(rows), 5)]
    batches = Batches(solver.case, holes)
    found = on_threads(lambda part: batches.solve([rows[k] for k in part]), parts, threads)
    found = [answer for some in found for answer in some]
    assert all(map(same, whole, found))
    backwards = solve_batch(solver.case, hole_of(solver.case, holes), rows[::-1], Workspace(60))
    assert all(map(same, whole, backwards[::-1]))


def test_a_row_alone_is_that_of_the_batch() -> None:
    solver, rows = rows_of(case_of())
    whole = solve_batch(solver.case, hole_of(solver.case, [solver.hole] * 2), rows, Workspace(60))
    for row, answer in zip(rows, whole, strict=True):
        point = solver.solve_string(row.operation, row.rates, row.laid)
        assert point.hookload == answer.numbers[HOOKLOAD]
        assert point.iterations == answer.numbers[STEPS]
        assert point.total_contact_force == answer.numbers[SHAPE + SUM_NORMAL]


def test_a_row_is_that_of_the_methods_in_python() -> None:
    """The same compiled parts in the same order: to the last bit but for the tangent of an arc at the bit."""
    solver, rows = rows_of(case_of())
    hole = hole_of(solver.case, [solver.hole] * 2)
    for row, answer in zip(rows, solve_batch(solver.case, hole, rows, Workspace(60)), strict=True):
        point = solver.solve_problem(solver.problem(row.operation, row.rates, row.laid))
        by_hand = solver.finish(row.operation, row.rates, row.laid, answer)
        assert (by_hand.hookload, by_hand.surface_torque) == (point.hookload, point.surface_torque)
        assert (by_hand.status, by_hand.iterations) == (point.status, point.iterations)
        assert by_hand.profile.equals(point.profile)


def test_a_bent_housing_is_left_to_python_without_its_neighbours() -> None:
    case = case_of(bend="1 deg")
    solver, rows = rows_of(case)
    straight = Row(LaidString(case_of(), solver.hole, rows_of(case_of())[1][0].laid.string), *rows[0][1:])
    mixed = solve_batch(case, hole_of(case, [solver.hole] * 2), [rows[0], straight], Workspace(60))
    assert [answer.numbers[SOLVED] for answer in mixed] == [0.0, 1.0]


def test_without_a_balance_there_is_no_answer() -> None:
    """A weight that no segment of this string can carry."""
    solver, rows = rows_of(case_of())
    case = solver.case.model_copy(update={"bit": solver.case.bit.model_copy(update={"weight_on_bit": 1e9})})
    row = next(row for row in rows if row.operation == "drill_rotating")
    (answer,) = solve_batch(case, hole_of(case, [solver.hole]), [row._replace(friction=0)], Workspace(60))
    assert not answer.numbers[SOLVED]
