"""Properties of a component per metre, by hand and at their limits."""

import numpy as np
import pytest

from fctd.model.section import section_of, shear_coefficient
from tests.cases import make_case, pipe


def test_shear_coefficient_limits() -> None:
    """Hutchinson 2001: solid circle 6(1+ν)²/(7+12ν+4ν²), thin tube (1+ν)/(2+ν)."""
    for nu in (0.0, 0.3, 0.5):
        solid = 6 * (1 + nu) ** 2 / (7 + 12 * nu + 4 * nu**2)
        assert shear_coefficient(1.0, 0.0, nu) == pytest.approx(solid, rel=1e-12)
        assert shear_coefficient(1.0, 1.0 - 1e-9, nu) == pytest.approx((1 + nu) / (2 + nu), rel=1e-7)


def test_shear_coefficient_between_its_limits() -> None:
    """A bore of half the diameter, ν = 0.3, by hand: 15.84375/24.105."""
    assert shear_coefficient(3.0, 1.5, 0.3) == pytest.approx(15.84375 / 24.105, rel=1e-12)


def test_buoyancy_lowers_weight_and_not_mass() -> None:
    component = make_case(components=[pipe(1000, 20)]).string.components[0]
    air, mud = section_of(component, 0.0), section_of(component, 1570.0)
    assert mud.mass == air.mass == pytest.approx(7850 * np.pi / 4 * (0.127**2 - 0.07**2))
    assert mud.weight == pytest.approx(0.8 * air.weight)


def test_the_weight_is_that_of_steel_and_fluid_inside_less_the_fluid_displaced() -> None:
    """Exact, for air in pipe that floats in; with tool joints the bore is that of the pipe body."""
    component = make_case(components=[pipe(1000, 20, linear_mass=90.0)]).string.components[0]
    bore, displaced = np.pi / 4 * 0.07**2, 90.0 / 7850 + np.pi / 4 * 0.07**2
    for outside, inside in ((1570.0, 0.0), (1200.0, 1800.0), (0.0, 1000.0)):
        section = section_of(component, outside, inside)
        assert section.weight == pytest.approx(9.80665 * (90.0 + inside * bore - outside * displaced))
        body = section.weight - (90.0 - section.EA / 206.8e9 * 7850) * 9.80665 * (1 - outside / 7850)
        assert section.body_weight == pytest.approx(body)
        weightless = {"weight": 0.0, "body_weight": 0.0, "wave_weight": 0.0}
        assert section._replace(**weightless) == section_of(component, 0.0)._replace(**weightless)
    assert section_of(component, 1570.0, 1570.0) == section_of(component, 1570.0)


def test_section_by_hand() -> None:
    """5 in 19.5 lb/ft pipe: numbers worked out from the formulas of a hollow circle."""
    component = make_case(components=[pipe(1000, 20)]).string.components[0]
    section = section_of(component, 0.0)
    b, a = 0.0635, 0.035
    assert pytest.approx(206.8e9 * 8.819236e-3, rel=1e-6) == section.EA
    assert pytest.approx(206.8e9 * np.pi * (b**4 - a**4) / 4) == section.EI
    assert pytest.approx(206.8e9 / 2.6 * np.pi * (b**4 - a**4) / 2) == section.GJ
    assert section.axial_inertia == pytest.approx(7850 * np.pi * (b**4 - a**4) / 2)
    assert section.weight == pytest.approx(7850 * 8.819236e-3 * 9.80665, rel=1e-6)
    shear_area = shear_coefficient(b, a, 0.3) * np.pi * (b * b - a * a)
    assert section.shear == pytest.approx(206.8e9 / 2.6 * shear_area)
    assert (section.outer, section.inner, section.contact_radius) == (b, a, b)
