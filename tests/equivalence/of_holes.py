"""Statements about the hole: the same hole written in other ways."""

import math
from itertools import pairwise
from typing import Any

import numpy as np

from fctd.arena.exact_hole import ExactHole
from fctd.model.drillstring import lay_out
from fctd.results.mesh_notes import chord
from tests.equivalence.answers import ARM, EXACT, ROUNDING, Answers, base, changed, plain, same, to_rounding
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import INCH, Raw
from tests.equivalence.table import applies, statement

# Chords of cylinders that miss the arc by this much [m].
FINE = 2e-4
# Cylinders that are cut elsewhere, and shoes that are blended over the length of a cell or of an overlap.
# Where cylinders end elsewhere, and for each degree of their kinks: a string that lies over a kink is pressed on there,
# and most of this is contact force.
CUT_ELSEWHERE, EACH_DEGREE = 2e-3, 0.02
# For each clearance by which cylinders miss the axis, where the note ``chord`` says that loads hang on it.
EACH_CLEARANCE = 0.05
AT_SHOE = 1e-3  # where the wall leads otherwise from one size to the next, over the same length
HYDRAULIC = ("standpipe", "bore", "annulus", "ecd", "pump", "lift_N")


@statement("sparse stations = dense stations of the same hole")
def dense_stations(drawn: Drawn) -> None:
    """Minimum curvature: directions between two stations lie on the great circle through theirs."""
    hole = drawn.raw["wellbore"]
    applies(hole["geometry"] != "cylinders" and not drawn.has("survey_smoothing"))
    dice = drawn.dice(2)

    def densify(raw: Raw) -> None:
        rows = raw["wellbore"]["stations"]
        dense = rows[:1]
        for above, below in pairwise(rows):
            for share in sorted(dice.number(0.05, 0.95) for _ in range(dice.whole(1, 3))):
                dense.append(between(above, below, share))
            dense.append(below)
        raw["wellbore"]["stations"] = dense

    same(drawn, changed(drawn, densify), ROUNDING)


def between(above: list[float], below: list[float], share: float) -> list[float]:
    """The station at a share of the arc between two [m, deg, deg]."""
    a, b = direction(above), direction(below)
    angle = math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))
    md = above[0] + share * (below[0] - above[0])
    if angle < 1e-12:
        return [md, *below[1:]]
    way = (math.sin((1 - share) * angle) * a + math.sin(share * angle) * b) / math.sin(angle)
    flat = math.hypot(way[0], way[1])
    azimuth = below[2] if flat < 1e-9 else math.degrees(math.atan2(way[1], way[0]))
    return [md, math.degrees(math.atan2(flat, way[2])), azimuth]


def direction(station: list[float]) -> np.ndarray:
    """Tangent (3,) of a station."""
    tilt, azimuth = math.radians(station[1]), math.radians(station[2])
    return np.array([math.sin(tilt) * math.cos(azimuth), math.sin(tilt) * math.sin(azimuth), math.cos(tilt)])


@statement("an interval = the same in two")
def split_interval(drawn: Drawn) -> None:
    """All keys but the depth of its end are the same; cylinders, and the shoe of hydraulics, end where intervals do."""
    dice = drawn.dice(3)

    def split(raw: Raw) -> None:
        rows = raw["wellbore"]["intervals"]
        k = dice.whole(0, len(rows) - 1)
        top = rows[k - 1]["to_md"] if k else 0.0
        rows.insert(k, rows[k] | {"to_md": top + dice.number(0.1, 0.9) * (rows[k]["to_md"] - top)})

    # Where a string lies is interpolated to the middles of what hydraulics cut there, and beside each of them the
    # annulus has the mean radius that a caliper measured: its gradient falls with the third power of the clearance.
    cut = drawn.raw["mud"].get("eccentricity") == "string" or drawn.has("caliper")
    flow = HYDRAULIC if cut else ()
    same(drawn, changed(drawn, split), cut_elsewhere(drawn), but=("ecd_shoe", "profile", *flow))


