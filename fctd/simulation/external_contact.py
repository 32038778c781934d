"""The engine's loop with another contact method in place of its own, which does stages 2 and 3.

Every step makes one compiled call before the query and one after.  The query is a Python call, which alone costs some
microseconds.
"""

from typing import Protocol

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.dynamics import load, move, padded_columns, update_axes
from fctd.mechanics.jit import entry
from fctd.mechanics.moving_string import MovingString
from fctd.mechanics.state import Laws, contact_point
from fctd.mechanics.stored_walls import store_sticking, store_wall
from fctd.mechanics.topdrive import Motion
from fctd.mechanics.wall_law import stiffen_walls
from fctd.model.pieces import AROUND, DECAY, EXCESS, FRICTION, RADIUS, STIFFNESS, TO_MD
from fctd.model.wellbore import Contacts, Wellbore

# Where a method reports no contact the wall is placed this far from the string [m].
OUT_OF_REACH = 1.0


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
def _store(S, n, radii, penetration, normal, md, wall):
    """Write queried walls; hole radius, stiffness and friction come from ``wall`` (Wellbore.nominal_wall)."""
    last = wall.shape[0] - 1
    for j in range(1, n + 1):
        k = j - 1
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
            distance = hole - radii[k] + penetration[k]
            store_wall(
                S, j, distance * normal[k, 0], distance * normal[k, 1], distance * normal[k, 2],
                hole, stiffness, friction, around,
            )  # fmt: skip
            store_sticking(S, j, wall[i, EXCESS], wall[i, DECAY])
        else:
            store_wall(S, j, 0.0, 0.0, 0.0, radii[k] + OUT_OF_REACH, 0.0, 0.0, 0.0)


@entry
def _before(S, top, n, laws, motion, pipe, dt, points):
    """Stage 1 of a step, and the points (n, 3) to query; returns feed [m/s] and rotation [rad/s]."""
    feed, rate = load(S, top, n, laws, motion, pipe, dt)
    _points(S, n, points)
    return feed, rate


@entry
def _after(S, top, n, laws, pipe, feed, rate, dt, radii, penetration, normal, md, wall):
    """Stages 3 to 5 of a step with the queried walls."""
    _store(S, n, radii, penetration, normal, md, wall)
    if laws.wall_exponent != 1:
        stiffen_walls(S, top, n, laws)
    move(S, top, n, laws, pipe, feed, rate, dt)


class QueriedWall:
    """A contact method as a Wall: the loop of ``dynamics.advance`` with the walls that the method returns."""

    # In the corner between two facets of a mesh a point's only contact alternates between them.
    jumps = True
    seams = False

    def __init__(self, method: WallQuery, hole: Wellbore, segments: int) -> None:
        self.name, self._method = method.name, method
        self._wall = hole.nominal_wall()  # of its radii the penetration does not depend
        self._segments = segments
        self._points = np.empty((segments, 3))

    def advance(self, string: MovingString, motion: Motion, laws: Laws, dt: float, steps: int) -> None:
        """See ``Wall.advance``."""
        S, top, pipe = string.S, string.top, string.pipe
        n, radii = self._segments, self._radii(S)
        update_axes(S, padded_columns(n))
        for _ in range(steps):
            feed, rate = _before(S, top, n, laws, motion, pipe, dt, self._points)
            hits = self._query(radii)
            _after(S, top, n, laws, pipe, feed, rate, dt, radii, *hits, self._wall)

    def refresh(self, string: MovingString) -> None:
        """See ``Wall.refresh``."""
        S = string.S
        radii = self._radii(S)
        _points(S, self._segments, self._points)
        _store(S, self._segments, radii, *self._query(radii), self._wall)

    def _radii(self, S: Array) -> Array:
        return state.row(S, state.RADIUS, self._segments).copy()

    def _query(self, radii: Array) -> Contacts:
        """The method's contacts; raises ValueError when their shapes do not match the points."""
        n = self._segments
        hits = self._method.query(self._points, radii)
        shapes = [part.shape for part in hits]
        if shapes != [(n,), (n, 3), (n,)]:
            raise ValueError(f"contact method {self.name!r} returned shapes {shapes} for {n} points")
        return hits
