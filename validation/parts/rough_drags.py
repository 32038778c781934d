"""Points dragged along the wall of holes that are rough, by the stepper's search: does any leave its hole or jump?

The holes have calipers of random arms, spacing and roughness, some with ledges and grooves.  What judges the search is
made without it: how far a disc moves in each section until it touches the wall, point by point of that wall, and angles
from the high side at the depth to which the point was dragged.  Between cells the wall lies between the values of the
cells beside it.  Jumps of its normal are looked for around and along the hole in steps of a micrometre, over which the
wall's own roughness turns it by hundredths of a degree.
"""

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from scipy.ndimage import maximum_filter, minimum_filter

from fctd import Case, Wellbore, build_wellbore
from fctd.arrays import Array
from fctd.mechanics import contact, state
from fctd.mechanics.dynamics import padded_columns
from fctd.mechanics.query import WALL_COLUMNS, query_sampled
from fctd.mechanics.sampled import AROUND_CELLS
from fctd.mechanics.stored_walls import update_walls
from fctd.model.frames import hole_frame
from fctd.model.sampled_hole import POINTS, in_cells, wall_around
from validation.parts.drags import AT_REST, SHARE, STEPS, move, sideways

SEED = 23
STIFFNESS = 1e7  # of the wall [N/m]
TURNED, LENGTH = 10.0, (30.0, 60.0)  # largest bend in 30 m [deg], length of a hole [m]
UPRIGHT = 15.0  # least inclination [deg]: nearer to the vertical the high side turns fast along the hole
ROUGHNESS, LEDGES = (0.0003, 0.006), (0.005, 0.02)  # standard deviation of the radius, and steps of it [m]
FINER = 4  # directions in each cell around the hole, since those of the sampled hole lie elsewhere
# What a way between these directions may lie beyond them, where a disc touches two places [m].
ALLOWED = 1e-4
BEYOND = 1e-3  # penetration at the end beyond that of balance [m]
# Rings of a hole, places on each border of its cells, steps of both, and how deep in the wall they are [m].
RINGS, ACROSS, STEP, DEEP = 3, 8, 1e-6, 0.002


class Rough(NamedTuple):
    """A rough hole, its string's contact radius [m], and what judges the search.

    md (n,) : middles of the cells [m]; low, high (n, directions) : bounds of the way of a disc between the cells beside
    [m].
    """

    hole: Wellbore
    string: float
    md: Array
    low: Array
    high: Array


def rough_case(rng: np.random.Generator) -> Case:
    """A random hole of 30 to 60 m and more that bends in space, measured all along, with a pipe in it."""
    stations, md, bit = [], 0.0, rng.uniform(0.15, 0.35)
    inclination, azimuth, last = rng.uniform(UPRIGHT, 110.0), rng.uniform(0, 360), rng.uniform(*LENGTH)
    while md < last + 30.0:
        stations.append([md, inclination, azimuth % 360])
        course = rng.uniform(5, 20)
        turned = rng.choice([0.0, 1.0]) * TURNED * course / 30
        inclination = float(np.clip(inclination + rng.uniform(-turned, turned), UPRIGHT, 120.0))
        azimuth += rng.uniform(-turned, turned)
        md += course
    depth = stations[-1][0]
    rows, cell = _log(rng, depth, bit), rng.uniform(0.05, 0.15)
    string = rng.uniform(0.25, 0.45) * bit
    wellbore = {
        "stations": stations, "survey_method": "minimum_curvature", "geometry": "sampled", "cell": cell,
        "caliper": {"rows": rows.tolist(), "values": "radius"}, "stiffness": STIFFNESS,
        "intervals": [{"to_md": depth, "diameter": bit, "friction": 0.2, "kind": "open"}],
    }  # fmt: skip
    pipe = {"name": "pipe", "outer_diameter": 2 * string, "inner_diameter": string}
    return Case.model_validate({"name": "rough", "wellbore": wellbore, "string": {"components": [pipe]}})


def judged(case: Case) -> Rough:
    """The hole of a case and what judges the search in it."""
    hole, string = build_wellbore(case), 0.5 * case.string.components[0].contact_diameter
    return Rough(hole, string, *bounds(hole, string))


