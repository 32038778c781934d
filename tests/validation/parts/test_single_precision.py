"""Single precision in a well: rounding of walls, and bodies that do not fall, against closed forms."""

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import build_wellbore, find_contacts
from validation.parts import single_precision as single
from validation.parts.single_precision import by_positions, by_velocities
from validation.studies import precision_in_depth

HEIGHTS = st.floats(20.0, 8000.0)
EXACT = 9.80665 * 0.1**2 / 2


def test_spacing_is_that_of_24_bits() -> None:
    assert single.spacing(600.0) == 2.0**-14
    assert single.spacing(1.0) == 2.0**-24
    assert single.spacing(5000.0) == 2.0**-11


@pytest.mark.parametrize("fall", [by_positions, by_velocities])
def test_in_double_precision_a_body_falls(fall: single.Integrator) -> None:
    """By ½gt(t + h), as any symplectic Euler."""
    assert fall(4000.0, 1e-3, 0.1, np.float64) == pytest.approx(EXACT * 1.01, rel=1e-4)


@given(HEIGHTS)
def test_a_body_without_a_velocity_falls_from_its_estimate_on(height: float) -> None:
    step = single.frozen_by_positions(height)
    assert by_positions(height, 0.97 * step, 0.1, np.float32) == height - float(np.float32(height))
    assert by_positions(height, 1.03 * step, 0.1, np.float32) > 0.5 * EXACT


@given(HEIGHTS, st.floats(1.01, 2.0))
def test_a_body_without_a_velocity_falls_right_from_its_estimate_on(height: float, longer: float) -> None:
    step = longer * single.exact_by_positions(np.ceil(height), 0.05)
    assert single.rounding_error(by_positions, float(np.float32(height)), step, 0.1) < 0.05


def test_the_places_that_others_found_by_descent_on_vertices() -> None:
    """A free sphere of Newton 1.8 in SolverVBD, 0.1 s from rest: 59.7, 38.5, 0 and 0 mm where 49 are right."""
    fallen = [by_positions(*at, 0.1, np.float32) for at in ((1, 1e-4), (100, 1e-3), (600, 1e-3), (4000, 1e-3))]
    assert 1e3 * np.array(fallen) == pytest.approx([59.7, 38.5, 0, 0], abs=0.1)


def test_a_body_with_a_velocity_stops_at_its_estimate() -> None:
    step = single.frozen_by_velocities(4000.0, 0.1)
    assert by_velocities(4000.0, 0.97 * step, 0.1, np.float32) == 0
    assert by_velocities(4000.0, 1.2 * step, 0.1, np.float32) > 0


@pytest.mark.parametrize("geometry", ["cylinders", "arcs"])
def test_pieces_in_single_precision_are_off_by_the_spacing_of_numbers(geometry: str) -> None:
    points, method = single.points_near_the_wall(60), single.Pieces(geometry)
    exact = method.exact(points)
    own = find_contacts(build_wellbore(single.hole_case(geometry)), points.places, single.RADIUS)
    np.testing.assert_allclose(exact, own.penetration, atol=1e-12)
    deep, near = (float(np.abs(found - exact).max()) for found in (method.at(points, 4e3), method.in_chunks(points)))
    assert 0.2 < deep / single.spacing(4900.0) < 1
    assert near < 0.1 * deep


def test_an_origin_makes_the_rounding_small() -> None:
    places = np.array([[1.0, 2.0, 4000.1], [3.0, 4.0, 4010.2]])
    assert np.abs(single.single(places, np.zeros(3)) - places).max() == pytest.approx(1e-4, rel=0.3)
    assert np.abs(single.single(places, np.array([0, 0, 4000.0])) - places).max() < 1e-6


def test_an_engine_in_single_precision_misses_the_check() -> None:
    steps = precision_in_depth.shortest_steps()
    for difference, verdict in ((1e-11, "met"), (2e-3, "missed")):
        today = pd.DataFrame({"engine": ["one"], "difference": [difference]})
        checks = precision_in_depth.step_checks(steps, today)
        assert checks[-1].verdict == verdict
        assert [check.verdict for check in checks[:-1]] == ["met"] * (len(checks) - 1)
