"""FCTD's own contact methods, called from Python like the others: cylinders, arcs, the paper's FOR-loop."""

from typing import ClassVar, Literal

import numpy as np
from numba import njit

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case import units
from fctd.case.errors import Table
from fctd.case.hole import WellboreSpec
from fctd.case.load import Case
from fctd.case.raw_case import checked
from fctd.mechanics import contact
from fctd.mechanics.state import ARCS
from fctd.model.pieces import RADIUS
from fctd.model.wellbore import Wellbore, build_wellbore
from references.contact.for_loop import for_loop_owner


@njit(error_model="numpy")
def _write(j, wall, radius, penetration, normal, md):  # type: ignore[no-untyped-def]
    px, py, pz, hole, _stiffness, _friction, depth, _around = wall
    distance = np.sqrt(px * px + py * py + pz * pz)
    k = 1 / max(distance, 1e-300)
    penetration[j] = distance - hole + radius
    normal[j, 0], normal[j, 1], normal[j, 2] = k * px, k * py, k * pz
    md[j] = depth


@njit(error_model="numpy", cache=True)
def _query(C, geometry, points, radii, owner, penetration, normal, md):  # type: ignore[no-untyped-def]
    for j in range(points.shape[0]):
        x, y, z = points[j, 0], points[j, 1], points[j, 2]
        if geometry == ARCS:
            owner[j] = contact.arc_owner(C, owner[j], x, y, z)
            _write(j, contact.arc_wall(C, owner[j], x, y, z), radii[j], penetration, normal, md)
        else:
            owner[j] = contact.cylinder_owner(C, owner[j], x, y, z)
            _write(j, contact.cylinder_wall(C, owner[j], x, y, z), radii[j], penetration, normal, md)


@njit(error_model="numpy", cache=True)
def _query_for_loop(C, points, radii, penetration, normal, md):  # type: ignore[no-untyped-def]
    for j in range(points.shape[0]):
        x, y, z = points[j, 0], points[j, 1], points[j, 2]
        i = for_loop_owner(C, x, y, z)
        if i < 0:
            penetration[j] = -np.inf
            normal[j] = np.nan
            md[j] = np.nan
        else:
            _write(j, contact.cylinder_wall(C, i, x, y, z), radii[j], penetration, normal, md)


class CylinderOptions(Table):
    """Lengths [m] as the keys of [wellbore]; a missing one is taken from the case."""

    cylinder_length: units.PositiveLength | None = None
    chord_tolerance: units.PositiveLength | None = None
    overlap: units.Length | None = None


class ArcOptions(Table):
    """Arcs have no options."""


def _hole(case: Case, geometry: Literal["cylinders", "arcs"], options: Table) -> Wellbore:
    """The hole of a case in the given geometry, which may differ from that of the case."""
    changes = {**options.model_dump(exclude_none=True), "geometry": geometry}
    spec = case.wellbore.model_dump(exclude_none=True)
    if changes.keys() & {"cylinder_length", "chord_tolerance"}:  # only one of the two keys is allowed
        spec = {key: value for key, value in spec.items() if key not in ("cylinder_length", "chord_tolerance")}
    return build_wellbore(case.model_copy(update={"wellbore": checked(WellboreSpec, spec | changes)}))


def _empty(n: int) -> Contacts:
    return Contacts(np.empty(n), np.empty((n, 3)), np.empty(n))


class _CachedOwners:
    """Methods that keep each point's piece of hole from one query to the next, as the engine's loop does."""

    distribution: ClassVar[str] = "fctd"
    gives_clearance = True

    def __init__(self, hole: Wellbore) -> None:
        self.hole = hole
        self._owner = np.empty(0, np.int64)
        # No point of a string is this deep in the wall [m]: a deeper one is a new point, whose piece is searched.
        self._wide = 2 * float(hole.intervals[:, RADIUS].max())

    def query(self, points: Array, radii: Array) -> Contacts:
        """See ``ContactMethod.query``."""
        hole, hits = self.hole, _empty(len(points))
        if len(self._owner) != len(points):
            self._owner = hole.owners(points)
        _query(hole.pieces, hole.geometry, points, radii, self._owner, *hits)
        if (hits.penetration > self._wide).any():
            self._owner = hole.owners(points)
            _query(hole.pieces, hole.geometry, points, radii, self._owner, *hits)
        return hits

    @property
    def pieces(self) -> int:
        """Number of cylinders or arcs."""
        return len(self.hole.pieces)


class Cylinders(_CachedOwners):
    """The paper's cylinders with overlap (§4.2–4.4); each point keeps its cylinder from one query to the next."""

    name = "cylinders"
    does: ClassVar[str] = "point in cylinder with overlap, each point keeps its cylinder between queries"
    Options: ClassVar[type[Table]] = CylinderOptions
    settings: ClassVar[Settings] = tuple(
        {"cylinder_length": length, "overlap": min(0.2, 0.5 * length)} for length in (10.0, 5.0, 2.0, 0.5)
    )

    def __init__(self, case: Case, options: CylinderOptions) -> None:
        super().__init__(_hole(case, "cylinders", options))

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Sagitta and half the angle of the chord."""
        return chord_error(self.hole, curvature)


class Arcs(_CachedOwners):
    """Exact closest points on the arcs of minimum curvature."""

    name = "arcs"
    does: ClassVar[str] = "closest point on circular arcs, each point keeps its arc between queries"
    Options: ClassVar[type[Table]] = ArcOptions

    def __init__(self, case: Case, options: ArcOptions) -> None:
        super().__init__(_hole(case, "arcs", options))

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """No error: the arcs are the hole itself."""
        return 0.0, 0.0


class ForLoop(Cylinders):
    """The paper's search: the first cylinder from the top between whose end planes the point lies.

    Errors are those of ``Cylinders`` where the loop finds the right one; in a hole that turns past 90° it may not.
    """

    name = "for_loop"
    does: ClassVar[str] = "point in cylinder with overlap, searched from the top at every query (the paper)"

    def query(self, points: Array, radii: Array) -> Contacts:
        """See ``ContactMethod.query``; a point between the end planes of no cylinder has no contact."""
        hits = _empty(len(points))
        _query_for_loop(self.hole.pieces, points, radii, *hits)
        return hits


def chord_error(hole: Wellbore, curvature: float) -> tuple[float, float]:
    """Error of penetration κℓ²/8 [m] and of direction κℓ/2 [rad] of the longest cylinder (length ℓ) in a bend.

    Only cylinders that turn against both neighbours count; those of a straight hole do not.
    """
    turns = np.linalg.norm(np.diff(hole.directions[:-1], axis=0), axis=1) > 1e-9
    bent = np.append(False, turns) & np.append(turns, False)
    if curvature == 0 or not bent.any():
        return 0.0, 0.0
    length = float(np.diff(hole.md)[bent].max())
    return curvature * length**2 / 8, 0.5 * curvature * length
