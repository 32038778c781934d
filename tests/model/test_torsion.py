"""The slowest torsional period of a string."""

import numpy as np
import pytest

from fctd.model.drillstring import lay_out
from fctd.model.torsion import period_of, torsional_period
from tests.cases import make_case, pipe

INERTIA, STIFFNESS = 0.11, 9.4e5  # of 5 in drill pipe, per metre
WAVE = np.sqrt(STIFFNESS / INERTIA)  # [m/s]


def test_a_uniform_string_is_a_quarter_of_a_wave() -> None:
    """Period 4L/c of a shaft held at one end and free at the other; the parts may be cut anyhow."""
    for length in ([3000.0], [1700.0, 1300.0], [10.0] * 300):
        n = len(length)
        assert torsional_period(length, [INERTIA] * n, [STIFFNESS] * n) == pytest.approx(4 * 3000 / WAVE, rel=1e-4)


def test_a_flywheel_below_a_light_shaft() -> None:
    """A massless shaft of stiffness GJ/L with a disc: period 2π √(I L/GJ), the disc of 200 kg m²."""
    found = torsional_period([2000.0, 1.0], [1e-6, 200.0], [STIFFNESS, 1e12])
    assert found == pytest.approx(2 * np.pi * np.sqrt(200 * 2000 / STIFFNESS), rel=1e-4)


def test_a_laid_out_string_is_steel_all_along() -> None:
    """Waves run with √(G/ρ) through plain pipe of any size; mass of joints makes them slower."""
    case = make_case([[0, 0, 0], [1000, 0, 0]], [pipe(None, 40, 0.127, 0.1086)])
    part = case.string.components[0]
    wave = np.sqrt(part.youngs_modulus / (2 * (1 + part.poisson_ratio)) / part.density)
    assert period_of(lay_out(case, 1000.0)) == pytest.approx(4 * 1000 / wave, rel=1e-4)
