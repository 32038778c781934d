"""Single precision in a well: false force of the wall by depth, and the shortest step with which a body still falls."""

import numpy as np
import pandas as pd

from fctd.mechanics.topdrive import GRAVITY
from references import engines
from references.engines import gate
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Rows, Study, left_out, table_of_rows
from validation.parts import single_precision as single
from validation.parts.single_precision import by_positions, by_velocities

STIFFNESS = 1e7  # of the wall at a contact point [N/m], as in all cases
DEPTHS = (0.0, 1e3, 2e3, 4e3, 8e3)  # of the upper end of the hole [m]
DEEP = 4e3
HEIGHTS = (1.0, 100.0, 600.0, 4e3)  # [m]
SECONDS, RIGHT = 0.1, 0.05  # of a fall; relative error of a fall that counts as right
SHOWN = (10.0, 5.0, 2.0, 1.0, 0.5, 0.25, 0.1)  # steps of the table of falls [ms]
STEPS = np.geomspace(1e-4, 2e-2, 160)  # [s]
INTEGRATORS = {"places alone": by_positions, "velocity kept": by_velocities}
SEGMENT = 25.0  # [m]


@table_of_rows
def wall_forces(count: int) -> Rows:
    """False force of the wall at the worst of ``count`` points: hole and points rounded at depth, and in chunks."""
    points = single.points_near_the_wall(count)
    for method in (single.Mesh(), single.Pieces("cylinders"), single.Pieces("arcs")):
        exact = method.exact(points)

        def worst(found: np.ndarray, exact: np.ndarray = exact) -> float:
            return STIFFNESS * float(np.abs(found - exact).max()) / 1e3

        chunks = worst(method.in_chunks(points))
        for depth in DEPTHS:
            yield {
                "method": method.name,
                "depth_m": depth,
                "false_force_kN": worst(method.at(points, depth)),
                "spacing_kN": STIFFNESS * single.spacing(depth + single.STATIONS[-1][0]) / 1e3,
                "with_origins_kN": chunks,
            }


@table_of_rows
def falls() -> Rows:
    """Fall of a free body in SECONDS from rest, in single precision."""
    for height in HEIGHTS:
        for step in SHOWN:
            found = {
                f"{name.replace(' ', '_')}_mm": 1e3 * fall(height, step / 1e3, SECONDS, np.float32)
                for name, fall in INTEGRATORS.items()
            }
            yield {"height_m": height, "step_ms": step, **found, "exact_mm": 1e3 * GRAVITY * SECONDS**2 / 2}


@table_of_rows
def shortest_steps() -> Rows:
    """The longest step with which a body does not move, and the one from which on it falls right, with estimates."""
    for height in HEIGHTS:
        for name, fall in INTEGRATORS.items():
            error = np.array([single.rounding_error(fall, height, float(step), SECONDS) for step in STEPS])
            rests, wrong = STEPS[error == 1], STEPS[:-1][error[:-1] > RIGHT]
            kept = fall is by_velocities
            frozen = single.frozen_by_velocities(height, SECONDS) if kept else single.frozen_by_positions(height)
            yield {
                "integrator": name,
                "height_m": height,
                "frozen_up_to_ms": 1e3 * float(rests[-1]) if len(rests) else np.nan,
                "frozen_expected_ms": 1e3 * frozen,
                "right_from_ms": 1e3 * float(STEPS[wrong.max(initial=0.0) < STEPS][0]),
                "right_expected_ms": np.nan if kept else 1e3 * single.exact_by_positions(height, RIGHT),
            }


@table_of_rows
def engines_of_today(names: list[str]) -> Rows:
    """Fall of the bit of a released string in every engine of the suite, over ½gt², at 0 and 4 km."""
    for name in names:
        shallow, deep = (gate.fall(engines.build(name), depth) for depth in (0.0, DEEP))
        yield {"engine": name, "fall_at_0_m": shallow, "fall_at_4_km": deep, "difference": abs(deep - shallow)}


