"""The wall of a sampled hole: a caliper's radii in the cells of its table of pieces (mechanics/sampled.py)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array
from fctd.case.calipers.caliper import Caliper
from fctd.case.hole import WellboreSpec
from fctd.mechanics import contact, sampled
from fctd.mechanics.disc import roll_disc
from fctd.mechanics.sampled import PER_CELL
from fctd.model.frames import hole_frame
from fctd.model.pieces import RADIUS, TO_MD

# Longest cell around the hole [m], fewest cells, and points of the wall in each of them.
CELL_AROUND, FEWEST, POINTS = 0.02, 16, 8
# A wall that lies within this of the round hole is round [m].
ROUND = 1e-9
# Depths that are equal but for rounding differ by less than this [m].
SAME_DEPTH = 1e-6
# Shortest piece as a share of a cell; ways of a disc that is hardly narrower than its hole count as this much [m].
SHORTEST, SHORTEST_WAY = 0.05, 0.005


@dataclass(frozen=True)
class Sampling:
    """What the cells of a sampled hole are made of.

    caliper : None where nothing was measured; open_hole : from, to and radius of each interval of open hole [m]; cell :
    length of cells along it [m]; radii : of the discs that may touch the wall [m], first 0: the wall itself.
    """

    caliper: Caliper | None
    open_hole: tuple[tuple[float, float, float], ...]
    cell: float
    radii: tuple[float, ...]

    def has(self, radii: Array) -> bool:
        """Whether the contact of discs of all these radii [m] is among those of the cells."""
        known = np.array(self.radii)
        return bool((np.abs(np.unique(radii)[:, None] - known).min(axis=1) <= sampled.SAME_RADIUS).all())

    def with_radii(self, radii: Array) -> "Sampling":
        """The same with the contact of further discs."""
        return replace(self, radii=tuple(np.union1d(self.radii, np.unique(radii)).tolist()))

    def borders(self, ends: Array, intervals: Array) -> Array:
        """The ends of intervals (k, INTERVAL_COLUMNS) among ``ends`` (m,) [m], from the first on, that cut the hole.

        Within open hole that was measured a border between equal intervals does not cut the cell that it lies in.
        """
        if self.caliper is None or not len(ends):
            return ends
        alike = np.append((intervals[1:, RADIUS:] == intervals[:-1, RADIUS:]).all(axis=1), False)[: len(ends)]
        alike &= (ends > self.caliper.md[0]) & (ends < self.caliper.md[-1])
        within = [(ends > top) & (ends < bottom) for top, bottom, _ in self.open_hole]
        return ends[~(alike & np.any(within, axis=0))] if within else ends

    def cut(self, md: Array) -> Array:
        """Ends of pieces [m], with those of cells where open hole was measured.

        A cell more, above and below, leads back to the round hole.
        """
        if self.caliper is None:
            return md
        ends: list[Array] = []
        for top, bottom, _ in self.open_hole:
            first, last = max(float(self.caliper.md[0]), top), min(float(self.caliper.md[-1]), bottom)
            if last > first:
                count = int(np.ceil((last - first - SAME_DEPTH) / self.cell))
                ends.append(np.linspace(first - self.cell, last + self.cell, count + 3))
        if not ends:
            return md
        cells = np.concatenate(ends)
        cells = cells[(cells > md[0]) & (cells < md[-1])]
        # No cell is far shorter than the others.
        i = np.clip(np.searchsorted(md, cells), 1, len(md) - 1)
        apart = np.minimum(np.abs(cells - md[i - 1]), np.abs(cells - md[i]))
        return np.union1d(md, cells[apart > SHORTEST * self.cell])


def sampling_of(hole: WellboreSpec, ends: Array, radii: Sequence[float]) -> Sampling:
    """The sampling of a hole whose intervals have these ends [m], for discs of radii [m].

    Intervals of one size are one stretch of open hole, in however many pieces a case writes it.
    """
    open_hole: list[tuple[float, float, float]] = []
    starts = np.concatenate([[0.0], ends[:-1]])
    for start, end, interval in zip(starts.tolist(), ends.tolist(), hole.intervals, strict=True):
        radius = 0.5 * interval.diameter
        if interval.kind == "cased":
            continue
        if open_hole and open_hole[-1][1:] == (start, radius):
            start, _, _ = open_hole.pop()
        open_hole.append((start, end, radius))
    return Sampling(hole.calipers, tuple(open_hole), hole.cell, tuple(np.union1d([0.0], radii).tolist()))


def turns(pieces: Array) -> Array:
    """Angles [rad] of every piece from the normal of its arc to the direction from which angles around the hole count.

    That direction goes with the hole without turning about it.  From the end of one arc to the start of the next it is
    the same, and normals differ by the angle between their planes.
    """
    tangent, normal = _vectors(pieces, contact.DIRECTION), _vectors(pieces, contact.NORMAL)
    angle = (pieces[:, contact.CURVATURE] * pieces[:, contact.LENGTH])[:, None]
    binormal, at_end = np.cross(tangent, normal), np.cos(angle) * normal - np.sin(angle) * tangent
    following = normal[1:]
    between = np.arctan2((following * binormal[:-1]).sum(axis=1), (following * at_end[:-1]).sum(axis=1))
    return -np.concatenate([[0.0], np.cumsum(between)])


def reference_angles(pieces: Array, reference: str) -> Array:
    """Angles [rad] around the hole of the high side, or of north, in the middle of every piece."""
    tangent, normal = _vectors(pieces, contact.DIRECTION), _vectors(pieces, contact.NORMAL)
    half = (0.5 * pieces[:, contact.CURVATURE] * pieces[:, contact.LENGTH])[:, None]
    there, to_centre = np.cos(half) * tangent + np.sin(half) * normal, np.cos(half) * normal - np.sin(half) * tangent
    if reference == "north":
        towards = np.array([1.0, 0.0, 0.0]) - there[:, :1] * there
    else:
        towards, _ = hole_frame(there)
    binormal = np.cross(tangent, normal)
    return np.asarray(np.arctan2((towards * binormal).sum(axis=1), (towards * to_centre).sum(axis=1)) - turns(pieces))


def wall_around(radii: Array, first: Array, angles: Array) -> Array:
    """Radii (n, m) [m] of sections at angles (m,) [rad], of those that the arms of a caliper measured (n, arms).

    first (n,) : angle of the first arm; the others follow at equal angles.  One arm: a circle.  Two: an ellipse with
    these half axes.  More: a periodic cubic that has its extremes at the arms (Fritsch & Butland 1984).
    """
    turned = angles[None, :] - first[:, None]
    arms = radii.shape[1]
    if arms == 1:
        return np.broadcast_to(radii, turned.shape).copy()
    if arms == 2:
        a, b = radii[:, :1], radii[:, 1:]
        return np.asarray(a * b / np.hypot(b * np.cos(turned), a * np.sin(turned)))
    rise = np.roll(radii, -1, axis=1) - radii
    before, product = np.roll(rise, 1, axis=1), np.roll(rise, 1, axis=1) * rise
    slope = np.where(product > 0, 2 * product / np.where(product > 0, before + rise, 1.0), 0.0)
    place = np.mod(turned * arms / (2 * np.pi), arms)
    k = np.minimum(place.astype(np.int64), arms - 1)
    t, following = place - k, (k + 1) % arms

    def of(values: Array, column: NDArray[np.int64]) -> Array:
        return np.asarray(np.take_along_axis(values, column, axis=1))

    here, there = of(radii, k), of(radii, following)
    bend = (there - here) * t * t * (3 - 2 * t)
    return np.asarray(here + bend + of(slope, k) * t * (1 - t) ** 2 - of(slope, following) * t * t * (1 - t))


def cells_around(radius: float) -> int:
    """Number of cells around a hole of a radius [m]."""
    return max(FEWEST, 4 * int(np.ceil(2 * np.pi * radius / CELL_AROUND / 4)))


def in_cells(caliper: Caliper, top: Array, bottom: Array) -> tuple[Array, Array]:
    """Mean radii (n, arms) [m] between measured depths (n,) [m], NaN where a row is missing, and angles (n,) of arm 1.

    Means and not single rows: a log may have more rows than the table has cells.
    """
    steps = np.diff(caliper.md)[:, None]
    areas = np.vstack([np.zeros(caliper.radii.shape[1]), np.cumsum(0.5 * steps * _pairs(caliper.radii, 0.0), axis=0)])
    missing = np.isnan(_pairs(caliper.radii, np.nan)).any(axis=1)
    gaps = np.concatenate([[0], np.cumsum(missing)])
    first = np.clip(np.searchsorted(caliper.md, top + SAME_DEPTH, side="right") - 1, 0, len(steps))
    last = np.clip(np.searchsorted(caliper.md, bottom - SAME_DEPTH, side="left"), 0, len(steps))
    outside = (top < caliper.md[0] - SAME_DEPTH) | (bottom > caliper.md[-1] + SAME_DEPTH) | (gaps[last] > gaps[first])
    filled = np.nan_to_num(caliper.radii)
    of = [
        (
            _integral(caliper.md, filled[:, k], areas[:, k], bottom)
            - _integral(caliper.md, filled[:, k], areas[:, k], top)
        )
        / (bottom - top)
        for k in range(filled.shape[1])
    ]
    radii = np.stack(of, axis=1)
    radii[outside] = np.nan
    nearest = np.clip(np.searchsorted(caliper.md, 0.5 * (top + bottom) - SAME_DEPTH), 0, len(caliper.md) - 1)
    return radii, caliper.angles[nearest, 0]


def sample(pieces: Array, sampling: Sampling) -> Array:
    """The table of pieces (m, ...) of arcs with the columns of a sampled hole.

    Below its end the hole goes on as it was measured there: a string with its bit at the end stretches beyond it.
    """
    top = pieces[:, contact.START_MD].copy()
    bottom = top + pieces[:, contact.LENGTH]
    top[-1], bottom[-1] = top[-2], bottom[-2]
    middle = 0.5 * (top + bottom)
    nominal = np.full(len(pieces), np.nan)  # where the hole is cased
    for first, last, radius in sampling.open_hole:
        nominal[(middle > first) & (middle < last)] = radius
    cells = cells_around(max((radius for _, _, radius in sampling.open_hole), default=0.0))
    size = 1 + PER_CELL * cells
    table = np.zeros((len(pieces), sampled.TABLES + len(sampling.radii) * size))
    table[:, : contact.COLUMNS] = pieces
    table[:, sampled.TURN_COS] = 1.0
    table[:, sampled.TABLES :: size] = sampling.radii
    if sampling.caliper is None:
        return table
    measured, first_arm = in_cells(sampling.caliper, top, bottom)
    (known,) = np.nonzero(~np.isnan(nominal) & ~np.isnan(measured).any(axis=1))
    if not len(known):
        return table
    start = reference_angles(pieces, sampling.caliper.reference)[known] + first_arm[known]
    # Cells count from the first arm: the normal of a straight piece is that of rounding.
    turn, start = turns(pieces) + start[0], start - start[0]
    table[:, sampled.TURN_COS], table[:, sampled.TURN_SIN] = np.cos(turn), np.sin(turn)
    angles = np.linspace(0.0, 2 * np.pi, POINTS * cells, endpoint=False)
    wall = wall_around(measured[known], start, angles)
    is_round = np.ones(len(known), np.bool_)
    # From which the cells deviate: at a shoe the radius of the table changes along the piece.
    of = pieces[known]
    at_middle = of[:, contact.HOLE_RADIUS] + 0.5 * of[:, contact.RADIUS_GAIN] * of[:, contact.LENGTH]
    for k, radius in enumerate(sampling.radii):
        ways, corners = wall[:, ::POINTS], np.zeros((len(known), cells, 2))
        if radius:
            ways = np.empty((len(known), cells))
            roll_disc(wall, radius, cells, ways, corners)
        deviation = ways + radius - at_middle[:, None]
        deviation[np.abs(deviation) < ROUND] = 0.0
        at = sampled.TABLES + k * size + 1
        of_cells = np.concatenate([deviation[:, :, None], corners], axis=2)
        table[known, at : at + PER_CELL * cells] = of_cells.reshape(len(known), PER_CELL * cells)
        is_round &= (deviation == 0).all(axis=1)
    uneven = np.zeros(len(pieces), np.bool_)
    uneven[known] = ~is_round
    beside = uneven | np.append(uneven[1:], False) | np.append(False, uneven[:-1])
    table[beside, sampled.AROUND_CELLS] = cells
    return table


def deviations(pieces: Array) -> tuple[Array, NDArray[np.int64]]:
    """Deviations (m, cells) of the wall itself [m], of the cells that are not round, and their rows (m,)."""
    (rows,) = np.nonzero(pieces[:, sampled.AROUND_CELLS])
    cells = int(pieces[:, sampled.AROUND_CELLS].max())
    return pieces[rows, sampled.TABLES + 1 : sampled.TABLES + 1 + PER_CELL * cells : PER_CELL], rows


def has_corners(pieces: Array) -> bool:
    """Whether any disc touches two places at once in any cell."""
    (rows,) = np.nonzero(pieces[:, sampled.AROUND_CELLS])
    if not len(rows):
        return False
    size = 1 + PER_CELL * int(pieces[rows[0], sampled.AROUND_CELLS])
    of_cells = pieces[rows, sampled.TABLES :].reshape(len(rows), -1, size)[:, :, 1:]
    return bool(of_cells[:, :, PER_CELL - 1 :: PER_CELL].any())


def narrow_cells(pieces: Array) -> tuple[Array, Array]:
    """Measured depths (k, 2) [m] of the ends of cells that are not round, and half their least diameters (k,) [m]."""
    found, rows = deviations(pieces)
    of, half = pieces[rows], found.shape[1] // 2
    across = 0.5 * (found[:, :half] + found[:, half:]).min(axis=1, initial=np.inf)
    top, length = of[:, contact.START_MD], of[:, contact.LENGTH]
    nominal = of[:, contact.HOLE_RADIUS] + np.minimum(of[:, contact.RADIUS_GAIN] * length, 0.0)
    return np.column_stack([top, top + length]), nominal + across


def with_mean_radii(rows: Array, pieces: Array) -> Array:
    """The wall along a hole, rows of ``Wellbore.wall_along``, with the circles of the same area as its cells."""
    found, cells = deviations(pieces)
    if not len(cells):
        return rows
    of = pieces[cells]
    md = of[:, contact.START_MD] + 0.5 * of[:, contact.LENGTH]
    nominal = of[:, contact.HOLE_RADIUS] + 0.5 * of[:, contact.RADIUS_GAIN] * of[:, contact.LENGTH]
    radius = np.sqrt(((nominal[:, None] + found) ** 2).mean(axis=1))
    depths = np.union1d(rows[:, TO_MD], md)
    along = np.column_stack([depths, *(np.interp(depths, rows[:, TO_MD], column) for column in rows.T[1:])])
    # From the middle of a cell to that of the next the radius is theirs, also where an interval ends there.
    below = np.minimum(np.searchsorted(md, depths), len(md) - 1)
    measured = (md[below] == depths) | ((md[below] > depths) & (cells[below] == cells[below - 1] + 1))
    along[measured, RADIUS] = np.interp(depths[measured], md, radius)
    return along


def mean_radii(rows: Array, top: Array, bottom: Array) -> Array:
    """Means (n,) [m] between measured depths (n,) of the radius that rows of ``Wellbore.wall_along`` have.

    Above the first row and below the last one it is theirs.
    """
    first, last = min(0.0, float(top.min())), max(float(bottom.max()), float(rows[-1, TO_MD]))
    md = np.concatenate([[first], rows[:, TO_MD], [last + 1.0]])
    radius = np.concatenate([rows[:1, RADIUS], rows[:, RADIUS], rows[-1:, RADIUS]])
    areas = np.append(0.0, np.cumsum(0.5 * np.diff(md) * (radius[1:] + radius[:-1])))
    area = _integral(md, radius, areas, bottom) - _integral(md, radius, areas, top)
    return np.asarray(area / (bottom - top))


def steepest(pieces: Array) -> float:
    """Bound of the slope of the wall, along and around the hole together, against that of the round hole."""
    (rows,) = np.nonzero(pieces[:, sampled.AROUND_CELLS])
    if not len(rows):
        return 0.0
    cells = int(pieces[rows[0], sampled.AROUND_CELLS])
    size, worst = 1 + PER_CELL * cells, 0.0
    for at in range(sampled.TABLES, pieces.shape[1], size):
        radius, of = pieces[0, at], pieces[:, at + 1 : at + 1 + PER_CELL * cells : PER_CELL]
        apart = 0.5 * (pieces[rows[1:], contact.LENGTH] + pieces[rows[:-1], contact.LENGTH])
        along = np.abs(of[rows[1:]] - of[rows[:-1]]).max(axis=1) / apart
        way = np.maximum(pieces[rows, contact.HOLE_RADIUS][:, None] + of[rows] - radius, SHORTEST_WAY)
        around = np.abs(np.roll(of[rows], -1, axis=1) - of[rows]) * cells / (2 * np.pi) / way
        worst = max(worst, float(np.hypot(along.max(initial=0.0), around.max())))
    return worst


def _vectors(pieces: Array, column: int) -> Array:
    return pieces[:, column : column + 3]


def _pairs(values: Array, missing: float) -> Array:
    """Sums of the values of neighbouring rows."""
    filled = np.nan_to_num(values, nan=missing)
    return np.asarray(filled[1:] + filled[:-1])


def _integral(md: Array, values: Array, areas: Array, at: Array) -> Array:
    """Integral of values that are linear between depths, from the first of these to others (n,)."""
    i = np.clip(np.searchsorted(md, at, side="right") - 1, 0, len(md) - 2)
    s = np.clip(at, md[0], md[-1]) - md[i]
    slope = (values[i + 1] - values[i]) / (md[i + 1] - md[i])
    return np.asarray(areas[i] + s * (values[i] + 0.5 * s * slope))
