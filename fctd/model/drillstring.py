"""The string: components laid from the bit up become rigid segments with springs between them (§3.2, 5.1)."""

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, ceiling, nearest
from fctd.case.errors import Computed, InputError
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.case.string import ComponentSpec
from fctd.mechanics import state
from fctd.model.default_layout import DefaultLayout
from fctd.model.fluids import Fluids, fluids_of
from fctd.model.joints import Kind, Part, Pieces, cut_joints, joints_in, repeat_of, sections_of, segments_in
from fctd.model.perturbed import perturb_lengths
from fctd.model.section import Section, buoyed, same_section, tool_joint_radii
from fctd.model.string_rows import find_contacts, find_stiffness

# A long segment must be this long [m].
SHORTEST_LONG_SEGMENT = 10.0
# Largest error of a length in a layout [m].
SAME_LENGTH = 1e-6


class LongSegmentError(InputError):
    """The long segment cannot be fed: its hole is not vertical, it is too short, or its component ends."""


# By the identities of sections, which each entry keeps alive: hashing their numbers would take a tenth of a chart row.
_TABLES: dict[tuple[int, ...], tuple[tuple[Section, ...], Array, Array]] = {}
MOST_TABLES = 64


def _tables_of(sections: tuple[Section, ...]) -> tuple[Array, Array]:
    """The sections as rows (k, ...), and their weights (3, k): of the whole, of the body, of the pipe that buckles."""
    key = tuple(map(id, sections))
    found = _TABLES.get(key)
    if found is None:
        if len(_TABLES) >= MOST_TABLES:
            _TABLES.clear()
        weights = np.array([(of.weight, of.body_weight, of.wave_weight) for of in sections]).T
        found = _TABLES[key] = sections, np.array(sections), weights
    return found[1:]


