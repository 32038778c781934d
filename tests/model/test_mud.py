"""Viscous mud around a string: closed forms."""

import numpy as np
import pytest

from fctd.model.mud import added_mass, hole_radius, lateral_damping, resistance
from tests.cases import make_case

INCH = 0.0254
PIPE, IN_HOLE = 2.5 * INCH, 4.25 * INCH
CASING, IN_WIDE_HOLE = 0.5 * 13.375 * INCH, 8.75 * INCH


@pytest.mark.parametrize(("radius", "hole", "expected"), [(PIPE, IN_HOLE, 28.0), (CASING, IN_WIDE_HOLE, 220.0)])
def test_lateral_damping_of_pipe_and_casing(radius: float, hole: float, expected: float) -> None:
    """Mud of 1200 kg/m³ and 20 mPa s at 120 rev/min, computed by hand from the formula."""
    assert lateral_damping(radius, hole, 1200.0, 0.02, 2.0) == pytest.approx(expected, rel=0.02)


def test_lateral_damping_grows_with_the_root_of_viscosity_and_frequency() -> None:
    """In an unbounded fluid it is 4 π^1.5 ρ r √(νf), Stokes's of a cylinder with a thin boundary layer."""
    wide = lateral_damping(PIPE, 1e6, 1000.0, 0.01, 4.0)
    assert wide == pytest.approx(4 * np.pi**1.5 * 1000 * PIPE * np.sqrt(1e-5 * 4))
    assert lateral_damping(PIPE, IN_HOLE, 1200.0, 0.08, 1.0) == pytest.approx(
        2 * float(lateral_damping(PIPE, IN_HOLE, 1200.0, 0.02, 1.0))
    )


def test_added_mass_is_the_displaced_mud_in_a_wide_hole_and_grows_in_a_narrow_one() -> None:
    assert added_mass(PIPE, 0.0, 1e3, 1200.0) == pytest.approx(1200 * np.pi * PIPE**2)
    assert added_mass(PIPE, 0.05, 1e3, 1200.0) == pytest.approx(1200 * np.pi * (PIPE**2 + 0.05**2))
    ratio = (IN_HOLE**2 + PIPE**2) / (IN_HOLE**2 - PIPE**2)
    assert added_mass(PIPE, 0.0, IN_HOLE, 1200.0) == pytest.approx(ratio * 1200 * np.pi * PIPE**2)


def test_a_body_that_fills_its_hole_has_finite_coefficients() -> None:
    found = [lateral_damping(0.1, 0.1, 1200, 0.02), added_mass(0.1, 0.0, 0.1, 1200), *resistance(0.1, 0.1, 0.02)]
    assert np.isfinite(found).all()


def test_the_hole_beside_the_middle_of_a_segment() -> None:
    intervals = [{"to_md": 500, "diameter": 0.3, "friction": 0.2}, {"to_md": 1000, "diameter": 0.2, "friction": 0.2}]
    case = make_case(wellbore={"intervals": intervals})
    lengths = np.array([100.0, 410.0, 480.0])
    assert hole_radius(case, 0.0, lengths).tolist() == [0.15, 0.15, 0.1]
    assert hole_radius(case, 300.0, lengths).tolist() == [0.15, 0.1, 0.1]
