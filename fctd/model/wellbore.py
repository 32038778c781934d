"""The hole as a table of pieces for the contact algorithm: cylinders with overlap (§5.2, Fig. 8), or arcs."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, Contacts, ceiling
from fctd.case.errors import Computed, InputError
from fctd.case.hole import WellboreSpec
from fctd.case.load import Case, naming_file
from fctd.case.message import quantity
from fctd.case.string import ComponentSpec
from fctd.mechanics import contact
from fctd.mechanics.query import WALL_COLUMNS, Walls, query_sampled, query_walls, walls_in
from fctd.mechanics.sampled import AROUND_CELLS
from fctd.mechanics.state import ARCS, CYLINDERS, SAMPLED
from fctd.model import survey
from fctd.model.chords import longest_cylinders
from fctd.model.frames import hole_frame
from fctd.model.perturbed import perturb_stations
from fctd.model.pieces import (
    AROUND,
    FRICTION,
    INTERVAL_COLUMNS,
    RADIUS,
    RUN_OUT,
    TO_MD,
    arcs,
    cylinders,
    fill_wall,
    intervals_of,
)
from fctd.model.sampled_hole import Sampling, has_corners, narrow_cells, sample, sampling_of, steepest, with_mean_radii
from fctd.model.section import contact_radii
from fctd.model.tortuosity import winding

# Largest difference between the length of a hole's axis and the sum of its pieces [m].
SAME_LENGTH = 1e-6
# More cylinders would not fit into memory, or take longer to lay out than the run takes.
MOST_CYLINDERS = 1_000_000
# No point of a string is further from the origin [m]; squares of far larger numbers overflow.
FARTHEST = 1e7
# Largest turn [rad] and smallest distance [m] between two rows of ``bends``; the chord of a small turn θ has the
# curvature of its arc within θ²/24.
SMALL_TURN, APART = 0.02, 1e-3


@dataclass(frozen=True)
class Wellbore:
    """A hole ready for queries.

    pieces : (m, COLUMNS) table of contact.py, with further columns of sampled.py; geometry : CYLINDERS, ARCS, SAMPLED.
    md (k,) [m], points (k, 3) [m], directions (k, 3): axis sampled at the ends of the pieces.
    Raises AssertionError for pieces that do not cover the axis.
    """

    pieces: Array
    geometry: int
    md: Array
    points: Array
    directions: Array
    intervals: Array = field(repr=False)  # (k, INTERVAL_COLUMNS), columns above
    shoe: float  # length of the transition from one interval to the next [m]
    courses: survey.Courses | None = None
    derrick: float = 0.0  # height of a first piece above the rotary table, without friction [m] (derrick.py)
    sampling: Sampling | None = None  # of a sampled hole: the caliper, and the radii whose contact its pieces hold

    def __post_init__(self) -> None:
        # Pieces with a gap between them, or that end early, are a defect of the program; no later check would find it.
        chords = np.linalg.norm(np.diff(self.points, axis=0), axis=1)
        if not (chords <= np.diff(self.md) + SAME_LENGTH).all():
            raise AssertionError("the axis of the hole is longer than its measured depth")
        along, shared = self.total_depth, 0.0
        if self.geometry == CYLINDERS:
            along, shared = float(chords.sum()), float(self.pieces[:, contact.OVERLAP].sum())
        covered = float(self.pieces[:, contact.LENGTH].sum()) - shared - 2 * RUN_OUT - self.derrick
        if not abs(covered - along) <= SAME_LENGTH:
            raise AssertionError(f"the pieces of the hole cover {covered:.6f} m of an axis of {along:.6f} m")

    def __repr__(self) -> str:
        return f"Wellbore({self.total_depth:g} m, {len(self.pieces)} pieces)"

    @property
    def stiffest_wall(self) -> float:
        """Largest wall stiffness [N/m per point, or N/m/m]; a wall that leans is stiffer (stored_walls.lean_wall)."""
        stiffest = float(self.pieces[:, contact.STIFFNESS].max())
        return stiffest if self.sampling is None else stiffest * (1 + steepest(self.pieces) ** 2)

    @property
    def is_round(self) -> bool:
        """Whether every section of the hole is a circle of its interval's size."""
        return self.sampling is None or not self.pieces[:, AROUND_CELLS].any()

    @cached_property
    def narrowest(self) -> float:
        """Smallest radius of the hole [m]."""
        nominal = float(self.intervals[:, RADIUS].min())
        return nominal if self.is_round else min(nominal, float(narrow_cells(self.pieces)[1].min()))

    @property
    def total_depth(self) -> float:
        """Measured depth of the last station [m]."""
        return float(self.md[-1])

    @property
    def orthotropic(self) -> bool | None:
        """True where friction factors along and around the string differ anywhere, else None; see ``state.Laws``."""
        return True if (self.pieces[:, contact.FACTOR] != self.pieces[:, contact.FACTOR_AROUND]).any() else None

    @cached_property
    def corners(self) -> bool | None:
        """True where a disc of the string may touch two places of the wall at once, else None; see ``state.Laws``."""
        return True if self.sampling is not None and has_corners(self.pieces) else None

    def with_friction(self, factors: Array | float) -> "Wellbore":
        """The same hole with other friction factors.

        factors : one for every interval and every direction, (k,) one for each interval, or (k, 2) those along and
        around the string.
        """
        pieces, intervals = self.pieces.copy(), self.intervals.copy()
        given = np.asarray(factors, dtype=float)
        pairs = given if given.ndim == 2 else np.stack([given, given], axis=-1)
        intervals[:, FRICTION], intervals[:, AROUND] = pairs[..., 0], pairs[..., 1]
        fill_wall(pieces, self.geometry, self.md, intervals, self.shoe)
        return replace(self, pieces=pieces, intervals=intervals)

    def at(self, md: Array) -> tuple[Array, Array]:
        """Positions (n, 3) [m] and unit tangents (n, 3) of the axis at measured depths (n,) [m]."""
        md = np.atleast_1d(np.asarray(md, dtype=float))
        if self.courses is not None:
            return survey.along_courses(self.courses, md)
        i = np.maximum(np.searchsorted(self.md, md, side="right") - 1, 0)
        direction = self.directions[i]
        return self.points[i] + (md - self.md[i])[:, None] * direction, direction

    def off_axis(self, md: Array, angle: Array, distance: Array) -> Array:
        """Points (n, 3) [m] beside the axis at measured depths (n,) [m].

        angle (n,) [rad] : from the high side clockwise looking downhole; distance (n,) [m] : from the axis.
        """
        axis, tangent = self.at(md)
        high, right = hole_frame(tangent)
        return axis + distance[:, None] * (np.cos(angle)[:, None] * high + np.sin(angle)[:, None] * right)

    def wall_along(self) -> Array:
        """The wall over measured depth, linear between rows: columns of the intervals.

        Below the end of an interval the values change to the next one's over one overlap, as in cylinders and arcs.
        Where the hole is sampled, its radius is that of the circle of the same area.
        """
        return self.nominal_wall() if self.sampling is None else self._mean_wall

    @cached_property
    def _mean_wall(self) -> Array:
        return with_mean_radii(self.nominal_wall(), self.pieces)

    def nominal_wall(self) -> Array:
        """``wall_along`` with the radii of the intervals, also where the hole is sampled."""
        if len(self.intervals) == 1:
            return self.intervals.copy()
        above, below = self.intervals[:-1].copy(), self.intervals[1:].copy()
        below[:, TO_MD] = np.minimum(
            above[:, TO_MD] + self.shoe, below[:, TO_MD]
        )  # an interval may be shorter than a shoe
        return np.stack([above, below], axis=1).reshape(-1, INTERVAL_COLUMNS)

    @cached_property
    def bends(self) -> Array:
        """Measured depth and tangent of the axis (k, 4), in steps so short that both are linear between rows.

        Cylinders are straight, with all their bend at the ends: their rows lie at their middles.
        """
        if self.courses is None:
            middle = 0.5 * (self.md[1:] + self.md[:-1])
            if len(middle) == 1:
                return np.column_stack([self.md, self.directions])
            return np.column_stack([middle, self.directions[:-1]])
        turn = np.linalg.norm(np.diff(self.directions, axis=0), axis=1)
        md = _divided(self.md, np.maximum(ceiling(turn / SMALL_TURN), 1))
        md = md[np.append(True, np.diff(md) > APART)]
        return np.column_stack([md, self.at(md)[1]])

    def inclination(self, md: Array) -> Array:
        """Inclination of the axis [rad] at measured depths (n,) [m]."""
        return np.asarray(np.arccos(np.clip(self.at(md)[1][:, 2], -1.0, 1.0)))

    def steepest_above(self, md: float) -> float:
        """Bound of the hole's inclination between the surface and a measured depth [m], in rad.

        It is the largest of all ends of pieces down to the first one at that depth or below: no point of an arc is more
        inclined than both its ends where these are below 90°.  From 90° on the bound is infinite.
        """
        ends = self._steepest
        return float(ends[min(int(np.searchsorted(self.md, md)), len(ends) - 1)])

    @cached_property
    def _steepest(self) -> Array:
        """Largest inclination from the surface down to each end of a piece (k,) [rad]; infinite from 90° on."""
        down = np.minimum.accumulate(self.directions[:, 2])
        return np.where(down > 0, np.arccos(np.clip(down, -1.0, 1.0)), np.inf)

    def with_radii(self, radii: Array) -> "Wellbore":
        """The same hole, where it is sampled with the contact of discs of these radii [m] too."""
        if self.sampling is None or self.sampling.has(radii):
            return self
        sampling = self.sampling.with_radii(radii)
        return replace(self, pieces=sample(self.pieces[:, : contact.COLUMNS], sampling), sampling=sampling)

    def walls(self, points: Array, near: NDArray[np.int64] | None = None, radii: Array | None = None) -> Walls:
        """Walls beside points (n, 3) [m].

        near : (n,) pieces at which the search starts, for points near those of an earlier query; radii (n,) : of the
        discs whose centres they are, 0 by default [m]; the walls of sampled holes depend on them.
        """
        return walls_in(self._query(points, near, radii)[0])

    def contacts(self, points: Array, radii: Array) -> Contacts:
        """Contacts of points (n, 3) [m] of strings with radii (n,) [m]."""
        walls, _, towards = self.with_radii(radii)._query(points, None, radii)
        found = walls_in(walls)
        penetration = np.linalg.norm(found.offset, axis=1) - found.radius + radii
        size = np.maximum(np.linalg.norm(towards, axis=1), 1e-300)[:, None]
        return Contacts(penetration, towards / size, found.md)

    def radii_towards(self, md: Array, towards: Array) -> Array:
        """Radii (k, m) [m] of the hole at measured depths (k,) [m] in directions across it (k, m, 3)."""
        if self.sampling is None:
            rows = self.wall_along()
            radii = np.interp(md, rows[:, TO_MD], rows[:, RADIUS])
            return np.broadcast_to(radii[:, None], towards.shape[:2])
        inside = np.clip(md, self.md[0], self.md[-1])
        points = self.at(inside)[0][:, None] + self.narrowest * towards
        near = np.searchsorted(self.pieces[:, contact.START_MD], inside, side="right") - 1
        return self.walls(points.reshape(-1, 3), np.repeat(near, towards.shape[1])).radius.reshape(towards.shape[:2])

    def owners(self, points: Array) -> NDArray[np.int64]:
        """Index of the piece that owns each point (n, 3) [m]."""
        return self._query(points, None, None)[1]

    def _query(
        self, points: Array, near: NDArray[np.int64] | None, radii: Array | None
    ) -> tuple[Array, NDArray[np.int64], Array]:
        """Walls (n, WALL_COLUMNS), owners (n,), and the directions (n, 3) in which the walls lie."""
        points = np.ascontiguousarray(np.atleast_2d(points), dtype=float)
        owner = self.nearest(points) if near is None else near.copy()
        out = np.empty((len(points), WALL_COLUMNS))
        if self.geometry == SAMPLED:
            towards = np.empty((len(points), 3))
            of = np.zeros(len(points)) if radii is None else np.ascontiguousarray(radii, dtype=float)
            query_sampled(self.pieces, points, of, owner, out, towards)
            return out, owner, towards
        query_walls(self.pieces, self.geometry, points, owner, out)
        return out, owner, walls_in(out).offset

    def nearest(self, points: Array) -> NDArray[np.int64]:
        """Piece nearest to each point, from samples of the axis at most half a metre apart."""
        from scipy.spatial import cKDTree  # seldom needed, and slow to import

        md = _divided(self.md, np.ceil(np.diff(self.md) / 0.5))
        _, i = cKDTree(self.at(md)[0]).query(points)
        return np.searchsorted(self.pieces[:, contact.START_MD], md[i], side="right").astype(np.int64) - 1


