"""Unknowns in the coordinates of the fit with scatter: friction by its logarithm, all else as it is."""

import numpy as np
import pytest

from fctd.calibration.scatter import coordinate, slopes_of, values_of, with_friction
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import find_unknowns, parse_fits
from tests.calibration.wells import well

UNKNOWNS = find_unknowns(parse_fits(["friction.cased", "friction.open", "rig.block_weight"]), Setup(), [well()])
VALUES = np.array([0.2, 0.35, 250e3])


def at(values: np.ndarray) -> np.ndarray:
    return np.array([coordinate(unknown, value) for unknown, value in zip(UNKNOWNS, values, strict=True)], float)


def test_values_and_coordinates_are_each_others_inverse() -> None:
    assert values_of(UNKNOWNS, at(VALUES)) == pytest.approx(VALUES, rel=1e-12)


def test_slopes_are_those_of_differences() -> None:
    z, step = at(VALUES), 1e-6
    for k, slope in enumerate(slopes_of(UNKNOWNS, VALUES)):
        aside = np.where(np.arange(len(z)) == k, step * max(1.0, abs(z[k])), 0.0)
        rise = (values_of(UNKNOWNS, z + aside) - values_of(UNKNOWNS, z - aside))[k]
        assert rise / (2 * aside[k]) == pytest.approx(slope, rel=1e-6)


def test_the_effect_of_a_day_scales_friction_alone() -> None:
    found = with_friction(UNKNOWNS, VALUES, np.array(np.log(1.5)))
    assert found == pytest.approx(VALUES * [1.5, 1.5, 1.0])
