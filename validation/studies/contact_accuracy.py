"""Every contact method at the same points near the wall: missed contacts, errors and cost."""

from functools import partial

import numpy as np
import pandas as pd

from fctd import Case
from references import contact
from references.contact import traps
from references.timing.footprint import footprint
from references.timing.stopwatch import machine_table, race
from validation.harness.study import Check, Context, Outcome, Rows, Study, left_out, table_of_rows
from validation.parts.contact_settings import built
from validation.parts.wall_points import RADIUS, errors_of, points_in, the_case, tried

BASELINE = "cylinders, 2 m"


def costs(methods: dict[str, contact.ContactMethod], points: pd.DataFrame, rounds: int) -> pd.DataFrame:
    """The race of all settings over the points, a row each."""
    places, radii = np.ascontiguousarray(points[["x", "y", "z"]]), np.full(len(points), RADIUS)
    actions = {key: partial(method.query, places, radii) for key, method in methods.items()}
    cost = race(actions, dict.fromkeys(actions, len(points)), rounds, BASELINE)
    cost = cost.rename(columns={"name": "setting", "ns": "ns_per_point", "units": "points"})
    cost["method"] = [key.partition(",")[0] for key in cost["setting"]]
    cost["pieces"] = [methods[key].pieces for key in cost["setting"]]
    return cost


@table_of_rows
def footprints(context: Context, case: Case, names: list[str]) -> Rows:
    """Memory and time of building each method at its own defaults; cylinders and arcs are the engine's own."""
    for name in context.progress(names, "memory"):
        memory, seconds = footprint(name, case)
        yield {"method": name, "pieces": contact.build(name, case).pieces, "memory_MB": memory, "build_s": seconds}


def run(context: Context) -> Outcome:
    """Errors of every setting at the same points, cost per point, memory and build time, and wrong results."""
    quick, case = context.quick, the_case()
    points = points_in(case, 250 if quick else 2500)
    methods, refused, missing = built(case, contact.METHODS, quick)
    rows = [
        {"setting": key, "method": key.partition(",")[0]} | row
        for key, method in context.progress(methods.items(), "methods")
        for row in errors_of(method, points, case)
    ]
    errors = pd.DataFrame(rows)
    cost = costs(methods, points.sample(120 if quick else 400, random_state=1), 5 if quick else 15)
    bends = errors[errors["region"] != "straight"].groupby("setting")
    for column in ("max_penetration_error_mm", "max_angle_error_deg"):
        cost[column] = cost["setting"].map(bends[column].max())
    raced = [name for name in contact.METHODS if name not in missing]
    trapped = tried([trap for trap in traps.TRAPS if traps.installed(trap)])
    return Outcome(
        tables={
            "errors": errors,
            "cost": cost,
            "builds": footprints(context, case, [n for n in raced if not quick or n in ("cylinders", "fcl")]),
            "traps": trapped,
            "refused": refused,
            "machine": machine_table(),
        },
        checks=checks(errors, trapped),
        notes=notes(missing),
        display={
            "cost": "Cost of a point beside the largest error in bends; all settings timed in turns",
            "builds": "Memory and build time at default settings, one process per method",
            "traps": "Usual calls of the libraries that give wrong results",
            "refused": "Settings that a library rejects",
            "machine": "What the times depend on",
        },
    )


def checks(errors: pd.DataFrame, trapped: pd.DataFrame) -> list[Check]:
    """Geometric bounds for all methods, and the wrong results of libraries, recorded as findings."""
    # A micrometre for rounding and for the radius that libraries require of a point.
    excess = errors["max_penetration_error_mm"] / (errors["bound_mm"] + 1e-3)
    late = errors["deepest_missed_mm"] - errors["bound_mm"]
    found = [
        Check("largest error of penetration over its geometric bound", float(excess.max()), 1.02, "at_most", "",
              "sagitta of facets r(1 − cos π/n), of chords and rings κℓ²/8"),
        Check("largest error of the normal over its geometric bound", float(errors["angle_over_bound"].max()), 1.02,
              "at_most", "", "half a facet, half a chord, and the bound above over the distance from the axis"),
        Check("missed contacts deeper than the geometric bound", float(late.max()), 1e-3, "at_most", "mm",
              "the same formulas"),
    ]  # fmt: skip
    capsule = trapped[trapped["tried"].str.startswith("a capsule")] if len(trapped) else trapped
    if len(capsule):
        found.append(
            Check("error of a capsule's depth in python-fcl", float(capsule["found"].iloc[0]), 0.1, "at_least", "m",
                  "finding: capsules are unfit for the long triangles of a tube")
        )  # fmt: skip
    return found


def notes(skipped: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *left_out(skipped),
        "The reference is the exact arc. A mesh on the wall lies inside the hole by the sagitta of its facets and, "
        "between rings, towards the inside of the bend: contacts are found early on the outside of a bend and late "
        "on its inside.",
        "fcl and coal compute the distance of the centre, which gives the clearance too; their collision queries "
        "have the same errors, and the study contact_swap has their costs. bullet and mujoco report contacts alone.",
        "Cylinders and arcs are called from Python like the others. For a point that is queried again they remember "
        "its piece, as in the engine's loop; the trees of the meshes have no such memory.",
        "A sphere offset from its body's origin, which is reported to fall through a mesh in Bullet's own time "
        "steps, is found by Bullet's closest-point query.",
    ]


STUDY = Study(
    "contact_accuracy",
    "How accurate is each contact method, and what does it cost per point?",
    run,
    reproduce=True,
    timed=True,
)
