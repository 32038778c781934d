"""Contact methods of rivals and plugins at the points of contact_accuracy: errors, cost, depth, wrong results."""

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.arena.exact_hole import ExactHole
from fctd.arena.frames import Frame, frame
from fctd.arena.result import Comparison
from fctd.arrays import Array
from references import contact
from references.contact.chunks import SinglePrecision
from references.contact.rival_traps import TRAPS
from references.contact.tube_mesh import Tube
from references.methods import asked
from references.methods.asked import every_setting
from references.methods.compare import Preset
from references.registry import RIVAL_PACKAGES, absent
from references.rivals import METHODS
from references.timing.stopwatch import Action, machine_table, race
from validation.harness.study import Check, Context, Outcome, Rows, Study, quartiles_of, ratio_check, table_of_rows
from validation.parts.brought import brought
from validation.parts.contact_presets import (
    FRONTS,
    PRINTED,
    bounds,
    by_size,
    compared,
    is_default,
    left_out,
    regions,
    settings,
)
from validation.parts.wall_points import REGIONS, near_wall, the_case, tried

BASELINES = ("arcs", "cylinders", "fcl")
MESH = "fcl"  # the mesh in double precision
NOT_INSTALLED = "not installed"
COUNTS = (1, 1000, 100_000)  # points of a call
DEPTHS = (500.0, 1000.0, 4000.0, 8000.0)  # where the build of the hole ends, measured [m]
# Largest distance from the mesh in double precision [mm]; a target of this project.
WITHIN = {"embree": 0.1, "warp": 0.1, "rapier": 0.2}


@table_of_rows
def parts(built: Mapping[str, contact.ContactMethod], near: Frame, counts: Sequence[int]) -> Rows:
    """Time of a point [ns] in the library, and in what a query does around it, of methods in single precision."""
    for count in counts:
        at = near.part(slice(0, count) if count <= len(near.md) else np.resize(np.arange(len(near.md)), count))
        for key, method in built.items():
            if not isinstance(method, SinglePrecision):
                continue
            ring = method.tube.ring_above(at.places)
            library = partial(method.nearest, at.places, ring)
            around = partial(_around, method.tube, at.places, at.radii, *method.nearest(at.places, ring))
            actions: dict[str, Action] = {"library": library, "wrapper": around}
            # Of a single point one call is too short for the clock.
            repeated = {name: partial(_repeat, action, 20 if count == 1 else 1) for name, action in actions.items()}
            raced = race(repeated, dict.fromkeys(actions, 20 if count == 1 else count), 5, "library").set_index("name")
            yield {
                "setting": key, "method": method.name, "points": count, "library_ns": raced["ns"]["library"],
                "wrapper_ns": raced["ns"]["wrapper"],
            }  # fmt: skip


def _around(tube: Tube, points: Array, radii: Array, near: Array, faces: NDArray[np.int64]) -> None:
    """What a query does before and after the library's part."""
    tube.ring_above(points)
    tube.contacts(points, radii, near, faces)


def _repeat(action: Action, times: int) -> None:
    for _ in range(times):
        action()


