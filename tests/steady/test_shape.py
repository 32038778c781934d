"""The data of a profile: walls, loads and buckling belong to the contact points of the string."""

import numpy as np
import pytest

from fctd.model.operations import steady_rates
from fctd.results.buckling import NOT_BUCKLED
from fctd.steady.equilibrium import Solver
from tests.cases import level_case, make_case


def test_loads_and_walls_are_those_of_the_profile() -> None:
    case = make_case([[0, 0, 0], [300, 0, 0], [700, 60, 0], [1000, 60, 0]])
    point = Solver(case).solve("trip_out", steady_rates(case, "trip_out"), 900.0)
    shape, profile = point._shape, point.profile
    assert shape.loads.tension[0] == pytest.approx(point.hookload, rel=1e-6)
    assert np.array_equal(shape.loads.normal, profile["contact_force_N"].to_numpy(float)[1:])
    assert np.array_equal(shape.walls.md, profile["md_m"].to_numpy(float)[1:])
    assert np.array_equal(shape.radius, shape.laid.string.contact_radius())
    assert shape.buckling == NOT_BUCKLED  # all of it is in tension


def test_a_compressed_string_is_judged() -> None:
    case = level_case(bit={"weight_on_bit": 150e3}, solver={"buckling": "detect"})
    point = Solver(case).solve("drill_sliding", steady_rates(case, "drill_sliding"), 150.0)
    assert point._shape.buckling.mode != NOT_BUCKLED.mode
    assert point._shape.buckling == point.buckling
