"""The tally of a string that is tripped stand by stand: all segments of the run, and where the stands end."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.errors import Computed, InputError
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.case.string import ComponentSpec
from fctd.mechanics import state
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.default_layout import DefaultLayout
from fctd.model.drillstring import String, check_lengths, check_segments
from fctd.model.fluids import Fluids
from fctd.model.joints import Part, Pieces, cut_joints, repeat_of, sections_of, segments_in
from fctd.model.string_in_hole import check_clearance
from fctd.model.wellbore import Wellbore

# A stand may be longer or shorter by this share, to end where a component ends.
UNEVEN: Final = 0.1
# Largest inclination at the rotary table of a string that hangs in a derrick [rad].
STEEPEST_DERRICK: Final = np.radians(60.0)
SAME_ANGLE: Final = 1e-9  # [rad]: 60 deg in another unit is 60 deg


@dataclass(frozen=True)
class Tally:
    """All segments of a run that moves stands, from the top of the last stand to the bit.

    whole : the string with the bit at the greatest depth, whose ``top_md`` is not above 0 only where a stand sticks up.
    count (s + 1,) : number of segments from the bit up to the end of 0, 1, … s stands; reach (s + 1,) : their length
    [m].
    """

    whole: String
    count: NDArray[np.int64]
    reach: Array

    def __post_init__(self) -> None:
        from_bit = np.append(0.0, np.cumsum(self.whole.length[::-1]))
        if self.count[-1] != self.whole.segments or not np.allclose(from_bit[self.count], self.reach, atol=1e-6):
            raise AssertionError("the stands do not add up to the string")

    @property
    def stands(self) -> int:
        """Number of stands."""
        return len(self.reach) - 1

    def stands_for(self, bit_depth: float) -> int:
        """Number of stands that reach a bit depth [m]; the block is above the table by what they are longer."""
        return int(np.searchsorted(self.reach, bit_depth - 1e-9))

    def length_of(self, stand: int) -> float:
        """Length of a stand [m], counted from 1 at the bit."""
        return float(self.reach[stand] - self.reach[stand - 1])

    def string(self, stands: int, bit_depth: float) -> String:
        """The string of so many stands with the bit at a depth [m]; its ``top_md`` is negative above the table."""
        n = int(self.count[stands])
        length, component = self.whole.length[-n:], self.whole.component[-n:]
        return String(
            top_md=bit_depth - float(length.sum()),
            bit_depth=bit_depth,
            length=length,
            component=component,
            sections=self.whole.sections[: int(component[0]) + 1],
            parts=self.whole.parts[: int(component[0]) + 1],
            long_segment=False,
            fluids=self.whole.fluids,
        )

    def filled(self, fluids: Fluids | None) -> "Tally":
        """The same with fluids inside and outside the string."""
        return replace(self, whole=replace(self.whole, fluids=fluids))


def check_stands(tally: Tally, hole: Wellbore, shallowest: float) -> None:
    """Raise InputError for a string that is wider than its hole, or a hole too steep at the table for a derrick.

    shallowest : smallest bit depth of the run [m].
    """
    whole = tally.whole
    bottom = whole.top_md + np.cumsum(whole.length)
    check_clearance(whole, hole, bottom - whole.length - (whole.bit_depth - shallowest), bottom)
    tilt = float(hole.inclination(np.zeros(1))[0])
    if tilt > STEEPEST_DERRICK + SAME_ANGLE:
        raise InputError(
            f"a hole within {np.degrees(STEEPEST_DERRICK):g} deg of vertical at the rotary table, to move stands",
            key="wellbore",
            value=f"{np.degrees(tilt):.4g} deg",
        )


def lay_out_stands(case: Case, shallowest: float, deepest: float) -> Tally:
    """The tally of a run whose bit moves between two depths [m].

    Stands are counted from the bit.  Segments end where components and stands end; a stand that would end close to the
    end of a component ends there.  Raises InputError for a string or a stand with which no trip can be made.
    """
    rig, components = case.rig, case.string.components
    if case.string.top_md != 0:
        raise InputError(
            "0 m, the rotary table, where stands are moved",
            key="string.top_md",
            value=quantity(case.string.top_md, "m"),
        )
    ends = np.cumsum([np.inf if part.length is None else part.length for part in components])
    if ends[-1] < deepest - 1e-6:
        raise InputError(
            f"enough to reach a bit depth of {quantity(deepest, 'm')}",
            key="string.components",
            value=Computed(f"{quantity(ends[-1], 'm')} of string"),
        )
    if ends[-1] < rig.stand_length:
        raise InputError(
            f"at most the string, {quantity(ends[-1], 'm')}",
            key="rig.stand_length",
            value=quantity(rig.stand_length, "m"),
        )
    _check_joints(case)
    reach = _stand_ends(components, ends, rig.stand_length, deepest)
    longest = float(np.diff(reach).max())
    if longest > rig.derrick_height:
        raise InputError(
            f"stands that fit into rig.derrick_height, {quantity(rig.derrick_height, 'm')}",
            key="rig.stand_length",
            value=f"a stand of {quantity(longest, 'm', '.4g')}",
        )
    total = float(reach[-1])
    layout = None
    if any(part.cut_by_default for part in components):
        layout = DefaultLayout(case, shallowest, deepest, total)
    lengths: list[float] = []
    owner: list[int] = []
    parts: list[Part] = []
    count = [0]
    start = 0.0
    for end in np.union1d(reach[1:], ends[ends < total - 1e-9]).tolist():
        k = int(np.searchsorted(ends, 0.5 * (start + end)))
        for part, pieces in _cut(components[k], k, start, end, layout, len(lengths)):
            if not parts or parts[-1][1:] != part[1:]:  # a component goes on from one stand to the next
                parts.append(part)
            lengths += pieces
            owner += [len(parts) - 1] * len(pieces)
        if np.abs(reach - end).min() < 1e-9:
            count.append(len(lengths))
        start = end
    check_segments(len(lengths))
    whole = String(
        top_md=deepest - total,
        bit_depth=deepest,
        length=np.array(lengths[::-1]),
        component=np.array(owner[::-1], dtype=np.int64),
        sections=sections_of(parts, case.mud.density),
        parts=tuple(parts),
        long_segment=False,
    )
    check_lengths(whole, np.diff(np.append(0.0, np.minimum(ends, total)))[: parts[-1].origin + 1].tolist())
    return Tally(whole, np.array(count, dtype=np.int64), reach)


def _cut(
    component: ComponentSpec, origin: int, start: float, end: float, layout: DefaultLayout | None, before: int
) -> Pieces:
    """Segments of a component between two distances above the bit [m], in one stand.

    before : number of those below.  Joints are made to fit: a stand has whole ones.
    """
    if layout is not None and component.cut_by_default:
        check_segments(before + layout.count(start, end))
        pieces = layout.lengths(start, end)
    else:
        shares = (end - start) / _nominal(component)
        count = max(round(shares), 1)
        if component.repeat is not None:
            check_segments(before + segments_in(component, count))
            return cut_joints(component, origin, end - start, count, (end - start) / count)
        check_segments(before + shares)
        pieces = [(end - start) / count] * count
    if component.contact == "point":
        pieces = [(end - start) / len(pieces)] * len(pieces)
    return [(Part(component, origin), pieces)]


def _check_joints(case: Case) -> None:
    """Raise InputError where a component repeats and its stretches would have to be much longer or shorter to fit."""
    stand = case.rig.stand_length
    for component in case.string.components:
        if component.repeat is None or (component.length or np.inf) < stand:
            continue
        joint = repeat_of(component).every
        count = max(round(stand / joint), 1)
        if abs(stand / count - joint) > UNEVEN * joint:
            raise InputError(
                f"a whole number of {component.repeats} of {quantity(joint, 'm', '.4g')} within a tenth",
                key="rig.stand_length",
                value=quantity(stand, "m"),
            )


def _nominal(part: ComponentSpec) -> float:
    """Nominal length of a component's segments or joints [m]; infinite where one segment shall reach the table."""
    if part.repeat is not None:
        return repeat_of(part).every
    if part.segment_length is not None:
        return part.segment_length
    assert part.segments is not None  # ``lay_out_stands`` cuts a component that has neither
    return np.inf if part.length is None else part.length / part.segments