@dataclass(frozen=True)
class String:
    """A laid-out string, arrays from the top segment to the bit, shape (n,).

    bit_depth : unstretched length below the rotary table [m]; length [m]; component : index into ``sections`` and
    ``parts``, the case's components or parts of them (joints.py); long_segment : whether the top segment is the paper's
    long one, whose length may change while the string moves; fluids : inside and outside, None where they are those of
    ``sections``.  Raises AssertionError where these disagree, which is a defect of the program.
    """

    top_md: float
    bit_depth: float
    length: Array
    component: NDArray[np.int64]
    sections: tuple[Section, ...]
    parts: tuple[Part, ...]
    long_segment: bool
    fluids: Fluids | None = None

    def __post_init__(self) -> None:
        off = self.top_md + float(np.add.reduce(self.length)) - self.bit_depth
        if not abs(off) <= SAME_LENGTH:
            raise AssertionError(f"the segments end {off:g} m below the bit depth, {self.bit_depth:g} m")
        if (shortest := np.minimum.reduce(self.length)) <= 0:
            raise AssertionError(f"a segment of {shortest:g} m")
        # From the top down the components follow each other in reverse order of the list, without a gap.
        steps = self.component[:-1] - self.component[1:]
        ends = self.component[0] == len(self.sections) - 1 and self.component[-1] == 0
        ends &= len(self.parts) == len(self.sections)
        # Steps of 0 and 1, and no others, have no further bits.
        if len(self.component) != len(self.length) or not ends or np.bitwise_or.reduce(steps) >> 1:
            raise AssertionError("the segments do not follow the order of the components")

    @property
    def segments(self) -> int:
        """Number of segments."""
        return len(self.length)

    @cached_property
    def bodies(self) -> NDArray[np.int64]:
        """Of each segment the number of its section (n,), as ``component``; neighbours of one section are one body.

        A component that is written as two has the stresses of the one.
        """
        first = list(range(len(self.sections)))
        for k, (below, here) in enumerate(pairwise(self.sections), start=1):
            if not here.point and not here.swivel and same_section(here, below):
                first[k] = first[k - 1]
        return np.array(first)[self.component]

    @property
    def origin(self) -> NDArray[np.int64]:
        """Indices (n,) of the case's components that the segments are of."""
        return np.array([part.origin for part in self.parts])[self.component]

    def key_of(self, segment: int) -> str:
        """The key of the case's component that a segment is of."""
        return f"string.components[{int(self.origin[segment])}]"

    def width_key(self, segment: int) -> str:
        """The key that says how wide a segment is where it touches."""
        part = self.parts[self.component[segment]]
        width = f"{part.component.repeat_key}.diameter" if part.kind == Kind.FITTING else "contact_diameter"
        return f"{self.key_of(segment)}.{width}"

    def of(self, name: str) -> Array:
        """A section property of every segment, shape (n,), in the unit that `Section` gives."""
        return np.array([getattr(s, name) for s in self.sections])[self.component]

    @cached_property
    def channel_radii(self) -> tuple[Array, Array]:
        """Radii (n,) [m] that mud flows past, outside and inside: of a tool joint that is laid out its own."""
        radii = [
            (section.outer, section.inner)
            if part.kind != Kind.TOOL_JOINT or part.component.joint is None
            else tool_joint_radii(part.component.joint, section.inner)
            for part, section in zip(self.parts, self.sections, strict=True)
        ]
        outer, inner = np.array(radii)[self.component].T
        return outer, inner

    @cached_property
    def above_bit(self) -> Array:
        """Distances from the bit (n + 1,) [m] of the string's top and of the lower ends of its segments."""
        return np.append(np.cumsum(self.length[::-1])[::-1], 0.0)

    @cached_property
    def contacts_above(self) -> Array:
        """Distances from the bit (n + 1,) [m] of the string's top and of its contact points."""
        above = self.above_bit.copy()
        above[1:] += np.where(self.mid_contact(), 0.5 * self.length, 0.0)
        return above

    @cached_property
    def densities(self) -> tuple[Array, Array] | None:
        """Mean densities of the fluids inside and outside every segment (n,) [kg/m³]; None where ``fluids`` is."""
        return None if self.fluids is None else self.fluids.densities(self.above_bit[:-1], self.above_bit[1:])

    @property
    def weight(self) -> Array:
        """Buoyed weight of every segment (n,) [N/m]."""
        of: Array = self.weights[0]
        return of

    @property
    def body_weight(self) -> Array:
        """Buoyed weight of the body alone of every segment (n,) [N/m]."""
        of: Array = self.weights[1]
        return of

    @property
    def wave_weight(self) -> Array:
        """Buoyed weight of the pipe as a whole, with which every segment buckles (n,) [N/m]."""
        of: Array = self.weights[2]
        return of

    @cached_property
    def weights(self) -> Array:
        """Buoyed weights (3, n) [N/m]: ``weight``, ``body_weight`` and ``wave_weight``, which a row asks for."""
        if self.fluids is None:
            return np.take(self._tables[1], self.component, axis=1)
        assert self.densities is not None  # as there are fluids
        inside, outside = self.densities
        density, inner = self.of("density"), self.of("inner")
        return np.array(
            [buoyed(self.of(mass), density, inner, outside, inside) for mass in ("mass", "body_mass", "wave_mass")]
        )

    def lengthened(self, by: float) -> "String":
        """The same string with ``by`` [m] more in its top segment."""
        longer = np.concatenate([self.length[:1] + by, self.length[1:]])
        return replace(self, bit_depth=self.bit_depth + by, length=longer)

    @cached_property
    def _tables(self) -> tuple[Array, Array]:
        return _tables_of(self.sections)

    @property
    def table(self) -> Array:
        """The sections (k, ...), a column for each property."""
        return self._tables[0]

    @cached_property
    def _contacts(self) -> tuple[NDArray[np.bool_], Array, Array]:
        middle, radius, tributary = np.empty(self.segments, np.bool_), *np.empty((2, self.segments))
        find_contacts(self.length, self.component, self.table, self.long_segment, middle, radius, tributary)
        return middle, radius, tributary

    def mid_contact(self) -> NDArray[np.bool_]:
        """Which segments (n,) touch at their middle, as the middle ones of points do, but for the bit."""
        return self._contacts[0]

    def contact_radius(self) -> Array:
        """Radii (n,) at contact points [m]: the larger one of unlike neighbours; see ``contact_point``."""
        return self._contacts[1]

    @property
    def longest(self) -> float:
        """Longest segment below the topmost one, which takes the remainder of the string [m]."""
        return float(self.length[1:].max(initial=0.0))

    def tributary(self) -> Array:
        """Length (n,) of pipe whose wall force the contact points bear [m]; see ``contact_point``."""
        return self._contacts[2]

    def joints(self, name: str) -> Array:
        """Stiffness (n,) of the joints for a section stiffness per length, see ``joint_stiffness``.

        EA and shear [N] give [N/m]; EI and GJ [N m^2] give [N m/rad].
        """
        stiffness, column = np.empty(self.segments), Section._fields.index(name)
        find_stiffness(self.length, self.component, self.table, self.long_segment, column, stiffness)
        return stiffness


