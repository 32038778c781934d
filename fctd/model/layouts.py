"""Segment lengths of a string: uniform, or graded (short in bends and near the bit, longer elsewhere).

A layout is a list of components, so that a case can have it.  A graded layout divides a component into several of
the same pipe; it is counted from the bit upwards and made for one bit depth.
"""

from collections.abc import Callable
from itertools import groupby
from typing import Any

import numpy as np

from fctd.arrays import Array, ceiling
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.string import ComponentSpec
from fctd.model import survey
from fctd.model.default_layout import AT_MOVING_BIT, DefaultLayout
from fctd.model.fluids import SAME_PLACE, fluids_of
from fctd.model.joints import finer, joints_in, longest_segment, segments_in
from fctd.model.section import buoyed, section_of

Components = tuple[ComponentSpec, ...]
# A case, a bit depth [m], the length of the shortest segments [m] and the least number of segments of a component to
# components.
Layout = Callable[[Case, float, float, int], Components]

# Largest ratio of a segment to the shortest one; lengths differ by factors of two.
LONGEST = 8.0
# A hole whose curvature is nowhere larger counts as straight [1/m].
STRAIGHT = np.radians(0.5) / 30
# What components up to this length [m], and bent ones, do to the string beside them fades within its wave, of some
# 20 m: it shows on segments of at most that length [m].
SHORT, BESIDE_SHORT = 30.0, 10.0
# Components are cut into a least number of segments down to this length [m].
SHORTEST = 0.5
# Weight that pipe which floats is taken to have at least [N/m].
FLOATS = 1.0
SAMPLES = 4000


def with_components(case: Case, components: Components) -> Case:
    """The case with another string."""
    return case.model_copy(update={"string": case.string.model_copy(update={"components": components})})


def uniform(case: Case, bit_depth: float, length: float, least: int = 1) -> Components:
    """Every component in equal segments of about ``length`` [m], a shorter one in ``least``; a long segment stays."""
    return tuple(_cut(part, length, least) for part in case.string.components)


def graded(case: Case, bit_depth: float, length: float, least: int = 1) -> Components:
    """Segments of about ``length`` [m] at the bit and in the sharpest bend, longer where ``coarseness`` is larger.

    A component of fewer than ``least`` segments is cut into these.
    """
    above_bit, factor = coarseness(case, bit_depth)
    pieces: list[ComponentSpec] = []
    start, total = 0.0, bit_depth - case.string.top_md
    for part in case.string.components:
        end = total if part.length is None else min(start + part.length, total)
        if start >= total - 1e-9 or not is_cut(part):
            pieces.append(part)
        elif part.contact == "point":
            pieces.append(_cut(part, length, least))
        else:
            runs = _walk(start, end, length, above_bit, factor)
            enough = sum(count for _, count in runs) >= _at_least(part, least)
            pieces += _grade(part, runs) if enough else (_cut(part, np.inf, least),)
        start = end
    return tuple(pieces)


def resolved(case: Case, bit_depth: float, md: Array, needed: Array) -> Components:
    """Segments of at most ``needed`` (n,) [m] beside the measured depths ``md`` (n,) [m], rising; else the case's own.

    A component is cut where that changes by a factor of two; the paper's long segment stays.  Of one that resolves its
    joints all bodies are cut alike.
    """
    pieces: list[ComponentSpec] = []
    start, total = 0.0, bit_depth - case.string.top_md
    above_bit, shortest = bit_depth - md[::-1], needed[::-1]
    by_default = DefaultLayout(case, bit_depth).at(above_bit)
    for part in case.string.components:
        end = total if part.length is None else min(start + part.length, total)
        own = by_default if part.cut_by_default else np.full(len(above_bit), _nominal(part, end - start))
        inside = (above_bit >= start) & (above_bit <= end)
        if start >= total or is_long(part) or (shortest[inside] >= own[inside]).all():
            pieces.append(part)
        elif part.repeat is not None:
            pieces.append(finer(part, float(shortest[inside].min())))
        elif part.contact == "point":
            pieces.append(_cut(part, float(np.minimum(shortest, own)[inside].min())))
        else:
            longest = float(own[inside].max())
            wanted = np.minimum(shortest, own)
            least = float(wanted[inside].min())
            unit = longest / ceiling(longest / least)
            # The few short segments at the bit do not keep the others from being longer.
            at_most = LONGEST * max(float(np.minimum(shortest, AT_MOVING_BIT)[inside].min()) / least, 1.0)
            factor = np.minimum(wanted / unit, at_most)
            pieces += _grade(part, _walk(start, end, unit, above_bit, factor, at_most))
        start = end
    return tuple(pieces)