def find_contacts(wellbore: Wellbore, points: Array, radii: Array | float) -> Contacts:
    """Penetration, normal and measured depth of points in a hole (§4.2–4.4).

    points : (n, 3) north, east, down [m]; radii : (n,) or one, contact radius of the string [m].
    Raises InputError for what is no hole, for shapes that disagree, for values that are not finite, for a point beyond
    FARTHEST, and for a radius below 0 or above that of the hole.
    """
    given: object = wellbore
    if not isinstance(given, Wellbore):
        expected = "the hole of a case, as build_wellbore(case) makes it"
        raise InputError(expected, key="wellbore", value=Computed(type(given).__name__))
    points, radii = _numbers("points", points), _numbers("radii", radii)
    points = np.atleast_2d(points)
    if points.ndim != 2 or points.shape[1] != 3:
        raise InputError("three numbers a point, (n, 3)", key="points", value=Computed(str(points.shape)))
    if radii.shape not in ((), points.shape[:1]):
        expected = f"one radius, or one for each of {len(points)} points"
        raise InputError(expected, key="radii", value=Computed(str(radii.shape)))
    radii = np.broadcast_to(radii, points.shape[:1])
    for k, axis in np.argwhere(~(np.abs(points) <= FARTHEST))[:1].tolist():
        expected = f"a point within {quantity(FARTHEST, 'm')} of the origin, north, east and down"
        raise InputError(expected, key=f"points[{k}][{axis}]", value=float(points[k, axis]))
    widest = float(wellbore.wall_along()[:, RADIUS].max())
    for k in np.flatnonzero(~((radii >= 0) & (radii <= widest)))[:1].tolist():
        expected = f"a contact radius in metres, from 0 to the {quantity(widest, 'm', '.4g')} of the hole"
        raise InputError(expected, key=f"radii[{k}]", value=float(radii[k]))
    return wellbore.contacts(points, radii)


