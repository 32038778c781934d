"""Dog-legs that come from rounded numbers, and what `survey_smoothing` does to them."""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.surveys.directions import severity, tangents
from fctd.case.surveys.smoothing import LARGEST_ANGLE, smooth
from fctd.case.surveys.stations import Survey

_LAST_DIGITS: Final = (1.0, 0.5, 0.25, 0.1, 0.05, 0.01, 0.001)
_FEWEST: Final = 10  # inner stations in bends: with fewer, chance decides
# [deg/30 m]: twice what tenths of a degree make every 10 m, and six times what they make every 30 m.
_FALSE: Final = 0.25
# The change of curvature from course to course over that which rounding makes: about 1 where all of it is rounding, 0
# in a plan with whole numbers, and large where the hole itself turns.
_BY_ROUNDING: Final = (0.4, 1.6)
_FEWEST_VALUES: Final = 5  # of an angle, to tell how it is written
_SPINS: Final = 30.0  # [deg] azimuth from station to station
_FEWEST_SPINS: Final = 3  # of them in the well
_VERTICAL: Final = 0.1  # [deg/30 m] on the mean of a vertical section


def last_digit(values: Array) -> float:
    """The step in which numbers are written, such as 0.1 or 0.25; 0 where it is finer than a thousandth."""
    for step in _LAST_DIGITS:
        parts = values / step
        if np.all(np.abs(parts - np.round(parts)) < 1e-6):
            return step
    return 0.0


def _digits(survey: Survey) -> Array:
    """The steps in which depth, inclination and azimuth are written, in the units of their columns.

    An angle that hardly changes may have no decimals by chance: it is written as the other one is.
    """
    values = survey.written.values
    steps = np.array([last_digit(column) for column in values.T])
    for angle, other in ((1, 2), (2, 1)):
        if len(np.unique(values[:, angle])) < _FEWEST_VALUES:
            steps[angle] = min(steps[angle], last_digit(values[:, other]))
    return steps


def _errors(survey: Survey) -> Array:
    """`_digits` in m, rad, rad."""
    return np.asarray(_digits(survey) * survey.written.factors * np.array([1.0, math.pi / 180, math.pi / 180]))


def rounded(survey: Survey) -> Iterator[InputWarning]:
    """A warning where most of what a hole bends from course to course is rounding."""
    s = survey.stations[int(survey.tied_in) :]
    if len(s) < _FEWEST + 2:
        return
    depth, inclination, azimuth = _errors(survey)
    length = np.diff(s[:, 0])
    curvature = np.diff(tangents(s), axis=0) / length[:, None]
    bend = np.linalg.norm(curvature, axis=1)
    # Rounding to a step is an error of step/√12.  Each direction has one, of which each course has two.
    direction = (inclination**2 + (np.sin(s[:, 1]) * azimuth) ** 2) / 12
    false = np.sqrt(direction[1:] + direction[:-1] + 2 * (bend * depth) ** 2 / 12) / length
    change = np.linalg.norm(np.diff(curvature, axis=0), axis=1)
    by_rounding = np.sqrt(
        direction[2:] / length[1:] ** 2
        + direction[1:-1] * (1 / length[1:] + 1 / length[:-1]) ** 2
        + direction[:-2] / length[:-1] ** 2
        + (bend[1:] * depth / length[1:]) ** 2 / 6
        + (bend[:-1] * depth / length[:-1]) ** 2 / 6
    )
    bends = ((bend[1:] > 0.0) | (bend[:-1] > 0.0)) & (by_rounding > 0.0)
    if np.count_nonzero(bends) < _FEWEST:
        return
    ratio = float(np.median(change[bends] / by_rounding[bends]))
    typical = math.degrees(float(np.median(false[1:][bends]))) * 30.0
    if not _BY_ROUNDING[0] <= ratio <= _BY_ROUNDING[1] or typical < _FALSE:
        return
    across = float(np.max(np.sin(s[:, 1])))
    angle = 0.5 * math.hypot(inclination, across * azimuth) + 0.5 * depth * float(np.median(bend[bend > 0.0]))
    worst, effect = _effect(survey, angle, np.ones(len(survey.stations) - 1, dtype=bool))
    columns = zip(("depths", "inclinations", "azimuths"), _digits(survey), survey.written.units, strict=True)
    steps = [f"{name} to {step:g} {unit}" for name, step, unit in columns if step > 0.0]
    yield InputWarning(
        "rounded_survey",
        survey.rows(worst, worst + 1),
        f"rounding ({', '.join(steps)}) makes dog-legs of about {quantity(typical, 'deg/30 m', '.2g')} in the whole "
        "well",
        effect,
    )


def spinning(survey: Survey) -> Iterator[InputWarning]:
    """A warning where a vertical hole turns because the azimuth of a rounded inclination is any."""
    s, step = survey.stations, _errors(survey)[1]
    vertical = (s[:, 1] > 0.0) & (s[:, 1] <= 2.001 * step)
    spin = np.degrees(np.abs(np.angle(np.exp(1j * np.diff(s[:, 2])))))
    courses = vertical[1:] & vertical[:-1]
    spins = courses & (spin >= _SPINS)
    if np.count_nonzero(spins) < _FEWEST_SPINS:
        return
    bend = float(np.mean(severity(s)[courses]))
    if bend < _VERTICAL:
        return
    first, *_, last = np.flatnonzero(spins)
    # A turn has two components, of which each is bounded by the angle over √2.
    _, effect = _effect(survey, math.sqrt(2.0) * float(s[vertical, 1].max()), courses)
    yield InputWarning(
        "azimuth_noise",
        survey.rows(int(first), int(last) + 1),
        f"the azimuth turns by up to {spin[spins].max():.3g} deg between stations whose inclination is at most "
        f"twice its last digit, which bends a vertical hole by {quantity(bend, 'deg/30 m', '.2g')}",
        effect,
    )


def _effect(survey: Survey, angle: float, courses: NDArray[np.bool_]) -> tuple[int, str]:
    """The course whose dog-leg smoothing reduces most, and what smoothing does to these courses, in words."""
    from scipy.integrate import cumulative_trapezoid

    angle = min(float(f"{1.005 * math.degrees(angle):.2g}"), math.degrees(LARGEST_ANGLE))
    before = np.where(courses, severity(survey.stations), 0.0)
    try:
        smoothed = smooth(survey.stations, math.radians(angle))
    except InputError:  # too many stations, or too close to each other
        return int(np.argmax(before)), "use a survey with more digits"
    after = np.where(courses, severity(smoothed), 0.0)
    turned = tangents(smoothed) - tangents(survey.stations)
    path = cumulative_trapezoid(turned, survey.stations[:, 0], axis=0)
    moved = float(np.linalg.norm(path, axis=1).max())
    return int(np.argmax(before - after)), (
        f'survey_smoothing = "{angle:g} deg" brings the greatest of these dog-legs from {before.max():.3g} to '
        f"{quantity(after.max(), 'deg/30 m', '.3g')}, and moves the path by at most {quantity(moved, 'm', '.2g')}"
    )
