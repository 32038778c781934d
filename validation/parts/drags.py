"""Points dragged along the wall of random bends with the stepper's search: does any of them leave its hole?

A point is moved along the exact axis, and a side force that turns about it presses it against the wall.  Wherever the
search finds no wall, or one that is too far away, the force carries the point out of the hole.  The depth of the point
is known, since the drag sets it; neither it nor the exact axis hangs on the search.

``python -m validation.parts.drags --count 1000000`` drags as many points as wanted.
"""

import math
import time
from collections.abc import Callable, Iterator
from typing import Annotated, Any, NamedTuple

import numpy as np
import pandas as pd
import typer
from numpy.typing import NDArray

from fctd import Case, Wellbore, build_wellbore
from fctd.arrays import Array
from fctd.mechanics import contact, state, stored_walls
from fctd.mechanics.dynamics import padded_columns

Search = Callable[[Array, NDArray[np.int64], int, int, Array, int], None]  # that of ``stored_walls.update_walls``

GEOMETRIES = ("cylinders", "arcs")
STEPS, AT_REST = 150, 40  # steps of a drag; the point's depth stays the same in the last of them
SHARE = 0.5  # of the way to balance at the wall that a point moves in a step
ROUNDING = 1e-9  # [m]


class Bend(NamedTuple):
    """A hole, its exact axis, and what the straight cylinders may differ from that.

    string : radius [m]; allowed : of the wall's place across the hole [m]; along : of a point's depth [m]; shoe :
    length over which two cylinders of unlike sizes may blend at the most [m], 0 where it is known.
    """

    hole: Wellbore
    exact: Wellbore
    string: float
    allowed: float
    along: float
    shoe: float


def bend(rng: np.random.Generator, geometry: str, overlap: float | None = None) -> Bend:
    """A random hole that bends in space by up to 30° in 30 m, cased above.

    overlap : of its cylinders [m]; None for a random one.
    """
    direction = sideways(rng.normal(size=3), rng.normal(size=3)) if rng.random() < 0.5 else np.array([0.0, 0.0, 1.0])
    turning, stations, md = rng.normal(size=3), [], 0.0
    for _ in range(rng.integers(6, 12)):
        inclination, azimuth = np.arccos(np.clip(direction[2], -1, 1)), np.arctan2(direction[1], direction[0])
        stations.append([md, math.degrees(inclination), math.degrees(azimuth) % 360])
        course = rng.uniform(5, 30)
        turning = turning + rng.choice([0.0, 0.3, 3.0]) * rng.normal(size=3)  # on in a plane, or another way
        angle = rng.choice([0.0, 1.0]) * math.radians(rng.uniform(0, 30)) * course / 30
        direction = math.cos(angle) * direction + math.sin(angle) * sideways(turning, direction)
        direction, md = direction / np.linalg.norm(direction), md + course
    last = stations[-1][0]
    string, clearance = rng.uniform(0.02, 0.17), rng.uniform(0.005, 0.1)
    cased = {"to_md": rng.uniform(0.3, 0.7) * last, "diameter": 2 * (string + clearance + rng.uniform(0.0, 0.02))}
    open_hole = {"to_md": last, "diameter": 2 * (string + clearance)}
    cylinder = rng.uniform(0.3, 3.0)
    wellbore: dict[str, Any] = {
        "stations": stations,
        "survey_method": "minimum_curvature",
        "cylinder_length": cylinder,
        "overlap": rng.uniform(0.02, 0.95) * cylinder if overlap is None else overlap,
        "intervals": [part | {"friction": 0.2} for part in (cased, open_hole)],
    }

    def built(geometry: str) -> Wellbore:
        string = {"components": [{"name": "pipe", "outer_diameter": 0.1, "inner_diameter": 0.05}]}
        shape = {"geometry": geometry} | ({"cylinder_length": None} if geometry == "arcs" else {})
        return build_wellbore(Case.model_validate({"name": "bend", "wellbore": wellbore | shape, "string": string}))

    exact = built("arcs")
    if geometry == "arcs":
        return Bend(exact, exact, string, ROUNDING, ROUNDING, 0.0)
    hole = built(geometry)
    return Bend(hole, exact, string, *_of_cylinders(hole, exact, string + clearance + 0.02), hole.shoe)