def _log(rng: np.random.Generator, depth: float, bit: float) -> Array:
    """Rows (n, 1 + arms) [m] of a caliper in radii: rough along and around, perhaps with ledges and a groove."""
    md, arms = np.arange(0.0, depth + 1e-9, rng.uniform(0.05, 0.3)), int(rng.integers(3, 17))
    noise: Array = rng.normal(size=(len(md), arms))
    if rng.random() < 0.5:
        noise = (np.roll(noise, -1, 0) + noise + np.roll(noise, 1, 0)) / math.sqrt(3)
    radii = 0.5 * bit + np.exp(rng.uniform(*np.log(ROUGHNESS))) * (np.abs(noise) if rng.random() < 0.5 else noise)
    for start in rng.uniform(0, depth, rng.integers(0, 4)):
        inside = (md > start) & (md < start + rng.uniform(0.2, 5.0))
        radii[np.ix_(inside, rng.permutation(arms)[: rng.integers(1, arms + 1)])] += rng.uniform(*LEDGES)
    return np.column_stack([md, np.maximum(radii, 0.48 * bit)])


def bounds(hole: Wellbore, string: float) -> tuple[Array, Array, Array]:
    """Middles of the cells of a hole, and bounds of the way of a disc of a radius in them [m]."""
    pieces = hole.pieces[1:-1]
    cells = int(hole.pieces[:, AROUND_CELLS].max())
    top, length = pieces[:, contact.START_MD], pieces[:, contact.LENGTH]
    assert hole.sampling is not None
    assert hole.sampling.caliper is not None
    measured, first = in_cells(hole.sampling.caliper, top, top + length)
    nominal = pieces[:, contact.HOLE_RADIUS]
    missing = np.isnan(measured).any(axis=1)
    measured[missing] = nominal[missing, None]
    angles = np.linspace(0.0, 2 * np.pi, POINTS * cells, endpoint=False)
    ways = ways_of_disc(wall_around(measured, first, angles), string, FINER * cells)
    beside = (3, 2 * 2 * FINER + 1)  # a cell above and below, two to both sides
    low, high = (of(ways, beside, mode=("nearest", "wrap")) for of in (minimum_filter, maximum_filter))
    return top + 0.5 * length, low, high


