"""Grooves in casing and what they leave, against arithmetic of others, a quadrature and a printed table."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.integrate import quad

from fctd.model.casing_wear import WEAR_UNIT, groove_area, groove_depth

INCH, FOOT, POUND = 0.0254, 0.3048, 4.4482216152605
JOINT, BORE, WALL = 3.25 * INCH, 0.5 * 8.681 * INCH, 0.472 * INCH  # 6 1/2 in tool joint, 9 5/8 in 47 lb/ft casing


def test_a_hundred_hours_of_a_tool_joint() -> None:
    """2000 lbf on a joint of 30 ft, 120 rev/min, wear factor 5e-10/psi: worked by hand, V = WF·F·s."""
    force, sliding = 2000 * POUND / (30 * FOOT), 2 * math.pi * JOINT * 120 * 60 * 100
    area = 5 * WEAR_UNIT * force * sliding
    depth = groove_depth(area, JOINT, BORE, WALL)
    assert area == pytest.approx(26.35e-6, rel=5e-4)
    assert depth == pytest.approx(0.849e-3, rel=1e-3)
    assert depth / WALL == pytest.approx(0.071, abs=5e-4)


@given(share=st.floats(1e-9, 1.0), joint=st.floats(0.04, 0.12), gap=st.floats(1.001, 3.0))
def test_a_depth_comes_back_from_its_area(share: float, joint: float, gap: float) -> None:
    wall, bore = 0.012, gap * joint
    depth = share * wall
    area = groove_area(depth, joint, bore)
    assert groove_depth(area, joint, bore, wall) == pytest.approx(depth, rel=1e-9)


@given(depth=st.floats(1e-6, 0.012), joint=st.floats(0.06, 0.1), gap=st.floats(1.01, 2.0))
def test_the_area_is_what_the_tool_joint_has_beyond_the_bore(depth: float, joint: float, gap: float) -> None:
    bore = gap * joint
    apart = bore - joint + depth
    assume(bore**2 > joint**2 + apart**2)  # the crossings lie on the half of the tool joint that is in the wall
    half = math.sqrt(joint**2 - ((bore**2 - joint**2 - apart**2) / (2 * apart)) ** 2)

    def beyond(y: float) -> float:
        return apart + math.sqrt(joint**2 - y**2) - math.sqrt(bore**2 - y**2)

    assert 2 * quad(beyond, 0.0, half, epsabs=0)[0] == pytest.approx(groove_area(depth, joint, bore), rel=1e-6)


def test_the_wall_is_the_deepest_groove() -> None:
    assert groove_depth(1.0, JOINT, BORE, WALL) == WALL
    assert groove_depth(0.0, JOINT, BORE, WALL) == groove_area(0.0, JOINT, BORE) == 0.0
