"""Long helices of tubing against what is published of them, as rows of their cases give them."""

import numpy as np
import pytest

from fctd import Equilibrium, equilibrium
from fctd.case.load import Case
from fctd.model.section import section_of
from tests.cases import make_case

INCH, FOOT, POUND = 0.0254, 0.3048, 4.4482216152605
LENGTH, PRESS = 10_000 * FOOT, 20_000 * POUND


def tubing_case(
    length: float, press: float, inclination: float = 0.0, friction: float = 0.0, torque: float = 0.0
) -> Case:
    """2⅞ in tubing in casing of 6.095 in, 5.81 lb/ft in mud (Lubinski, Althouse & Logan 1962), buckling resolved."""
    part = {
        "name": "tubing", "outer_diameter": 2.875 * INCH, "inner_diameter": 2.441 * INCH, "segment_length": 10.0,
        "linear_mass": 5.81148 * POUND / FOOT / 9.80665, "youngs_modulus": 30e6 * POUND / INCH**2,
    }  # fmt: skip
    hole = {"intervals": [{"to_md": length, "diameter": 6.095 * INCH, "friction": friction}]}
    return make_case(
        [[0, inclination, 0], [length, inclination, 0]], [part], wellbore=hole,
        bit={"weight_on_bit": press, "torque": torque}, solver={"buckling": "resolve"},
    )  # fmt: skip


def winding(point: Equilibrium, start: float, end: float) -> tuple[float, float]:
    """Rate of a helix between two depths [rad/m], and its compression [N]."""
    part = point.profile[point.profile["md_m"].between(start, end)]
    angle = np.unwrap(np.arctan2(part["offset_right_m"], part["offset_high_m"]))
    rate = (angle[-1] - angle[0]) / float(np.ptp(part["md_m"]))
    return float(rate), -float(part["effective_tension_N"].mean())


@pytest.mark.slow
@pytest.mark.parametrize("inclination", [0.0, 0.5, 1.0])
def test_the_example_of_1962_is_a_row_like_any_other(inclination: float) -> None:
    """Its allowance of work was too small; in slightly inclined hole the path from small loads ended before them."""
    point = equilibrium(tubing_case(LENGTH, PRESS, inclination), "drill_sliding", LENGTH)
    assert (point.status, point.shape) == ("converged", "helix")
    weight = 5.81148 * POUND / FOOT * LENGTH * np.cos(np.radians(inclination))
    assert point.hookload == pytest.approx(weight - PRESS, rel=1e-4)
    rate, compression = winding(point, LENGTH - 40.0, LENGTH - 10.0)
    EI = section_of(point.case.string.components[0], 0.0).EI
    assert 2 * np.pi / abs(rate) == pytest.approx(2 * np.pi * np.sqrt(2 * EI / compression), rel=0.015)
    if inclination == 0.0:
        # r F³/12EIw, the wall force of the helix from the neutral point down.
        assert point.total_contact_force == pytest.approx(204.11e3, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("friction", [0.0, 0.2])
@pytest.mark.parametrize("torque", [1.5e3, 5e3])
def test_a_torque_at_the_bit_winds_the_helix_its_own_way(friction: float, torque: float) -> None:
    """θ′ = [1.5M + √(2.25M² + 8EIF)]/4EI (Miska & Cunha 1995); such a helix rolled without end."""
    case = tubing_case(1200.0, 7000 * POUND, 0.0, friction, torque)
    point = equilibrium(case, "drill_sliding", 1200.0)
    assert (point.status, point.shape) == ("converged", "helix")
    rate, compression = winding(point, 1100.0, 1180.0)
    EI = section_of(case.string.components[0], 0.0).EI
    exact = (1.5 * torque + np.sqrt(2.25 * torque**2 + 8 * EI * compression)) / (4 * EI)
    assert -rate == pytest.approx(exact, rel=0.01)