def _numbers(key: str, given: Array | float) -> Array:
    """Numbers as an array; InputError for what is none."""
    try:
        return np.asarray(given, dtype=float)
    except (TypeError, ValueError):
        raise InputError("numbers in metres", key=key, value=Computed(type(given).__name__)) from None


def build_wellbore(case: Case) -> Wellbore:
    """The hole of a case.

    Raises InputError for an overlap longer than a cylinder, for too many pieces, or for stations that no arc joins.
    """
    with naming_file(case):
        return _build(case.wellbore, case.string.components, case.solver.perturbed)


def _build(hole: WellboreSpec, components: Sequence[ComponentSpec], seed: int | None) -> Wellbore:
    stations, intervals = perturb_stations(hole.trajectory, seed), intervals_of(hole)
    if hole.tortuosity is not None:
        _courses(hole, stations)  # names a station that no arc reaches
        stations = winding(stations, hole.tortuosity)
    ends = intervals[:, TO_MD][intervals[:, TO_MD] < stations[-1, 0]]
    courses = _courses(hole, stations) if hole.survey_method == "minimum_curvature" else None
    sampling = None
    if hole.geometry == "sampled":
        sampling = sampling_of(hole, intervals[:, TO_MD], contact_radii(components))
    if hole.geometry != "cylinders":
        assert courses is not None  # WellboreSpec requires the method
        # Where the hole changes, a shoe as long as the overlap of cylinders leads from one size to the next.
        if sampling is not None:
            ends = sampling.borders(ends, intervals)
        shoes = np.minimum(ends + hole.overlap, stations[-1, 0])
        md = np.union1d(stations[:, 0], np.concatenate([ends, shoes]))
        if sampling is not None:
            md = sampling.cut(md)
        points, directions = survey.along_courses(courses, md)
        geometry, pieces = ARCS if sampling is None else SAMPLED, arcs(courses, md)
    else:
        md = _cylinder_ends(hole, stations, ends)
        if courses is not None:
            points = survey.along_courses(courses, md)[0]
        else:
            points = survey.average_angle(survey.interpolate_angles(stations, md))
        geometry, pieces = CYLINDERS, cylinders(hole.overlap, md, points)
        directions = pieces[:, contact.DIRECTION : contact.DIRECTION + 3]
        directions = np.vstack([directions, directions[-1:]])
    fill_wall(pieces, geometry, md, intervals, hole.overlap)
    if sampling is not None:
        pieces = sample(pieces, sampling)
    kept = None if geometry == CYLINDERS else courses
    return Wellbore(pieces, geometry, md, points, directions, intervals, hole.overlap, kept, sampling=sampling)