def ways_of_disc(walls: Array, radius: float, directions: int) -> Array:
    """How far a disc moves from the axis in equal directions until it touches a point of the wall (n, directions) [m].

    walls (n, J) : radii at equal angles [m], J a multiple of ``directions``.
    """
    count = walls.shape[1]
    ways = np.full((len(walls), directions), np.inf)
    for k in range(-count // 4, count // 4 + 1):
        reach = np.roll(walls, -k, 1)[:, :: count // directions]
        aside, ahead = reach * math.sin(2 * np.pi * k / count), reach * math.cos(2 * np.pi * k / count)
        left = radius**2 - aside**2
        ways = np.minimum(ways, np.where(left >= 0, ahead - np.sqrt(np.maximum(left, 0.0)), np.inf))
    return ways


class Drag(NamedTuple):
    """What became of points (n,): the largest values over their steps, and at the end.

    wrong_wall [m] : the wall of the search outside its bounds; beyond [m] : the penetration at the end, after that
    which balances the side force.
    """

    wrong_wall: Array
    beyond: Array


def drag(rough: Rough, count: int, rng: np.random.Generator) -> Drag:
    """Drag points through a rough hole, each at its own speed, to and fro between the ends."""
    hole, ends = rough.hole, (1.0, rough.hole.total_depth - 1.0)
    md, step = rng.uniform(*ends, count), np.exp(rng.uniform(np.log(1e-4), np.log(0.3), count))
    step *= rng.choice([-1.0, 1.0], count)
    turn = rng.uniform(-0.02, 0.02, count)  # of the side force [rad] in a step
    pressed = rng.uniform(0.002, 0.01, count)  # penetration that balances it [m]
    axis, tangent = hole.at(md)
    force = sideways(rng.normal(size=(count, 3)), tangent)
    offset = rough.low.min() * force

    S, owner = state.new_state(count), np.zeros(count + 2, np.int64)
    owner[1 : count + 1] = np.searchsorted(hole.pieces[:, contact.START_MD], md, side="right") - 1
    state.row(S, state.TRIBUTARY, count)[:] = 1.0
    state.row(S, state.RADIUS, count)[:] = rough.string
    place, radial = ([state.row(S, of, count) for of in rows] for rows in (_PLACE, _RADIAL))
    radius, stiffness = state.row(S, state.HOLE, count), state.row(S, state.K_WALL, count)
    wrong_wall, depth = np.zeros(count), np.zeros(count)
    for k in range(STEPS + AT_REST):
        if k < STEPS:
            md, step, axis, tangent, offset, force = move(hole, ends, md, step, offset, force, turn)
        for row, value in zip(place, (axis + offset).T, strict=True):
            row[:] = value
        update_walls(S, owner, count, padded_columns(count), hole.pieces, hole.geometry)
        found = np.stack(radial, axis=1)
        distance = np.maximum(np.linalg.norm(found, axis=1), 1e-12)
        lean = np.sqrt(stiffness / STIFFNESS)  # |∇d|: see ``stored_walls.lean_wall``
        depth = lean * (distance - radius + rough.string)
        low, high = _beside(rough, md, offset, tangent)
        way = np.linalg.norm(offset, axis=1) - depth
        wrong_wall = np.maximum(wrong_wall, np.where(depth > 0, np.maximum(low - way, way - high), 0.0))
        normal = found / distance[:, None]
        push = pressed[:, None] * force - (np.maximum(depth, 0.0) * lean)[:, None] * normal
        push = SHARE * (push - np.sum(push * tangent, axis=1)[:, None] * tangent) / np.maximum(lean, 1.0)[:, None] ** 2
        offset = offset + push
    return Drag(wrong_wall, depth - pressed)


_PLACE = (state.X, state.Y, state.Z)
_RADIAL = (state.PX, state.PY, state.PZ)


def _beside(rough: Rough, md: Array, offset: Array, tangent: Array) -> tuple[Array, Array]:
    """Bounds of the way of a disc beside points (n,) [m]."""
    high, right = hole_frame(tangent)
    angle = np.arctan2(np.sum(offset * right, axis=1), np.sum(offset * high, axis=1))
    directions = rough.low.shape[1]
    column = np.rint(angle / (2 * np.pi) * directions).astype(np.int64) % directions
    i = np.clip(np.searchsorted(rough.md, md), 1, len(rough.md) - 1)
    row = np.where(md - rough.md[i - 1] < rough.md[i] - md, i - 1, i)
    return rough.low[row, column], rough.high[row, column]


def sharpest_turn(rough: Rough, rng: np.random.Generator) -> float:
    """Largest turn of the wall's normal [deg] in steps of ``STEP`` around a hole and across borders of its cells."""
    hole, way = rough.hole, float(0.5 * (rough.low.mean() + rough.high.mean())) + DEEP
    borders = np.repeat(hole.pieces[2:-1, contact.START_MD], ACROSS)
    angle = np.repeat(rng.uniform(0, 2 * np.pi, len(borders)), 2)
    across = hole.off_axis((borders[:, None] + [-0.5 * STEP, 0.5 * STEP]).ravel(), angle, np.full(len(angle), way))
    worst = _turns(rough, across, np.repeat(borders, 2))[::2].max()
    around = np.arange(0.0, 2 * np.pi, STEP / way)
    for md in rng.uniform(1.0, hole.total_depth - 1.0, RINGS):
        depth = np.full(len(around), md)
        worst = max(worst, _turns(rough, hole.off_axis(depth, around, np.full(len(around), way)), depth).max())
    return float(np.degrees(worst))


def _turns(rough: Rough, points: Array, md: Array) -> Array:
    """How far the normal turns [rad] from each point (n, 3) near measured depths (n,) [m] to the next."""
    pieces, count = rough.hole.pieces, len(points)
    owner = np.searchsorted(pieces[:, contact.START_MD], md, side="right") - 1
    towards = np.empty((count, 3))
    query_sampled(pieces, points, np.full(count, rough.string), owner, np.empty((count, WALL_COLUMNS)), towards)
    normal = towards / np.linalg.norm(towards, axis=1)[:, None]
    return np.asarray(2 * np.arcsin(0.5 * np.linalg.norm(np.diff(normal, axis=0), axis=1)))


def campaign(count: int, holes: int, seed: int = SEED) -> Iterator[dict[str, Any]]:
    """Rows of drags in random rough holes, ``count`` in all."""
    for k in range(holes):
        rng = np.random.default_rng([seed, k])
        made = judged(rough_case(rng))
        found = drag(made, count // holes, rng)
        held = (found.wrong_wall <= ALLOWED) & (found.beyond <= BEYOND)
        yield {
            "hole": k, "drags": len(held), "cells": len(made.md), "contact_radius_mm": 1e3 * made.string,
            "furthest_outside_mm": 1e3 * float(found.wrong_wall.max()),
            "furthest_beyond_mm": 1e3 * float(found.beyond.max()), "leaks": int((~held).sum()),
            "sharpest_turn_deg": sharpest_turn(made, rng),
        }  # fmt: skip
