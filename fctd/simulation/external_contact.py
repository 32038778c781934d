"""The engine's loop with another contact method in place of its own, which does stages 2 and 3.

Every step makes one compiled call before the query and one after.  The query is a Python call, which alone costs some
microseconds.
"""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array, Contacts
from fctd.case.errors import Computed, InputError
from fctd.mechanics import state
from fctd.mechanics.contact import START_MD
from fctd.mechanics.dynamics import load, move, padded_columns, update_axes
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.jit import entry
from fctd.mechanics.moving_string import MovingString
from fctd.mechanics.state import Laws, contact_point
from fctd.mechanics.stored_walls import store_sticking, store_wall
from fctd.mechanics.topdrive import Motion
from fctd.mechanics.wall_law import stiffen_walls
from fctd.model.pieces import AROUND, DECAY, EXCESS, FRICTION, RADIUS, STIFFNESS, TO_MD
from fctd.model.wellbore import Wellbore

# Where a method reports no contact the wall is placed this far from the string [m].
OUT_OF_REACH = 1.0
# How much the length of a normal may differ from 1.
NOT_UNIT = 1e-3
# A point this near to the axis [m] has no side of the hole.
ON_AXIS = 1e-4
# What a method may return that no hole has: codes of ``_fault``, and what a message says of the point.
NO_DEPTH, NO_UNIT, TOO_DEEP = 1, 2, 3
FAULTS = {
    NO_DEPTH: "a penetration that is not a number",
    NO_UNIT: "a contact whose normal is no unit vector, or whose depth along the hole is not a number",
    TOO_DEEP: "a penetration that is larger than the radius of the hole",
}


class WallQuery(Protocol):
    """A contact method as the loop needs it; ``name`` is written into the result."""

    name: str

    def query(self, points: Array, radii: Array) -> Contacts:
        """Contacts of points (n, 3) [m] with contact radii (n,) [m].

        penetration (n,) [m]: where it is not above 0, normal (n, 3) and md (n,) are not read and may be nan.
        """


@entry
def _points(S, n, points):
    for j in range(1, n + 1):
        points[j - 1] = contact_point(S, j)


@entry
def _fault(k, penetration, normal, md, hole):
    """What is wrong with the contact of a point in a hole of this radius, a key of FAULTS; 0 where nothing is."""
    x, y, z = normal[k, 0], normal[k, 1], normal[k, 2]
    if not abs(math.sqrt(x * x + y * y + z * z) - 1.0) <= NOT_UNIT or not math.isfinite(md[k]):
        return NO_UNIT
    return 0 if penetration[k] <= hole else TOO_DEEP


@entry
def _store(S, n, radii, penetration, normal, md, wall):
    """Write queried walls; hole radius, stiffness and friction come from ``wall`` (Wellbore.nominal_wall).

    Returns 0, or what is wrong with a point's contact, a key of FAULTS, and the number of the point.
    """
    last, wrong, of = wall.shape[0] - 1, 0, 0
    for j in range(1, n + 1):
        k = j - 1
        if math.isnan(penetration[k]):
            wrong, of = NO_DEPTH, j
        if penetration[k] > 0:
            i = 0
            while i < last and md[k] > wall[i + 1, TO_MD]:
                i += 1
            below = min(i + 1, last)
            span = wall[below, TO_MD] - wall[i, TO_MD]
            v = min(max((md[k] - wall[i, TO_MD]) / span, 0.0), 1.0) if span > 0 else 0.0
            hole = wall[i, RADIUS] + v * (wall[below, RADIUS] - wall[i, RADIUS])
            stiffness = wall[i, STIFFNESS] + v * (wall[below, STIFFNESS] - wall[i, STIFFNESS])
            friction = wall[i, FRICTION] + v * (wall[below, FRICTION] - wall[i, FRICTION])
            around = wall[i, AROUND] + v * (wall[below, AROUND] - wall[i, AROUND])
            fault = _fault(k, penetration, normal, md, hole)
            if fault:
                wrong, of = fault, j
            distance = hole - radii[k] + penetration[k]
            store_wall(
                S, j, distance * normal[k, 0], distance * normal[k, 1], distance * normal[k, 2],
                hole, stiffness, friction, around,
            )  # fmt: skip
            store_sticking(S, j, wall[i, EXCESS], wall[i, DECAY])
        else:
            store_wall(S, j, 0.0, 0.0, 0.0, radii[k] + OUT_OF_REACH, 0.0, 0.0, 0.0)
    return wrong, of


@entry
def _before(S, top, n, laws, motion, pipe, dt, points):
    """Stage 1 of a step, and the points (n, 3) to query; returns feed [m/s] and rotation [rad/s]."""
    feed, rate = load(S, top, n, laws, motion, pipe, dt)
    _points(S, n, points)
    return feed, rate