def _of_cylinders(hole: Wellbore, exact: Wellbore, reach: float) -> tuple[float, float]:
    """What cylinders may differ from the exact axis: across [m], and along [m] of points within ``reach`` of it.

    A chord of length ℓ in a bend of curvature κ lies κℓ²/8 off; in an overlap of length o the upper one, as it fades
    out, adds a quarter of o times the angle between the two.  That angle tilts the planes at their ends, too.
    """
    length, overlap = np.diff(hole.md), hole.pieces[:-1, contact.OVERLAP]
    kink = np.linalg.norm(np.diff(hole.directions[:-1], axis=0), axis=1)
    curvature = exact.pieces[_piece_at(exact, 0.5 * (hole.md[1:] + hole.md[:-1])), contact.CURVATURE]
    across = (curvature * length**2).max() / 8 + 0.25 * (overlap * kink).max(initial=0.0)
    tilt = (curvature * length).max() + kink.max(initial=0.0)
    return float(1.05 * across + reach * tilt**2 + ROUNDING), float((reach + hole.shoe) * tilt + ROUNDING)


class Drag(NamedTuple):
    """What became of points (n,): the largest values over their steps, and at the end.

    wrong_wall [m] : the wall of the search against the exact one; beyond [m] : the wall at the end, after the
    penetration that balances the side force; wrong_depth [m] : outside the piece that owns the point.
    """

    wrong_wall: Array
    beyond: Array
    wrong_depth: Array


def drag(bend: Bend, count: int, rng: np.random.Generator, search: Search = stored_walls.update_walls) -> Drag:
    """Drag points through a bend, each at its own speed, to and fro between the ends."""
    hole, exact = bend.hole, bend.exact
    wall, ends = exact.wall_along(), (0.5, exact.total_depth - 0.5)
    md, step = rng.uniform(*ends, count), np.exp(rng.uniform(np.log(1e-3), np.log(0.3), count))
    step *= rng.choice([-1.0, 1.0], count)
    turn = rng.uniform(-0.02, 0.02, count)  # of the side force [rad] in a step
    pressed = rng.uniform(0.005, 0.02, count)  # penetration that balances it [m]
    axis, tangent = exact.at(md)
    force = sideways(rng.normal(size=(count, 3)), tangent)
    offset = (wall[:, 1].min() - bend.string) * force

    S, owner = state.new_state(count), np.zeros(count + 2, np.int64)
    owner[1 : count + 1] = _piece_at(hole, md)
    state.row(S, state.TRIBUTARY, count)[:] = 1.0
    place, radial = [[state.row(S, of, count) for of in rows] for rows in (_PLACE, _RADIAL)]
    radius = state.row(S, state.HOLE, count)
    wrong_wall, wrong_depth = np.zeros(count), np.zeros(count)
    for k in range(STEPS + AT_REST):
        if k < STEPS:
            md, step, axis, tangent, offset, force = move(exact, ends, md, step, offset, force, turn)
        for row, value in zip(place, (axis + offset).T, strict=True):
            row[:] = value
        search(S, owner, count, padded_columns(count), hole.pieces, hole.geometry)
        found = np.stack(radial, axis=1)
        distance = np.maximum(np.linalg.norm(found, axis=1), 1e-12)
        penetration = distance - radius + bend.string
        low, high = _clearance(wall, md, bend)
        distances = np.linalg.norm(offset, axis=1)
        error = np.maximum(penetration - (distances - low), (distances - high) - penetration)
        wrong_wall = np.maximum(wrong_wall, error)
        wrong_depth = np.maximum(wrong_depth, _outside(hole, owner[1 : count + 1], md))
        push = pressed[:, None] * force - (np.maximum(penetration, 0.0) / distance)[:, None] * found
        offset += SHARE * (push - np.sum(push * tangent, axis=1)[:, None] * tangent)
    beyond = np.linalg.norm(offset, axis=1) - _clearance(wall, md, bend)[1] - pressed
    return Drag(wrong_wall, beyond, wrong_depth)


class Moved(NamedTuple):
    """Points (n,) after a step: depth and next step [m], axis and tangent (n, 3) there, offset from the axis (n, 3) [m]
    and direction of the side force (n, 3), both across the hole."""

    md: Array
    step: Array
    axis: Array
    tangent: Array
    offset: Array
    force: Array