def by_default(case: Case) -> Components:
    """Segments as a case has them that gives no lengths and resolves no joints; a long segment stays."""
    none = {"segments": None, "segment_length": None, "joint_segments": None}
    return tuple(part if is_long(part) else part.model_copy(update=none) for part in case.string.components)


LAYOUTS: dict[str, Layout] = {"uniform": uniform, "graded": graded}


def coarseness(case: Case, bit_depth: float) -> tuple[Array, Array]:
    """Distances above the bit (n,) [m] and how many times as long as the shortest a segment may be there (n,).

    A segment's chord misses a bend of curvature κ by κh²/8, so lengths go with 1/√κ.  Away from bends and bit they
    grow by the shortest one over the length of a wave in which a string lies in the hole, 2π (EI r/w)^¼ (Dawson &
    Paslay 1984).
    """
    stations = case.wellbore.trajectory
    above_bit = np.linspace(0.0, bit_depth - case.string.top_md, SAMPLES)
    md = bit_depth - above_bit
    course = np.minimum(np.searchsorted(stations[:, 0], md, side="right") - 1, len(stations) - 2)
    curvature = (survey.dogleg(stations) / np.diff(stations[:, 0]))[course]
    sharpest = max(float(curvature.max()), STRAIGHT)
    factor = np.minimum(np.sqrt(sharpest / np.maximum(curvature, 1e-12)), LONGEST)
    factor[0] = 1.0
    travelled = np.concatenate([[0.0], np.cumsum(np.diff(above_bit) / _wave(case, md, above_bit)[1:])])
    factor = np.minimum.accumulate(factor - travelled) + travelled
    factor = (np.minimum.accumulate((factor + travelled)[::-1]))[::-1] - travelled
    return above_bit, factor


def _wave(case: Case, md: Array, above_bit: Array) -> Array:
    """2π (EI r/w)^¼ [m] along the string."""
    parts = case.string.components
    ends = np.cumsum([np.inf if part.length is None else part.length for part in parts])
    k = np.minimum(np.searchsorted(ends, above_bit), len(parts) - 1)
    sections = [section_of(part, case.mud.density) for part in parts]
    intervals = case.wellbore.intervals
    i = np.minimum(np.searchsorted([interval.to_md for interval in intervals], md), len(intervals) - 1)
    hole = np.array([0.5 * interval.diameter for interval in intervals])[i]
    slack = np.maximum(hole - np.array([s.contact_radius for s in sections])[k], 1e-3)
    stiffness, weight = (np.array([getattr(s, name) for s in sections])[k] for name in ("EI", "weight"))
    fluids = fluids_of(case, float(md[0] + above_bit[0]))
    if fluids is not None:
        inside, outside = fluids.densities(above_bit, above_bit - SAME_PLACE)
        mass, density, inner = np.array([(s.mass, s.density, s.inner) for s in sections])[k].T
        weight = np.maximum(np.abs(buoyed(mass, density, inner, outside, inside)), FLOATS)
    return np.asarray(2 * np.pi * (stiffness * slack / weight) ** 0.25)


def segments_in_hole(case: Case, bit_depth: float) -> int:
    """Approximate number of segments with the bit at a depth [m]; counted without laying out the string."""
    remaining, count = bit_depth - case.string.top_md, 0.0
    for part in case.string.components:
        take = remaining if part.length is None else min(part.length, remaining)
        if take <= 0:
            break
        if part.cut_by_default:
            start = bit_depth - case.string.top_md - remaining
            count += DefaultLayout(case, bit_depth).count(start, start + take)
        elif part.repeat is not None:
            count += segments_in(part, joints_in(part, take))
        else:
            nominal = part.segment_length or (take if part.length is None else part.length) / (part.segments or 1)
            count += max(take / nominal, 1)
        remaining -= take
    return round(count)


