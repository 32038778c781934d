"""Bodies that touch the wall between tool joints bend as beams against an obstacle and in strings that resolve them."""

import math
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from fctd import equilibrium
from fctd.results.touching_body import bend_touching
from tests.cases import make_case, pipe
from tests.compiled import kept
from tests.results.test_hanging_body import DOGLEG, EI, FOOT, HALF, INCH, ROOM, SHORT_JOINT, body, joints
from tests.results.test_hanging_body_resolved import TENSION, by_obstacle, dogleg, in_bend

touch = kept(bend_touching)


def touching(
    curvature: float, tension: float, weight: float, room: float, tool_joint: float = 0.5, give: float = 0.3
) -> tuple[float, float]:
    """Moment [N m] and share of the room of a body in joints of 30 ft; the weight acts to the centre of the bend."""
    moment, share = body(
        tension, EI * curvature, EI, 2 * HALF, tool_joint, give, room, 0.0, 0.0, curvature, 0.0, 0.0, weight
    )  # fmt: skip
    return moment, share


# Forces by (Kl)², below 0 in compression.
@pytest.mark.parametrize("pull", [60.0, 15.0, 2.0, 1e-5, 0.0, -1e-5, -2.0, -5.0, -9.0])
@pytest.mark.parametrize(("lever", "give", "bent"), [(0.0, 1.0, 0.0), (0.4, 0.2, 0.006), (0.4, 0.2, -0.003)])
def test_a_body_bends_as_a_beam_against_an_obstacle(pull: float, lever: float, give: float, bent: float) -> None:
    """At the tool joint, in the middle and where it bends most between, from a touch to most of it on the wall."""
    touched = 0
    for free, load, room in ((3.0, 2e3, 0.01), (3.0, 60e3, 0.01), (6.5, 1e3, 0.03), (6.5, 400.0, 0.005)):
        tension, pressed = pull * EI / free**2, load * max(pull, 1.0)
        hanging, moments = (
            by_obstacle(pressed, tension, 2 * free, to_wall, 160, lever, give, bent) for to_wall in (math.inf, room)
        )
        if np.allclose(moments, hanging, rtol=1e-9):
            continue
        end, middle, between, _ = touch(tension, EI, free, lever, give, bent, pressed, room)
        expected = [moments[0], moments[-1], moments.min()]
        found = EI * np.array([end, middle, min(middle, between)])
        np.testing.assert_allclose(found, expected, atol=0.01 * np.abs(moments).max(), rtol=0)
        touched += 1
    assert touched > 1


in_any_hole = given(
    curvature=st.floats(1e-4, 0.02), tension=st.floats(-100e3, 3e6), weight=st.floats(-2000.0, 2000.0),
    tool_joint=st.floats(0.0, 1.0), give=st.floats(0.05, 1.0), share=st.floats(0.05, 1.0),
)  # fmt: skip


@in_any_hole
def test_the_moment_goes_on_where_the_body_touches_and_where_it_lies_on_the_wall(
    curvature: float, tension: float, weight: float, tool_joint: float, give: float, share: float
) -> None:
    """At the first touch, and with any smaller room: a little less of it changes the moment a little."""
    sag = touching(curvature, tension, weight, ROOM, tool_joint, give)[1] * ROOM
    assume(sag > 1e-4)
    (more, less), (wide, narrow) = (
        [touching(curvature, tension, weight, room * (1 + change), tool_joint, give)[0] for change in (1e-7, -1e-7)]
        for room in (sag, share * sag)
    )
    assert less == pytest.approx(more, rel=1e-4)
    assert narrow == pytest.approx(wide, rel=1e-4)


@pytest.mark.parametrize(("tension", "curvature"), [(TENSION, 0.003), (0.0, 0.003), (-150e3, 0.001)])
def test_the_moment_is_continuous_in_the_load(tension: float, curvature: float) -> None:
    """From a body that hangs to one on the wall, by weight that grows a thousandth a step."""
    weights = math.copysign(1.0, tension) * np.geomspace(10.0, 50e3, 8500)
    moments, shares = np.array([touching(curvature, tension, weight, ROOM) for weight in weights]).T
    assert shares[0] < 1 < shares[-1]
    assert (np.abs(np.diff(moments)) < 2e-3 * moments[1:]).all()


def test_in_wide_hole_the_body_hangs_and_in_narrow_hole_it_follows_the_hole() -> None:
    x = HALF * math.sqrt(TENSION / EI)
    wide, narrow = (touching(DOGLEG, TENSION, 0.0, room, 0.0)[0] / (EI * DOGLEG) for room in (1e3, 1e-9))
    assert wide == pytest.approx(x / math.tanh(x))
    assert narrow == pytest.approx(1.0, abs=2e-3)


