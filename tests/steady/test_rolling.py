"""Strings that roll slowly round a vertical hole, against closed forms of the way round."""

import numpy as np
import pytest

from fctd import equilibrium
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.problem import Problem
from fctd.steady.rolling import Roll, roll
from tests.cases import make_case, pipe

DEPTH, FRICTION = 300.0, 0.2


def rolling_case(
    inclination: float = 0.0, drag: float = 20.0, weight_on_bit: float = 9e3, segment: float = 3.0
) -> Case:
    """300 m of 5 in pipe in a straight hole of 12¼ in; its lower end is free."""
    hole = {
        "intervals": [{"to_md": DEPTH, "diameter": 0.31115, "friction": FRICTION}],
        "geometry": "arcs", "stiffness_per_length": 1e6,
    }  # fmt: skip
    part = pipe(None, None, inner=0.1086, segment_length=segment)
    return make_case(
        [[0, inclination, 0], [DEPTH, inclination, 0]], [part], wellbore=hole,
        bit={"weight_on_bit": weight_on_bit}, mud={"density": 1200.0, "viscosity": 0.0, "lateral_damping": drag},
    )  # fmt: skip


def problem_of(case: Case, operation: str = "drill_rotating") -> Problem:
    solver = Solver(case)
    return solver.problem(operation, steady_rates(case, operation, None, None), solver.lay_out(DEPTH))


def rolled(case: Case) -> tuple[Problem, Roll]:
    problem = problem_of(case)
    found = roll(problem)
    assert found.friction == 1
    assert found.imbalance <= problem.allowed
    return problem, found


def test_the_friction_of_the_wall_drives_the_string_as_much_as_the_mud_resists() -> None:
    """Σ μ F_n r = Ω Σ c r², r the offset: the string hardly slides along the hole."""
    problem, found = rolled(rolling_case())
    contacts = problem.reactions().contacts
    walls, drag = problem.walls(contacts), state.row(problem.work.S, state.MUD_LATERAL, problem.n)
    offset = np.linalg.norm(walls.offset, axis=1)
    # Between contact points, at the ends of segments, the string lies on the chord.
    inner = np.concatenate(([walls.offset[0]], walls.offset[:-1]))
    square = ((walls.offset**2 + walls.offset * inner + inner**2) / 3).sum(axis=1)
    driven = FRICTION * float(contacts[:, 3] @ offset)
    assert found.rate < 0  # against the rotation
    assert -found.rate * float(drag @ square) == pytest.approx(driven, rel=0.01)


def test_in_mud_that_resists_twice_as_much_it_rolls_half_as_fast() -> None:
    rates = [rolled(rolling_case(drag=drag))[1].rate for drag in (40.0, 80.0)]
    assert rates[0] == pytest.approx(2 * rates[1], rel=0.02)


def test_a_string_rolls_only_where_it_turns_in_vertical_hole_with_mud_and_friction() -> None:
    assert problem_of(rolling_case()).can_roll
    assert not problem_of(rolling_case(), "drill_sliding").can_roll
    assert not problem_of(rolling_case(inclination=0.2)).can_roll
    assert not problem_of(rolling_case(drag=0.0)).can_roll


@pytest.mark.slow
def test_a_row_says_that_and_how_fast_the_string_rolls() -> None:
    """Without mud the same string has no steady motion that the solver looks for."""
    point = equilibrium(rolling_case(), "drill_rotating", DEPTH)
    assert (point.status, point.answered, point.status.acceptable) == ("rolling", True, True)
    turns = f"{-point.roll_rate * 30 / np.pi:.2g}"
    assert point.message == f"the string rolls round the hole {turns} times a minute, against its rotation"
    assert point.total_contact_force > 10
    # A string that bends shortens by its slope: the hook load is that of the straight string.
    still = equilibrium(rolling_case(drag=0.0), "drill_rotating", DEPTH)
    assert still.status == "unstable"
    assert still.total_contact_force == pytest.approx(0.0, abs=1e-6)
    assert np.isnan(still.roll_rate)
    assert point.hookload == pytest.approx(still.hookload, rel=1e-3)


def test_a_row_whose_slow_roll_ends_before_its_loads_says_where() -> None:
    """Pressed harder, at 21 % of the friction, in segments of 1 m as well."""
    point = equilibrium(rolling_case(weight_on_bit=50e3), "drill_rotating", DEPTH)
    assert point.status == "unstable"
    assert "; its slow roll round the hole was followed up to 20." in point.message
    assert point.message.endswith(" % of the friction")


@pytest.mark.slow
def test_a_resolved_string_rolls_on_segments_that_can_bend_as_it_does() -> None:
    """From long and from short segments at the same rate."""
    rates = []
    for segment in (6.0, 10.0):
        case = rolling_case(weight_on_bit=12e3, segment=segment)
        coarse = equilibrium(case, "drill_rotating", DEPTH)
        assert coarse.status == "under_resolved"
        assert coarse.message.startswith("the string rolls round the hole ")
        fine = case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": "resolve"})})
        point = equilibrium(fine, "drill_rotating", DEPTH)
        assert (point.method, point.buckling.resolved) == ("rolled", True)
        assert point.status == "rolling"
        assert point.roll_rate == pytest.approx(coarse.roll_rate, rel=0.2)
        rates.append(point.roll_rate)
    assert rates[0] == pytest.approx(rates[1], rel=0.02)
