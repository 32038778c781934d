"""Sampled holes as such: points dragged through rough ones, the ledger of strings in them, and their order.

A smooth wall of which the normal is known shows how fast the cells come near to it.
"""

from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, build_wellbore, simulate
from fctd.arrays import Array
from validation.harness.study import Check, Context, Outcome, Rows, Study, log_slope, table_of_rows
from validation.parts.rough_drags import ALLOWED, BEYOND, STEP, campaign, rough_case

HOLES, DRAGS, QUICK_HOLES = 200, 100_000, 4
STRINGS, QUICK_STRINGS = 10, 1  # that turn, in holes of their own
SEED = 32
SEGMENT, RPM, SECONDS = 2.0, 60.0, 6.0  # [m], [rev/min], [s]
# Smooth walls: waves along the hole, and those of an eccentric hole with three lobes that wind along it.
BORE, ARMS, SPACING, DEPTH = 0.2159, 64, 0.004, 24.0  # [m]
WAVES, LOBES = "waves", "lobes"
WALLS = {WAVES: ((0.003, 0, 12.0),), LOBES: ((0.006, 1, 2.0), (0.003, 3, 12.0))}  # amplitude [m], lobes, turn [rad/m]
CELLS, QUICK_CELLS, FINE = (0.16, 0.08, 0.04, 0.02), (0.08, 0.04), 0.02  # [m]
POINTS, BEHIND = 4000, 1e-4  # and how far beyond the wall they lie [m]


def smooth(name: str, md: Array, angle: Array) -> tuple[Array, Array, Array]:
    """Radius of a smooth wall [m] and its slopes, by depth and by angle [m/rad]."""
    radius = np.full(np.broadcast(md, angle).shape, 0.5 * BORE)
    along, around = np.zeros_like(radius), np.zeros_like(radius)
    for size, lobes, turn in WALLS[name]:
        phase = lobes * angle - turn * md
        radius += size * np.cos(phase)
        along += size * turn * np.sin(phase)
        around -= size * lobes * np.sin(phase)
    return radius, along, around


@table_of_rows
def orders(context: Context) -> Rows:
    """Errors of place and normal on the smooth walls of a straight hole, over the length of the cells."""
    rng = np.random.default_rng(SEED)
    at, angle = rng.uniform(2.0, DEPTH - 2.0, POINTS), rng.uniform(0, 2 * np.pi, POINTS)
    for name in WALLS:
        radius, along, around = smooth(name, at, angle)
        for cell in context.progress(QUICK_CELLS if context.quick else CELLS, "cells"):
            hole = build_wellbore(smooth_case(name, cell))
            axis, tangent = hole.at(at)
            points = hole.off_axis(at, angle, radius + BEHIND)
            found = hole.contacts(points, np.zeros(POINTS))
            outwards = (points - axis) / (radius + BEHIND)[:, None]
            slope = (around / (radius + BEHIND))[:, None]
            normal = outwards - slope * np.cross(tangent, outwards) - along[:, None] * tangent
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            apart, error = np.linalg.norm(found.normal - normal, axis=1), found.penetration - BEHIND
            yield {
                "wall": name, "cell_mm": 1e3 * cell, "place_rms_mm": 1e3 * float(np.sqrt((error**2).mean())),
                "place_largest_mm": 1e3 * float(np.abs(error).max()),
                "angle_rms_deg": float(np.degrees(np.sqrt((apart**2).mean()))),
                "angle_largest_deg": float(np.degrees(apart.max())),
            }  # fmt: skip


def smooth_case(name: str, cell: float) -> Case:
    """A straight hole with a smooth wall, in cells of a length [m]."""
    md, angle = np.arange(0.0, DEPTH + 1e-9, SPACING), np.linspace(0.0, 2 * np.pi, ARMS, endpoint=False)
    rows = np.column_stack([md, smooth(name, md[:, None], angle)[0]]).tolist()
    wellbore = {
        "stations": [[0, 40, 0], [DEPTH, 40, 0]], "geometry": "sampled", "cell": cell,
        "caliper": {"rows": rows, "values": "radius"},
        "intervals": [{"to_md": DEPTH, "diameter": BORE, "friction": 0.2, "kind": "open"}],
    }  # fmt: skip
    pipe = {"name": "pipe", "outer_diameter": 0.1, "inner_diameter": 0.05}
    return Case.model_validate({"name": "smooth", "wellbore": wellbore, "string": {"components": [pipe]}})


