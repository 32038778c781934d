"""The finite-element beam of a case."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.case.string import JointSpec
from fctd.mechanics.topdrive import ramp
from references.beams import case, elements
from references.beams.case import beam_of, steady, top_of
from validation.cases import load


def test_beam_is_the_whole_string_at_its_greatest_depth():
    beam = beam_of(load("scaled_section"), 0.3, 20.0)
    assert beam.length == pytest.approx(44.0)
    assert beam.around.clearance == pytest.approx(0.025)
    assert beam.around.stiffness == 3e6
    assert beam.around.lateral_damping == 50.0
    sizes = np.diff(beam.nodes)
    assert sizes[beam.nodes[1:] < 24].max() == pytest.approx(2.0)
    assert sizes[(beam.nodes[:-1] > 24.1) & (beam.nodes[1:] < 43.3)] == pytest.approx(0.3, rel=0.02)
    assert sizes[-1] == pytest.approx(0.1)
    assert beam.gravity.sum() == pytest.approx(beam.section.weight * 44.0)


def test_elements_like_segments():
    beam = beam_of(load("scaled_section"), 0.6, 18.0, like_segments=True)
    assert np.diff(beam.nodes)[-30:] == pytest.approx(0.6)
    assert beam.wall.dx.shape[1] == 2


def test_top_moves_down_as_fctd_feeds_pipe():
    top, duration = top_of(load("scaled_section"))
    assert duration == pytest.approx(25.0)  # 12 m at 0.5 m/s, and half of the ramp of 2 s
    assert top(0.0) == pytest.approx(-12.0)
    assert top(duration) == pytest.approx(0.0, abs=1e-12)
    h = 1e-5
    for time in (0.3, 1.0, 1.7, 5.0, 20.0):
        assert (top(time + h) - top(time - h)) / (2 * h) == pytest.approx(ramp(time, 0.0, 2.0, 0.0, 0.5), abs=1e-8)


def test_several_operations_follow_each_other():
    first = {"kind": "trip_in", "from_md": 32.0, "to_md": 40.0, "speed": 0.5, "ramp_time": 1.0}
    back = {"kind": "trip_out", "to_md": 36.0, "speed": 0.5, "ramp_time": 1.0}
    top, duration = top_of(load("scaled_section", operations=[first, back]))
    assert top(0.0) == pytest.approx(-8.0)
    assert top(17.0) == pytest.approx(0.0, abs=1e-12)
    assert top(duration) == pytest.approx(-4.0)


@pytest.mark.parametrize(
    ("overrides", "key"),
    [
        ({"wellbore__stations": [[0, 0, 0], [32, 0, 0], [38, 12, 0], [50, 30, 40]]}, "wellbore.stations"),
        ({"string__components__1__outer_diameter": "60 mm"}, "string.components"),
        ({"wellbore__stiffness_per_length": None, "wellbore__stiffness": 1e6}, "wellbore.stiffness_per_length"),
        (
            {
                "wellbore__intervals": [
                    {"to_md": 20.0, "diameter": 0.12, "friction": 0.0},
                    {"to_md": 50.0, "diameter": 0.1, "friction": 0.0},
                ]
            },
            "wellbore.intervals",
        ),
    ],
)
def test_unsuitable_cases_are_refused(overrides, key):
    with pytest.raises(InputError) as refused:
        beam_of(load("scaled_section", **overrides), 0.3, 20.0)
    assert refused.value.key == key


def test_resolved_joints_are_refused():
    """Their tool joints and bodies have sections of their own, which a uniform beam has not."""
    joint = JointSpec(length=2.0, tool_joint_length=0.1, tool_joint_diameter=0.09)
    of_case = load("scaled_section")
    cut = {"joint": joint, "joint_segments": 2, "segments": None, "segment_length": None, "contact_diameter": 0.09}
    part = of_case.string.components[0].model_copy(update=cut)
    string = of_case.string.model_copy(update={"components": (part,)})
    with pytest.raises(InputError, match="components of one section"):
        beam_of(of_case.model_copy(update={"string": string}), 0.3, 20.0)


def test_a_fine_mesh_longer_than_the_string_is_refused():
    with pytest.raises(ValueError, match="fine mesh"):
        beam_of(load("scaled_section"), 0.3, 44.0)


def slanted(**changes):
    """A straight hole of 40 m at 60 deg, with pipe over its whole length."""
    hole = {"wellbore__stations": [[0, 60, 0], [40, 60, 0]], "operations": None, "wellbore__intervals__0__to_md": 40.0}
    even = {"string__components__1__segments": None, "string__components__1__segment_length": 0.6}
    return load("scaled_section", **hole, **even, wellbore__intervals__0__friction=0.25, **changes)


@pytest.mark.parametrize("segments", [1, 3])
def test_contact_force_is_the_weight_across_and_hook_load_has_the_friction(segments, monkeypatch):
    """Contact force W sin I less ⅔ wL at the clamp (L⁴ = 72 EI c/w, w across); hook load W cos I less μ times it."""
    section = beam_of(load("scaled_section"), 0.3, 20.0).section
    across = section.weight * np.sin(np.pi / 3)
    clamp = 2 / 3 * across * (72 * section.EI * 0.025 / across) ** 0.25
    meshes = []

    def beam(nodes, *others):
        meshes.append(np.diff(nodes))
        return elements.Beam(nodes, *others)

    monkeypatch.setattr(case, "Beam", beam)
    found = steady(slanted(), 40.0, segments)
    assert all(np.median(sizes) == pytest.approx(0.6 * segments, rel=0.05) for sizes in meshes)
    assert found.contact_force == pytest.approx(40 * across - clamp, rel=0.02)
    assert found.hookload == pytest.approx(20 * section.weight - 0.25 * found.contact_force, rel=2e-3)
