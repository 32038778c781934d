"""Smoothed stations: within the angle, with less false curvature, and exact ones untouched."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.surveys.directions import severity, tangents
from fctd.case.surveys.smoothing import MOST_SMOOTHED, smooth
from fctd.case.surveys.stations import to_radians


def well(count: int = 300) -> Array:
    """Vertical, build, hold, turn and build, hold, in m and degrees; two stations are not evenly apart."""
    md = np.sort(np.append(np.linspace(0, 3000, count - 1), 1234.5))
    inclination = np.interp(md, [0, 500, 1100, 2000, 2400, 3000], [0, 0, 40, 40, 85, 85])
    return np.column_stack([md, inclination, np.interp(md, [0, 2000, 2400], [350, 350, 395])])


def turned(a: Array, b: Array) -> Array:
    """The angles between the directions of two lists of stations [rad]."""
    return np.asarray(2 * np.arcsin(np.minimum(0.5 * np.linalg.norm(tangents(a) - tangents(b), axis=1), 1)))


def curvature_error(a: Array, b: Array) -> float:
    """The root mean square of the difference in curvature [deg/30 m]."""
    difference = np.diff(tangents(a) - tangents(b), axis=0) / np.diff(a[:, 0])[:, None]
    return float(np.degrees(np.sqrt(np.mean(np.sum(difference**2, axis=1)))) * 30)


@pytest.mark.parametrize(("step", "share"), [(1.0, 0.2), (0.1, 0.6)])
def test_it_takes_rounding_out(step: float, share: float) -> None:
    """Of the curvature that rounding adds to a known well, less than this share is left; measured 0.13 and 0.50."""
    exact = to_radians(well())
    rounded = to_radians(np.column_stack([well()[:, 0], np.round(well()[:, 1:] / step) * step]))
    angle = float(turned(exact, rounded).max())
    smoothed = smooth(rounded, angle)
    assert curvature_error(smoothed, exact) < share * curvature_error(rounded, exact)
    assert severity(smoothed).max() < severity(exact).max() + 0.25 * (severity(rounded).max() - severity(exact).max())


@settings(max_examples=15, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    angle=st.floats(1e-4, 0.02),
    count=st.integers(3, 40),
    least=st.sampled_from([1e-3, 1.0]),
)
def test_no_direction_turns_by_more_than_the_angle(seed: int, angle: float, count: int, least: float) -> None:
    rng = np.random.default_rng(seed)
    stations = np.column_stack(
        [np.cumsum(rng.uniform(least, 50, count)) - least, rng.uniform(0, 60, count), rng.uniform(0, 360, count)]
    )
    stations[0] = 0.0
    before = to_radians(stations)
    after = smooth(before, angle)
    assert np.array_equal(after[:, 0], before[:, 0])
    assert np.all(after[:, 1] >= 0)
    assert np.all(np.abs(np.diff(after[:, 2])) <= np.pi + 1e-12)
    # The limits of the program are met to its tolerance, 1e-7; on the sphere a turn is an arctangent, which is less.
    assert np.all(turned(after, before) <= angle + 1e-6)


def test_what_has_even_curvature_stays() -> None:
    """Straight sections and builds of whole degrees: no turn saves variation, so none is made."""
    md = np.arange(0.0, 1000.0, 10.0)
    straight = to_radians(np.column_stack([md, np.full(100, 30.0), np.full(100, 40.0)]))
    assert np.array_equal(smooth(straight, 0.01), straight)
    vertical = to_radians(np.column_stack([md, np.zeros(100), np.arange(100)]))
    assert np.array_equal(smooth(vertical, 0.01), vertical)


def test_a_vertical_hole_stays_vertical() -> None:
    """Azimuths of rounded inclinations spin; with 0.1 deg to turn by in both directions, the hole is straight."""
    rng = np.random.default_rng(5)
    stations = to_radians(np.column_stack([np.arange(0.0, 500.0, 10.0), np.full(50, 0.1), rng.uniform(0, 360, 50)]))
    assert severity(stations).max() > 0.5
    assert severity(smooth(stations, np.radians(0.1415))).max() < 1e-3


def test_short_and_long_surveys() -> None:
    two = to_radians(np.array([[0, 0, 0], [100, 10, 0.0]]))
    assert np.array_equal(smooth(two, 0.01), two)
    many = np.zeros((MOST_SMOOTHED + 1, 3))
    with pytest.raises(InputError, match="at most 5000 stations to smooth, found 5001"):
        smooth(many, 0.01)