def move(
    hole: Wellbore, ends: tuple[float, float], md: Array, step: Array, offset: Array, force: Array, turn: Array
) -> Moved:
    """Move points along a hole, back where they would pass its ends [m], and turn their side force [rad]."""
    step = np.where((md + step < ends[0]) | (md + step > ends[1]), -step, step)
    md = md + step
    axis, tangent = hole.at(md)
    offset = np.linalg.norm(offset, axis=1)[:, None] * sideways(offset, tangent)
    force = sideways(force, tangent)
    force = np.cos(turn)[:, None] * force + np.sin(turn)[:, None] * np.cross(tangent, force)
    return Moved(md, step, axis, tangent, offset, force)


def leaks(bend: Bend, found: Drag) -> NDArray[np.bool_]:
    """Points (n,) that ever saw the wall elsewhere than it is, or end beyond it."""
    return (found.wrong_wall > bend.allowed) | (found.beyond > bend.allowed)


_PLACE = (state.X, state.Y, state.Z)
_RADIAL = (state.PX, state.PY, state.PZ)


def sideways(vector: Array, tangent: Array) -> Array:
    """Unit vectors across tangents."""
    across = vector - np.sum(vector * tangent, axis=-1)[..., None] * tangent
    return np.asarray(across / np.maximum(np.linalg.norm(across, axis=-1), 1e-300)[..., None])


def _clearance(wall: Array, md: Array, bend: Bend) -> tuple[Array, Array]:
    """Least and largest distance [m] from the axis to the wall less the string's radius, as far as depths are known."""
    shifts = -bend.along, 0.0, bend.along + bend.shoe
    radii = [np.interp(md + shift, wall[:, 0], wall[:, 1]) for shift in shifts]
    return np.min(radii, axis=0) - bend.string, np.max(radii, axis=0) - bend.string


def _piece_at(hole: Wellbore, md: Array) -> NDArray[np.int64]:
    return np.searchsorted(hole.pieces[:, contact.START_MD], md, side="right").astype(np.int64) - 1


def _outside(hole: Wellbore, owner: NDArray[np.int64], md: Array) -> Array:
    """How far depths are from the pieces that own them [m]."""
    start = hole.pieces[owner, contact.START_MD]
    end = start + hole.pieces[owner, contact.LENGTH]
    return np.asarray(np.maximum(np.maximum(start - md, md - end), 0.0))


def campaign(count: int, seed: int = 14, batch: int = 1000) -> Iterator[dict[str, Any]]:
    """Rows of drags in random bends, ``batch`` of them in each, as many as wanted in both geometries together.

    leaks : number of points that leak; wrong_owners : number of those that a piece owned which does not reach them.
    """
    for k, done in enumerate(range(0, count, batch)):
        rng, geometry = np.random.default_rng([seed, k]), GEOMETRIES[k % 2]
        made = bend(rng, geometry)
        found = drag(made, min(batch, count - done), rng)
        yield {
            "geometry": geometry,
            "overlap_m": made.hole.shoe,
            "drags": len(found.beyond),
            "allowed_mm": 1e3 * made.allowed,
            "largest_error_mm": 1e3 * float(found.wrong_wall.max()),
            "furthest_beyond_mm": 1e3 * float(found.beyond.max()),
            "leaks": int(leaks(made, found).sum()),
            "wrong_owners": int((found.wrong_depth > made.along).sum()),
        }


def main(
    count: Annotated[int, typer.Option(min=1, help="Points to drag.")] = 1_000_000,
    seed: Annotated[int, typer.Option(help="Of the bends and points.")] = 14,
) -> None:
    """Drag points through random bends; exit code 1 where one leaves its hole or changes to a wrong piece."""
    began = time.perf_counter()
    rows = pd.DataFrame(campaign(count, seed, batch=1000))
    of = rows.groupby("geometry")[["drags", "leaks", "wrong_owners"]].sum()
    typer.echo(of.to_string())
    typer.echo(f"{count} drags in {len(rows)} bends, {time.perf_counter() - began:.0f} s")
    if rows[["leaks", "wrong_owners"]].to_numpy().any():
        raise typer.Exit(1)


if __name__ == "__main__":
    typer.run(main)