def run(context: Context) -> Outcome:
    """Walls of a hole that lies deeper and deeper, falls at several heights, and the engines of the suite."""
    names = {name: engines.installed_version(name) is not None for name in engines.ENGINES}
    tables = {
        "wall": wall_forces(100 if context.quick else 1000),
        "falls": falls(),
        "steps": shortest_steps(),
        "engines": engines_of_today([name for name, there in names.items() if there]),
    }
    return Outcome(
        tables=tables,
        checks=[*wall_checks(tables["wall"]), *step_checks(tables["steps"], tables["engines"])],
        notes=[
            *left_out([name for name, there in names.items() if not there]),
            "Numbers in single precision are 0.06 mm apart at 600 m, 0.24 mm at 4 km and 0.49 mm beyond 4.1 km. "
            f"The wall's force is that of {STIFFNESS:g} N/m; of the mesh only vertices and points are rounded, and "
            "the query is exact; FCTD's cylinders and arcs are computed in single precision throughout, by the "
            "engine's own functions. None of this is how FCTD runs: it computes in double precision.",
            f"The cure of queries is an origin for every {single.CHUNK:g} m of hole. Arcs keep ten times more error "
            "than cylinders with it, since they are measured from their own starts, up to 300 m away.",
            "Engines that keep places alone (position-based dynamics and descent on vertices) derive velocity from "
            "two of them. Where g h² is less than half a spacing, a body at rest never falls; with a little more it "
            "falls too fast, since every step is rounded up to a whole spacing. So a shorter step makes them worse. "
            "Engines that keep the velocity lose its product with the step, and freeze at steps ten times shorter. "
            "This concerns engines in single precision: Newton, PhysX, Rapier, MuJoCo on GPU (MJX, Warp), Genesis. "
            "Of the engines of this suite it concerns none: they keep velocities, in double precision. MuJoCo's ball "
            "chain does not stretch, and falls nowhere.",
        ],
        display={
            "wall": "False force of the wall at the worst point, by depth of the hole, and with an origin per chunk",
            "falls": f"Fall of a free body in {SECONDS:g} s from rest, in single precision",
            "steps": "The longest step with which it does not move, and from which step on it falls right",
            "engines": "Engines of the suite: fall of a released string over ½gt²",
        },
    )


def wall_checks(table: pd.DataFrame) -> list[Check]:
    """False force of the wall against closed forms and against what a segment weighs."""
    deepest, deep = (table[table["depth_m"] == depth] for depth in (DEPTHS[-1], DEEP))
    pipe = load("curved_chain").string.components[0]
    area = np.pi / 4 * (pipe.outer_diameter**2 - pipe.inner_diameter**2)
    weight = 7850 * area * GRAVITY * SEGMENT / 1e3
    origins = table.groupby("method")["with_origins_kN"].first()
    arcs = origins.index.str.contains("arcs")
    return [
        Check("false force of the wall at 8 km over that of one spacing, largest",
              float((deepest["false_force_kN"] / deepest["spacing_kN"]).max()), (0.3, 1.0), "within", "",
              "half a spacing of the point and half of the wall, in the worst direction"),
        Check("false force of the wall at 4 km over the weight of a segment of 25 m, least of mesh, cylinders and arcs",
              float(deep["false_force_kN"].min() / weight), 0.1, "at_least", "",
              "its contact force in a level hole"),
        Check("false force of the wall with origins, mesh and cylinders", float(origins[~arcs].max()),
              2 * STIFFNESS * single.spacing(single.CHUNK / 2) / 1e3, "at_most", "kN",
              "two spacings at half a chunk, at any depth"),
        Check("false force of the wall with origins, arcs", float(origins[arcs].max()),
              STIFFNESS * single.spacing(300.0) / 1e3, "at_most", "kN",
              "one spacing at the end of the longest arc, 300 m from its start, at any depth"),
    ]  # fmt: skip


def step_checks(table: pd.DataFrame, today: pd.DataFrame) -> list[Check]:
    """Steps against their estimates, and the engines of the suite."""
    alone, kept = (table[table["integrator"] == name] for name in INTEGRATORS)
    deep = kept[kept["height_m"] == DEEP].iloc[0]
    begins = (alone["frozen_up_to_ms"] / alone["frozen_expected_ms"]).dropna()
    off = float(begins.iloc[int((begins - 1).abs().to_numpy().argmax())])
    near = 1.04  # from one step of the ladder to the next
    return [
        Check("places alone: step with which a body stays at rest, over its estimate, furthest of heights", off,
              (1 / near, 1.0), "within", "", "√(spacing/2g): g h² is half a spacing"),
        Check("places alone: step from which a body falls right, over its estimate, largest of heights",
              float((alone["right_from_ms"] / alone["right_expected_ms"]).max()), near, "at_most", "",
              f"√(spacing/2εg), ε {RIGHT:.0%}: g h² is wrong by half a spacing at most"),
        Check("places alone: step from which a body falls right at 600 m", float(
              alone.loc[alone["height_m"] == 600, "right_from_ms"].iloc[0]), 3.9, "at_least", "ms",
              "the longest step of an engine of the suite, FCTD's with segments of 25 m"),
        Check("velocity kept: step with which a body stays at rest for 0.1 s at 4 km, over its estimate",
              float(deep["frozen_up_to_ms"] / deep["frozen_expected_ms"]), (1 / near, 1.0), "within", "",
              "spacing/2gt: the product of step and velocity is half a spacing"),
        Check("velocity kept: step from which a body falls right, largest of heights",
              float(kept["right_from_ms"].max()), 1.0, "at_most", "ms",
              "steps of the engines of the suite, 0.4 to 4 ms"),
        Check("engines of the suite: fall at 4 km against that at 0, largest difference over ½gt²",
              float(today["difference"].max()), 1e-6, "at_most", "",
              "places in double precision; in single precision a spacing at 4 km is a part in 500 of the fall"),
    ]  # fmt: skip


STUDY = Study("precision_in_depth", "What does single precision cost an engine in a well?", run)