@given(
    curvature=st.floats(0.0, 0.05), tension=st.floats(-5e6, 1e8), weight=st.floats(-1e4, 1e4),
    tool_joint=st.floats(0.0, 2.0), give=st.floats(0.01, 1.0), room=st.floats(1e-4, 0.1),
)  # fmt: skip
def test_any_body_has_a_moment(
    curvature: float, tension: float, weight: float, tool_joint: float, give: float, room: float
) -> None:
    moment, share = touching(curvature, tension, weight, room, tool_joint, give)
    assert math.isfinite(moment)
    assert share >= 0


@pytest.mark.parametrize(("rate", "tool_joint"), [(6.8, SHORT_JOINT), (10.0, SHORT_JOINT), (10.0, 21 * INCH)])
def test_a_coarse_string_in_a_sharp_bend_has_the_bending_of_a_resolved_one(rate: float, tool_joint: float) -> None:
    """200,000 lbf, in which the body begins to touch at 6.8°/100 ft."""
    cases = (dogleg(n, rate, tool_joint, 2e10, tool_joint_inner=3.25 * INCH) for n in (32, None))
    fine, coarse = (in_bend(case)["bending_moment_N_m"].max() for case in cases)
    assert coarse == pytest.approx(fine, rel=0.02)


def test_a_coarse_string_under_compression_has_the_bending_of_a_resolved_one() -> None:
    """KL = 1.4 and narrow tool joints, in 3.25°/100 ft: most beside the middle of the body, which the wall holds back.

    From KL = π/2 on bodies turn aside by turns, and no string has the symmetric shape of the closed form.
    """
    depth = 50 / 3.25 * 100 * FOOT
    hole: dict[str, Any] = {"geometry": "arcs", "stiffness_per_length": 2e10}
    hole["intervals"] = [{"to_md": depth, "diameter": 7 * INCH, "friction": 0.0}]
    joint = {"length": 2 * HALF, "tool_joint_length": SHORT_JOINT, "tool_joint_diameter": 5.2 * INCH}
    moments = []
    for cut in ({"joint_segments": 16}, {"segment_length": 4.5}):
        part = joints(joint=joint, linear_mass=0.05, **cut)
        bit = {"weight_on_bit": 1.4**2 * EI / HALF**2}
        case = make_case([[0, 20, 0], [depth, 70, 0]], [part], wellbore=hole, bit=bit)
        point = equilibrium(case, "drill_sliding", depth)
        rows = point.profile
        rows = rows[(rows["md_m"] > 0.3 * depth) & (rows["md_m"] < 0.7 * depth)]
        moments.append(rows["bending_moment_N_m"].max())
    assert "body" in {note.code for note in point.notes}
    assert moments[1] == pytest.approx(moments[0], rel=0.01)
    assert moments[1] < 0.9 * EI * DOGLEG * 1.4 / math.sin(1.4)


def test_a_heavy_body_in_level_hole_bends_as_a_resolved_one() -> None:
    """The string turns down at its end, where a light bar hangs from it."""
    stations = [[0, 90, 0], [150, 90, 0], [450, 0, 0], [550, 0, 0]]
    hole: dict[str, Any] = {"geometry": "arcs", "stiffness_per_length": 2e10}
    hole["intervals"] = [{"to_md": 550, "diameter": 8.5 * INCH, "friction": 0.0}]
    low = pipe(330, 66, outer=5 * INCH, inner=4.276 * INCH, linear_mass=0.1)
    light = pipe(20, 4, outer=6 * INCH, inner=2 * INCH, linear_mass=300.0)
    joint = {"length": 2 * HALF, "tool_joint_length": SHORT_JOINT, "tool_joint_diameter": 6.625 * INCH}
    profiles: list[pd.DataFrame] = []
    for cut in ({"joint_segments": 32}, {"segment_length": 9.0}):
        case = make_case(stations, [light, low, joints(joint=joint, linear_mass=300.0, **cut)], wellbore=hole)
        rows = equilibrium(case, "rotate_off_bottom", 490.0).profile
        profiles.append(rows[(rows["md_m"] > 40) & (rows["md_m"] < 110)])
    fine, coarse = (rows["bending_moment_N_m"].max() for rows in profiles)
    assert coarse == pytest.approx(fine, rel=0.03)