@statement("hole below the bit")
def longer_hole(drawn: Drawn) -> None:
    """No load depends on it; a chord of cylinders ends elsewhere."""
    hole = drawn.raw["wellbore"]
    applies(not drawn.has("survey_smoothing") and "tortuosity" not in hole and not drawn.has("rows"))
    applies("swivel" not in hole and hole["intervals"][-1]["to_md"] >= hole["stations"][-1][0])

    def lengthen(raw: Raw) -> None:
        stations = raw["wellbore"]["stations"]
        stations.append([stations[-1][0] + 40.0, *stations[-1][1:]])
        raw["wellbore"]["intervals"][-1]["to_md"] += 40.0

    same(drawn, changed(drawn, lengthen), cut_elsewhere(drawn))


def cut_elsewhere(drawn: Drawn) -> float:
    """The bound of a hole whose pieces end elsewhere: arcs are the same hole, chords have their kinks elsewhere."""
    hole = drawn.case.wellbore
    if hole.geometry != "cylinders":
        return ROUNDING
    curvature = ExactHole(hole).curvature
    kink = curvature * hole.cylinder_length if hole.cylinder_length else (8 * hole.chord_tolerance * curvature) ** 0.5
    note = chord(drawn.case, lay_out(drawn.case, drawn.depth))
    noted = 0.0 if note is None else EACH_CLEARANCE * note.excess
    return max(CUT_ELSEWHERE, EACH_DEGREE * math.degrees(kink), noted)


def without_north(drawn: Drawn) -> bool:
    """Whether nothing counts from north: neither waves of the hole nor, where it is vertical, the high side.

    Nor arms from north, where it is not: between north and the high side there the angle across the hole is not the
    azimuth.
    """
    hole = drawn.raw["wellbore"]
    if "tortuosity" in hole or drawn.has("survey_smoothing"):
        return False
    tilts, reference = [station[1] for station in hole["stations"]], hole.get("caliper", {}).get("reference")
    if reference == "north" and max(tilts) > 0:
        return False
    counts = drawn.has("bend") or reference == "high_side"
    return not counts or min(tilts) > 0.1


@statement("azimuth turned (unbuckled)")
def turned(drawn: Drawn) -> None:
    """A caliper that counts from north turns with the hole."""
    applies(without_north(drawn))
    by = drawn.dice(4).number(5, 350)

    def turn(raw: Raw) -> None:
        hole = raw["wellbore"]
        hole["stations"] = [[md, tilt, azimuth + by] for md, tilt, azimuth in hole["stations"]]
        if hole.get("caliper", {}).get("reference") == "north":
            hole["caliper"]["first_arm"] = hole["caliper"].get("first_arm", 0.0) + math.radians(by)

    same(drawn, changed(drawn, turn), ROUNDING)


@statement("mirror left and right (sliding)")
def mirrored(drawn: Drawn) -> None:
    """East is west, and right of the hole is left; a string that turns has no mirror, nor has a bit's torque."""
    applies(without_north(drawn) and not drawn.has("bend") and not drawn.raw.get("bit", {}).get("torque"))
    applies(drawn.raw["mud"].get("eccentricity") != "string")
    kinds = [kind for kind in ("trip_in", "trip_out", "drill_sliding") if not rotation(drawn, kind)]

    def mirror(raw: Raw) -> None:
        hole = raw["wellbore"]
        hole["stations"] = [[md, tilt, -azimuth] for md, tilt, azimuth in hole["stations"]]
        if "first_arm" in (caliper := hole.get("caliper", {})):
            caliper["first_arm"] = -caliper["first_arm"]
        if "rows" in caliper:
            caliper["rows"] = [[row[0], row[1], *row[:1:-1]] for row in caliper["rows"]]

    other = Answers(changed(drawn, mirror), drawn.depth)
    same(drawn, other, ROUNDING, kinds=kinds, but=("surface_torque", "drive_torque", "sum_r_ft", "profile torque"))
    for kind in kinds:  # what a bend to the right turns to one side, a bend to the left turns to the other

        def compare(*both: Answers, bound: float = ROUNDING, kind: str = kind) -> None:
            right, left = (of[kind].surface_torque / (ARM * of.weight) for of in both)
            assert abs(right + left) <= bound, f"{kind}: torque {right:.6g} and {left:.6g}"

        if plain(base(drawn)[kind]) and plain(other[kind]):
            to_rounding(compare, kind, base(drawn), other)


