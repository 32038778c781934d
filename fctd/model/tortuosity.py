"""Micro-tortuosity: waves of the hole's axis between the stations of a survey, too short for it to show.

The direction of the hole is turned by a random process of a narrow band of wavelengths, a sum of cosines with random
phases (Shinozuka & Deodatis 1991).  New stations give it to the hole, so that a string feels it through its own
stiffness and contacts, not through its friction factor.
"""

import numpy as np

from fctd.arrays import Array, ceiling
from fctd.case.errors import InputError
from fctd.case.message import Message, quantity
from fctd.case.wall import TortuositySpec
from fctd.model import survey

# Stations for each wave; an arc through a sixteenth of a sine misses it by less than 1 % of the amplitude.
PER_WAVE = 16
# Cosines of the process, and the spread of their wavelengths about the given one.
WAVES, SPREAD = 9, 0.2
# Segments for each wave below which a string cannot follow it.
SEGMENTS_PER_WAVE = 8
MOST_STATIONS = 200_000


def winding(stations: Array, spec: TortuositySpec) -> Array:
    """Stations (m, 3) [m, rad, rad] of a hole that winds about the one through the given stations (n, 3).

    In each of two directions across the hole its axis has the root mean square of a sine of the amplitude.  Equal
    seeds give equal holes.  Raises InputError for too many stations, and ValueError as ``minimum_curvature`` does.
    """
    ends = stations[[0, -1], 0]
    count = int(ceiling((ends[1] - ends[0]) / spec.wavelength * PER_WAVE))
    if count > MOST_STATIONS:
        raise InputError(
            f"a wavelength that needs at most {MOST_STATIONS} stations",
            key="wellbore.tortuosity.wavelength",
            value=quantity(spec.wavelength, "m"),
        )
    md = np.linspace(ends[0], ends[1], count + 1)
    direction = survey.along_courses(survey.minimum_curvature(stations), md)[1]
    tilt = _slopes(md, spec)
    direction = direction + tilt - (tilt * direction).sum(axis=1, keepdims=True) * direction
    inclination = np.arctan2(np.hypot(direction[:, 0], direction[:, 1]), direction[:, 2])
    azimuth = np.unwrap(np.arctan2(direction[:, 1], direction[:, 0]))
    return np.column_stack([md, inclination, azimuth])


def _slopes(md: Array, spec: TortuositySpec) -> Array:
    """Slopes (n, 3) of the process along three axes at depths (n,) [m]."""
    phases = np.random.default_rng(spec.seed).uniform(0, 2 * np.pi, (3, WAVES))
    rates = 2 * np.pi / (spec.wavelength * np.linspace(1 - SPREAD, 1 + SPREAD, WAVES))
    steepness = spec.amplitude * rates / np.sqrt(WAVES)
    return np.stack([np.cos(np.outer(md, rates) + phase) @ steepness for phase in phases], axis=1)


def shortfall(spec: TortuositySpec | None, longest: float) -> Message:
    """What segments of up to ``longest`` [m] lack to follow a winding hole; empty where they can."""
    if spec is None or longest * SEGMENTS_PER_WAVE <= spec.wavelength * (1 + 1e-9):
        return Message("")
    most = spec.wavelength / SEGMENTS_PER_WAVE
    step = 10.0 ** (np.floor(np.log10(most)) - 2)  # so rounded, lengths that differ little are not the same number
    return Message(
        f"segments of {quantity(np.ceil(longest / step - 1e-6) * step, 'm', '.4g')} are too long for tortuosity of "
        f"{quantity(spec.wavelength, 'm')}: use segments of at most "
        f"{quantity(np.floor(most / step + 1e-6) * step, 'm', '.3g')}"
    )


def resolving(spec: TortuositySpec | None) -> float:
    """Longest segment that follows a winding hole [m]."""
    return np.inf if spec is None else spec.wavelength / SEGMENTS_PER_WAVE
