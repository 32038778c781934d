"""A level hole with 5 in pipe in it, whose buckling has closed forms."""

import numpy as np

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.steady.equilibrium import Solver
from fctd.steady.problem import Problem
from tests.cases import make_case, pipe

HOLE = 0.2159


def level_case(times_onset: float, length: float = 150.0, segment: float = 1.5, friction: float = 0.0) -> Case:
    """5 in pipe that slides in a level hole, pressed at the bit with a multiple of the onset of snaking."""
    part = pipe(length, None, inner=0.1086, segment_length=segment)
    case = make_case(
        [[0, 90, 0], [length, 90, 0]], [part],
        wellbore={
            "intervals": [{"to_md": length, "diameter": HOLE, "friction": friction}],
            "geometry": "arcs", "stiffness_per_length": 1e6,
        },
        mud={"density": 1200.0},
    )  # fmt: skip
    bit = case.bit.model_copy(update={"weight_on_bit": times_onset * onset(case)})
    return case.model_copy(update={"bit": bit})


def with_tables(case: Case, **tables: dict[str, object]) -> Case:
    return Case.model_validate(case.model_dump(exclude_defaults=True) | tables)


def onset(case: Case) -> float:
    """2√(EI w/r) [N] (Dawson & Paslay 1984)."""
    s = section_of(case.string.components[0], case.mud.density)
    return float(2 * np.sqrt(s.EI * s.weight / (HOLE / 2 - s.contact_radius)))


def problem_of(case: Case) -> Problem:
    """The sliding string of a case, with friction at its axis."""
    rates = steady_rates(case, "drill_sliding", None, None)
    solver = Solver(case)
    problem = solver.problem("drill_sliding", rates, solver.lay_out(case.wellbore.intervals[-1].to_md))
    problem.at_axis = 1
    return problem
