"""Contact methods of rivals and plugins at the points of contact_accuracy: errors, cost, depth, wrong results."""

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd import Case
from fctd.arrays import Array
from references import contact
from references.contact.chunks import SinglePrecision
from references.contact.rival_traps import TRAPS
from references.contact.tube_mesh import Tube
from references.registry import RIVAL_PACKAGES, absent
from references.rivals import METHODS
from references.timing.footprint import footprint
from references.timing.stopwatch import Action, machine_table, race
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.brought import brought
from validation.parts.contact_settings import built
from validation.parts.wall_points import RADIUS, REGIONS, errors_of, points_in, the_case, tried

BASELINES = ("arcs", "cylinders", "fcl")
EXACT = "arcs"  # in double precision, and the denominator of ratios
MESH = "fcl"  # the mesh in double precision
NOT_INSTALLED = "not installed"
# Queries of this many points; the last for methods below SLOW [ns] a point alone.
COUNTS, SLOW = (1, 1000, 100_000), 10_000.0
DEPTHS = (500.0, 1000.0, 4000.0, 8000.0)  # where the build of the hole ends, measured [m]
# Largest distance from the mesh in double precision [mm]; a target of this project.
WITHIN = {"embree": 0.1, "warp": 0.1, "rapier": 0.2}


def places(points: pd.DataFrame) -> Array:
    """Coordinates (n, 3) [m]."""
    return np.ascontiguousarray(points[["x", "y", "z"]])


@table_of_rows
def errors(context: Context, methods: dict[str, contact.ContactMethod], points: pd.DataFrame, case: Case) -> Rows:
    """A row for each setting and region, as in contact_accuracy."""
    for key, method in context.progress(methods.items(), "methods"):
        for row in errors_of(method, points, case):
            yield {"setting": key, "method": method.name, "status": "measured"} | row


@table_of_rows
def costs(methods: dict[str, contact.ContactMethod], points: pd.DataFrame, counts: Sequence[int], rounds: int) -> Rows:
    """A row for each setting and number of points: time a point [ns] of all of a query, and of the library's part.

    points : at least as many as the largest of the counts, shuffled.
    """
    fast = list(methods)
    for count in counts:
        at, radii = places(points.iloc[:count]), np.full(count, RADIUS)
        actions: dict[str, Action] = {}
        for key in fast:
            method = methods[key]
            actions[key] = partial(method.query, at, radii)
            if isinstance(method, SinglePrecision):
                ring = method.tube.ring_above(at)
                actions[f"{key}, library"] = partial(method.nearest, at, ring)
                actions[f"{key}, wrapper"] = partial(_around, method.tube, at, radii, *method.nearest(at, ring))
        # Of a single point one call is too short for the clock.
        repeated = {key: partial(_repeat, action, 20 if count == 1 else 1) for key, action in actions.items()}
        units = 20 if count == 1 else count
        raced = race(repeated, dict.fromkeys(actions, units), rounds, EXACT)
        # The fastest round is the one least disturbed: a call of milliseconds is, where other processes run.
        least = dict(zip(raced["name"], raced["ns_least"], strict=True))
        median = dict(zip(raced["name"], raced["ns"], strict=True))
        for key in fast:
            yield {
                "setting": key, "method": methods[key].name, "status": "measured", "points": count,
                "median_ns": median[key], "least_ns": least[key], "library_ns": least.get(f"{key}, library", np.nan),
                "wrapper_ns": least.get(f"{key}, wrapper", np.nan), "times_arcs": least[key] / least[EXACT],
            }  # fmt: skip
        fast = [key for key in fast if count == 1 or least[key] < SLOW]


def _around(tube: Tube, points: Array, radii: Array, near: Array, faces: NDArray[np.int64]) -> None:
    """What a query does before and after the library's part."""
    tube.ring_above(points)
    tube.contacts(points, radii, near, faces)


def _repeat(action: Action, times: int) -> None:
    for _ in range(times):
        action()


@table_of_rows
def footprints(context: Context, case: Case, names: list[str]) -> Rows:
    """Memory and time of building each method at its own defaults."""
    for name in context.progress(names, "memory"):
        memory, seconds = footprint(name, case)
        pieces = contact.build(name, case).pieces
        yield {"method": name, "status": "measured", "pieces": pieces, "memory_MB": memory, "build_s": seconds}


@table_of_rows
def depths(context: Context, names: list[str], options: dict[str, Any]) -> Rows:
    """How far methods in single precision are from the mesh in double precision, in a build that ends ever deeper."""
    for depth in context.progress((1000.0, 8000.0) if context.quick else DEPTHS, "depths"):
        case = the_case(depth - REGIONS["build"][1])
        at = places(points_in(case, 500).query("region == 'build'"))
        radii = np.full(len(at), RADIUS)
        mesh = contact.build(MESH, case, **options).query(at, radii)
        for name in names:
            for origin in ("chunk", "well"):
                method = contact.build(name, case, origin=origin, **options)
                assert isinstance(method, SinglePrecision)
                hits = method.query(at, radii)
                off = np.abs(hits.penetration - mesh.penetration)
                yield {
                    "method": name, "status": "measured", "depth_m": depth, "origin": origin,
                    "no_answer_percent": 100 * float(np.isnan(off).mean()),
                    "largest_distance_mm": 1e3 * float(np.max(off)),
                    "bound_mm": 1e3 * method.chunks.rounding,
                }  # fmt: skip


