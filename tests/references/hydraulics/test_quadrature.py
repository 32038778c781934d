"""The referee by quadrature against closed forms, and against numbers that others computed."""

import numpy as np
import pytest
from scipy.optimize import brentq

from fctd.case.errors import InputError
from references.hydraulics.flow import Annulus, Mud
from references.hydraulics.quadrature import solve
from references.hydraulics.random_cases import slot_mean
from references.hydraulics.tripping import closed
from references.hydraulics.witnesses import FOOT, GALLON_A_MINUTE, INCH, PSI, YIELD_UNIT, yield_power_law

THIN = Mud(0.0, 0.02, 1.0)
PIPE_IN_HOLE = Annulus(2.5 * INCH, 4.25 * INCH)
CASING = Annulus(5.375 * INCH, 7.375 * INCH)
SPEED = 110 * FOOT / 60


def test_newtonian_annulus() -> None:
    """126.251 Pa/m at 25 L/s, by the textbook's law."""
    a, b = PIPE_IN_HOLE
    shape = b**4 - a**4 - (b**2 - a**2) ** 2 / np.log(b / a)
    answer = solve(PIPE_IN_HOLE, THIN, 0.025)
    assert answer.gradient == pytest.approx(8 * 0.02 * 0.025 / (np.pi * shape), rel=1e-10)
    assert answer.gradient == pytest.approx(126.251, abs=5e-4)
    square = (b**2 - a**2) / (2 * np.log(b / a))
    assert answer.zero_shear**2 == pytest.approx(square, rel=1e-10)
    assert answer.lift == pytest.approx(np.pi * square * answer.gradient, rel=1e-10)


@pytest.mark.parametrize(("ratio", "clinging"), [(0.3, 0.3164), (0.5, 0.3880), (0.7, 0.4411), (0.9, 0.4825)])
def test_clinging_constant(ratio: float, clinging: float) -> None:
    """The share of the wall's speed at which mud must move up to lose no pressure, by the closed form's numbers."""
    annulus = Annulus(0.1 * ratio, 0.1)
    still = brentq(lambda mean: solve(annulus, THIN, mean * annulus.area, 1.0).gradient, -1.0, 0.0, xtol=1e-12)
    assert -still == pytest.approx(clinging, abs=1e-4)


@pytest.mark.parametrize("mud", [Mud(0.0, 0.5, 0.4), Mud(4.0, 0.03, 1.0), Mud(3.0, 0.4, 0.6)])
def test_narrow_annulus_is_a_slot(mud: Mud) -> None:
    annulus = Annulus(0.0999, 0.1)
    answer = solve(annulus, mud, slot_mean(annulus.gap, mud, 6.0) * annulus.area)
    assert answer.gradient == pytest.approx(2 * 6.0 / annulus.gap, rel=1e-6)
    assert answer.lift == pytest.approx(np.pi * annulus.pipe * annulus.hole * answer.gradient, rel=1e-6)


def test_published_surge_of_a_closed_casing() -> None:
    """88.5 psi over 6,400 ft: Bingham with a moving wall."""
    answer = closed(CASING, Mud(6 * YIELD_UNIT, 0.037, 1.0), SPEED)
    assert answer.gradient * 6400 * FOOT / PSI == pytest.approx(88.5, abs=0.05)


def test_lift_of_a_closed_casing() -> None:
    """25.6 kN over 2,000 m of 10¾ in casing in 14¾ in hole, 37 cP."""
    assert closed(CASING, Mud(0.0, 0.037, 1.0), SPEED).lift * 2000 == pytest.approx(25.6e3, rel=0.005)


def test_pumping_past_drill_pipe() -> None:
    """235.3 psi and 36.2 kN over 10,000 ft of 5 in pipe in 8½ in hole at 400 gal/min."""
    mud = yield_power_law({600: 60, 300: 40, 6: 8, 3: 6})
    answer = solve(PIPE_IN_HOLE, mud, 400 * GALLON_A_MINUTE)
    assert answer.gradient * 1e4 * FOOT / PSI == pytest.approx(235.3, abs=0.05)
    assert answer.lift * 1e4 * FOOT == pytest.approx(36.2e3, rel=0.005)


def test_a_wall_that_drags_a_layer_along() -> None:
    """Mud that yields at 5 Pa, sheared out to 70 mm without a gradient, rτ = C; beyond it sticks to the hole."""
    annulus, (limit, viscosity, _) = Annulus(0.06, 0.1), (mud := Mud(5.0, 0.05, 1.0))
    a, edge = annulus.pipe, 0.07
    moment = limit * edge
    speed = (moment * np.log(edge / a) - limit * (edge - a)) / viscosity
    across = (moment * (edge**2 - a**2) / 2 - limit * (edge**3 - a**3) / 3) / viscosity
    for direction in (1, -1):
        answer = solve(annulus, mud, direction * np.pi * (a**2 * speed - across), direction * speed)
        assert abs(answer.gradient) < 1e-9 * limit / annulus.gap
        assert answer.lift == pytest.approx(direction * 2 * np.pi * moment, rel=1e-10)
        assert np.isnan(answer.zero_shear)
        assert abs(answer.hole_stress) < limit < abs(answer.pipe_stress)


def test_rest_and_refusals() -> None:
    assert solve(PIPE_IN_HOLE, Mud(3.0, 0.1, 0.7), 0.0)[:2] == (0.0, 0.0)
    with pytest.raises(InputError, match="that of the pipe below that of the hole"):
        solve(Annulus(0.1, 0.1), THIN, 0.01)
    with pytest.raises(InputError, match="consistency and index above 0"):
        solve(PIPE_IN_HOLE, Mud(0.0, 0.0, 1.0), 0.01)
