"""Probable mistakes in the string: its masses and sizes, and where it cannot have passed."""

import re
from collections.abc import Sequence
from itertools import accumulate
from typing import Final

import numpy as np

from fctd.case.doubts.usual import Doubts
from fctd.case.hole import WellboreSpec
from fctd.case.input_warnings import InputWarning
from fctd.case.message import quantity
from fctd.case.pipes.catalogue import SAME_DIAMETER, pipe_named
from fctd.case.pipes.filling import lacks_joints
from fctd.case.rig import MudSpec
from fctd.case.string import ComponentSpec, StringSpec

LIGHT, HEAVY = 0.85, 2.5  # mass over that of the pipe body: spiral collars have 0.95, tool joints add up to 0.6
SAME_DEPTH: Final = 1e-6  # [m]: one depth written in two units
JOINTED: Final = 0.98  # of its body: pipe with tool joints has more, and tables are rounded
ONE_JOINT: Final = 14.0  # [m]: pipe that is longer and touches wider than its body has tool joints
PIPE_BORE: Final = 0.55  # of the outer diameter: heavy-weight pipe has 0.59, collars 0.45 and less
IN_GAUGE: Final = 0.9  # of the hole's diameter: a bit that drilled the hole, or runs in it


def light_string(string: StringSpec, mud: MudSpec) -> Doubts:
    """A linear mass that floats in the mud, or that does not go with the pipe's body."""
    for i, part in enumerate(string.components):
        area = 0.25 * np.pi * (part.outer_diameter**2 - part.inner_diameter**2)
        key, mass = f"string.components[{i}].linear_mass", part.linear_mass
        if mass is None:
            continue
        around = max((row.density for row in mud.outside), default=mud.density)
        body, displaced = float(part.density * area), float(around * area)
        if mass < displaced:
            text = (
                f"{_name(part)} weighs {quantity(mass, 'kg/m', '.4g')}, less than the mud in its place, "
                f"{quantity(displaced, 'kg/m', '.4g')}"
            )
            yield InputWarning("floating_string", key, text, _REMEDY_OF_MASS)
        elif not (JOINTED if _has_joints(part) else LIGHT) * body <= mass <= HEAVY * body:
            text = (
                f"{_name(part)} weighs {quantity(mass, 'kg/m', '.4g')}, its body alone {quantity(body, 'kg/m', '.4g')}"
            )
            yield InputWarning("linear_mass", key, text, _REMEDY_OF_MASS)


def no_tool_joints(string: StringSpec) -> Doubts:
    """A pipe of the catalogue whose tool joints or couplings no page gives, where the case does not give them."""
    for i, part in enumerate(string.components):
        if part.pipe is None or part.joint is not None or not lacks_joints(pipe_named(part.pipe)):
            continue
        # A stored case has all keys.
        bare = part.contact_diameter == part.outer_diameter
        if part.linear_mass is None or bare:
            lacks = "weighs as its body alone" if part.linear_mass is None else ""
            touches = "touches with its body" if bare else ""
            yield InputWarning(
                "no_tool_joints", f"string.components[{i}].pipe",
                f"{_name(part)} {' and '.join(filter(None, (lacks, touches)))}: the catalogue has no tool joints or "
                "couplings for it",
                "give linear_mass with them, contact_diameter, and joint where its bending matters",
            )  # fmt: skip


def unlike_pipe(string: StringSpec) -> Doubts:
    """A component whose diameters are not those of the pipe that it names."""
    for i, part in enumerate(string.components):
        if part.pipe is None:
            continue
        pipe = pipe_named(part.pipe)
        own, named = (part.outer_diameter, part.inner_diameter), (pipe.outer, pipe.inner)
        if pipe.inner + pipe.wall_share * (pipe.outer - pipe.inner) - SAME_DIAMETER <= own[0] < pipe.outer:
            named = own[0], pipe.inner  # as measured, of worn pipe
        if max(abs(x - y) for x, y in zip(own, named, strict=True)) > SAME_DIAMETER:
            sizes = [
                f"{quantity(1e3 * outer, 'mm', '.6g')} by {quantity(1e3 * inner, 'mm', '.6g')}"
                for outer, inner in (own, named)
            ]
            yield InputWarning(
                "unlike_pipe", f"string.components[{i}].pipe",
                f"{_name(part)} has a body of {sizes[0]}, its pipe one of {sizes[1]}",
                "leave out the keys that the pipe gives, mass and joint among them, or the pipe",
            )  # fmt: skip


_REMEDY_OF_MASS: Final = "write linear_mass with its unit, such as '19.5 lb/ft', and check diameters and density"


