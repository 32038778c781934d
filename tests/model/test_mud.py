"""Viscous mud around a string: closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import build_wellbore
from fctd.model.drillstring import lay_out
from fctd.model.mud import added_mass, hole_radius, lateral_damping, resistance
from fctd.model.pieces import INTERVAL_COLUMNS, RADIUS, TO_MD
from fctd.model.sampled_hole import mean_radii
from fctd.model.string_in_hole import damping_of
from tests.calipers import BORE, FIRST, LAST, bent_case
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
    found = [lateral_damping(0.1, 0.1, 1200, 0.02), added_mass(0.1, 0.0, 0.1, 1200), resistance(0.1, 0.1, 0.02)]
    assert np.isfinite(found).all()
    assert found[-1] < 0.1  # N s: a gauge bit of a metre loses 1 N m at 120 rev/min, no thousands


def test_the_hole_beside_the_middle_of_a_segment() -> None:
    intervals = [{"to_md": 500, "diameter": 0.3, "friction": 0.2}, {"to_md": 1000, "diameter": 0.2, "friction": 0.2}]
    case = make_case(wellbore={"intervals": intervals})
    lengths = np.array([100.0, 410.0, 480.0])
    hole = build_wellbore(case)
    assert hole_radius(hole, 0.0, lengths).tolist() == [0.15, 0.15, 0.1]
    assert hole_radius(hole, 300.0, lengths).tolist() == [0.15, 0.1, 0.1]


def test_the_hole_of_a_caliper_is_that_around_a_segment() -> None:
    """A hole that widens from 0.3 to 0.4 m, and its viscous resistance."""
    case = bent_case("sampled", caliper={"rows": [[FIRST, 0.3], [620, 0.3], [720, 0.4], [LAST, 0.4]]})
    hole = build_wellbore(case)
    found = hole_radius(hole, 600.0, np.array([20.0, 100.0, 8.0, 8.0]))
    assert found == pytest.approx([0.15, 0.175, 0.2, 0.2], abs=1e-3)
    assert hole_radius(hole, 0.0, np.array([490.0])) == pytest.approx(0.15)
    assert hole_radius(hole, 990.0, np.array([5.0, 5.0])) == pytest.approx(0.5 * BORE)  # below the log
    # Pipe above the rotary table, wholly and in part, is as if the hole went on there.
    assert hole_radius(hole, -30.0, np.array([20.0, 20.0, 10.0])) == pytest.approx(0.15)
    viscous = case.model_copy(update={"mud": case.mud.model_copy(update={"density": 1200.0, "viscosity": 0.03})})
    string = lay_out(viscous, 740.0)
    around = resistance(string.of("outer"), hole_radius(hole, 0.0, string.length), 0.03)
    assert damping_of(viscous, string, hole)[:, 2] == pytest.approx(around)
    assert around[-10:].max() < around[:10].min()


@given(st.lists(st.floats(0.11, 0.3), min_size=2, max_size=30), st.integers(1, 40))
def test_means_over_segments_have_the_whole_hole(radii: list[float], segments: int) -> None:
    """Whatever the segments are, their lengths times their radii are those of the hole."""
    rows = np.zeros((len(radii), INTERVAL_COLUMNS))
    rows[:, TO_MD], rows[:, RADIUS] = np.linspace(100.0, 1000.0, len(radii)), radii
    ends = np.linspace(0.0, 1200.0, segments + 1)
    parts = mean_radii(rows, ends[:-1], ends[1:])
    whole = 100 * radii[0] + np.trapezoid(rows[:, RADIUS], rows[:, TO_MD]) + 200 * radii[-1]
    assert float(parts.sum()) * 1200 / segments == pytest.approx(whole, rel=1e-12)
    assert min(radii) - 1e-12 <= parts.min() <= parts.max() <= max(radii) + 1e-12
