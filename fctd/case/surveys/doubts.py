"""Probable mistakes in a survey that can be used: each is a warning that names rows and a remedy.

The limits are chosen so that surveys as wells have them pass: `docs/well.md` lists them.  Stations that are written in
a case are a plan, which few stations describe exactly; a few long courses are a doubt in a file only.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Final

import numpy as np

from fctd.arrays import first_largest
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.surveys.directions import dogleg, severity
from fctd.case.surveys.rounding import rounded, spinning
from fctd.case.surveys.stations import StationKey, Survey
from fctd.case.text import counted

Doubt = Callable[[Survey], Iterator[InputWarning]]

_FEW: Final = 5  # stations
_GAP: Final = 300.0  # [m] without a station ...
_TURN: Final = 5.0  # ... in which the hole turns by more than this [deg]
_NAMED: Final = 5  # rejected stations in a message
_STEEP: Final = 5.0  # [deg]: at a first station below surface, a hole that is not vertical above it
_SLANT: Final = 10.0  # [deg]: at a first station at surface, beyond what is not said to be a slant rig
# Short-radius wells aside, hardly a course bends by more: [deg/30 m], [deg] of the course, [m] of such a hole.
_SHARP, _SEEN, _DEEP_ENOUGH = 15.0, 2.0, 100.0
_HILL: Final = 50.0  # [m]: a crossing of a river or a tunnel may end so far above its start
_OTHER_ZERO: Final = 1.0  # [m]: depths are rounded, and dips of a degree or two left out
_LONGEST: Final = 12_000.0  # [m]: a dozen wells are longer, which were drilled by two or three rigs
# Surveys are taken at connections: stands of three joints are 28 to 30 m or 92 to 96 ft long.
_STANDS: Final = {"m": (91.0, 97.0), "ft": (27.0, 30.3), "usft": (27.0, 30.3)}
_STEPS: Final = 10  # courses, seven of ten of them as long as a stand in the other unit
_SHARE: Final = 0.7


def _tie_in(survey: Survey) -> Iterator[InputWarning]:
    if not survey.tied_in:
        return
    bend = math.degrees(survey.stations[1, 1])
    first = f"{survey.written.values[0, 0]:g} {survey.written.units[0]}"
    text = f"the first station is at {first}, so a vertical station at measured depth 0 was added"
    remedy = "give the survey a station at 0 if the hole is not vertical there"
    if bend > _STEEP:
        text += f", and the hole bends by {bend:.3g} deg between them"
        remedy = "give the survey the stations from the surface down to this one"
    yield InputWarning("tie_in", survey.rows(1, 1), text, remedy)


def _surface(survey: Survey) -> Iterator[InputWarning]:
    slant = math.degrees(survey.stations[0, 1])
    if not survey.tied_in and slant > _SLANT:
        yield InputWarning(
            "surface_inclination",
            survey.rows(0, 0),
            f"the hole starts with an inclination of {slant:.4g} deg",
            "check that inclination and azimuth are not exchanged, and that inclinations are measured from the "
            "vertical: 0 is straight down, 90 level",
        )


def _sharp(survey: Survey) -> Iterator[InputWarning]:
    """Courses that bend as no drilled hole does; one wrong row makes two of them."""
    bend, rate = np.degrees(dogleg(survey.stations)), severity(survey.stations)
    sharp = (rate > _SHARP) & (bend > _SEEN)
    sharp[: survey.tied_in] = False  # told with the station that was added
    if sharp.any() and survey.stations[-1, 0] > _DEEP_ENOUGH:
        worst = first_largest(np.where(sharp, rate, 0.0))
        others = int(sharp.sum()) - 1
        more = f" (and {counted(others, 'more such course')})" if others else ""
        yield InputWarning(
            "dog_leg",
            survey.rows(worst, worst + 1),
            f"the hole bends by {bend[worst]:.3g} deg in "
            f"{quantity(np.diff(survey.stations[:, 0])[worst], 'm', '.4g')}, a dog-leg of "
            f"{quantity(rate[worst], 'deg/30 m', '.3g')}{more}",
            "check these rows and their neighbours for a slip of the pen",
        )


def _few(survey: Survey) -> Iterator[InputWarning]:
    count = len(survey.stations) - survey.tied_in
    if survey.written.file and count < _FEW and np.any(survey.stations[:, 1] > 0.0):
        yield InputWarning(
            "few_stations",
            survey.rows(0, -1),
            f"a well of {count} stations has a single arc between each two",
            "check that the file is complete, or write the stations of a plan into the case (wellbore.stations)",
        )


def _rejected(survey: Survey) -> Iterator[InputWarning]:
    numbers = survey.written.rejected
    if numbers:
        some = ", ".join(map(str, numbers[:_NAMED])) + (", …" if len(numbers) > _NAMED else "")
        yield InputWarning(
            "rejected_stations",
            survey.written.file,
            f"stations that the file marks as rejected are left out: {len(numbers)} ({some})",
            "check that they were rejected for good",
        )


def _above_surface(survey: Survey) -> Iterator[InputWarning]:
    """A hole that rises above its first station: inclinations of a dip, or from another zero."""
    md, inclination = survey.stations[:, 0], survey.stations[:, 1]
    cosines = np.cos(inclination)
    # The mean of the cosines stands for the arc between two stations: only the sign of a depth of metres counts.
    depth = np.concatenate([[0.0], np.cumsum(np.diff(md) * (cosines[1:] + cosines[:-1]) / 2)])
    highest = int(np.argmin(depth))
    if depth[highest] < -_HILL:
        yield InputWarning(
            "above_surface",
            survey.rows(highest, highest),
            f"the hole rises to {quantity(-depth[highest], 'm', '.4g')} above its first station",
            "check that inclinations are measured from the vertical: 0 is straight down, 90 level, 180 straight up",
        )


def _vertical(survey: Survey) -> Iterator[InputWarning]:
    """A true vertical depth below the measured depth, which no hole has."""
    written = survey.written
    if written.vertical is None:
        return
    measured = written.values[:, 0] * written.factors[0]
    below = np.nan_to_num(written.vertical - measured)
    worst = int(np.argmax(below))
    if below[worst] > _OTHER_ZERO:
        yield InputWarning(
            "tvd_below_md",
            written.rows(worst, worst),
            f"a true vertical depth of {quantity(written.vertical[worst], 'm', '.4g')} beside a measured depth of "
            f"{quantity(measured[worst], 'm', '.4g')}, which cannot be less",
            "check that the two columns are not exchanged, and that both begin at the same height",
        )


def _gap(survey: Survey) -> Iterator[InputWarning]:
    if not survey.written.file:
        return
    length, turn = np.diff(survey.stations[:, 0]), np.degrees(dogleg(survey.stations))
    length[: survey.tied_in] = 0.0
    wide = np.flatnonzero((length > _GAP) & (turn > _TURN))
    if len(wide):
        worst = int(wide[np.argmax(turn[wide])])
        more = f" (and {len(wide) - 1} more such gaps)" if len(wide) > 1 else ""
        yield InputWarning(
            "gap_in_curve",
            survey.rows(worst, worst + 1),
            f"no station for {quantity(length[worst], 'm', '.4g')}, in which the hole turns by {turn[worst]:.3g} "
            f"deg{more}",
            "check that no rows are missing; a single arc hides the dog-legs between",
        )


def _radians(survey: Survey) -> Iterator[InputWarning]:
    """Inclinations up to π and azimuths up to 2π that are no whole numbers; a hole that is nearly vertical has azimuths
    all round the compass."""
    if survey.written.units[1:] != ("deg", "deg"):
        return
    angles = np.abs(survey.written.values[:, 1:])
    fractions = np.any(angles % 1.0 != 0.0, axis=0)
    largest = angles.max(axis=0)
    if np.all(fractions) and np.all(largest > 0.1) and np.all(largest <= np.array([math.pi, 2 * math.pi]) + 0.001):
        yield InputWarning(
            "angles_look_like_radians",
            survey.rows(0, -1),
            f"inclinations up to {largest[0]:.4g} and azimuths up to {largest[1]:.4g} are read as degrees and look "
            "like radians",
            "if they are, " + _another_unit(survey, {"inc": "rad", "azi": "rad"}, "degrees"),
        )


def _depth_unit(survey: Survey) -> Iterator[InputWarning]:
    written, unit = survey.written, survey.written.units[0]
    depths = written.values[:, 0]
    steps = np.diff(depths)
    low, high = _STANDS[unit]
    near = steps[(steps > low) & (steps < high)]
    # Steps of one length are those of a plan or of an interpolation.
    stands = len(steps) >= _STEPS and len(near) >= _SHARE * len(steps) and float(np.std(near)) > 0.02
    other, word = ("ft", "feet") if unit == "m" else ("m", "metres")
    if stands:
        text = f"most stations are {np.median(steps):.3g} {unit} apart, which is a stand in {word}"
    elif unit == "m" and depths[-1] > _LONGEST:
        text = f"the well is {quantity(depths[-1] / 1e3, 'km', '.3g')} long, which looks like a depth in feet"
    else:
        return
    yield InputWarning(
        f"depths_look_like_{word}",
        survey.rows(0, -1),
        text,
        f"if the depths are in {word}, " + _another_unit(survey, {"md": other}, "metres"),
    )


def _another_unit(survey: Survey, units: Mapping[StationKey, str], accepted: str) -> str:
    """How to say that columns are in other units: stations in a case have no columns, nor has WITSML.

    Depths of the case follow from the survey: a new case has them right.
    """
    if not survey.written.file:
        return f"write them in {accepted}"
    if not survey.written.has_columns:
        return "correct their unit (uom) in the file"
    options = " ".join(f"--columns {key}.unit={unit}" for key, unit in units.items())
    columns = ", ".join(f'{key} = {{unit = "{unit}"}}' for key, unit in units.items())
    depths = ", and correct its depths" if "md" in units else ""
    return f"write the case anew with fctd init {options}, or say so in the case: columns = {{{columns}}}{depths}"


_DOUBTS: Final[tuple[Doubt, ...]] = (
    _tie_in,
    _surface,
    _few,
    _rejected,
    _above_surface,
    _vertical,
    _sharp,
    _gap,
    _radians,
    _depth_unit,
)


def find(survey: Survey, *, smoothed: bool = False) -> tuple[InputWarning, ...]:
    """The warnings about a survey; about rounding only where the case does not smooth it."""
    doubts = _DOUBTS if smoothed else (*_DOUBTS, spinning, rounded)
    return tuple(warning for doubt in doubts for warning in doubt(survey))
