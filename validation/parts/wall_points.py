"""A hole with bends, points near its wall, and the errors of a contact method there."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, InputError, build_wellbore, find_contacts
from references import contact
from references.contact import traps
from validation.cases import load
from validation.harness.study import Rows, table_of_rows

RADIUS = 0.051  # contact radius of the pipe [m]
HOLE = 0.1556  # hole radius [m]
BAND = 0.015  # points lie within this distance of touching [m]
# Vertical, a build and then a turn of 286 m radius (20°/100 m, as sharp as the paper's), and straight hole.
STATIONS: list[list[float]] = [[0, 0, 0], [200, 0, 0], [500, 60, 0], [740, 60, 55], [900, 60, 55]]
REGIONS = {"straight": (10.0, 190.0), "build": (205.0, 495.0), "turn in space": (505.0, 735.0)}
Mesh = tuple[int, float]  # facets around the hole, ring spacing [m]


def label(name: str, options: dict[str, Any]) -> str:
    """The name of a setting in tables and figures."""
    if "facets" in options:
        return f"{name}, {options['facets']} facets, {options['ring_spacing']:g} m"
    return f"{name}, {options['cylinder_length']:g} m" if options else name


def settings(name: str, lengths: Iterable[float], meshes: Iterable[Mesh]) -> Iterator[dict[str, Any]]:
    """Options of a method: cylinders of these lengths [m], or meshes of these facets and ring spacings [m]."""
    keys = contact.method_class(name).Options.model_fields
    if "facets" in keys:
        yield from ({"facets": facets, "ring_spacing": ring} for facets, ring in meshes)
    elif "cylinder_length" in keys:
        yield from ({"cylinder_length": each, "overlap": min(0.2, 0.5 * each)} for each in lengths)
    else:
        yield {}


def built(
    case: Case, names: Iterable[str], lengths: Sequence[float], meshes: Sequence[Mesh]
) -> tuple[dict[str, contact.ContactMethod], list[dict[str, str]], list[str]]:
    """Methods by the label of their setting, settings that a library rejects, names that are not installed.

    A method is asked once: a plugin that raises whatever it may is among the settings that are rejected.
    """
    plugins, hole = contact.REGISTRY.plugins(), build_wellbore(case)
    middle = hole.at(np.array([0.5 * hole.total_depth]))[0]
    methods: dict[str, contact.ContactMethod] = {}
    refused: list[dict[str, str]] = []
    missing: list[str] = []
    for name in names:
        try:
            if contact.installed_version(name) is None:
                missing.append(name)
                continue
        except InputError as error:  # a plugin that cannot be imported
            refused.append({"setting": name, "why": str(error)})
            continue
        for options in settings(name, lengths, meshes):
            key, foreseen = label(name, options), Exception if name in plugins else InputError
            try:
                method = contact.build(name, case, **options)
                method.query(middle, np.array([RADIUS]))
            except foreseen as error:
                refused.append({"setting": key, "why": str(error) or type(error).__name__})
            else:
                methods[key] = method
    return methods, refused, missing


def the_case(deeper: float = 0.0) -> Case:
    """The hole of exact arcs, its bends ``deeper`` [m]; the meshes and the cylinders are made from it."""
    stations: list[list[float]] = [STATIONS[0], *([md + deeper, *angles] for md, *angles in STATIONS[1:])]
    size = [{"to_md": stations[-1][0], "diameter": 2 * HOLE, "friction": 0.2}]
    return load(
        "curved_chain",
        wellbore__stations=stations,
        wellbore__intervals=size,
        wellbore__geometry="arcs",
        string__top_md=0.0,
        operations=None,
    )


def points_in(case: Case, count: int) -> pd.DataFrame:
    """``count`` seeded points near the wall in each region, and as many where 2 m cylinders overlap in the bends.

    Who times a query shuffles them first: in this order the first lie in the straight part, and a tree looks fast.
    """
    exact, rng = build_wellbore(case), np.random.default_rng(20240525)
    deeper = exact.total_depth - STATIONS[-1][0]
    parts = []
    for region in (*REGIONS, "overlap"):
        if region == "overlap":
            # The first 0.2 m of the cylinders of 2 m that stand for build and turn.
            md = 200.0 + 2.0 * rng.integers(3, 265, count) + rng.uniform(0.0, 0.2, count)
        else:
            md = rng.uniform(*REGIONS[region], count)
        angle = rng.uniform(0, 2 * np.pi, count)
        offset = HOLE - RADIUS + rng.uniform(-BAND, BAND, count)
        places = exact.off_axis(md + deeper, angle, offset)
        parts.append(pd.DataFrame(places, columns=["x", "y", "z"]).assign(region=region, offset=offset))
    return pd.concat(parts, ignore_index=True)


def errors_of(method: contact.ContactMethod, points: pd.DataFrame, case: Case) -> Rows:
    """A row for each region: contacts missed and false, errors of penetration and normal, and their bounds."""
    places = np.ascontiguousarray(points[["x", "y", "z"]])
    exact = find_contacts(build_wellbore(case), places, RADIUS)
    hits = method.query(places, np.full(len(places), RADIUS))
    for region, chosen in points.groupby("region", sort=False).indices.items():
        depth, turn = method.error_bound(0.0 if region == "straight" else 1 / 286.479)
        truth, found = exact.penetration[chosen], hits.penetration[chosen]
        known = np.isfinite(found)
        error = found[known] - truth[known]
        cosine = np.sum(hits.normal[chosen] * exact.normal[chosen], axis=1)[known]
        direction = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
        turned = np.degrees(turn + np.arcsin(np.minimum(depth / points["offset"].to_numpy()[chosen][known], 1)))
        # NaN, no answer, counts as a miss.
        missed, false = (truth > 0) & ~(found > 0), (truth <= 0) & (found > 0)
        yield {
            "region": region,
            "points": len(chosen),
            "missed_percent": 100 * float(missed.mean()),
            "false_percent": 100 * float(false.mean()),
            "deepest_missed_mm": 1e3 * float(truth[missed].max(initial=0.0)),
            "max_penetration_error_mm": 1e3 * float(np.abs(error).max()),
            "rms_penetration_error_mm": 1e3 * float(np.sqrt((error**2).mean())),
            "bound_mm": 1e3 * depth,
            "max_angle_error_deg": float(direction.max()),
            "angle_over_bound": float((direction / np.maximum(turned, 1e-4)).max()),
            "max_md_error_m": float(np.nanmax(np.abs(hits.md - exact.md)[chosen])),
        }


@table_of_rows
def tried(trapped: Sequence[traps.Trap]) -> Rows:
    """Usual calls of libraries that give wrong results, a row each; without a number where a package is missing."""
    at = traps.scene()
    for trap in trapped:
        yield {
            "package": trap.distribution,
            "tried": trap.tried,
            "what_is_measured": trap.measure.__doc__.splitlines()[0] if trap.measure.__doc__ else "",
            "found": traps.measure(trap, at) if traps.installed(trap) else np.nan,
            "unit": trap.unit,
            "used_instead": trap.instead,
        }
