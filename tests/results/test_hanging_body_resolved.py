"""Strings laid joint by joint bend as beams between tool joints do: in tension, compression, by weight, on the wall."""

import math
from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import sparse
from scipy.linalg import solve_banded

from fctd import Case, equilibrium, torque_drag
from fctd.model.section import Section
from fctd.results.hanging_body import SMALL, stiffer
from tests.cases import make_case, pipe
from tests.compiled import kept
from tests.results.test_hanging_body import DOGLEG, EI, FOOT, HALF, INCH, POUND, ROOM, SHORT_JOINT, bar, factor, joints

TENSION = 200e3 * POUND
over_segments = kept(stiffer)
# Segments of a body, by how much the moment in its middle may be off: the error falls fourfold with twice as many, down
# to what the tension of the pipe's own weight does.
FINER = {8: 0.055, 16: 0.017, 32: 0.0075, 64: 0.005}


def dogleg(
    segments: int | None, rate: float = 3.25, tool_joint: float = SHORT_JOINT, wall: float = 1e9, **more: Any
) -> Case:
    """Pipe that carries 200,000 lbf round a bend [°/100 ft], in air and without friction; the bit is at its end.

    wall : stiffness per length [N/m/m].
    """
    bend = 24 / rate * 100 * FOOT
    joint = {"length": 2 * HALF, "tool_joint_length": tool_joint, "tool_joint_diameter": 6.625 * INCH} | more
    cut: dict[str, Any] = {"segment_length": 3.0} if segments is None else {"joint_segments": segments}
    hole: dict[str, Any] = {"geometry": "arcs", "stiffness_per_length": wall}
    hole["intervals"] = [{"to_md": bend + 80, "diameter": 8.5 * INCH, "friction": 0.0}]
    stations = [[0, 24, 0], [20, 24, 0], [20 + bend, 0, 0], [80 + bend, 0, 0]]
    return make_case(stations, [bar(20.0), joints(joint=joint, **cut)], wellbore=hole)


def in_bend(case: Case, kind: str = "rotate_off_bottom") -> pd.DataFrame:
    """The profile of the middle half of the bend."""
    (_, first, last, end) = case.wellbore.trajectory[:, 0]
    profile = equilibrium(case, kind, end - 20).profile
    quarter = 0.25 * (last - first)
    return profile[(profile["md_m"] > first + quarter) & (profile["md_m"] < last - quarter)]


