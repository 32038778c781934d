"""Engines in single precision in a well: whether a free sphere falls, by height and step, against ten lines of ours."""

import numpy as np
import pandas as pd

from fctd.mechanics.topdrive import GRAVITY
from references.engines.free_sphere import SPHERES
from references.registry import version_of
from validation.harness.study import Check, Context, Outcome, Rows, Study, table_of_rows
from validation.parts.single_precision import by_positions, by_velocities, exact_by_positions, spacing

HEIGHTS = (1.0, 100.0, 600.0, 4e3)  # [m]
SECONDS, RIGHT = 0.1, 0.05  # of a fall; relative error of a fall that counts as right
STEPS, QUICK = (10e-3, 5e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3, 0.1e-3), (5e-3, 1e-3, 0.5e-3)  # [s]
FALL = 1e3 * GRAVITY * SECONDS**2 / 2  # [mm]
WELL, STEP = 600.0, 1e-3  # a string of some length, and a step with which local solvers carry it [m, s]


@table_of_rows
def falls(quick: bool) -> Rows:
    """Fall of a sphere in every rival, and by our own lines in single precision; a row for one not installed.

    quick : with few steps, and without Newton, which compiles for a minute and a half in a new environment.
    """
    steps = QUICK if quick else STEPS
    for name, sphere in SPHERES.items():
        if quick and sphere.distribution == "newton":
            continue
        if version_of(sphere.distribution) is None:
            yield {"engine": name, "status": "not installed"}
            continue
        lines = by_positions if sphere.places_alone else by_velocities
        for height in HEIGHTS:
            for step in steps:
                yield {
                    "engine": name,
                    "status": "measured",
                    "height_m": height,
                    "step_ms": 1e3 * step,
                    "fall_mm": 1e3 * sphere.fall(height, step, SECONDS),
                    "by_our_lines_mm": 1e3 * lines(height, step / sphere.sub_steps, SECONDS, np.float32),
                    "exact_mm": FALL,
                }


def run(context: Context) -> Outcome:
    """One free sphere in every rival."""
    table = falls(context.quick)
    # Without any rival there are rows without numbers.
    table = table.reindex(columns=["engine", "status", "height_m", "step_ms", "fall_mm", "by_our_lines_mm", "exact_mm"])
    return Outcome(
        tables={"falls": table},
        checks=checks(table),
        notes=[
            "A symplectic Euler falls by a step in 0.1 s too far: 5 % with 5 ms. More than that is single precision. "
            f"Newton's VBD falls right from √(spacing/2εg) on, {1e3 * exact_by_positions(WELL, RIGHT):.1f} ms at "
            f"{WELL:g} m for ε = {RIGHT:.0%}; solvers that keep the velocity freeze at spacing/2gt, which Rapier's "
            "sub-steps reach with a step four times as long. An origin near the string, as in this suite's Rapier, "
            "makes all of them fall; their own interface gives none.",
        ],
        display={
            "falls": f"Fall of a free sphere in {SECONDS:g} s from rest, {FALL:.1f} mm, in engines and by our lines"
        },
    )


def checks(table: pd.DataFrame) -> list[Check]:
    """For every rival that is installed: our lines explain its fall; and whether it falls in a well."""
    made = []
    for name, rows in table[table["status"] == "measured"].groupby("engine", sort=False):
        off = (rows["fall_mm"] - rows["by_our_lines_mm"]).abs().max()
        deep = rows[(rows["height_m"] == WELL) & np.isclose(rows["step_ms"], 1e3 * STEP)].iloc[0]
        made += [
            Check(f"{name}: fall against that by our lines in single precision, largest difference", float(off),
                  1e3 * spacing(HEIGHTS[-1]), "at_most", "mm", f"one spacing of numbers at {HEIGHTS[-1]:g} m"),
            Check(f"{name}: error of the fall at {WELL:g} m with {1e3 * STEP:g} ms",
                  100 * abs(float(deep["fall_mm"]) / FALL - 1), 100 * RIGHT, "at_most", "%",
                  "½gt²; the bound of the gate before any speed"),
        ]  # fmt: skip
    return made


STUDY = Study("rival_precision", "Does a free body fall in engines of single precision, deep in a well?", run)