def reach(string: StringSpec, ends: Sequence[float], deepest: float) -> Doubts:
    """A string too short for the hole, and components that lie above it.

    ends [m] : greatest bit depths of the operations; deepest [m] : of the hole.
    """
    lengths = [np.inf if part.length is None else part.length for part in string.components]
    asked, long = max(ends, default=deepest) - string.top_md, sum(lengths)
    if long < asked - SAME_DEPTH:
        yield InputWarning(
            "short_string", "string.components",
            f"all components together are {quantity(long, 'm')} long: with the bit at "
            f"{quantity(asked + string.top_md, 'm')} they do not reach string.top_md",
            "check their lengths, or leave out that of the last one, which then reaches it",
        )  # fmt: skip
    for i, (part, below) in enumerate(zip(string.components, accumulate(lengths, initial=0.0), strict=False)):
        if below >= deepest - string.top_md:
            yield InputWarning(
                "outside_the_hole", f"string.components[{i}]",
                f"{_name(part)} begins {quantity(below, 'm')} above the bit, and the hole is "
                f"{quantity(deepest, 'm')} deep: no row has it in the hole",
                "check the lengths of the components below it",
            )  # fmt: skip
            return  # those above it do not enter either


def bit_size(string: StringSpec, hole: WellboreSpec, td: float) -> Doubts:
    """A bit that is smaller than the string above it, or that is not the first component.

    A bit that fits the hole at the end of the well [m] is below pipe of any size that stays in the wider hole above.
    """
    first, *others = string.components
    bits = [_is_bit(part) for part in string.components]
    compared = list(string.components)
    if first.contact_diameter >= IN_GAUGE * hole.intervals[-1].diameter:
        above = hole.intervals[-2].to_md if len(hole.intervals) > 1 else 0.0
        below = accumulate((part.length or np.inf for part in string.components), initial=0.0)
        compared = [part for part, length in zip(compared, below, strict=False) if td - length > above or part is first]
    widest = max(compared, key=lambda part: part.contact_diameter)
    if bits[0] and widest.contact_diameter > first.contact_diameter:
        yield InputWarning(
            "bit_size", "string.components[0].outer_diameter",
            f"{_name(first)} has {quantity(1e3 * first.contact_diameter, 'mm', '.6g')}, {_name(widest)} above it "
            f"{quantity(1e3 * widest.contact_diameter, 'mm', '.6g')}",
            "check both diameters",
        )  # fmt: skip
    elif others and any(bits) and not bits[0]:
        yield InputWarning(
            "bit_not_first", f"string.components[{bits.index(True)}]",
            f"{_name(string.components[bits.index(True)])} is above {_name(first)}",
            "list the components from the bit up",
        )  # fmt: skip


def bent_along_gauge(string: StringSpec, hole: WellboreSpec) -> Doubts:
    """A bent component whose stabiliser is given as if it were as long as the component.

    The end of a straight tool of length L, tilted by β against the string above, lies βL aside.  Where its hole leaves
    less, and its body does not touch, the wall has to bend the tool straight.
    """
    wide = hole.intervals[-1].diameter
    for i, part in enumerate(string.components):
        gauge = part.contact_diameter > part.outer_diameter or part.contact_diameter >= IN_GAUGE * wide
        if part.contact != "sleeve" or part.length is None or not gauge:
            continue
        aside, room = part.bend * part.length, max(wide - part.contact_diameter, 0.0)
        if aside > room:
            yield InputWarning(
                "bent_along_gauge", f"string.components[{i}].contact_diameter",
                f"{_name(part)} touches along all of its {quantity(part.length, 'm', '.4g')}, is bent by "
                f"{quantity(1e3 * aside, 'mm', '.3g')} over this length, and has "
                f"{quantity(1e3 * room, 'mm', '.3g')} of room in the hole",
                "give its stabiliser sleeve, the part up to the bend and the body above it as components of their own",
            )  # fmt: skip


def does_not_drift(string: StringSpec, hole: WellboreSpec, deepest: float) -> Doubts:
    """A component that, with the bit at its greatest depth [m], is below a narrower part of the hole than it is."""
    below = accumulate((part.length or np.inf for part in string.components), initial=0.0)
    for i, (part, length) in enumerate(zip(string.components, below, strict=False)):
        passed = [interval for interval in hole.intervals if interval.to_md < deepest - length]
        tight = min(passed, key=lambda interval: interval.diameter, default=None)
        if tight is not None and part.contact_diameter > tight.diameter * (1 + 1e-9):
            key = "contact_diameter" if "contact_diameter" in part.model_fields_set else "outer_diameter"
            yield InputWarning(
                "does_not_drift", f"string.components[{i}].{key}",
                f"{_name(part)} has {quantity(1e3 * part.contact_diameter, 'mm', '.6g')} and cannot have passed the "
                "hole of "
                f"{quantity(1e3 * tight.diameter, 'mm', '.6g')} above {quantity(tight.to_md, 'm')}",
                "check both diameters; of a tool that opens below a shoe only the rows below are meant",
            )  # fmt: skip


def _has_joints(part: ComponentSpec) -> bool:
    """Whether tool joints repeat along a component, which a whole assembly as one component has not."""
    wider = part.contact_diameter > part.outer_diameter and part.fittings is None
    of_pipe = part.inner_diameter > PIPE_BORE * part.outer_diameter
    return part.joint is not None or (wider and of_pipe and (part.length is None or part.length > ONE_JOINT))


def _name(component: ComponentSpec) -> str:
    return f'"{component.name}"'


def _is_bit(component: ComponentSpec) -> bool:
    """Whether a component is named as a bit, and not as the sub above one."""
    name = component.name.lower()
    return re.search(r"\bbit\b", name) is not None and "sub" not in name