def by_obstacle(
    load: float,
    tension: float,
    length: float,
    room: float,
    n: int = 600,
    lever: float = 0.0,
    give: float = 1.0,
    bent: float = 0.0,
) -> np.ndarray:
    """Moments that a lateral load [N/m] adds to a beam up to a wall, from its end to its middle (n/2 + 1,) [N m].

    EI u'''' − T u'' = load − p by finite differences, with the wall's pressure p ≥ 0 where u is all of the room.  Its
    ends turn with tool joints of half length ``lever`` [m] in a hole of curvature ``bent`` [1/m]; clamped without.
    """
    h = length / n
    values = [EI * bending / h**4 + tension * pull / h**2 for bending, pull in ((1, 0), (-4, -1), (6, 2))]
    offsets = np.arange(2, -3, -1)  # in this order the data are a band of solve_banded
    fourth = sparse.diags_array([*values, *values[1::-1]], offsets=offsets, shape=(n + 1, n + 1))
    # u(−h) = mirrored u(h) + lifted, by u'(0) = lever (give (bent + u'') − bent).
    turns = 0.5 / h + lever * give / h**2
    mirrored, lifted = (0.5 / h - lever * give / h**2) / turns, lever * bent * (1 - give) / turns
    fourth.data[2, [1, -2]] += EI * mirrored / h**4
    loads = np.full(n + 1, load)
    loads[[1, -2]] -= EI * lifted / h**4
    touching, ends = np.zeros(n + 1, bool), np.isin(np.arange(n + 1), [0, n])
    rows = np.clip(np.arange(n + 1) - offsets[:, None], 0, n)
    for _ in range(200):
        held, place = touching | ends, np.where(touching, room, 0.0)
        band = np.where(held[rows], offsets[:, None] == 0, fourth.data)
        u = np.where(held, place, solve_banded((2, 2), band, np.where(held, place, loads)))
        pressure = loads - fourth @ u
        changed = (touching & (pressure >= 0)) | (u > room * (1 + 1e-12))
        changed[[0, -1]] = False
        if (changed == touching).all():
            return EI * np.diff(np.append(mirrored * u[1] + lifted, u), 2)[: n // 2 + 1] / h**2
        touching = changed
    raise AssertionError("the stretch on the wall is not found")


@pytest.mark.parametrize("segments", FINER)
def test_moments_in_the_dog_leg_of_lubinski_converge_with_the_square_of_the_segments(segments: int) -> None:
    """3.894 times the hole's bending at a tool joint (of 20 mm), 0.159 in the middle, and 15.14 kN on the wall."""
    profile = in_bend(dogleg(segments))
    bending = profile["bending_moment_N_m"] / (EI * DOGLEG)
    assert bending.max() == pytest.approx(3.894, rel=0.002)
    x = HALF * math.sqrt(TENSION / EI)
    assert bending.min() == pytest.approx(x / math.sinh(x), rel=FINER[segments])
    touching = profile[profile["contact_force_N"] > 100]
    np.testing.assert_allclose(touching["contact_force_N"], 15.14e3, rtol=0.01)
    # A row of a tool joint has the moment of its ends.
    np.testing.assert_allclose(touching["bending_moment_N_m"] / (EI * DOGLEG), 3.894, rtol=0.002)


@pytest.mark.parametrize("segments", [2, 3, 4])
def test_few_segments_bend_the_tool_joint_as_many_do(segments: int) -> None:
    bending = in_bend(dogleg(segments))["bending_moment_N_m"] / (EI * DOGLEG)
    assert bending.max() == pytest.approx(3.894, rel=0.002)


@given(
    lengths=st.lists(st.floats(0.05, 3.0), min_size=1, max_size=6), odd=st.booleans(), tension=st.floats(-1e5, 5e6),
    tool_joint=st.floats(0.02, 0.9), up=st.sampled_from([1, -1]),
)  # fmt: skip
def test_a_beam_over_its_segments_is_that_of_a_solved_chain(
    lengths: list[float], odd: bool, tension: float, tool_joint: float, up: int
) -> None:
    """Segments of slopes θ between springs, whose outermost are turned by half of the tool joint's end."""
    body = np.array(lengths[:-1] + lengths[::-1] if odd else lengths + lengths[::-1])
    n, stiff = len(body), 6.0
    sections = np.zeros((2, len(Section._fields)))
    sections[:, Section._fields.index("EI")] = EI, stiff * EI
    length = np.append(tool_joint, body) if up == 1 else np.append(body, tool_joint)
    component = np.append(1, np.zeros(n, int)) if up == 1 else np.append(np.zeros(n, int), 1)
    found = over_segments(tension, length, component, sections, 0 if up == 1 else n, up)
    own = 0.5 * tool_joint / (stiff * EI)
    around = np.concatenate([[0.0], body, [0.0]])
    compliance = 0.5 * (around[1:] + around[:-1]) / EI
    compliance[[0, -1]] += own
    k = 1 / compliance
    matrix = np.diag(k[:-1] + k[1:] + tension * body) - np.diag(k[1:-1], 1) - np.diag(k[1:-1], -1)
    right = np.zeros(n)
    right[0] -= k[0]
    right[-1] += k[-1]
    slope = np.linalg.solve(matrix, right) if tension > 0 else right
    x = 0.5 * body.sum() * math.sqrt(max(tension, 0.0) / EI)
    beam = 1 / (own + 0.5 * body.sum() * math.tanh(x) / (x * EI)) if x > 0 else 1.0
    expected = beam / (k[0] * (slope[0] + 1)) if x >= SMALL else 1.0
    assert found == pytest.approx(expected, rel=1e-9)


def test_the_coarse_string_agrees_and_neither_is_corrected_twice() -> None:
    """With tool joints of 20 mm and with real ones, which give way by themselves."""
    for tool_joint in (SHORT_JOINT, 21 * INCH):
        fine, coarse = (in_bend(dogleg(n, tool_joint=tool_joint, tool_joint_inner=3.25 * INCH)) for n in (32, None))
        assert coarse["bending_moment_N_m"].max() == pytest.approx(fine["bending_moment_N_m"].max(), rel=0.01)
        assert coarse["von_mises_Pa"].max() == pytest.approx(fine["von_mises_Pa"].max(), rel=0.01)


def test_no_closed_form_speaks_of_resolved_joints() -> None:
    """Beyond the yield strength that is said, and nothing is assumed of tool joints."""
    case = dogleg(16)
    (heavy, part) = case.string.components
    for strength, codes in ((320e6, ["yield"]), (931e6, [])):
        components = (heavy, part.model_copy(update={"yield_strength": strength}))
        weak = case.model_copy(update={"string": case.string.model_copy(update={"components": components})})
        point = equilibrium(weak, "rotate_off_bottom", 260.0)
        assert [note.code for note in point.notes] == codes


def test_compression_bends_the_middle_of_the_body_most() -> None:
    """KL = 1 without weight: 1.188 times the hole's bending there, 0.642 at the tool joint."""
    depth = 50 / 3.25 * 100 * FOOT
    hole: dict[str, Any] = {"geometry": "arcs", "stiffness_per_length": 1e9}
    hole["intervals"] = [{"to_md": depth, "diameter": 8.5 * INCH, "friction": 0.0}]
    joint = {"length": 2 * HALF, "tool_joint_length": SHORT_JOINT, "tool_joint_diameter": 6.625 * INCH}
    part = joints(joint=joint, joint_segments=32, linear_mass=0.05)
    bit = {"weight_on_bit": EI / HALF**2}
    case = make_case([[0, 20, 0], [depth, 70, 0]], [part], wellbore=hole, bit=bit)
    profile = equilibrium(case, "drill_sliding", depth).profile
    profile = profile[(profile["md_m"] > 0.3 * depth) & (profile["md_m"] < 0.7 * depth)]
    bending = profile["bending_moment_N_m"] / (EI * DOGLEG)
    assert bending.max() == pytest.approx(1.188, rel=0.02)
    assert bending[profile["contact_force_N"] > 100].max() == pytest.approx(0.642, rel=0.02)
    assert bending.min() == pytest.approx(0.642, rel=0.02)


@pytest.mark.parametrize("rate", [5.0, 9.0, 14.0])
def test_a_body_that_touches_bends_as_a_beam_on_a_wall(rate: float) -> None:
    """From 6.8°/100 ft on; the load that presses it there is tension times the curvature of the hole."""
    curvature = math.radians(rate) / (100 * FOOT)
    profile = in_bend(dogleg(32, rate, wall=2e10))  # in which a tool joint of 20 mm sinks by a tenth of a millimetre
    at_end, *_, in_middle = by_obstacle(TENSION * curvature, TENSION, 2 * HALF - SHORT_JOINT, ROOM)
    assert profile["bending_moment_N_m"].max() == pytest.approx(EI * curvature + at_end, rel=0.02)
    body = profile[profile["clearance_m"] > 0.5 * (8.5 - 6) * INCH]
    assert (body["contact_force_N"].max() > 100) == (rate > 6.8)
    if rate < 6.8:
        assert profile["bending_moment_N_m"].min() == pytest.approx(EI * curvature + in_middle, rel=0.03)


def test_the_weight_of_the_body_bends_it_in_level_hole() -> None:
    """As the beam's closed form says; the string turns down at its end, where a bar hangs from it."""
    stations = [[0, 90, 0], [150, 90, 0], [450, 0, 0], [550, 0, 0]]
    low = pipe(330, 66, outer=5 * INCH, inner=4.276 * INCH, linear_mass=0.1)
    joint = {"length": 2 * HALF, "tool_joint_length": SHORT_JOINT, "tool_joint_diameter": 6.625 * INCH}
    hole: dict[str, Any] = {"geometry": "arcs", "stiffness_per_length": 1e9}
    hole["intervals"] = [{"to_md": 550, "diameter": 8.5 * INCH, "friction": 0.0}]
    part = joints(joint=joint, joint_segments=32, linear_mass=25.0)
    case = make_case(stations, [bar(20.0), low, part], wellbore=hole)
    profile = equilibrium(case, "rotate_off_bottom", 490.0).profile
    profile = profile[(profile["md_m"] > 40) & (profile["md_m"] < 110)]
    expected, taken = factor(profile["effective_tension_N"].mean(), 0.0, SHORT_JOINT, 25.0 * 9.80665)
    assert profile["bending_moment_N_m"].max() == pytest.approx(expected, rel=0.02)
    assert 0 < taken < 1


def test_loads_of_a_well_are_those_of_the_coarse_string() -> None:
    """2,950 m with a build and a hold, some 300 joints: within 0.2 %; a chart's rows are those of single strings."""
    stations = [[0, 0, 0], [600, 0, 0], [1500, 60, 0], [3000, 60, 0]]
    hole = {"intervals": [{"to_md": 3000, "diameter": 8.5 * INCH, "friction": 0.25}]}
    below = [pipe(0.3, 1, outer=8.5 * INCH, inner=0.06, name="bit"), pipe(80, 16, outer=0.165, inner=0.0714)]
    coarse, fine = (
        make_case(stations, [*below, {"pipe": "5 in 19.5 S-135 NC50"} | cut], wellbore=hole, mud={"density": 1200.0})
        for cut in ({"segment_length": 10.0}, {"joint_segments": 4})
    )
    kinds, depths = ["trip_in", "trip_out", "rotate_off_bottom"], [2700.0, 2803.0, 2950.0]
    rows, finer = (torque_drag(case, kinds, depths) for case in (coarse, fine))
    np.testing.assert_allclose(finer["hookload_N"], rows["hookload_N"], rtol=2e-3)
    torque = rows["surface_torque_N_m"].abs().max()
    np.testing.assert_allclose(finer["surface_torque_N_m"], rows["surface_torque_N_m"], atol=2e-3 * torque)
    point = equilibrium(fine, "trip_out", 2803.0)
    row = finer[(finer["operation"] == "trip_out") & (finer["bit_depth_m"] == 2803.0)].iloc[0]
    assert row["hookload_N"] == pytest.approx(point.hookload, rel=1e-9)
    assert row["notes"] == "none"
