"""The numbers of a shape against those of its arrays."""

import numpy as np

from fctd.case.load import Case
from fctd.model.operations import steady_rates
from fctd.results.buckling import buckling_along
from fctd.results.limits import WORST
from fctd.steady.equilibrium import Solver
from fctd.steady.reading import NOTED, OUTSIDE, SHARES, SUM_NORMAL, SUM_R_FT, SUM_R_MU_FN
from fctd.steady.steady_string import Equilibrium
from fctd.steady.tangent import NORMAL_FORCE, R_FT, R_MU_FN
from tests.cases import make_case, pipe
from tests.results.test_limits import shares_of


def point_of(kind: str, **more: object) -> Equilibrium:
    components = [pipe(100.0, 10, outer=0.16), pipe(None, None, segment_length=10.0)]
    case: Case = make_case([[0, 0, 0], [300, 0, 0], [900, 80, 0]], components, solver={"buckling": "detect"}, **more)
    return Solver(case).solve(kind, steady_rates(case, kind), 900.0)


def test_the_sums_are_those_of_the_contact_points() -> None:
    shape = point_of("drill_rotating")._shape
    for number, column in ((SUM_NORMAL, NORMAL_FORCE), (SUM_R_FT, R_FT), (SUM_R_MU_FN, R_MU_FN)):
        np.testing.assert_allclose(shape.numbers[number], shape.contacts[:, column].sum(), rtol=1e-12)


def test_the_buckled_stretch_is_that_of_the_tension_along_the_string() -> None:
    shape = point_of("drill_sliding", bit={"weight_on_bit": 3e5})._shape
    walls, string = shape.walls, shape.laid.string
    _, expected = buckling_along(
        shape.hole, shape.laid.pipe, string.top_md, walls.md, walls.radius, shape.loads.tension, -3e5
    )
    assert expected.mode != "none"
    assert shape.buckling == expected


def test_segments_outside_and_shares_of_limits_are_found() -> None:
    point = point_of("trip_out")
    sound = point._shape
    assert sound.numbers[OUTSIDE] == 0
    worst = shares_of(sound.laid.string, sound.loads, point.hookload, sound.walls)
    np.testing.assert_allclose(sound.numbers[SHARES:].reshape(-1, WORST), worst, rtol=1e-9)
    assert not sound.numbers[NOTED]
    soft = point_of("trip_out", wellbore={"stiffness": 1e3})._shape
    depth = np.linalg.norm(soft.walls.offset, axis=1) + soft.radius - 2 * soft.walls.radius
    assert soft.numbers[OUTSIDE] == np.argmax(depth > 0) + 1
    assert soft.numbers[SHARES] > 1
    assert soft.numbers[NOTED] == 1
