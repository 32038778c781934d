"""Parts of a string: tool joints and bodies add up to their component, whatever its length and wherever it is cut."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import InputError, equilibrium
from fctd.model.drillstring import SHORTEST_LONG_SEGMENT, String, lay_out
from fctd.model.joints import Kind, Part, cut_joints, joints_in, longest_segment, sections_of, segments_in
from fctd.model.section import section_of
from fctd.model.stands import lay_out_stands
from tests.cases import make_case, pipe


@st.composite
def jointed(draw: st.DrawFn, length: float | None = None) -> dict[str, Any]:
    """Pipe with resolved joints, some of a mass or of stiffnesses of its own."""
    joint = {
        "length": draw(st.floats(4.0, 14.0)),
        "tool_joint_length": draw(st.floats(0.05, 0.9)),
        "tool_joint_diameter": draw(st.floats(0.13, 0.18)),
        "tool_joint_inner": draw(st.sampled_from([None, 0.06, 0.09])),
    }
    more: dict[str, Any] = {}
    if draw(st.booleans()):
        more["linear_mass"] = draw(st.floats(5.0, 120.0))
    if draw(st.booleans()):
        more |= {"axial_stiffness": 1.2e9, "torsional_stiffness": 3e6, "bending_stiffness": 2e6, "shear_stiffness": 3e8}
    return pipe(length, None, joint=joint, joint_segments=draw(st.integers(2, 12)), **more)


@st.composite
def strings(draw: st.DrawFn) -> list[dict[str, Any]]:
    """A component with resolved joints between others, or one of several; the last reaches the surface."""
    below = draw(st.sampled_from([[], [pipe(20.0, 4, outer=0.16)], [draw(jointed(draw(st.floats(2.0, 150.0))))]]))
    middle = draw(jointed(draw(st.floats(2.0, 300.0))))
    return [*below, middle, draw(st.sampled_from([pipe(None, None, segment_length=12.0), draw(jointed())]))]


def mean(string: String, name: str, origin: int) -> float:
    of = string.origin == origin
    return float(np.average(string.of(name)[of], weights=string.length[of]))


@given(part=jointed(), depth=st.floats(40.0, 900.0), inside=st.sampled_from([0.0, 900.0, 1500.0]))
def test_other_fluids_inside_weigh_the_parts_as_the_component(
    part: dict[str, Any], depth: float, inside: float
) -> None:
    """In all; the pipe that buckles has the weight of the component everywhere."""
    mud = {"density": 1200.0, "inside": [{"density": inside}], "float": True}
    whole = {key: value for key, value in part.items() if key != "joint_segments"} | {"segment_length": 20.0}
    parts, coarse = (lay_out(make_case(components=[of], mud=mud), depth) for of in (part, whole))
    assert parts.weight @ parts.length == pytest.approx(coarse.weight @ coarse.length, rel=1e-9)
    assert parts.wave_weight == pytest.approx(coarse.weight[0], rel=1e-12)


@settings(max_examples=60)
@given(components=strings(), depth=st.floats(40.0, 900.0), shallower=st.floats(0.3, 1.0))
def test_parts_add_up_to_their_component(components: list[dict[str, Any]], depth: float, shallower: float) -> None:
    """In mass, weight, length and compliance, to rounding, at every bit depth."""
    case = make_case(components=components, mud={"density": 1200.0})
    string = lay_out(case, depth)
    assert float(string.length.sum()) == pytest.approx(depth, abs=1e-9)
    below = 0.0
    for k in range(int(string.origin[0]) + 1):
        component, section = case.string.components[k], section_of(case.string.components[k], 1200.0)
        taken = min(component.length or np.inf, depth - below)
        assert float(string.length[string.origin == k].sum()) == pytest.approx(taken, abs=1e-9)
        below += taken
        if component.joint_segments is None:
            continue
        for name in ("mass", "weight"):
            assert mean(string, name, k) == pytest.approx(getattr(section, name), rel=1e-9)
        of = string.origin == k
        for name in ("EA", "GJ"):
            compliance = float(np.average(1 / string.of(name)[of], weights=string.length[of]))
            assert compliance == pytest.approx(1 / getattr(section, name), rel=1e-9)
        assert component.linear_mass is None or mean(string, "mass", k) == pytest.approx(component.linear_mass)
        kinds = [part.kind for part in string.parts if part.origin == k]
        assert kinds == [Kind.TOOL_JOINT, Kind.BODY] * (len(kinds) // 2)
    # A chart packs strings of all depths with the sections of the longest.
    other = lay_out(case, shallower * depth)
    assert other.sections == string.sections[: len(other.sections)]
    assert [part[1:] for part in other.parts] == [part[1:] for part in string.parts[: len(other.parts)]]


@given(part=jointed(), length=st.floats(0.1, 2000.0))
def test_joints_are_whole_but_the_uppermost(part: dict[str, Any], length: float) -> None:
    """That one has a quarter to five quarters of the others' length, where there are several."""
    component = make_case(components=[part]).string.components[0]
    assert component.joint is not None
    joint = component.joint.length
    count = joints_in(component, length)
    pieces = cut_joints(component, 0, length, count, joint)
    lengths = np.array([sum(one) for _, one in pieces]).reshape(-1, 2)
    assert len(lengths) == count
    np.testing.assert_allclose(lengths[:-1].sum(axis=1), joint)
    assert count == 1 or 0.25 * joint - 1e-6 <= lengths[-1].sum()
    assert lengths[-1].sum() <= 1.25 * joint + 1e-6
    assert sum(len(one) for _, one in pieces) <= segments_in(component, count)
    np.testing.assert_allclose(lengths[:, 0] / lengths.sum(axis=1), component.joint.tool_joint_length / joint)
    body = np.array(pieces[1][1])
    np.testing.assert_allclose(body, body[::-1])
    assert (np.diff(body[: (len(body) + 1) // 2]) >= -1e-9).all()  # shorter towards the tool joint
    if count > 1:
        assert (len(body), body.max()) == (component.joint_segments, pytest.approx(longest_segment(component)))


def test_sections_by_hand() -> None:
    """A tool joint by its diameters, heavier than its body by what the component weighs more."""
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168, "tool_joint_inner": 0.083}
    component = make_case(components=[pipe(None, None, joint=joint, joint_segments=4)]).string.components[0]
    tool_joint, body = sections_of([Part(component, 0, Kind.TOOL_JOINT), Part(component, 0, Kind.BODY)], 0.0)
    plain = section_of(make_case(components=[pipe(None, 1)]).string.components[0], 0.0)
    for name in ("mass", "weight", "axial_inertia", "EA", "GJ", "EI", "shear", "contact_radius"):
        assert getattr(body, name) == pytest.approx(getattr(plain, name))
    own = section_of(make_case(components=[pipe(None, 1, outer=0.168, inner=0.083)]).string.components[0], 0.0)
    for name in ("mass", "weight", "axial_inertia", "EA", "GJ", "EI", "shear", "contact_radius"):
        assert getattr(tool_joint, name) == pytest.approx(getattr(own, name))
    # Bending is computed and not corrected, and stress at a tool joint is that of the body's end.
    assert (tool_joint.joint, tool_joint.tool_joint, body.joint, body.tool_joint) == (0.0, 0.5, 0.0, 0.0)
    assert (tool_joint.outer, tool_joint.inner, tool_joint.point, body.point) == (body.outer, body.inner, 1.0, 0.0)


def test_tool_joints_touch_at_their_middle_and_bodies_with_their_own_radius() -> None:
    joint = {"length": 10.0, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168}
    string = lay_out(make_case(components=[pipe(10.0, 1), pipe(None, None, joint=joint, joint_segments=4)]), 50.0)
    middle, radius = string.mid_contact(), string.contact_radius()
    of_tool_joint = np.array([part.kind == Kind.TOOL_JOINT for part in string.parts])[string.component]
    assert of_tool_joint.sum() == 4
    np.testing.assert_array_equal(middle, of_tool_joint)
    np.testing.assert_allclose(radius, np.where(of_tool_joint, 0.084, 0.0635))
    np.testing.assert_allclose(string.tributary()[of_tool_joint], 0.5)


@settings(max_examples=20)
@given(part=jointed(), depth=st.floats(40.0, 900.0))
def test_pipe_that_is_fed_ends_in_a_long_segment_of_whole_pipe(part: dict[str, Any], depth: float) -> None:
    case = make_case(components=[part])
    string = lay_out(case, depth, depth + 50.0)
    assert string.long_segment
    assert string.parts[-1].kind == Kind.WHOLE
    assert string.sections[-1] == section_of(case.string.components[0], 0.0)
    joint = part["joint"]["length"]
    assert SHORTEST_LONG_SEGMENT - 1e-9 <= string.length[0] <= SHORTEST_LONG_SEGMENT + joint + 1e-9
    assert mean(string, "mass", 0) == pytest.approx(string.sections[-1].mass, rel=1e-9)


@pytest.mark.parametrize("joints", [3, 11, 40])
def test_whole_joints_of_fed_pipe_do_not_hang_on_rounding(joints: int) -> None:
    joint = {"length": 9.3, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168}
    case, depth = make_case(components=[pipe(None, None, joint=joint, joint_segments=4)]), 10.0 + joints * 9.3
    found = {lay_out(case, depth * (1 + off), depth + 50.0).segments for off in (-1e-15, 0.0, 1e-15)}
    assert found == {joints * 5 + 1}


@settings(max_examples=20)
@given(part=jointed(), deepest=st.floats(100.0, 900.0), joints=st.integers(1, 4), off=st.floats(-0.09, 0.09))
def test_stands_have_whole_joints(part: dict[str, Any], deepest: float, joints: int, off: float) -> None:
    stand = joints * part["joint"]["length"] * (1 + off)
    rig = {"stand_length": stand, "derrick_height": 90.0}
    case = make_case(components=[pipe(18.0, 3, outer=0.16), part], rig=rig, mud={"density": 1200.0})
    tally = lay_out_stands(case, 50.0, deepest)
    section = section_of(case.string.components[1], 1200.0)
    for k in range(1, tally.stands + 1):
        string = tally.string(k, float(tally.reach[k]))
        if string.origin.max() == 0:
            continue
        assert mean(string, "mass", 1) == pytest.approx(section.mass, rel=1e-9)
        assert string.parts[-1].kind == Kind.BODY
    assert float(tally.whole.length.sum()) == pytest.approx(tally.reach[-1])


def test_stands_that_are_no_whole_joints_are_refused() -> None:
    joint = {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168}
    case = make_case(components=[pipe(None, None, joint=joint, joint_segments=4)], rig={"stand_length": 14.0})
    with pytest.raises(InputError, match=r"rig.stand_length = .*whole number of joints of 9.5 m within a tenth"):
        lay_out_stands(case, 50.0, 900.0)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"joint": None}, r"joint_segments.*a component with joint"),
        ({"segments": 4}, "segments or joint_segments, not both"),
        ({"segment_length": 4.0}, "segment_length or joint_segments, not both"),
        ({"joint_segments": 1}, "at least 2"),
        ({"joint_segments": 2.5}, "a whole number"),
    ],
)
def test_what_does_not_go_with_resolved_joints_is_refused(change: dict[str, Any], expected: str) -> None:
    joint = {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.168}
    part = {key: value for key, value in ({"joint": joint, "joint_segments": 4} | change).items() if value is not None}
    with pytest.raises((InputError, ValueError), match=expected):
        make_case(components=[pipe(None, None) | part])


def test_messages_name_the_component_of_the_case() -> None:
    """Which is not the part of the string, of which there are many more."""
    joint = {"length": 9.5, "tool_joint_length": 0.5, "tool_joint_diameter": 0.25}
    case = make_case(components=[pipe(20.0, 2), pipe(None, None, joint=joint, joint_segments=4)])
    with pytest.raises(InputError, match=r"string.components\[1\].contact_diameter = .*at most the hole's 215.9 mm"):
        equilibrium(case, "rotate_off_bottom", 500.0)
    fine = make_case(components=[pipe(20.0, 2), pipe(None, None, joint=joint, joint_segments=2000)])
    with pytest.raises(InputError, match=r"at most 10000 segments in all"):
        equilibrium(fine, "rotate_off_bottom", 500.0)
    with pytest.raises(InputError, match=r"at most 10000 segments in all"):
        lay_out_stands(make_case(components=[pipe(None, None, joint=joint, joint_segments=2000)]), 50.0, 500.0)
