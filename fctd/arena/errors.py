"""How far the answers of a contact method are from the exact ones, and from what its geometry allows."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fctd.arena.frames import Frame
from fctd.arena.method import ContactMethod
from fctd.arrays import Array, Contacts

# For rounding, and for the radius that some libraries require of a point [m].
ROUNDING = 1e-6
# Errors of mesh rings and of overlaps at the ends of a bend, over the bound of the bend.
AT_ENDS = 1.02
NEAR = 0.1  # a contact is looked up so far from its point along the hole [m]
AXIAL = 3.0  # distance between rings [m] up to which a contact may have the depth or normal of another section


@dataclass(frozen=True)
class Errors:
    """Errors of the points that have an answer, and which contacts are missed or false.

    known, missed, false (n,) : of bool.  depth, angle, md (n,) : errors of penetration [m], of the normal's direction
    [rad] and of the depth along the hole [m], nan where there is no answer.  bound, turn (n,) : the largest errors of
    penetration [m] and direction [rad] that the geometry of the method allows at each point.
    """

    known: NDArray[np.bool_]
    missed: NDArray[np.bool_]
    false: NDArray[np.bool_]
    depth: Array
    angle: Array
    md: Array
    bound: Array
    turn: Array


def errors_of(method: ContactMethod, frame: Frame, found: Contacts) -> Errors:
    """The errors of the contacts that a method found at the points of a frame."""
    exact = frame.exact
    known = np.isfinite(found.penetration)
    blank = np.where(known, 0.0, np.nan)
    off = blank + found.penetration - exact.penetration
    angle = blank + np.arccos(np.clip(np.sum(found.normal * exact.normal, axis=1), -1, 1))
    bounds = {k: method.error_bound(k) for k in np.unique(frame.hole.curvatures(frame.md)).tolist()}
    both = np.array([bounds[k] for k in frame.hole.curvatures(frame.md).tolist()]).reshape(-1, 2)
    # Beside a shoe a wall may have its own slope, where the exact contact is that of a cylinder of its radius there.
    depth = AT_ENDS * both[:, 0] + ROUNDING
    depth += (1 - np.cos(_slope(frame, NEAR))) * (frame.radii + np.abs(exact.penetration))
    offset = exact.penetration + frame.hole.radii(exact.md) - frame.radii
    # A wall that is aside by its bound turns the normal by that over the distance from the axis.
    turn = both[:, 1] + _slope(frame, AXIAL) + np.arcsin(np.minimum(depth / np.maximum(offset, 1e-9), 1)) + 1e-6
    return Errors(
        known,
        (exact.penetration > depth) & ~(found.penetration > 0),
        (exact.penetration < -depth) & (found.penetration > 0),
        off,
        angle,
        np.where(known, found.md - exact.md, np.nan),
        depth,
        turn,
    )


def _slope(frame: Frame, within: float) -> Array:
    """Angle (n,) [rad] of the wall to the axis, the largest so near to each point along the hole [m]."""
    md = frame.md[:, None] + np.linspace(-within, within, 1 + 2 * round(within / NEAR))
    step = 0.5 * NEAR
    change = frame.hole.radii(md + step) - frame.hole.radii(md - step)
    return np.asarray(np.arctan(np.abs(change).max(axis=1) / (2 * step)))
