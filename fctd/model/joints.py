"""Parts of a string: its components, and the tool joints and bodies of those that resolve their joints.

A component with ``joint_segments`` is laid joint by joint from its lower end upwards, the tool joint of each below its
body.  A tool joint is one segment that touches at its middle.  A body has segments of its own, shorter towards the tool
joints, where its curvature changes most, and touches with its outer diameter.

The joint at the upper end of a component, or of the string, is as long as what is left.  Its tool joint has the same
share of it as of the others: so mass and stiffness of the parts are those of the component whatever its length is.
"""

import math
from collections.abc import Iterable
from enum import Enum
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from fctd.case.string import ComponentSpec, JointSpec
from fctd.model.section import Section, body_of, section_of, tool_joint_of

# A joint at the upper end that is shorter than this share of the others becomes one with the joint below it.
SHORTEST: Final = 0.25


class Kind(Enum):
    """What a part is of its component."""

    WHOLE, TOOL_JOINT, BODY = "whole", "tool joint", "body"


class Part(NamedTuple):
    """A part of a string, which has one section: a component of the case, its index there, what of it the part is."""

    component: ComponentSpec
    origin: int
    kind: Kind = Kind.WHOLE


# Parts from the bit up, and the lengths of their segments [m], from the lower end upwards.
Pieces = list[tuple[Part, list[float]]]


def joint_of(component: ComponentSpec) -> JointSpec:
    """The joint of a component that resolves its joints."""
    assert component.joint is not None  # ``ComponentSpec`` refuses joint_segments without it
    return component.joint


def joints_in(component: ComponentSpec, length: float) -> int:
    """Number of joints in a length of a component [m]."""
    return max(math.ceil(length / joint_of(component).length - SHORTEST - 1e-9), 1)


def segments_in(component: ComponentSpec, joints: int) -> int:
    """Largest number of segments of so many joints of a component."""
    return joints * (1 + (component.joint_segments or 0))


def cut_joints(component: ComponentSpec, origin: int, length: float, count: int, joint: float) -> Pieces:
    """So many joints of a component: all of a length ``joint`` [m] but the uppermost, which is what is left."""
    top = length - (count - 1) * joint
    tool_joint, body = (Part(component, origin, kind) for kind in (Kind.TOOL_JOINT, Kind.BODY))
    pieces: Pieces = []
    for own in [joint] * (count - 1) + [top]:
        first, others = segments_of(component, own)
        pieces += (tool_joint, [first]), (body, list(others))
    return pieces


@lru_cache(maxsize=256)
def segments_of(component: ComponentSpec, length: float) -> tuple[float, tuple[float, ...]]:
    """The tool joint of a joint of a component, and the segments of its body, from the lower end upwards [m].

    Their ends lie midway between those of equal segments and of equal angles of a circle: the bending moments at the
    tool joint and in the middle of the body are then about equally wrong.  A joint that is shorter than the component's
    has fewer.
    """
    joint, most = joint_of(component), component.joint_segments or 0
    count = max(min(round(most * length / joint.length), most), 1)
    tool_joint = length * joint.tool_joint_length / joint.length
    share = np.arange(count + 1) / count
    ends = 0.5 * (length - tool_joint) * (share + 0.5 * (1 - np.cos(np.pi * share)))
    return tool_joint, tuple(np.diff(ends).tolist())


def finer(component: ComponentSpec, longest: float) -> ComponentSpec:
    """A component that resolves its joints with segments of at most ``longest`` [m], no fewer than it has."""
    joint = joint_of(component)
    # In the middle of a body the ends of segments are furthest apart: half of an equal share and π/4 of one.
    needed = (0.5 + 0.25 * math.pi) * (joint.length - joint.tool_joint_length) / longest
    return component.model_copy(update={"joint_segments": max(math.ceil(needed), component.joint_segments or 0)})


def longest_segment(component: ComponentSpec) -> float:
    """The longest segment of a component that resolves its joints [m]."""
    return max(segments_of(component, joint_of(component).length)[1])


def sections_of(parts: Iterable[Part], outside: float) -> tuple[Section, ...]:
    """Sections of parts in mud of a density [kg/m³]."""
    found: dict[tuple[int, Kind], Section] = {}
    sections = []
    for part in parts:
        if part.kind is Kind.WHOLE:
            sections.append(section_of(part.component, outside))
            continue
        key = part.origin, part.kind
        if key not in found:
            found[key] = (tool_joint_of if part.kind is Kind.TOOL_JOINT else body_of)(part.component, outside)
        sections.append(found[key])
    return tuple(sections)
