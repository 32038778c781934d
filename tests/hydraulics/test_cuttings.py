"""Cuttings: how fast they sink and rise, and what they weigh; by hand from Moore's correlation."""

import numpy as np
import pytest

from fctd.case.rheology import Rheology
from fctd.hydraulics.cuttings import Cuttings, share_of_cuttings, slip_speed, transport_ratio

G = 9.80665
ROCK = Cuttings(rate=0.01, size=0.006, density=2600.0)


def test_pieces_sink_by_moores_three_friction_factors() -> None:
    """40/Re in honey, 22/√Re in mud, 1.5 in water: f = 4/3 g d (ρ_s − ρ)/(ρ v²)."""
    viscosity, density = np.array([10.0, 0.05, 1e-4]), 1200.0
    found = slip_speed(ROCK, viscosity, density)
    reynolds = density * found * 0.006 / viscosity
    friction = 4 / 3 * G * 0.006 * 1400 / (density * found**2)
    assert friction == pytest.approx([40 / reynolds[0], 22 / np.sqrt(reynolds[1]), 1.5])
    assert slip_speed(ROCK, 0.05, 2600.0) == 0


def test_cuttings_rise_with_the_mud_less_what_they_sink() -> None:
    ratio = transport_ratio(
        ROCK, Rheology.newtonian(np.full(3, 0.05)), 1200.0, np.array([1.0, 0.05, 1.0]), 0.05, np.array([0.0, 0.0, 1.0])
    )
    slip = float(slip_speed(ROCK, 0.05, 1200.0))
    assert ratio[:2] == pytest.approx([1 - slip, 1 - slip / 0.05])
    assert ratio[1] < 0
    assert np.isnan(ratio[2])  # steeper than 30°


def test_cuttings_take_their_share_of_the_annulus() -> None:
    """Of 0.04 m² of hole at 0.01 m/s and 0.03 m³/s of mud; more where they rise slower, none known in steep hole."""
    feed = 0.04 * 0.01 / (0.04 * 0.01 + 0.03)
    found = share_of_cuttings(ROCK, np.array([1.0, 0.5, -1.0, np.nan]), 0.04, 0.03)
    assert found == pytest.approx([feed, 2 * feed, 20 * feed, 0.0])
