"""Changes of loads by the tangent, also of strings whose segments are laid out anew."""

import numpy as np
import pytest

from fctd.case.load import with_friction
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.sensitivity import Changed, solve_with_changes
from tests.cases import level_case, make_case


def changed(solver: Solver, bit_depth: float, friction: float) -> Changed:
    hole = solver.hole.with_friction(friction)
    return Changed(Solver(with_friction(solver.case, friction), hole, solver.work), solver.lay_out(bit_depth))


def test_the_tangent_equals_a_new_solve_to_second_order() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0], [700, 60, 0], [1000, 60, 0]], wellbore={"geometry": "arcs"})
    solver, string = Solver(case), Solver(case).lay_out(1000.0)
    for kind in ("trip_out", "rotate_off_bottom"):
        rates = steady_rates(case, kind)
        errors = []
        for step in (0.01, 0.005):
            other = changed(solver, 1000.0, 0.2 + step)
            point, (change,) = solve_with_changes(solver, kind, rates, string, [Changed(other.solver, string)])
            again = other.solver.solve_string(kind, rates, string)
            exact = np.array([again.hookload - point.hookload, again.surface_torque - point.surface_torque])
            errors.append(np.linalg.norm(change - exact) / np.linalg.norm(exact))
        assert errors[0] < 0.03
        # The next order is a share of that error, of the size of the step over the factor, 5 %.
        assert errors[1] == pytest.approx(0.5 * errors[0], rel=0.1)


def test_a_resolved_string_is_solved_anew() -> None:
    case = level_case(bit={"weight_on_bit": 150e3})
    solver = Solver(case)
    string = solver.lay_out(150.0)
    rates = steady_rates(case, "drill_sliding")
    other = changed(solver, 150.0, 0.45)
    point, (change,) = solve_with_changes(solver, "drill_sliding", rates, string, [other])
    assert point.shape != "none"
    again = other.solver.solve_string("drill_sliding", rates, string)
    assert change == pytest.approx([again.hookload - point.hookload, again.surface_torque - point.surface_torque])


def test_a_string_without_loads_has_no_changes() -> None:
    case = make_case()
    solver = Solver(case)
    rates = steady_rates(case, "trip_in")
    _, none = solve_with_changes(solver, "trip_in", rates, solver.lay_out(900.0), [])
    assert none.shape == (0, 2)