def divided_length(case: Case, bit_depth: float) -> float:
    """Length of the part of the string in the hole that is cut, without the paper's long segment [m].

    Raises InputError where that is all of the string.
    """
    in_hole = bit_depth - case.string.top_md
    last = case.string.components[-1]
    if not is_long(last):
        return in_hole
    cut = sum(part.length or 0.0 for part in case.string.components)
    if cut == 0:
        raise InputError("a component that can be cut, beside the long segment", key="string.components")
    return min(in_hole, cut)


def has_short(case: Case) -> bool:
    """Whether a component is bent or short."""
    return any(part.bend or (part.length or np.inf) <= SHORT for part in case.string.components)


def _nominal(part: ComponentSpec, in_hole: float) -> float:
    """Length of a component's segments [m], of the longest where it resolves its joints."""
    if part.repeat is not None:
        return longest_segment(part)
    if part.segment_length is not None:
        return part.segment_length
    assert part.segments is not None  # the caller has taken out those that are cut by default
    return (in_hole if part.length is None else part.length) / part.segments


def is_long(part: ComponentSpec) -> bool:
    """Whether a component is the paper's long segment."""
    return part.length is None and part.segments == 1


def is_cut(part: ComponentSpec) -> bool:
    """Whether a layout cuts a component: neither the paper's long segment nor one that resolves its joints."""
    return not is_long(part) and part.repeat is None


def _at_least(part: ComponentSpec, least: int) -> int:
    """The least number of segments of a component, in which none is shorter than ``SHORTEST``."""
    return 1 if part.length is None else max(min(least, int(part.length / SHORTEST)), 1)


def _cut(part: ComponentSpec, length: float, least: int = 1) -> ComponentSpec:
    if not is_cut(part):
        return part
    if part.length is None:
        return part.model_copy(update={"segments": None, "segment_length": length})
    count = max(round(part.length / length), _at_least(part, least))
    return part.model_copy(update={"segments": count, "segment_length": None})


def _grade(part: ComponentSpec, runs: list[tuple[float, int]]) -> Components:
    """A component as runs of equal segments, from the lower end upwards; a bend stays at its upper end."""
    pieces = [
        part.model_copy(update={"length": length, "segments": count, "segment_length": None, "bend": 0.0})
        for length, count in runs
    ]
    length, count = runs[-1]
    top: dict[str, Any] = {"bend": part.bend}
    if part.length is not None:
        top["length"] = part.length - sum(run for run, _ in runs[:-1])
    if part.length is None or top["length"] > length + 0.01:  # longer than its part in the hole
        top |= {"length": top.get("length"), "segments": None, "segment_length": round(length / count, 6)}
    return (*pieces[:-1], pieces[-1].model_copy(update=top))


def _walk(
    start: float, end: float, length: float, above_bit: Array, factor: Array, at_most: float = LONGEST
) -> list[tuple[float, int]]:
    """Runs of equal segments from ``start`` to ``end`` above the bit [m]: length of a run, segments in it.

    at_most : times ``length`` is the longest segment.
    """
    lengths: list[float] = []
    at = start
    while at < end:
        step = length
        # Twice as long while the string allows it all along the segment.
        while step < at_most * length and _least(at, at + 2 * step, above_bit, factor) > 1.999 * step / length:
            step *= 2
        lengths.append(min(step, end - at))
        at += step
    if len(lengths) > 1 and lengths[-1] < 0.5 * lengths[-2]:
        left_over = lengths.pop()
        lengths[-1] += left_over
    # The remainder at the upper end is spread over the last run.
    runs = [list(same) for _, same in groupby(lengths[:-1])]
    if runs and lengths[-1] < 1.5 * runs[-1][0]:
        runs[-1].append(lengths[-1])
    else:
        runs.append(lengths[-1:])
    # Rounded to millimetres, to keep the case file readable.
    return [(round(float(sum(run)), 3), len(run)) for run in runs]


def _least(start: float, end: float, above_bit: Array, factor: Array) -> float:
    """The least factor between two distances above the bit."""
    first, last = np.searchsorted(above_bit, [start, end])
    return float(factor[min(first, len(factor) - 1) : last + 1].min())
