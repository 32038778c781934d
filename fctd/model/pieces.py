"""The table of pieces of a hole: cylinders with overlap (§5.2, Fig. 8) or arcs, and their wall."""

import numpy as np

from fctd.arrays import Array
from fctd.case.hole import WellboreSpec
from fctd.case.wall import IntervalSpec
from fctd.mechanics import contact
from fctd.mechanics.state import CYLINDERS
from fctd.model import survey

# The first and last piece extend this far beyond surface and total depth [m].
RUN_OUT = 10.0
# Columns of the intervals and of what lies along the hole: lower end (or depth) [m], hole radius [m], wall stiffness
# [N/m or N/m/m], friction factor along the string, excess of the static factor as a share of it, decay speed [m/s],
# overbalance [Pa], friction factor around the string.
TO_MD, RADIUS, STIFFNESS, FRICTION, EXCESS, DECAY, OVERBALANCE, AROUND = range(8)
INTERVAL_COLUMNS = 8


def cylinders(longest_overlap: float, md: Array, points: Array) -> Array:
    """Cylinders between successive points, each but the last extended by the overlap (Fig. 8); no wall yet."""
    span = np.diff(points, axis=0)
    length = np.linalg.norm(span, axis=1)
    direction = span / length[:, None]
    pieces = np.zeros((len(length), contact.COLUMNS))
    pieces[:, contact.START : contact.START + 3] = points[:-1]
    pieces[:, contact.DIRECTION : contact.DIRECTION + 3] = direction
    pieces[:, contact.START_MD] = md[:-1]
    # Stations may be closer than the overlap, which must not exceed half of the next cylinder.
    overlap = np.minimum(longest_overlap, 0.5 * np.append(length[1:], 0.0))
    pieces[:, contact.OVERLAP] = overlap
    pieces[:, contact.LENGTH] = length + overlap
    pieces[0, contact.ALONE_FROM] = -np.inf
    pieces[0, contact.START : contact.START + 3] -= RUN_OUT * direction[0]
    pieces[0, contact.START_MD] -= RUN_OUT
    pieces[0, contact.LENGTH] += RUN_OUT
    pieces[-1, contact.LENGTH] += RUN_OUT
    pieces[:, contact.ALONE_TO] = pieces[:, contact.LENGTH] - overlap
    pieces[-1, contact.ALONE_TO] = np.inf
    return pieces


def arcs(courses: survey.Courses, md: Array) -> Array:
    """Arcs between successive depths, with a straight piece before the first and after the last; no wall yet."""
    point, tangent = survey.along_courses(courses, md)
    i = np.searchsorted(courses.md, md, side="right") - 1
    curvature, normal = courses.curvature[i], courses.normal[i]
    angle = (curvature * (md - courses.md[i]))[:, None]
    pieces = np.zeros((len(md) + 1, contact.COLUMNS))
    pieces[1:, contact.START : contact.START + 3] = point
    pieces[1:, contact.DIRECTION : contact.DIRECTION + 3] = tangent
    pieces[1:, contact.NORMAL : contact.NORMAL + 3] = np.cos(angle) * normal - np.sin(angle) * courses.tangent[i]
    pieces[1:-1, contact.CURVATURE] = curvature[:-1]
    pieces[1:-1, contact.LENGTH] = np.diff(md)
    pieces[-1, contact.LENGTH] = RUN_OUT
    pieces[1:, contact.START_MD] = md
    pieces[0] = pieces[1]
    pieces[0, contact.START : contact.START + 3] -= RUN_OUT * tangent[0]
    pieces[0, contact.CURVATURE] = 0.0
    pieces[0, contact.LENGTH] = RUN_OUT
    pieces[0, contact.START_MD] = md[0] - RUN_OUT
    half, length = 0.5 * pieces[:, contact.CURVATURE] * pieces[:, contact.LENGTH], pieces[:, contact.LENGTH]
    pieces[:, contact.HALF_COS] = np.cos(half)
    pieces[:, contact.HALF_SINE] = 0.5 * length * np.sinc(half / np.pi)
    return pieces


def fill_wall(pieces: Array, geometry: int, md: Array, intervals: Array, shoe: float) -> None:
    """Fill the wall's columns of laid-out pieces from the interval at the middle of each piece."""
    middle = 0.5 * (md[1:] + md[:-1])
    if geometry != CYLINDERS:  # with a straight piece before the first and after the last
        middle = np.concatenate([md[:1], middle, md[-1:]])
    k = np.minimum(np.searchsorted(intervals[:, TO_MD], middle), len(intervals) - 1)
    values = [contact.HOLE_RADIUS, contact.STIFFNESS, contact.FACTOR, contact.FACTOR_AROUND]
    pieces[:, values] = intervals[k][:, [RADIUS, STIFFNESS, FRICTION, AROUND]]
    pieces[:, contact.STATIC_EXCESS : contact.OVERBALANCE + 1] = intervals[k][:, EXCESS : OVERBALANCE + 1]
    if geometry != CYLINDERS:
        _lead_into_next(pieces, md, middle, intervals, shoe)
    else:
        bend = np.linalg.norm(np.diff(pieces[:, contact.DIRECTION : contact.DIRECTION + 3], axis=0), axis=1)
        pieces[1:, contact.ALONE_FROM] = pieces[:-1, contact.OVERLAP] + 4 * pieces[1:, contact.HOLE_RADIUS] * bend


def _lead_into_next(pieces: Array, md: Array, middle: Array, intervals: Array, length: float) -> None:
    """Make the wall of the shoe pieces below each interval change linearly from its values to the next one's."""
    values = [contact.HOLE_RADIUS, contact.STIFFNESS, contact.FACTOR, contact.FACTOR_AROUND]
    gains = [contact.RADIUS_GAIN, contact.STIFFNESS_GAIN, contact.FACTOR_GAIN, contact.GAIN_AROUND]
    start = np.concatenate([md[:1], md])
    for to_md in intervals[:-1, TO_MD]:
        (shoe,) = np.nonzero((middle > to_md) & (middle < to_md + length))
        if not len(shoe):
            continue
        share = (start[shoe] - to_md) / length
        for value, gain in zip(values, gains, strict=True):
            change = pieces[shoe, value] - pieces[shoe[0] - 1, value]
            pieces[shoe, value] -= (1 - share) * change
            pieces[shoe, gain] = change / length


def intervals_of(hole: WellboreSpec) -> Array:
    """The intervals (k, INTERVAL_COLUMNS) of a hole, columns above."""
    rows = [
        [
            i.to_md, 0.5 * i.diameter, _stiffness(hole, i), i.friction,
            i.static_excess, i.decay_speed or 0.0, i.overbalance or 0.0, i.friction_around,
        ]
        for i in hole.intervals
    ]  # fmt: skip
    return np.array(rows)


def _stiffness(hole: WellboreSpec, interval: IntervalSpec) -> float:
    """Wall stiffness of an interval [N/m per point, or N/m/m]: the interval's, else the wellbore's."""
    values = (interval.stiffness, interval.stiffness_per_length, hole.stiffness, hole.stiffness_per_length)
    return next(v for v in values if v is not None)
