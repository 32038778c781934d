"""Parts of a string: its components, and of those that repeat the tool joints, or fittings, and the pipe between them.

A component with ``joint_segments`` is laid joint by joint from its lower end upwards, the tool joint of each below its
body.  A tool joint is one segment that touches at its middle.  A body has segments of its own, shorter towards the tool
joints, where its curvature changes most, and touches with its outer diameter.  A component with centralisers or
friction reducers is laid in the same way from one of these fittings to the next, and its pipe is the whole one.

The joint at the upper end of a component, or of the string, is as long as what is left.  Its tool joint has the same
share of it as of the others: so mass and stiffness of the parts are those of the component whatever its length is.
"""

import math
from collections.abc import Iterable
from enum import Enum
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from fctd.arrays import ceiling, nearest
from fctd.case.string import ComponentSpec, Repeat
from fctd.model.section import Section, body_of, fitting_of, released, section_of, tool_joint_of

# A joint at the upper end that is shorter than this share of the others becomes one with the joint below it.
SHORTEST: Final = 0.25


class Kind(Enum):
    """What a part is of its component."""

    WHOLE, TOOL_JOINT, BODY, FITTING = "whole", "tool joint", "body", "fitting"


class Part(NamedTuple):
    """A part of a string, which has one section: a component of the case, its index there, what of it the part is."""

    component: ComponentSpec
    origin: int
    kind: Kind = Kind.WHOLE


# Parts from the bit up, and the lengths of their segments [m], from the lower end upwards.
Pieces = list[tuple[Part, list[float]]]


def repeat_of(component: ComponentSpec) -> Repeat:
    """How a component repeats that does."""
    assert component.repeat is not None  # the caller has asked
    return component.repeat


def joints_in(component: ComponentSpec, length: float) -> int:
    """Number of joints, or stretches, in a length of a component [m]."""
    return max(int(ceiling(length / repeat_of(component).every - SHORTEST)), 1)


def segments_in(component: ComponentSpec, joints: int) -> int:
    """Largest number of segments of so many joints of a component."""
    return joints * (1 + repeat_of(component).segments)


def cut_joints(component: ComponentSpec, origin: int, length: float, count: int, joint: float) -> Pieces:
    """So many joints of a component: all of a length ``joint`` [m] but the uppermost, which is what is left."""
    top = length - (count - 1) * joint
    kinds = (Kind.TOOL_JOINT, Kind.BODY) if component.fittings is None else (Kind.FITTING, Kind.WHOLE)
    tool_joint, body = (Part(component, origin, kind) for kind in kinds)
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
    every, own, most = repeat_of(component)
    count = max(min(int(nearest(most * length / every)), most), 1)
    tool_joint = length * own / every
    share = np.arange(count + 1) / count
    ends = 0.5 * (length - tool_joint) * (share + 0.5 * (1 - np.cos(np.pi * share)))
    return tool_joint, tuple(np.diff(ends).tolist())


def finer(component: ComponentSpec, longest: float) -> ComponentSpec:
    """A component that repeats with segments of at most ``longest`` [m], no fewer than it has."""
    every, own, segments = repeat_of(component)
    # In the middle of a body the ends of segments are furthest apart: half of an equal share and π/4 of one.
    count = max(math.ceil((0.5 + 0.25 * math.pi) * (every - own) / longest), segments)
    if component.fittings is None:
        return component.model_copy(update={"joint_segments": count})
    finer_ones = component.fittings.model_copy(update={"segments": count})
    return component.model_copy(update={component.repeat_key: finer_ones})


def longest_segment(component: ComponentSpec) -> float:
    """The longest segment of a component that repeats [m]."""
    return max(segments_of(component, repeat_of(component).every)[1])


SECTIONS: Final = {Kind.TOOL_JOINT: tool_joint_of, Kind.BODY: body_of, Kind.FITTING: fitting_of}


def sections_of(parts: Iterable[Part], outside: float) -> tuple[Section, ...]:
    """Sections of parts, from the bit up, in mud of a density [kg/m³]."""
    found: dict[tuple[int, Kind], Section] = {}
    sections = []
    above: Part | None = None
    for part in reversed(tuple(parts)):
        if part.kind is Kind.WHOLE:
            section = section_of(part.component, outside)
        else:
            key = part.origin, part.kind
            if key not in found:
                found[key] = SECTIONS[part.kind](part.component, outside)
            section = found[key]
        if part.component.swivel and above is not None and above.origin != part.origin:
            section = released(section)
        sections.append(section)
        above = part
    return tuple(reversed(sections))
