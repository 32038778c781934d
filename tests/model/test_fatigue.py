"""Dog-legs that bend drill pipe by what RP 7G bears without end, and the amplitudes themselves."""

import numpy as np
import pytest

from fctd.case.pipes.grades import KSI
from fctd.model.capacity import PSI
from fctd.model.fatigue import dogleg_of, endless_amplitude

INCH, POUND, FOOT = 0.0254, 4.4482216152605, 0.3048
OUTER, INNER, MODULUS = 5.0 * INCH, 4.276 * INCH, 30e6 * PSI
STEEL = np.pi / 4 * (OUTER**2 - INNER**2)
STIFFNESS = MODULUS * np.pi / 64 * (OUTER**4 - INNER**4)


@pytest.mark.parametrize(("pull", "degrees"), [(100e3, 5.416), (200e3, 3.252)])
def test_dogleg_of_5_in_e_75(pull: float, degrees: float) -> None:
    """5 in 19.5 lb/ft E-75 in joints of 30 ft, per 100 ft."""
    tension = pull * POUND
    stress = endless_amplitude(75 * KSI, tension / STEEL)
    assert stress is not None
    found = dogleg_of(stress, tension, OUTER, STIFFNESS, MODULUS, 30 * FOOT)
    assert np.degrees(found) * 100 * FOOT == pytest.approx(degrees, rel=5e-4)


def test_without_tension_the_pipe_bends_as_its_hole() -> None:
    assert dogleg_of(1e8, 0.0, OUTER, STIFFNESS, MODULUS, 9.1) == pytest.approx(2e8 / (MODULUS * OUTER))


def test_tension_leaves_less_and_in_the_end_nothing() -> None:
    stresses = [endless_amplitude(135 * KSI, tension * KSI) for tension in (0, 50, 145, 160)]
    assert stresses == pytest.approx([20 * KSI, 20 * KSI * (1 - 50 / 145), 0.0, 0.0], abs=1.0)


def test_other_grades_have_no_amplitude() -> None:
    assert endless_amplitude(105 * KSI, 0.0) is None