def _courses(hole: WellboreSpec, stations: Array) -> survey.Courses:
    try:
        return survey.minimum_curvature(stations)
    except ValueError:
        k = int(np.argmax(survey.dogleg(stations))) + 1
        md, inc, azi = stations[k, 0], *np.degrees(stations[k, 1:])
        raise InputError(
            "a direction that an arc can join with that of the station before, which is the opposite",
            key=f"station {k + 1}" if hole.survey is not None else f"wellbore.stations[{k}]",
            value=f"{quantity(md, 'm')}, {inc:g} deg, {azi:g} deg", file=hole.survey,
        ) from None  # fmt: skip


def _cylinder_ends(hole: WellboreSpec, stations: Array, ends: Array) -> Array:
    """Measured depths of the cylinder ends: stations, interval ends, and enough between for the chord.

    A chord of length ℓ in a bend of curvature κ misses the arc by κℓ²/8.
    """
    curvature = survey.dogleg(stations) / np.diff(stations[:, 0])
    wanted = longest_cylinders(hole, curvature)
    if hole.overlap > wanted.min():
        raise InputError(
            f"at most the length of a cylinder, here {quantity(wanted.min(), 'm', '.3g')}", key="wellbore.overlap",
            value=quantity(hole.overlap, "m"),
        )  # fmt: skip
    # An interval that ends at a station, but for rounding, ends there: the direction of a shorter piece is not known.
    apart = np.abs(np.subtract.outer(ends, stations[:, 0])).min(axis=1) > SAME_LENGTH
    breaks = np.union1d(stations[:, 0], ends[apart])
    course = np.searchsorted(stations[:, 0], breaks[:-1], side="right") - 1
    counts = np.maximum(ceiling(np.diff(breaks) / wanted[course]), 1)
    if counts.sum() > MOST_CYLINDERS:
        raise InputError(
            f"a hole of at most {MOST_CYLINDERS} cylinders",
            key="wellbore.chord_tolerance" if hole.cylinder_length is None else "wellbore.cylinder_length",
            value=f"{counts.sum():.3g} cylinders",
        )
    return _divided(breaks, counts)


def _divided(breaks: Array, counts: Array) -> Array:
    """Ends of the parts when the lengths between breaks (k + 1,) are cut into ``counts`` (k,) equal parts."""
    parts = counts.astype(np.int64)
    within = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    ends = within * np.repeat(np.diff(breaks) / parts, parts) + np.repeat(breaks[:-1], parts)
    return np.append(ends, breaks[-1])