def rotation(drawn: Drawn, kind: str) -> float:
    """Rotation of the drawn operation of a kind."""
    rows = drawn.raw.get("operations", [])
    return next((row.get("rpm", 0.0) for row in rows if row["kind"] == kind), 0.0)


@statement("sampled without a caliper = arcs")
def sampled_arcs(drawn: Drawn) -> None:
    """Where nothing is measured the hole is that of arcs."""
    hole = drawn.raw["wellbore"]
    applies(
        "caliper" not in hole and hole["geometry"] != "cylinders" and not drawn.has("starting_force", "centralisers")
    )
    other = "arcs" if hole["geometry"] == "sampled" else "sampled"

    def change(raw: Raw) -> None:
        raw["wellbore"]["geometry"] = other
        raw["wellbore"].pop("cell", None)

    same(drawn, changed(drawn, change), ROUNDING)


@statement("round caliper = circle")
def round_caliper(drawn: Drawn) -> None:
    """Arms of one length measure a circle, as a `diameter` says it; the shoe is then as long as some cells."""
    hole = drawn.raw["wellbore"]
    applies(
        hole["geometry"] == "arcs" and hole["intervals"][-1].get("kind") == "open" and not drawn.has("centralisers")
    )
    dice, components = drawn.dice(5), drawn.case.string.components
    cut = all(part.segments is not None or part.segment_length is not None for part in components)

    def measure(raw: Raw) -> None:
        hole, arms, radii = raw["wellbore"], dice.pick([1, 2, 3, 4]), dice.chance(0.5)
        size = hole["intervals"][-1]["diameter"] * (0.5 if radii else 1.0)
        total = hole["stations"][-1][0]
        rows = [[md, *[size] * arms] for md in (0.0, total)]
        hole |= {"geometry": "sampled", "cell": 0.4}
        hole["caliper"] = {"rows": rows, "values": "radius" if radii else "diameter"}
        if cut:  # default segments are cut for the clearance of the nominal hole
            hole["intervals"][-1]["diameter"] *= 1.02  # which what was measured replaces

    same(drawn, changed(drawn, measure), AT_SHOE, but=("profile",))


@statement("arcs = fine cylinders")
def fine_cylinders(drawn: Drawn) -> None:
    """Chords that miss the arc by 0.2 mm, of tens of clearance, move loads by less than half a per cent."""
    hole = drawn.raw["wellbore"]
    applies(hole["geometry"] == "arcs")

    def cut(raw: Raw) -> None:
        raw["wellbore"] |= {"geometry": "cylinders", "chord_tolerance": FINE, "overlap": 0.02}

    def shoe(raw: Raw) -> None:
        raw["wellbore"]["overlap"] = 0.02

    same(drawn, changed(drawn, cut), 5e-3, loads_only=True)


@statement("casing of the catalogue = the same written out")
def casing(drawn: Drawn) -> None:
    """API 5CT: diameters and the least yield strength of its grade."""
    applies(drawn.has("casing"))
    sizes = {
        "13 3/8 in 68 L-80": (13.375, 12.415, 80), "9 5/8 in 47 N-80": (9.625, 8.681, 80),
        "9 5/8 in 40 N-80": (9.625, 8.835, 80), "7 in 29 P-110": (7.0, 6.184, 110),
    }  # fmt: skip

    def write(raw: Raw) -> None:
        for row in raw["wellbore"]["intervals"]:
            if "casing" in row:
                outer, inner, strength = sizes[row.pop("casing")]
                row |= {"kind": "cased", "diameter": inner * INCH, "outer_diameter": outer * INCH}
                row["yield_strength"] = f"{strength} ksi"

    same(drawn, changed(drawn, write), ROUNDING)


@statement("keys of the hole that are no load's")
def without_effect(drawn: Drawn) -> None:
    """Names, the wall of casing, the window, what a run in time sticks with."""
    names: Any = ("name", "static_friction", "decay_speed", "overbalance")

    def strip(raw: Raw) -> None:
        for row in raw["wellbore"]["intervals"]:
            for key in names:
                row.pop(key, None)
        raw["wellbore"].pop("window", None)

    same(drawn, changed(drawn, strip), EXACT)
