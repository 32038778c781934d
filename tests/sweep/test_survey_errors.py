"""Errors of a survey: the position spread of a straight well in closed form, and stations that stay possible."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from fctd.model.survey import along_courses, minimum_curvature, tangents
from fctd.sweep.survey_errors import TOOLS, SurveyErrors, erred

DEPTH, COURSE, INCLINATION = 3000.0, 30.0, 0.9


def straight() -> np.ndarray:
    """A straight well from the surface, inclined all the way."""
    md = np.arange(0.0, DEPTH + 1, COURSE)
    return np.column_stack([md, np.full_like(md, INCLINATION), np.full_like(md, 0.4)])


def ends(errors: SurveyErrors, count: int) -> np.ndarray:
    """Ends of wells (count, 3) [m] with drawn errors, from the end of the true one."""
    found = []
    for seed in range(count):
        stations = erred(straight(), errors, np.random.default_rng(seed))
        found.append(along_courses(minimum_curvature(stations), np.array([DEPTH]))[0][0])
    true = along_courses(minimum_curvature(straight()), np.array([DEPTH]))[0][0]
    return np.array(found) - true


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["random", "systematic"])
def test_the_position_spread_of_a_straight_well_is_that_of_the_closed_form(kind: str) -> None:
    """A station turns half of the courses on its sides: their lengths add, or for random errors their squares.

    The first station is known.  Across the well in its vertical plane the spread is σ of the inclination times that
    length, sideways σ of the azimuth times it times the sine of the inclination.
    """
    sd = 0.004
    errors = SurveyErrors.model_validate({f"{kind}_inclination": sd, f"{kind}_azimuth": sd})
    spread = ends(errors, 2000)
    count = round(DEPTH / COURSE)
    weights = np.full(count, COURSE)
    weights[-1] /= 2
    length = np.sqrt((weights**2).sum()) if kind == "random" else weights.sum()
    tangent = np.array([np.sin(INCLINATION) * np.cos(0.4), np.sin(INCLINATION) * np.sin(0.4), np.cos(INCLINATION)])
    sideways = np.array([-np.sin(0.4), np.cos(0.4), 0.0])
    upwards = np.cross(sideways, tangent)
    # The standard error of a standard deviation of 2,000 draws is 1.6 %.
    assert (spread @ upwards).std() == pytest.approx(sd * length, rel=0.03)
    assert (spread @ sideways).std() == pytest.approx(sd * length * np.sin(INCLINATION), rel=0.03)


def test_tools_have_their_deviations_and_keys_go_before_them() -> None:
    tool = SurveyErrors.model_validate({"tool": "mwd", "random_azimuth": "1 deg"})
    assert tool.deviations.systematic_inclination == pytest.approx(np.radians(TOOLS["mwd"].systematic_inclination))
    assert tool.deviations.random_azimuth == pytest.approx(np.radians(1.0))


def test_no_error_at_all_is_refused() -> None:
    with pytest.raises(ValidationError, match="a tool, one of mwd"):
        SurveyErrors.model_validate({"random_azimuth": 0})


@given(st.lists(st.tuples(st.floats(0, np.pi), st.floats(-7, 7)), min_size=2, max_size=8), st.integers(0, 2**32))
def test_drawn_stations_are_those_of_a_hole(angles: list[tuple[float, float]], seed: int) -> None:
    stations = np.array([(30.0 * k, inc, azi) for k, (inc, azi) in enumerate(angles)])
    errors = SurveyErrors.model_validate({"random_inclination": 0.2, "systematic_azimuth": 0.2})
    found = erred(stations, errors, np.random.default_rng(seed))
    assert (found[:, 1] >= 0).all()
    assert (found[:, 1] <= np.pi).all()
    assert (found[0] == stations[0]).all()
    assert (found[:, 0] == stations[:, 0]).all()


@pytest.mark.parametrize("inclination", [0.01, np.pi - 0.01])
def test_an_inclination_drawn_beyond_an_end_points_the_same_way(inclination: float) -> None:
    """The direction is that of the angles without the turn; the drawn errors are those of a level well."""
    level = np.column_stack([30.0 * np.arange(40), np.full(40, 0.5 * np.pi), np.full(40, 0.4)])
    near = level.copy()
    near[:, 1] = inclination
    errors = SurveyErrors.model_validate({"random_inclination": 0.02, "random_azimuth": 0.02})
    found = erred(near, errors, np.random.default_rng(1))
    angles = near + erred(level, errors, np.random.default_rng(1)) - level
    assert ((angles[:, 1] < 0) | (angles[:, 1] > np.pi)).sum() > 5
    np.testing.assert_allclose(tangents(found), tangents(angles), atol=1e-12)
