"""A hole that is no circle: where a string touches it and with which force, against fine meshes of the same hole.

The well is an S with a washout, a ledge on the low side, rough hole, a key seat of tool joints and an oval section.
Every method has the same wall: the cells of the sampled hole, the meshes, and the circles of equal area that drilling
programs assume.
"""

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd import Case, build_wellbore, equilibrium, find_contacts
from fctd.arrays import Array
from fctd.mechanics.contact import START_MD
from fctd.mechanics.query import WALL_COLUMNS, query_sampled
from references import contact
from references.timing.stopwatch import rounds
from validation.harness.study import Check, Context, Outcome, Rows, Study, in_columns, table_of_rows, time_check
from validation.parts.uneven_hole import DEPTH, FIRST, LAST, PARTS, TOOL_JOINT, equal_areas, radii, uneven_case
from validation.parts.windows import in_parts

BIT_DEPTH, SEGMENT = DEPTH - 10.0, 10.0  # [m]
RPM, RAMP, SETTLES, MEASURED = 60.0, 4.0, 12.0, 12.0  # of the turning string [rev/min], [s]
QUICK_MEASURED = 2.0
SAMPLED, CIRCLE = "sampled", "circle of equal area"
MESHES = {"mesh, 48 facets": 48, "mesh, 96 facets": 96}  # rings at every cell of 0.1 m
FINEST = list(MESHES)[-1]
WINDOW = 10.0  # [m]
LOADS = {"hookload_N": "hook load", "surface_torque_N_m": "torque"}
TIMED, PASSES = 100_000, 5  # points whose time is taken
POINTS, BAND = 400, 0.004  # in each part, and how far from touching [m]
OPERATIONS = ("trip_in", "trip_out", "rotate_off_bottom")


def turning(case_of: Array | None, seconds: float) -> Case:
    """The string that turns off bottom in a hole of these radii."""
    operation = {"kind": "rotate_off_bottom", "at_md": BIT_DEPTH, "duration": SETTLES + seconds, "rpm": RPM,
                 "ramp_time": RAMP}  # fmt: skip
    record = {"interval": 1.0, "profile_at": []}
    return uneven_case(SEGMENT, case_of, operations=[operation], record=record)