@table_of_rows
def ledgers(context: Context) -> Rows:
    """Energy that a turning string's ledger misses, in rough holes and in the round ones of their bits."""
    for k in context.progress(range(QUICK_STRINGS if context.quick else STRINGS), "turning strings"):
        rough = rough_case(np.random.default_rng([SEED, k]))
        depth = rough.wellbore.intervals[-1].to_md - 2.0
        operation = {"kind": "rotate_off_bottom", "at_md": depth, "duration": SECONDS, "rpm": RPM, "ramp_time": 2.0}
        given = rough.model_dump(exclude_defaults=True)
        given["string"]["components"][0]["segment_length"] = SEGMENT
        sections = {"operations": [operation], "mud": {"density": 1200.0, "lateral_damping": 100.0}}
        arcs = {key: value for key, value in given["wellbore"].items() if key not in ("caliper", "cell")}
        for name, wellbore in (("sampled", given["wellbore"]), ("arcs", arcs | {"geometry": "arcs"})):
            result = simulate(Case.model_validate(given | sections | {"wellbore": wellbore}))
            yield {
                "hole": k, "wall": name, "status": str(result.status), "steps": int(result.run["steps"]),
                "energy_error": float(result.run["energy_error"]),
            }  # fmt: skip


def run(context: Context) -> Outcome:
    """All three; the quick run has fewer holes and cells."""
    holes = QUICK_HOLES if context.quick else HOLES
    batches = campaign(DRAGS * holes // HOLES, holes)
    tables = {
        "campaign": pd.DataFrame(context.progress(batches, "rough holes")),
        "ledgers": ledgers(context),
        "orders": orders(context),
    }
    display = {"ledgers": "Strings that turn in rough holes", "orders": "Smooth walls in cells of several lengths"}
    return Outcome(tables=tables, checks=_checks(tables, context.quick), notes=_notes(), display=display)


def _checks(tables: dict[str, pd.DataFrame], quick: bool) -> list[Check]:
    of, strings = tables["campaign"], tables["ledgers"]
    waves, lobes = (tables["orders"][tables["orders"]["wall"] == wall] for wall in WALLS)
    worst: Any = strings.groupby("wall")["energy_error"].max()
    checks = [
        Check("points that leave a rough hole", float(of["leaks"].sum()), 0.0, "at_most", "",
              f"none of {of['drags'].sum()} drags in {len(of)} holes"),
        Check("turn of the normal within a micrometre", float(of["sharpest_turn_deg"].max()), 0.1, "at_most", "deg",
              "no jump: its roughness alone turns it"),
        Check("strings that end as in round holes", float((strings["status"] == "completed").mean() * 100), 100.0,
              "at_least", "%", "each completes its run"),
        Check("largest error of the ledger, beside that in arcs", float(worst["sampled"] / worst["arcs"]), 2.0,
              "at_most", "", "as with arcs"),
        Check("order of the place of a smooth wall", log_slope(waves["cell_mm"], waves["place_rms_mm"]), 1.8,
              "at_least", "", "2, of quadratic splines"),
    ]  # fmt: skip
    if not quick:
        checks.append(
            Check("largest angle of the normal in cells of 20 mm",
                  float(lobes.set_index("cell_mm")["angle_largest_deg"][1e3 * FINE]), 0.5, "at_most", "deg",
                  "a target of this project")
        )  # fmt: skip
    return checks


def _notes() -> list[str]:
    return [
        "Rough holes bend in space by up to 10° in 30 m and are measured by 3 to 16 arms every 0.05 to 0.3 m; their "
        "radii scatter by 0.3 to 6 mm, and some have ledges of up to 20 mm. Each point is moved along the axis by up "
        "to 0.3 m a step while a turning side force presses it onto the wall by up to 10 mm. It has left the hole "
        f"where the search finds a wall more than {1e3 * ALLOWED:g} mm outside what the cells beside it allow, or "
        f"where it ends {1e3 * BEYOND:g} mm deeper than the force asks for. Steps across borders of cells are of "
        f"{1e6 * STEP:g} µm.",
    ]


STUDY = Study("rough_holes", "Does any point leave a rough hole, or jump, and is its energy kept?", run)
