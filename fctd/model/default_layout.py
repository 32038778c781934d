"""Segment lengths of components that give none: short in bends and near the bit, longer elsewhere.

A segment's chord misses a bend of curvature κ by κh²/8.  It is kept within the clearance, so that a segment that
touches the outer side of a bend with both ends stays clear of the inner side.

Against segments of 2 m the first five wells of ``validation/parts/random_wells.py`` (seeds 0 to 4, tripping both ways
and rotating at total depth) have hook loads within 0.1 % and torques within 0.7 %; 1.1 % with a motor in a nearly
vertical hole.

At the bit a steady string has segments of half a metre: with 10 m the side force on the bit of a slick assembly is
wrong by up to a fifth, with these by 1.3 % (exact: a beam on its bit and its tangent point).  They are a dozen more
segments.  A string that moves keeps 10 m there, as its time step falls with its shortest segment.
"""

import numpy as np

from fctd.arrays import Array, ceiling
from fctd.case.load import Case
from fctd.model import survey
from fctd.model.tortuosity import resolving

# Longest segment, and the segment at the bit, of a steady string and of one that moves [m].  Between them, and beside
# bends, lengths grow by this share of the distance: the bending moment of a bend fades within a wave of the string,
# about 20 m.
LONGEST, AT_BIT, AT_MOVING_BIT, GROWTH = 30.0, 0.5, 10.0, 0.25
# The curvature is a mean over this length, as a dog-leg severity is: two close stations are no bend [m].
COURSE = 30.0
# A stabiliser's clearance does not rule the length of its neighbours [m].
LEAST_CLEARANCE = 0.005
# A sample so far below an end of a component or an interval lies at this end, but for rounding [m].
SAME_PLACE = 1e-6
# Distance of the samples along the string [m], and near the bit of a steady one, up to so far above it.
SAMPLE, SAMPLE_AT_BIT, NEAR_BIT = 5.0, 0.5, 30.0
# The last stations, and what ``_turned`` says of them.
_LAST: list[tuple[Array, tuple[Array, float]]] = [(np.empty(0), (np.empty(0), 0.0))]


class DefaultLayout:
    """The largest segment lengths along a string whose bit is at a depth [m], or moves from there to ``deepest`` [m].

    A string that moves, or whose ``deepest`` is its bit depth, keeps its segments: every part of it has the length that
    the sharpest place on its way needs.
    length : of the string [m], where it is longer than what is in the hole at ``bit_depth``.
    """

    def __init__(self, case: Case, bit_depth: float, deepest: float | None = None, length: float | None = None) -> None:
        in_hole = bit_depth - case.string.top_md if length is None else length
        samples = max(int(ceiling(in_hole / SAMPLE)), 2) + 1
        self.above_bit, apart = np.linspace(0.0, in_hole, samples, retstep=True)
        steady, deepest = deepest is None, bit_depth if deepest is None else max(deepest, bit_depth)
        way = int(ceiling((deepest - bit_depth) / apart))
        # From the deepest place upwards: row i has the places of sample i, from the end of the trip to its beginning.
        md = deepest - apart * np.arange(samples + way)
        hole, bend = (np.lib.stride_tricks.sliding_window_view(a, way + 1) for a in _hole(case, md))
        clearance = np.maximum(hole - self._contact_radius(case)[:, None], LEAST_CLEARANCE)
        longest = min(LONGEST, resolving(case.wellbore.tortuosity))
        limit = np.minimum(np.sqrt(8 * clearance / np.maximum(bend, 1e-12)).min(axis=1), longest)
        limit[0] = min(limit[0], AT_BIT if steady else AT_MOVING_BIT)
        grown = GROWTH * self.above_bit
        limit = np.minimum.accumulate(limit - grown) + grown
        self.limit = np.minimum.accumulate((limit + grown)[::-1])[::-1] - grown
        if steady:
            samples_of_bit = np.arange(0.0, min(NEAR_BIT, in_hole), SAMPLE_AT_BIT)
            finer = np.union1d(self.above_bit, samples_of_bit)
            self.above_bit, self.limit = finer, np.interp(finer, self.above_bit, self.limit)
        shares = 0.5 * np.diff(self.above_bit) * (1 / self.limit[1:] + 1 / self.limit[:-1])
        self._count = np.append(0.0, np.cumsum(shares))

    def _contact_radius(self, case: Case) -> Array:
        """Contact radius [m] at the samples."""
        parts = case.string.components
        ends = np.cumsum([np.inf if part.length is None else part.length for part in parts])
        k = np.minimum(np.searchsorted(ends, self.above_bit - SAME_PLACE), len(parts) - 1)
        return np.array([0.5 * part.contact_diameter for part in parts])[k]

    def at(self, above_bit: Array) -> Array:
        """The largest length [m] of segments at distances above the bit (n,) [m]."""
        return np.interp(above_bit, self.above_bit, self.limit)

    def count(self, start: float, end: float) -> int:
        """Number of segments between two distances above the bit [m]."""
        first, last = np.interp([start, end], self.above_bit, self._count)
        return max(int(ceiling(last - first)), 1)

    def lengths(self, start: float, end: float) -> list[float]:
        """Segments from one distance above the bit to another [m], from the lower end upwards."""
        first, last = np.interp([start, end], self.above_bit, self._count)
        shares = np.linspace(first, last, self.count(start, end) + 1)[1:-1]
        ends = np.concatenate([[start], np.interp(shares, self._count, self.above_bit), [end]])
        lengths: list[float] = np.diff(ends).tolist()
        return lengths