@entry
def _after(S, top, n, laws, pipe, feed, rate, dt, radii, penetration, normal, md, wall):
    """Stages 3 to 5 of a step with the queried walls, unless one of them is wrong; see ``_store``."""
    wrong, of = _store(S, n, radii, penetration, normal, md, wall)
    if not wrong:
        if laws.wall_exponent != 1:
            stiffen_walls(S, top, n, laws)
        move(S, top, n, laws, pipe, feed, rate, dt)
    return wrong, of


class QueriedWall:
    """A contact method as a Wall: the loop of ``dynamics.advance`` with the walls that the method returns.

    judged : whether its answers are compared with the hole at every record.
    """

    # In the corner between two facets of a mesh a point's only contact alternates between them.
    jumps = True
    seams = False

    def __init__(self, method: WallQuery, hole: Wellbore, segments: int, *, judged: bool = True) -> None:
        if not hasattr(method, "query"):
            expected = "an object with name and query, as references.contact.build(name, case) makes one"
            raise InputError(expected, key="contact", value=method if isinstance(method, str) else repr(method))
        self.name, self._method = method.name, method
        self._hole, self._judged = hole, judged
        self._wall = hole.nominal_wall()  # of its radii the penetration does not depend
        self._segments = segments
        self._points = np.empty((segments, 3))
        self._near: NDArray[np.int64] | None = None

    def advance(self, string: MovingString, motion: Motion, laws: Laws, dt: float, steps: int) -> None:
        """See ``Wall.advance``."""
        S, top, pipe = string.S, string.top, string.pipe
        n, radii = self._segments, self._radii(S)
        update_axes(S, padded_columns(n))
        for _ in range(steps):
            feed, rate = _before(S, top, n, laws, motion, pipe, dt, self._points)
            hits = self._query(radii)
            wrong, of = _after(S, top, n, laws, pipe, feed, rate, dt, radii, *hits, self._wall)
            self._hold(wrong, of, radii, hits)

    def refresh(self, string: MovingString) -> None:
        """See ``Wall.refresh``."""
        S = string.S
        radii = self._radii(S)
        _points(S, self._segments, self._points)
        hits = self._query(radii)
        wrong, of = _store(S, self._segments, radii, *hits, self._wall)
        self._hold(wrong, of, radii, hits)
        if self._judged:
            self._compare(radii, hits)

    def _radii(self, S: Array) -> Array:
        return state.row(S, state.RADIUS, self._segments).copy()

    def _query(self, radii: Array) -> Contacts:
        """The method's contacts as arrays of numbers; InputError where they are none, or do not match the points."""
        n, found = self._segments, self._method.query(self._points, radii)
        expected = f"penetration ({n},), normal ({n}, 3) and md ({n},) from contact method {self.name!r}"
        try:
            hits = Contacts(*(np.ascontiguousarray(part, dtype=float) for part in found))
        except (TypeError, ValueError):
            raise InputError(expected, key="contact", value=Computed(type(found).__name__)) from None
        shapes = [part.shape for part in hits]
        if shapes != [(n,), (n, 3), (n,)]:
            raise InputError(expected, key="contact", value=Computed(", ".join(map(str, shapes))))
        return hits

    def _hold(self, wrong: int, of: int, radii: Array, hits: Contacts) -> None:
        """UnstableError where a contact is none that a hole has, as ``_store`` tells."""
        if wrong == TOO_DEEP:
            self._compare(radii, hits)  # a wrong normal throws a string through the wall
        if wrong:
            raise UnstableError(
                f"contact method {self.name!r} returns {FAULTS[wrong]}, at contact point {of} "
                f"(penetration {hits.penetration[of - 1]:.3g} m)"
            )

    def _compare(self, radii: Array, hits: Contacts) -> None:
        """UnstableError where a point has left the hole, or where the wall's normal points into the hole.

        A method that finds no contact there would let the string go through the rock without a word.
        """
        if not np.isfinite(self._points).all():
            return  # the guards of the run say so
        if self._near is None:
            self._near = self._hole.nearest(self._points)
        walls = self._hole.walls(self._points, self._near, radii)
        self._near = np.searchsorted(self._hole.pieces[:, START_MD], walls.md, side="right").astype(np.int64) - 1
        away = np.linalg.norm(walls.offset, axis=1)
        touching = (hits.penetration > 0) & (away > ON_AXIS)
        inwards = touching & (np.sum(hits.normal * walls.offset, axis=1) < 0)
        if inwards.any():
            raise UnstableError(
                f"contact method {self.name!r} returns normals that point into the hole at {int(inwards.sum())} of "
                f"{int(touching.sum())} contacts: expected those from the axis to the wall"
            )
        if (outside := away - walls.radius + radii - walls.radius).max() > 0:
            k = int(outside.argmax())
            raise UnstableError(
                f"contact method {self.name!r} lets contact point {k + 1} lie "
                f"{away[k] - walls.radius[k] + radii[k]:.3g} m deep in the wall"
            )
