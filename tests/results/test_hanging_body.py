"""Bending between tool joints: Lubinski's dog-leg, compression, lateral weight, and when the body touches."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd import Case, equilibrium
from fctd.mechanics.jit import kernel
from fctd.model.section import section_of
from fctd.results.hanging_body import bend_body
from tests.cases import make_case, pipe

INCH, POUND, FOOT = 0.0254, 4.4482216152605, 0.3048
# 5 in 19.5 lb/ft: EI [N m²], half of a joint of 30 ft [m], by how much tool joints of 6 5/8 in stand out [m].
EI = 30e6 * 6894.757 * math.pi / 64 * ((5 * INCH) ** 4 - (4.276 * INCH) ** 4)
HALF, ROOM = 180 * INCH, 0.8125 * INCH
DOGLEG = math.radians(3.25) / (100 * FOOT)
body = kernel(lambda *given: bend_body(*given))


def factor(tension: float, dogleg: float = DOGLEG, tool_joint: float = 0.0, weight: float = 0.0) -> tuple[float, float]:
    """Bending over that of the hole, and the share of the room; the weight acts towards the centre of the bend."""
    moment, taken = body(
        tension, EI * dogleg, EI, 2 * HALF, tool_joint, ROOM, 0.0, 0.0, dogleg, 0.0, 0.0, weight
    )  # fmt: skip
    return moment / (EI * dogleg) if dogleg else moment, taken


def by_differences(tension: float, dogleg: float, weight: float, tool_joint: float = 0.0, n: int = 4000) -> np.ndarray:
    """Moments from the middle of a body to its end, by finite differences of its slope θ: EI θ'' − T θ = q s.

    The slope is 0 in the middle, and that of half a joint in the hole's bend at the end.
    """
    free = HALF - 0.5 * tool_joint
    h = free / n
    main, beside = np.full(n + 1, -2.0 / h**2 - tension / EI), np.full(n, 1.0 / h**2)
    matrix = np.diag(main) + np.diag(beside, 1) + np.diag(beside, -1)
    load = np.zeros(n + 1)
    # Of the slope θ: EI θ'' − T θ = −q s, odd in s.
    s = np.linspace(0.0, free, n + 1)
    load[:] = weight * s / EI
    matrix[0], matrix[-1] = 0.0, 0.0
    matrix[0, 0] = matrix[-1, -1] = 1.0
    load[0], load[-1] = 0.0, dogleg * HALF
    slope = np.linalg.solve(matrix, load)
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
    assert "closed form" in note.text


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