def with_missing(table: pd.DataFrame, column: str, missing: list[str]) -> pd.DataFrame:
    """A table and a row for each method that is not installed; ``column`` names the method."""
    rows = pd.DataFrame({column: missing, "method": missing, "status": NOT_INSTALLED})
    return pd.concat([table, rows], ignore_index=True) if missing else table


def run(context: Context) -> Outcome:
    """Errors, cost, memory and depth of rivals and plugins beside three baselines, and what rivals get wrong."""
    quick, case = context.quick, the_case()
    names = [*BASELINES, *METHODS, *contact.REGISTRY.plugins()]
    methods, refused, missing = built(case, names, quick)
    near = errors(context, methods, points_in(case, 100 if quick else 2500), case)
    counts = COUNTS[:2] if quick else COUNTS
    cost = costs(
        methods, points_in(case, max(counts) // 4).sample(frac=1.0, random_state=1), counts, 5 if quick else 15
    )
    rivals = [name for name in METHODS if name not in missing]
    weighed = [name for name in names if name in {method.name for method in methods.values()}]
    deep = depths(context, rivals, {"facets": 24, "ring_spacing": 4.0} if quick else {})
    # Newton takes seconds to import and, once, minutes to compile.
    wrong = tried([trap for trap in TRAPS if not (quick and trap.distribution == "newton")])
    wrong["status"] = np.where(wrong["found"].isna(), NOT_INSTALLED, "measured")
    return Outcome(
        tables={
            "errors": with_missing(near, "setting", missing),
            "cost": with_missing(cost, "setting", missing),
            "builds": with_missing(footprints(context, case, weighed[:1] if quick else weighed), "method", missing),
            "depth": with_missing(deep, "method", missing),
            "traps": wrong,
            "refused": refused,
            "packages": brought(contact.REGISTRY, [*METHODS, *contact.REGISTRY.plugins()]),
            "machine": machine_table(RIVAL_PACKAGES),
        },
        checks=checks(near, cost, deep),
        notes=notes(missing),
        display={
            "cost": "Cost of a point, single and in batches: the query, and apart library and wrapper (fastest round)",
            "builds": "Memory and build time at default settings, one process per method",
            "depth": "Largest distance from the mesh in double precision, with an origin for each 100 m of hole and "
            "with that of the well",
            "traps": "Usual calls of the packages that give wrong results",
            "packages": "What the package of a method costs its user",
            "refused": "Settings that a library rejects, and plugins that cannot be used",
            "machine": "What the times depend on",
        },
    )


def checks(near: pd.DataFrame, cost: pd.DataFrame, deep: pd.DataFrame) -> list[Check]:
    """The bounds of all methods; of rivals that are installed, single precision and cost."""
    # A micrometre for rounding and for the radius that libraries require of a point.
    excess = near["max_penetration_error_mm"] / (near["bound_mm"] + 1e-3)
    late = near["deepest_missed_mm"] - near["bound_mm"]
    found = [
        Check("largest error of penetration over its bound", float(excess.max()), 1.02, "at_most", "",
              "sagitta of facets and rings, and rounding to single precision"),
        Check("missed contacts deeper than the bound", float(late.max()), 1e-3, "at_most", "mm", "the same formulas"),
    ]  # fmt: skip
    for name, within in WITHIN.items():
        for most, origin in ((1000.0, "well"), (8000.0, "chunk")):
            rows = deep.query("method == @name and depth_m <= @most and origin == @origin") if len(deep) else deep
            if len(rows):
                of = "about the origin of the well" if origin == "well" else "in chunks"
                found.append(
                    Check(f"{name}: from the mesh in double precision, to {most / 1e3:g} km {of}",
                          float(rows["largest_distance_mm"].max()), within, "at_most", "mm", "target of this project")
                )  # fmt: skip
    rivals = cost[cost["method"].isin(METHODS) & (cost["points"] == 1000)]
    if len(rivals):
        found.append(
            Check("fastest rival over FCTD's arcs, 1000 points", float(rivals["times_arcs"].min()), 5.0, "at_least",
                  "", "target of this project: a closed form is faster than any mesh", timed=True)
        )  # fmt: skip
    return found


def notes(missing: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    packages = dict.fromkeys(contact.method_class(name).distribution for name in missing)
    return [
        *(f"Package {absent(each)}." for each in packages),
        "All points are shuffled: in order, the first lie in the straight part, where a tree looks fast.",
        "The library's part is its call, with what brings points there and answers back; the wrapper finds the rings "
        "beside the points, and from nearest points the side of the wall, direction and measured depth.",
        "Embree is told where the axis is, and asked for a face alone, whose plane is then used in double precision: "
        "single precision costs it next to nothing. Warp and Rapier answer with points, which are rounded.",
        'Warp runs on the processor; device = "cuda" asks for a GPU.',
        "A plugin of the entry points fctd_references.contact_methods has its rows here too.",
    ]


STUDY = Study(
    "rival_contact",
    "What do rivals' contact queries cost, how accurate are they, and how deep does single precision reach?",
    run,
    timed=True,
)
