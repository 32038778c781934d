"""Bending between tool joints: Lubinski's dog-leg, compression, lateral weight, and when the body touches."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import solve_banded

from fctd import Case, equilibrium
from fctd.model.section import section_of
from fctd.results.hanging_body import USUAL, USUAL_TOOL_JOINT, bend_body, give_of, may_yield
from fctd.results.profile import von_mises
from tests.cases import make_case, pipe
from tests.compiled import kept

INCH, POUND, FOOT = 0.0254, 4.4482216152605, 0.3048
# 5 in 19.5 lb/ft: EI [N m²], half of a joint of 30 ft [m], by how much tool joints of 6 5/8 in stand out [m].
EI = 30e6 * 6894.757 * math.pi / 64 * ((5 * INCH) ** 4 - (4.276 * INCH) ** 4)
HALF, ROOM = 180 * INCH, 0.8125 * INCH
DOGLEG = math.radians(3.25) / (100 * FOOT)
body = kept(bend_body)
give = kept(give_of)
matters = kept(may_yield)


def factor(tension: float, dogleg: float = DOGLEG, tool_joint: float = 0.0, weight: float = 0.0) -> tuple[float, float]:
    """Bending over that of the hole, and the share of the room; the weight acts towards the centre of the bend."""
    moment, taken = body(
        tension, EI * dogleg, EI, 2 * HALF, tool_joint, 0.0, ROOM, 0.0, 0.0, dogleg, 0.0, 0.0, weight
    )  # fmt: skip
    return moment / (EI * dogleg) if dogleg else moment, taken


def by_differences(tension: float, dogleg: float, weight: float, tool_joint: float = 0.0, n: int = 4000) -> np.ndarray:
    """Moments from the middle of a body to its end, by finite differences of its slope θ: EI θ'' − T θ = q s.

    The slope is 0 in the middle, and that of half a joint in the hole's bend at the end.
    """
    free = HALF - 0.5 * tool_joint
    h = free / n
    band = np.full((3, n + 1), 1.0 / h**2)  # above, on and below the diagonal
    band[1] = -2.0 / h**2 - tension / EI
    # Of the slope θ: EI θ'' − T θ = −q s, odd in s.
    s = np.linspace(0.0, free, n + 1)
    load = weight * s / EI
    band[0, 1] = band[2, -2] = 0.0
    band[1, [0, -1]] = 1.0
    load[0], load[-1] = 0.0, dogleg * HALF
    slope = solve_banded((1, 1), band, load)
    return EI * np.gradient(slope, s, edge_order=2)


def test_the_dog_leg_of_lubinski() -> None:
    """5 in drill pipe at 200,000 lbf in 3.25°/100 ft: KL/tanh KL = 3.894; KL/sin KL at KL = 1 is 1.188."""
    assert factor(200e3 * POUND)[0] == pytest.approx(3.894, rel=5e-4)
    assert factor(-EI / HALF**2)[0] == pytest.approx(1.188, rel=5e-4)
    assert factor(0.0)[0] == pytest.approx(1.0)


@pytest.mark.parametrize("tension", [900e3, 50e3, 10.0, -10.0, -40e3, -90e3])
@pytest.mark.parametrize("tool_joint", [0.0, 0.6])
@pytest.mark.parametrize("weight", [0.0, 250.0, -250.0])
def test_the_closed_forms_are_those_of_the_beam(tension: float, tool_joint: float, weight: float) -> None:
    moments = by_differences(tension, DOGLEG, weight, tool_joint, 600)
    expected = max(abs(moments[0]), abs(moments[-1]))
    assert factor(tension, DOGLEG, tool_joint, weight)[0] * EI * DOGLEG == pytest.approx(expected, rel=2e-3)


@given(x=st.floats(1e-4, 3.0), sign=st.sampled_from([1.0, -1.0]))
def test_small_loads_and_larger_ones_meet(x: float, sign: float) -> None:
    """The series and the closed forms, on both sides of where one gives way to the other."""
    here, near = (factor(sign * EI * (y / HALF) ** 2)[0] for y in (x, x * 1.0001))
    assert near == pytest.approx(here, rel=2e-3)


def test_the_body_touches_in_sharper_bends_and_when_it_is_pushed() -> None:
    """From 6.8°/100 ft on at 200,000 lbf, and between 60,000 and 80,000 lbf of compression in 3.25°/100 ft."""
    at = math.radians(6.8) / (100 * FOOT)
    assert factor(200e3 * POUND, at)[1] == pytest.approx(1.0, abs=0.01)
    assert factor(-60e3 * POUND)[1] < 1 < factor(-80e3 * POUND)[1]
    assert factor(-2 * EI * (math.pi / HALF) ** 2)[1] == math.inf


def joints(**changes: Any) -> dict[str, Any]:
    """5 in pipe in joints of 30 ft."""
    joint = {"length": 30 * FOOT, "tool_joint_length": 0.02, "tool_joint_diameter": 6.625 * INCH}
    body = {"outer_diameter": 5 * INCH, "inner_diameter": 4.276 * INCH, "youngs_modulus": 30e6 * 6894.757}
    return {"name": "drill pipe", "joint": joint, "linear_mass": 1.0, **body, **changes}


def dogleg(**changes: Any) -> Case:
    """Pipe that carries 200,000 lbf round a bend of 3.25°/100 ft, in air and without friction."""
    bend = 24 / 3.25 * 100 * FOOT
    heavy = pipe(20, 4, linear_mass=200e3 * POUND / 9.80665 / 20)
    hole = {"geometry": "arcs", "intervals": [{"to_md": bend + 80, "diameter": 8.5 * INCH, "friction": 0.0}]}
    stations = [[0, 24, 0], [20, 24, 0], [20 + bend, 0, 0], [80 + bend, 0, 0]]
    return make_case(stations, [heavy, joints(**changes)], wellbore=hole)


@pytest.mark.parametrize("segment", [None, 10.0, 3.0])
def test_a_coarse_string_has_the_bending_of_its_joints(segment: float | None) -> None:
    case = dogleg(segment_length=segment)
    point = equilibrium(case, "rotate_off_bottom", 280.0, rpm=60)
    inside = point.profile[(point.profile["md_m"] > 70) & (point.profile["md_m"] < 200)]
    np.testing.assert_allclose(inside["bending_moment_N_m"] / (EI * DOGLEG), 3.894, rtol=0.01)
    assert point.notes == ()
    without = equilibrium(dogleg(segment_length=segment, joint=None), "rotate_off_bottom", 280.0, rpm=60).profile
    assert without["bending_moment_N_m"].max() / (EI * DOGLEG) < 1.05


SHORT_JOINT = 0.02  # of the resolved strings: Lubinski's tool joints have no length [m]


def one_by_one(count: int, segments: int, mass: float) -> list[dict[str, Any]]:
    """Tool joints and bodies as components of their own, and plain pipe above them; mass [kg/m]."""
    body = {"outer_diameter": 5 * INCH, "inner_diameter": 4.276 * INCH, "linear_mass": mass}
    body["youngs_modulus"] = 30e6 * 6894.757
    tool_joint = body | {"length": SHORT_JOINT, "segments": 1, "contact": "sleeve", "contact_diameter": 6.625 * INCH}
    hanging = body | {"length": 2 * HALF - SHORT_JOINT, "segments": segments}
    parts = [{"name": f"{k}", **part} for k in range(count) for part in (tool_joint, hanging)]
    return [*parts, {"name": "pipe", **body, "segment_length": 8.0}]


def resolved(
    stations: list[list[float]], components: list[dict[str, Any]], kind: str, depth: float, **more: Any
) -> Any:
    """The profile of a string without friction."""
    intervals = [{"to_md": stations[-1][0], "diameter": 8.5 * INCH, "friction": 0.0}]
    hole = {"geometry": "arcs", "stiffness_per_length": 1e9, "intervals": intervals}
    return equilibrium(make_case(stations, components, wellbore=hole, **more), kind, depth).profile


def bar(length: float) -> dict[str, Any]:
    """A weight of 200,000 lbf at the lower end."""
    return pipe(length, 4, outer=6 * INCH, inner=2 * INCH, linear_mass=200e3 * POUND / 9.80665 / length)


@pytest.mark.parametrize(("segments", "closer"), [(16, 0.04), (32, 0.02)])
def test_resolved_tool_joints_bend_as_the_closed_form_says(segments: int, closer: float) -> None:
    """At the tool joint, in the middle of the body, and in the side force: Tκ over a joint, 15.14 kN."""
    bend = 24 / 3.25 * 100 * FOOT
    stations = [[0, 24, 0], [20, 24, 0], [20 + bend, 0, 0], [80 + bend, 0, 0]]
    components = [bar(20.0), *one_by_one(26, segments, 1.0)]
    profile = resolved(stations, components, "rotate_off_bottom", 60 + bend)
    profile = profile[(profile["md_m"] > 20 + 0.25 * bend) & (profile["md_m"] < 20 + 0.75 * bend)]
    bending = profile["bending_moment_N_m"] / (EI * DOGLEG)
    assert bending.max() == pytest.approx(factor(200e3 * POUND)[0], rel=closer)
    x = HALF * math.sqrt(200e3 * POUND / EI)
    assert bending.min() == pytest.approx(x / math.sinh(x), rel=0.02)
    at_joints = profile.loc[profile["contact_force_N"] > 100, "contact_force_N"]
    assert 2 * at_joints.mean() == pytest.approx(15.14e3, rel=0.01)


def test_resolved_tool_joints_in_level_hole_bend_by_the_weight_of_the_body() -> None:
    """The string is level and then turns down, where the bar hangs from it."""
    stations = [[0, 90, 0], [150, 90, 0], [450, 0, 0], [550, 0, 0]]
    low = pipe(330, 66, outer=5 * INCH, inner=4.276 * INCH, linear_mass=0.1)
    profile = resolved(stations, [bar(20.0), low, *one_by_one(14, 32, 31.1)], "rotate_off_bottom", 490.0)
    profile = profile[(profile["md_m"] > 40) & (profile["md_m"] < 110)]
    expected, taken = factor(profile["effective_tension_N"].mean(), 0.0, SHORT_JOINT, 31.1 * 9.80665)
    assert profile["bending_moment_N_m"].max() == pytest.approx(expected, rel=0.03)
    assert 0 < taken < 1


def test_resolved_tool_joints_under_compression_bend_most_in_the_middle_of_the_body() -> None:
    """A build of 3.25°/100 ft, KL about 1; the weight acts against the bend."""
    depth = 50 / 3.25 * 100 * FOOT
    bit = {"weight_on_bit": 58e3}
    profile = resolved([[0, 20, 0], [depth, 70, 0]], one_by_one(48, 16, 5.0), "drill_sliding", depth, bit=bit)
    profile = profile[(profile["md_m"] > 0.5 * depth) & (profile["md_m"] < 0.8 * depth)]
    most = profile.loc[profile["bending_moment_N_m"].idxmax()]
    weight = -5.0 * 9.80665 * math.sin(math.radians(most["inclination_deg"]))
    expected, _ = factor(most["effective_tension_N"], DOGLEG, SHORT_JOINT, weight)
    assert expected > 1.2
    assert most["bending_moment_N_m"] / (EI * DOGLEG) == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("kind", ["rotate_off_bottom", "trip_out"])
def test_the_body_alone_hangs_between_tool_joints(kind: str) -> None:
    """Level, without tension: w l²/3, w the buoyed weight of the body; the wall carries that of the tool joints.

    These bend too, which leaves it a hundredth less.
    """
    hole = {"geometry": "arcs", "intervals": [{"to_md": 900, "diameter": 8.5 * INCH, "friction": 0.0}]}
    part = {"pipe": "5 in 19.5 S-135 NC50", "segment_length": 10.0}
    case = make_case([[0, 90, 0], [900, 90, 0]], [part], wellbore=hole, mud={"density": 1200.0})
    moment = equilibrium(case, kind, 800.0).profile["bending_moment_N_m"].iloc[30]
    body = 9.80665 * math.pi / 4 * (0.127**2 - 0.1086104**2) * (7850 - 1200)
    free = 0.5 * (31.7 * FOOT - 21 * INCH)
    softer = 1 + give(2.5 * INCH, 2.138 * INCH, 3.3125 * INCH) * 10.5 * INCH / free
    assert moment == pytest.approx(body * free**2 / 3 / softer, rel=0.002)


def test_tool_joints_whose_length_is_not_given_are_noted_where_they_matter() -> None:
    """The stress would be beyond the yield strength; with the joints given, that is said."""
    weak = {"yield_strength": 320e6, "segment_length": 10.0}
    silent = dogleg(joint=None, contact_diameter=6.625 * INCH, **weak)
    codes = [note.code for note in equilibrium(silent, "rotate_off_bottom", 280.0, rpm=60).notes]
    assert codes == ["tool_joints"]
    said = equilibrium(dogleg(**weak), "rotate_off_bottom", 280.0, rpm=60)
    assert [note.code for note in said.notes] == ["yield"]


def test_a_body_that_touches_is_noted() -> None:
    narrow = {"length": 30 * FOOT, "tool_joint_length": 0.02, "tool_joint_diameter": 5.3 * INCH}
    point = equilibrium(dogleg(joint=narrow, segment_length=10.0), "rotate_off_bottom", 280.0, rpm=60)
    (note,) = point.notes
    assert (note.code, note.excess > 1) == ("body", True)
    assert "that of a body on the wall" in note.text


def test_mass_and_stiffness_are_those_of_body_and_tool_joints() -> None:
    """By volumes, and by springs in series."""
    joint = {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168, "tool_joint_inner": 0.083}
    case = make_case(components=[pipe(None, 4, joint=joint)])
    plain = section_of(make_case(components=[pipe(None, 4)]).string.components[0], 0.0)
    section = section_of(case.string.components[0], 0.0)
    ratio = (0.168**2 - 0.083**2) / (0.127**2 - 0.07**2)
    assert section.mass == pytest.approx(plain.mass * (9.0 + 0.5 * ratio) / 9.5)
    assert pytest.approx(9.0 / plain.EA + 0.5 / (plain.EA * ratio)) == 9.5 / section.EA
    stiffer = (0.168**4 - 0.083**4) / (0.127**4 - 0.07**4)
    assert pytest.approx(9.0 / plain.GJ + 0.5 / (plain.GJ * stiffer)) == 9.5 / section.GJ
    assert (section.EI, section.contact_radius) == (plain.EI, 0.084)


@given(
    tension=st.floats(-150e3, 2e6), curvature=st.floats(0, 0.02), weight=st.floats(0, 600.0),
    outer=st.floats(0.08, 0.2), wall=st.floats(0.005, 0.03), towards=st.sampled_from([1.0, -1.0]),
)  # fmt: skip
def test_what_is_left_out_of_the_assumed_moment_is_below_half_of_the_yield_strength(
    tension: float, curvature: float, weight: float, outer: float, wall: float, towards: float
) -> None:
    """The bounds hold: the stress of tension and bending with usual joints is at most half of the strength."""
    inner = outer - 2 * wall
    part = pipe(None, 4, outer=outer, inner=inner, contact_diameter=outer + 0.03, yield_strength=400e6)
    section = section_of(make_case(components=[part]).string.components[0], 0.0)
    own = section.EI * curvature
    if matters(np.array(section), weight, tension, own):
        return
    gives = give(0.5 * outer, 0.5 * inner, 0.5 * outer + 0.015)
    moment, _ = body(
        tension, own, section.EI, USUAL, USUAL_TOOL_JOINT, gives, 0.015, 0.0, 0.0, curvature, 0.0, 0.0, towards * weight
    )  # fmt: skip
    assert von_mises(tension, 0.0, moment, 0.5 * outer, 0.5 * inner) <= 0.5 * 400e6 * (1 + 1e-9)