def _hole(case: Case, md: Array, course: Array | float = COURSE) -> tuple[Array, Array]:
    """Radius [m] and curvature [1/m] of the hole at depths (n,) [m], the curvature as a mean over a course [m]."""
    intervals = case.wellbore.intervals
    ends = [interval.to_md for interval in intervals]
    i = np.minimum(np.searchsorted(ends, md - SAME_PLACE), len(intervals) - 1)
    radius = np.array([0.5 * interval.diameter for interval in intervals])[i]
    return radius, mean_curvature(case.wellbore.trajectory, md, course)


def sagittas(case: Case, md: Array, length: Array, radius: Array) -> tuple[Array, Array]:
    """By how much segments miss the axis of the hole in their middle, κh²/8, and their clearances (n,) [m].

    md, length, radius (n,) [m] : depths of their middles, and contact radii.  κ is the mean over a segment, or over a
    ``COURSE`` where the segment is shorter.  The layout keeps the sagitta within the clearance on the mean over a
    segment, so that single segments miss by up to 1.3 clearances.
    """
    hole, bend = _hole(case, md, np.maximum(length, COURSE))
    return bend * length**2 / 8, hole - radius


def largest_sagitta(case: Case, length: float) -> float:
    """The sagitta [m] of a segment of a length [m] in the sharpest arc of the hole."""
    return _turned(case.wellbore.trajectory)[1] * length**2 / 8


def mean_curvature(stations: Array, md: Array, course: Array | float = COURSE) -> Array:
    """Mean curvature [1/m] of a course about each depth (n,) [m]; stations (k, 3) [m, rad, rad]."""
    turned, _ = _turned(stations)
    below, above = (np.interp(md + side * 0.5 * course, stations[:, 0], turned) for side in (1, -1))
    return np.asarray((below - above) / course)


def _turned(stations: Array) -> tuple[Array, float]:
    """How far the hole turns down to each of its stations (k,) [rad], and its largest curvature [1/m].

    They are kept, as rows of a chart ask for one hole.
    """
    known, found = _LAST[0]
    if known is not stations or stations.flags.writeable:
        turns, long = survey.dogleg(stations), np.diff(stations[:, 0])
        sharpest = np.divide(turns, long, out=np.zeros_like(turns), where=long > 0).max(initial=0.0)
        found = np.append(0.0, np.cumsum(turns)), float(sharpest)
        _LAST[0] = stations, found
    return found
