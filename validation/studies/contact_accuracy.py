"""Every contact method at the same points near the wall: missed contacts, errors and cost."""

import pandas as pd

from references import contact
from references.contact import traps
from references.methods.asked import every_setting
from references.methods.compare import Preset
from references.timing.stopwatch import machine_table
from validation.harness import study
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.contact_presets import bounds, compared, is_default, left_out, regions, settings
from validation.parts.wall_points import near_wall, the_case, tried

# Columns of the table of costs.
COST = [
    "setting", "method", "series", "points_of_a_call", "point_ns", "point_ns_low", "point_ns_high", "point_kernels",
    "point_arcs", "point_arcs_low", "point_arcs_high", "max_error_mm", "max_angle_deg", "missed_percent", "pieces",
]  # fmt: skip
# Methods whose memory a quick run measures.
QUICK_MEMORY = ("cylinders", "fcl")


def run(context: Context) -> Outcome:
    """Errors of every setting at the same points, cost per point, memory and build time, and wrong results."""
    quick, case = context.quick, the_case()
    near, named = near_wall(case, 250 if quick else 2500)
    rows = every_setting(contact.METHODS, defaults=quick)
    preset = Preset(
        case, near, regions=named,
        memory=lambda row: row.name in QUICK_MEMORY if quick else is_default(row),
    )  # fmt: skip
    found = compared(preset, rows, context).comparison
    refused, missing = left_out(found)
    table = settings(found)
    trapped = tried([trap for trap in traps.TRAPS if traps.installed(trap)])
    built = table.dropna(subset="memory_MB")
    return Outcome(
        tables={
            "errors": regions(found),
            "cost": table[COST],
            "builds": built[["method", "pieces", "memory_MB", "build_s"]],
            "traps": trapped,
            "refused": refused,
            "machine": machine_table(),
        },
        checks=[*bounds(found), *wrong_results(trapped)],
        notes=notes(missing),
        display={
            "cost": "Processor time of a point, median and quartiles of rounds in turns, beside the largest errors",
            "builds": "Memory and build time at default settings, one process per method",
            "traps": "Usual calls of the libraries that give wrong results",
            "refused": "Settings that a library rejects",
            "machine": "What the times depend on",
        },
        comparisons={"comparison": found},
    )


def wrong_results(trapped: pd.DataFrame) -> list[Check]:
    """What a library gets wrong, recorded as a finding."""
    capsule = trapped[trapped["tried"].str.startswith("a capsule")] if len(trapped) else trapped
    if not len(capsule):
        return []
    return [
        Check("error of a capsule's depth in python-fcl", float(capsule["found"].iloc[0]), 0.1, "at_least", "m",
              "more than this makes capsules unfit for the long triangles of a tube: a finding about the library")
    ]  # fmt: skip


def notes(skipped: list[str]) -> list[str]:
    """Notes for the reader of the numbers."""
    return [
        *study.left_out(skipped),
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