@table_of_rows
def depths(context: Context, names: list[str], options: dict[str, Any]) -> Rows:
    """How far methods in single precision are from the mesh in double precision, in a build that ends ever deeper."""
    for depth in context.progress((1000.0, 8000.0) if context.quick else DEPTHS, "depths"):
        deeper = depth - REGIONS["build"][1]
        case = the_case(deeper)
        near = frame(ExactHole(case.wellbore, case.solver.perturbed), 500, md=(REGIONS["build"][0] + deeper, depth))
        mesh = contact.build(MESH, case, **options).query(near.places, near.radii)
        for name in names:
            for origin in ("chunk", "well"):
                method = contact.build(name, case, origin=origin, **options)
                assert isinstance(method, SinglePrecision)
                hits = method.query(near.places, near.radii)
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
    plugins = list(contact.REGISTRY.plugins())
    near, named = near_wall(case, 100 if quick else 2500)
    rows = [*every_setting([*BASELINES, *METHODS, *plugins], defaults=quick), *asked.left_out("contact")]
    counts = COUNTS[:2] if quick else COUNTS
    weighed = BASELINES[:1] if quick else [row.name for row in rows]
    preset = Preset(
        case, near, regions=named, sizes=counts,
        memory=lambda row: row.name in weighed and is_default(row),
    )  # fmt: skip
    comparing = compared(preset, rows, context)
    found = comparing.comparison
    refused, missing = left_out(found)
    rivals = [name for name in METHODS if name not in missing]
    deep = depths(context, rivals, {"facets": 24, "ring_spacing": 4.0} if quick else {})
    # Newton takes seconds to import and, once, minutes to compile.
    wrong = tried([trap for trap in TRAPS if not (quick and trap.distribution == "newton")])
    wrong["status"] = np.where(wrong["found"].isna(), NOT_INSTALLED, "measured")
    table = settings(found)
    fronts = table[FRONTS].merge(by_size(found, counts).drop(columns="method"), on="setting")
    fronts["single_us"] = 1e-3 * fronts["ns_1"]
    return Outcome(
        tables={
            "errors": with_missing(regions(found).assign(status="measured"), "setting", missing),
            "fronts": with_missing(fronts.assign(status="measured"), "setting", missing),
            "settings": fronts[PRINTED],
            "parts": parts(comparing.built, near, counts),
            "depth": with_missing(deep, "method", missing),
            "traps": wrong,
            "refused": refused,
            "packages": brought(contact.REGISTRY, [*METHODS, *plugins]),
            "machine": machine_table(RIVAL_PACKAGES),
        },
        checks=[*bounds(found), *checks(fronts, deep), *usable(found, plugins)],
        notes=notes(missing),
        display={
            "settings": "Every setting: cost of a call with one point and of a point of 1000, errors",
            "parts": "Of a point's cost, the part of the library and that of the wrapper",
            "depth": "Largest distance from the mesh in double precision, with an origin for each 100 m of hole and "
            "with that of the well",
            "traps": "Usual calls of the packages that give wrong results",
            "packages": "What the package of a method costs its user",
            "refused": "Settings that a library rejects, and plugins that cannot be used",
            "machine": "What the times depend on",
        },
        comparisons={"comparison": found},
    )


def usable(found: Comparison, plugins: Collection[str]) -> list[Check]:
    """Whether every plugin that is installed can be used; the reason stands beside the number."""
    of = [row for row in found.rows if row.name in plugins or row.reason.endswith("is taken")]
    bad = [f"{row.label}: {row.reason}" for row in of if row.status not in ("measured", "not installed")]
    if not of:
        return []
    return [
        Check("settings of plugins that cannot be used", float(len(bad)), 0, "at_most", "",
              "; ".join(bad) or "every plugin that is installed has its rows")
    ]  # fmt: skip


def checks(cost: pd.DataFrame, deep: pd.DataFrame) -> list[Check]:
    """Of rivals that are installed, single precision and cost."""
    found: list[Check] = []
    for name, within in WITHIN.items():
        for most, origin in ((1000.0, "well"), (8000.0, "chunk")):
            rows = deep.query("method == @name and depth_m <= @most and origin == @origin") if len(deep) else deep
            if len(rows):
                of = "about the origin of the well" if origin == "well" else "in chunks"
                found.append(
                    Check(f"{name}: from the mesh in double precision, to {most / 1e3:g} km {of}",
                          float(rows["largest_distance_mm"].max()), within, "at_most", "mm", "target of this project")
                )  # fmt: skip
    rivals = cost[cost["method"].isin(METHODS)]
    if len(rivals):
        fastest = quartiles_of(rivals.sort_values("arcs_1000").iloc[0], "arcs_1000")
        found.append(
            ratio_check("fastest rival over FCTD's arcs, 1000 points", fastest, 5.0, "at_least",
                        "target of this project: a closed form is faster than any mesh")
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