def lay_out(case: Case, bit_depth: float, deepest: float | None = None) -> String:
    """Segments of the string that is in the hole with the bit at ``bit_depth`` [m].

    Components are laid from the bit up until the depth is reached; the topmost piece takes the remainder.  A component
    without ``segments`` and ``segment_length`` has those of ``DefaultLayout``; one that repeats is laid
    joint by joint, or from fitting to fitting, below a long segment of whole pipe where it is fed.
    deepest : greatest bit depth [m] of the run; pipe is fed to reach it, which needs a long segment at the top.
    Raises InputError when the string is too short, a long segment does not fit, or more than the topmost
    component would have to be fed.
    """
    fed = deepest is not None and deepest > bit_depth
    components = case.string.components
    remaining = bit_depth - case.string.top_md
    if remaining <= 0:
        raise InputError(
            f"less than the bit depth, {quantity(bit_depth, 'm')}",
            key="string.top_md",
            value=quantity(case.string.top_md, "m"),
        )
    lengths: list[float] = []
    owner: list[int] = []
    parts: list[Part] = []
    laid = 0.0
    by_default = None
    if any(component.cut_by_default for component in components):
        by_default = DefaultLayout(case, bit_depth, deepest)
    for k, component in enumerate(components):
        take = remaining if component.length is None else min(component.length, remaining)
        if component.repeat is not None:
            cut = _joint_by_joint(component, k, take, fed and remaining - take <= 1e-9)
        else:
            if by_default is not None and component.cut_by_default:
                start = bit_depth - case.string.top_md - remaining
                check_segments(by_default.count(start, start + take))
                pieces = by_default.lengths(start, start + take)
            else:
                pieces = _divide(component, take)
            if component.contact == "point":
                pieces = [take / len(pieces)] * len(pieces)  # its middle is that of a segment, or a joint
            cut = [(Part(component, k), pieces)]
        for part, pieces in cut:
            lengths += pieces
            owner += [len(parts)] * len(pieces)
            parts.append(part)
        if abs(sum(lengths) - (laid := laid + take)) > SAME_LENGTH:
            raise AssertionError(f"the segments of component {k} do not add up to its length in the hole, {take} m")
        remaining -= take
        if remaining <= 1e-9:
            break
    else:
        raise InputError(
            f"enough to reach from the bit at {quantity(bit_depth, 'm')} to string.top_md, or no length of the last "
            "component, "
            "which then reaches it",
            key="string.components",
            value=Computed(f"{quantity(sum(c.length or 0 for c in components), 'm')} of string"),
        )
    while fed and lengths[-1] < SHORTEST_LONG_SEGMENT and owner[-2:] == owner[-1:] * 2:
        uppermost = lengths.pop()  # before the line below: `a[-2] += a.pop()` reads one item, writes another
        lengths[-1] += uppermost
        owner.pop()
    top = parts[-1]
    long_segment = fed or top.component.long_segment
    if long_segment and lengths[-1] < SHORTEST_LONG_SEGMENT - 1e-9:
        raise LongSegmentError(
            f"at least {quantity(SHORTEST_LONG_SEGMENT, 'm')} at every bit depth, as the top segment's length changes",
            key=f"string.components[{top.origin}]",
            value=f"{quantity(lengths[-1], 'm', '.3g')} of it at the top",
        )
    if deepest is not None:
        _check_feed(case, top.origin, deepest)
    check_segments(len(lengths))
    return String(
        top_md=case.string.top_md,
        bit_depth=bit_depth,
        length=perturb_lengths(np.array(lengths[::-1]), case.solver.perturbed),
        component=np.array(owner[::-1], dtype=np.int64),
        sections=sections_of(parts, case.mud.density),
        parts=tuple(parts),
        long_segment=long_segment,
        fluids=fluids_of(case, bit_depth),
    )