def in_time(context: Context, seconds: float) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Mean loads over the last seconds of each method, and the mean contact forces of its points."""
    _, wall = radii()
    rows: list[dict[str, Any]] = []
    forces: list[pd.DataFrame] = []
    methods: dict[str, tuple[Array, int | None]] = {SAMPLED: (wall, None), CIRCLE: (equal_areas(wall), None)}
    if not context.quick:
        methods |= {name: (wall, facets) for name, facets in MESHES.items()}
    for name, (measured, facets) in context.progress(methods.items(), "methods"):
        case = turning(measured, seconds)
        method = None if facets is None else contact.build("fcl", case, facets=facets, ring_spacing=2.0)
        result, factors = in_parts(case, contact=method)
        history = result.history[result.history["time_s"] > SETTLES]
        rows.append(
            {"method": name, "status": str(result.status), "pieces": 0 if method is None else method.pieces}
            | {key: float(history[key].mean()) for key in (*LOADS, "total_contact_force_N")}
            | in_columns({"real_time_factor": factors})
        )
        profile = result.profile.iloc[1:]
        forces.append(profile[["md_m", "contact_force_N", "contact_angle_deg"]].assign(method=name))
    return pd.DataFrame(rows), pd.concat(forces, ignore_index=True)


@table_of_rows
def steady(context: Context) -> Rows:
    """Steady loads in the sampled hole, and how wrong those of circles are."""
    _, wall = radii()
    for kind in context.progress(OPERATIONS, "steady strings"):
        for name, measured in ((SAMPLED, wall), (CIRCLE, equal_areas(wall)), ("bit size", None)):
            point = equilibrium(uneven_case(SEGMENT, measured), kind, BIT_DEPTH)
            yield {
                "operation": kind, "hole": name, "status": str(point.status), "iterations": point.iterations,
                "hookload_N": point.hookload, "surface_torque_N_m": point.surface_torque,
                "largest_contact_force_N": float(point.profile["contact_force_N"].max()),
            }  # fmt: skip


@table_of_rows
def places(context: Context) -> Rows:
    """Penetration of seeded points of a tool joint in each part, against the finest mesh and against circles."""
    _, wall = radii()
    case = uneven_case(SEGMENT, wall)
    hole, round_hole = build_wellbore(case), build_wellbore(uneven_case(SEGMENT, equal_areas(wall)))
    facets = MESHES[FINEST] // (2 if context.quick else 1)
    mesh = contact.build("fcl", case, facets=facets, ring_spacing=2.0)
    rng = np.random.default_rng(7)
    for part, (first, last) in context.progress(PARTS.items(), "parts"):
        md, angle = rng.uniform(max(first, FIRST), min(last, LAST), POINTS), rng.uniform(0, 2 * np.pi, POINTS)
        near = hole.off_axis(md, angle, np.full(POINTS, 0.01))
        room = hole.walls(near, radii=np.full(POINTS, 0.5 * TOOL_JOINT)).radius - 0.5 * TOOL_JOINT
        points = hole.off_axis(md, angle, np.maximum(room + rng.uniform(0, BAND, POINTS), 1e-4))
        radius = np.full(POINTS, 0.5 * TOOL_JOINT)
        expected, found, circles = (
            mesh.query(points, radius), find_contacts(hole, points, radius), find_contacts(round_hole, points, radius)
        )  # fmt: skip
        both = (expected.penetration > 0) & (found.penetration > 0)
        cosine = (expected.normal[both] * found.normal[both]).sum(axis=1)
        yield {
            "part": part, "points": POINTS, "touch_in_mesh": int((expected.penetration > 0).sum()),
            "touch_sampled": int((found.penetration > 0).sum()),
            "error_mm": 1e3 * _rms(found.penetration - expected.penetration, both),
            "error_of_circle_mm": 1e3 * _rms(circles.penetration - expected.penetration, both),
            "angle_deg": float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean()),
        }  # fmt: skip


def point_time() -> pd.DataFrame:
    """Processor time of the wall beside a point [ns], a row for each of several passes along the hole."""
    hole = build_wellbore(uneven_case(SEGMENT, radii()[1]))
    md = np.linspace(FIRST + 1, LAST - 1, TIMED)
    points = hole.off_axis(md, np.linspace(0, 1000.0, TIMED), np.full(TIMED, 0.03))
    radius, out, towards = np.full(TIMED, 0.5 * TOOL_JOINT), np.empty((TIMED, WALL_COLUMNS)), np.empty((TIMED, 3))
    owner = np.searchsorted(hole.pieces[:, START_MD], md, side="right") - 1
    times = rounds(lambda: query_sampled(hole.pieces, points, radius, owner.copy(), out, towards), 1 + PASSES)
    return pd.DataFrame({"ns": 1e9 * np.array(times[1:]) / TIMED})  # the first may compile


def _rms(error: Array, of: NDArray[np.bool_]) -> float:
    return float(np.sqrt((error[of] ** 2).mean()))


def windows(forces: pd.DataFrame) -> pd.DataFrame:
    """Contact force summed over windows of the hole [N], a row for each window and a column for each method."""
    window = (forces["md_m"] // WINDOW) * WINDOW
    found = forces.assign(from_md_m=window).pivot_table("contact_force_N", "from_md_m", "method", aggfunc="sum")
    return found.reset_index()


def run(context: Context) -> Outcome:
    """The turning string in time, steady strings, and points near the wall; the quick run has no mesh in time."""
    loads, forces = in_time(context, QUICK_MEASURED if context.quick else MEASURED)
    tables = {
        "loads": loads, "forces": forces, "windows": windows(forces), "steady": steady(context),
        "places": places(context), "wall": _wall(), "point": point_time(),
    }  # fmt: skip
    display = {
        "loads": "The turning string by every method", "steady": "Steady strings", "places": "Points near the wall",
    }  # fmt: skip
    return Outcome(tables=tables, checks=_checks(tables, context.quick), notes=_notes(), display=display)


def _wall() -> pd.DataFrame:
    """Smallest, largest and equal-area radius of the hole over depth, for the figure."""
    md, wall = radii()
    return pd.DataFrame({
        "md_m": md, "least_m": wall.min(axis=1), "largest_m": wall.max(axis=1), "equal_area_m": equal_areas(wall)[:, 0],
    })[::5]  # fmt: skip


def _notes() -> list[str]:
    return [
        f"Loads are means from {SETTLES:g} s on.  Contact forces are those at the end of a run.",
        "A mesh has one contact for a point: it jumps from side to side where a tool joint touches both of a groove.",
        "A mesh is asked with a sphere at each contact point, the sampled hole with a disc across the hole: beside the "
        "ledge and the ends of the washout they are not the same body.",
    ]


def _checks(tables: dict[str, pd.DataFrame], quick: bool) -> list[Check]:
    """The numbers with bounds."""
    steady_rows, spots = tables["steady"], tables["places"]
    checks = [
        Check("steady rows in the sampled hole that converge",
              100 * float((steady_rows.loc[steady_rows["hole"] == SAMPLED, "status"] == "converged").mean()), 100.0,
              "at_least", "%", "wherever those of arcs do"),
        Check("penetration against the mesh, largest root mean square of a part", float(spots["error_mm"].max()), 1.0,
              "at_most", "mm", "a target of this project"),
        Check("penetration of the circle of equal area over that of the sampled hole, errors",
              float(spots["error_of_circle_mm"].max() / spots["error_mm"].max()), 3.0, "at_least", "",
              "what a circle leaves out"),
        time_check("time of a point, in order along the hole", tables["point"]["ns"], 50.0, "ns",
                   "a target of this project"),
    ]  # fmt: skip
    if quick:
        return checks
    loads = tables["loads"].set_index("method")
    for key, what in LOADS.items():
        checks.append(Check(f"{what} against the mesh", _percent(loads.loc[SAMPLED, key], loads.loc[FINEST, key]), 1.0,
                            "at_most", "%", f"{FINEST}"))  # fmt: skip
        coarse = next(iter(MESHES))
        checks.append(Check(f"{what} of the mesh, change from 48 to 96 facets",
                            _percent(loads.loc[coarse, key], loads.loc[FINEST, key]), 1.0, "at_most", "%",
                            "a mesh that can judge"))  # fmt: skip
    of = tables["windows"]
    off = (of[SAMPLED] - of[FINEST]).abs()
    checks += [
        Check("side force over 10 m against the mesh, largest difference", 100 * float((off / of[FINEST]).max()), 1.0,
              "at_most", "%", f"{len(of)} windows"),
        Check("side force over 10 m against the mesh, median difference", 100 * float((off / of[FINEST]).median()),
              1.0, "at_most", "%", f"{len(of)} windows"),
        Check("largest local force against the mesh",
              _percent(_largest(tables["forces"], SAMPLED), _largest(tables["forces"], FINEST)), 5.0, "at_most", "%",
              FINEST),
    ]  # fmt: skip
    return checks


def _percent(found: Any, expected: Any) -> float:
    return float(100 * abs(found / expected - 1))


def _largest(forces: pd.DataFrame, method: str) -> float:
    return float(forces.loc[forces["method"] == method, "contact_force_N"].max())


STUDY = Study(
    "washed_out_hole",
    "Does a wall sampled over depth and angle bear a string as a fine mesh of that hole does?",
    run,
    timed=True,
)
