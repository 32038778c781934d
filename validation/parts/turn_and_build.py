"""A section of the scaled hole that turns and builds, string at rest: rigid segments against a Cosserat rod."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, build_wellbore, simulate
from fctd.model.frames import hole_frame
from fctd.model.section import section_of
from references.beams.cosserat import rest
from validation.cases import load, rotation
from validation.harness.study import Check, Context
from validation.parts.windows import completed

# Vertical, a build of 2 deg/m, then a build that turns to the right at the same rate of dogleg.
STATIONS = [[0, 0, 0], [32, 0, 0], [38, 12, 0], [50, 33, 40]]
TOP, BIT = 26.0, 44.0  # [m]
COUNTS = (30, 60)
TOLERANCE = 1e-5


def section(count: int) -> Case:
    """The pipe of the scaled section, hung shortly above the bend and turned slowly: it stays at rest."""
    pipe = load("scaled_section").string.components[0]
    component = pipe.model_dump(exclude_none=True) | {"segments": count}
    return load(
        "scaled_section",
        wellbore__stations=STATIONS,
        wellbore__geometry="arcs",
        string__top_md=TOP,
        string__components=[component],
        operations=rotation(BIT, 0.5, ramp=0.1, rpm=0.1),
    )


def turn_and_build(context: Context) -> tuple[pd.DataFrame, list[Check]]:
    """Compare both at equal counts of segments and elements; returns the table and the checks of the finest."""
    rows = [_compare(count) for count in context.progress(COUNTS, "turn and build")]
    finest = rows[-1]
    where = f"in a turn and build at {COUNTS[-1]} segments against PyElastica"
    return pd.DataFrame(rows), [
        Check(f"contact force {where}", abs(finest["force_difference_percent"]), 3.0, "at_most", "%", "target"),
        Check(f"displacement {where}", finest["displacement_max_percent"], 1.0, "at_most", "%",
              "target: largest along the string, over the clearance"),
        Check(f"contact angle {where}", finest["angle_difference_deg"], 0.5, "at_most", "deg",
              "target: mean, weighted by the force"),
    ]  # fmt: skip


def _compare(count: int) -> dict[str, Any]:
    case = section(count)
    result = completed(simulate(case))
    hole, pipe = build_wellbore(case), section_of(case.string.components[0], case.mud.density)
    stiffness, clearance = (
        case.wellbore.stiffness_per_length,
        0.5 * case.wellbore.intervals[0].diameter - pipe.contact_radius,
    )
    assert stiffness is not None
    rod = rest(hole, pipe, TOP, BIT, count, stiffness, damping=10.0, tolerance=TOLERANCE, longest=30.0)
    force = np.linalg.norm(rod.wall_force[1:], axis=1)
    walls = hole.walls(rod.nodes[1:])
    high, right = hole_frame(hole.at(walls.md)[1])
    offset = np.stack([(walls.offset * high).sum(axis=1), (walls.offset * right).sum(axis=1)], axis=1)
    mine = result.profile.iloc[1:]
    own = mine["contact_force_N"].to_numpy()
    away = np.linalg.norm(mine[["offset_high_m", "offset_right_m"]].to_numpy() - offset, axis=1)
    aside = np.degrees(np.arctan2(offset[:, 1], offset[:, 0]))
    turned = (mine["contact_angle_deg"].to_numpy() - aside + 180) % 360 - 180
    return {
        "segments": count,
        "force_N": own.sum(),
        "rod_force_N": force.sum(),
        "force_difference_percent": 100 * (own.sum() / force.sum() - 1),
        "angle_difference_deg": float(np.average(np.abs(turned), weights=force)),
        "displacement_max_percent": 100 * float(away.max()) / clearance,
        "rod_step_ms": 1e3 * rod.step,
        "rod_steps": rod.steps,
    }