def _check_feed(case: Case, top: int, deepest: float) -> None:
    """Raise InputError when the component at the top ends before the bit is at ``deepest`` [m]."""
    lengths = [component.length for component in case.string.components[: top + 1]]
    if any(length is None for length in lengths):
        return
    reach = case.string.top_md + sum(length for length in lengths if length is not None)
    if deepest > reach + 1e-6:
        raise LongSegmentError(
            f"a length to reach a bit depth of {quantity(deepest, 'm')}, since a trip feeds pipe of one component only "
            "(make the component longer, or simulate a trip for each component)",
            key=f"string.components[{top}].length",
            value=f"enough for a bit depth of {quantity(reach, 'm')}",
        )


def check_segments(segments: float) -> None:
    """Raise InputError when the string has more segments than the state buffer holds."""
    if segments > state.MAX_SEGMENTS:
        raise InputError(
            f"at most {state.MAX_SEGMENTS} segments in all", key="string.components", value=f"{segments:.7g} segments"
        )


def check_lengths(string: String, taken: list[float]) -> None:
    """Raise AssertionError unless the segments of each component add up to its length in the hole, ``taken`` [m].

    Otherwise mass and weight of the string would be wrong.
    """
    if np.abs(np.bincount(string.origin, string.length) - taken).max() > SAME_LENGTH:
        raise AssertionError(f"the segments of a component do not add up to its length in the hole, {taken} m")


def _joint_by_joint(component: ComponentSpec, origin: int, take: float, fed: bool) -> Pieces:
    """Joints of ``take`` metres of a component from the bit up; below a long segment of it, where it is fed."""
    joint = repeat_of(component).every
    # Whole joints, but for rounding, that leave the long segment its shortest length.
    count = max(int(-ceiling((SHORTEST_LONG_SEGMENT - take) / joint)), 0) if fed else joints_in(component, take)
    check_segments(segments_in(component, count))  # before a list of them fills the memory
    if not fed:
        return cut_joints(component, origin, take, count, joint)
    below = cut_joints(component, origin, count * joint, count, joint) if count else []
    return [*below, (Part(component, origin), [take - count * joint])]


def _divide(part: ComponentSpec, take: float) -> list[float]:
    """Segments of ``take`` metres of a component from the bit up; remainder (0.5–1.5 nominal) on top."""
    whole = take if part.length is None else part.length
    nominal = whole / part.segments if part.segments is not None else part.segment_length
    assert nominal is not None  # ``lay_out`` cuts a component that has neither
    count = max(nearest(take / nominal), 1.0)
    check_segments(count)  # before a list of them fills the memory
    if abs(take - whole) < 1e-9:
        return [whole / count] * int(count)
    return [nominal] * int(count - 1) + [take - nominal * (count - 1)]