def _stand_ends(components: tuple[ComponentSpec, ...], ends: Array, stand: float, deepest: float) -> Array:
    """Distances from the bit at which stands end [m], from 0 to the first that reaches the deepest bit depth."""
    found = [0.0]
    while found[-1] < deepest - 1e-9:
        end = found[-1] + stand
        part = components[min(int(np.searchsorted(ends, end)), len(components) - 1)]
        nominal = stand if part.cut_by_default else _nominal(part)
        above = ends[ends > found[-1] + 1e-9]
        near = float(above[np.argmin(np.abs(above - end))])
        if part.contact == "point" or abs(near - end) <= min(0.5 * nominal, UNEVEN * stand):
            end = near  # a component that touches at a point is in the hole or not
        found.append(min(end, float(ends[-1])))
    return np.array(found)


def hang(S: Array, n: int) -> None:
    """Write into a filled buffer of n segments what those need that pass the rotary table (mechanics/derrick.py)."""
    row = state.row
    row(S, state.BUOYANCY, n)[:] = row(S, state.MASS, n) * GRAVITY - row(S, state.WEIGHT, n)
    row(S, state.IMMERSED, n)[:] = 1.0
    for whole, present in (
        (state.IN_MUD_AXIAL, state.MUD_AXIAL),
        (state.IN_MUD_LATERAL, state.MUD_LATERAL),
        (state.IN_MUD_SPIN, state.MUD_SPIN),
    ):
        row(S, whole, n)[:] = row(S, present, n)
