"""How far cylinders are from the arc they stand for, over their length: the largest geometric error."""

import numpy as np
import pandas as pd

from fctd import build_wellbore, find_contacts
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Study, log_slope

BEND = 450.0 / (np.pi / 2)  # radius [m] of the bend of curved-chain


def run(context: Context) -> Outcome:
    """Seeded points near the wall of the bend, penetration and normal against the exact arc."""
    exact = build_wellbore(load("curved_chain", wellbore__geometry="arcs"))
    rng = np.random.default_rng(20240525)
    count = 1000 if context.quick else 5000
    md = rng.uniform(1710.0, 2140.0, count)
    points = exact.off_axis(md, rng.uniform(0, 2 * np.pi, count), rng.uniform(0.08, 0.12, count))
    truth = find_contacts(exact, points, 0.051)
    rows = []
    for length in context.progress((0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0), "lengths"):
        hole = build_wellbore(
            load(
                "curved_chain",
                wellbore__chord_tolerance=None,
                wellbore__cylinder_length=length,
                wellbore__overlap=min(0.2, 0.5 * length),
            )
        )
        hits = find_contacts(hole, points, 0.051)
        error = 1e3 * (hits.penetration - truth.penetration)
        turned = np.clip(np.sum(hits.normal * truth.normal, axis=1), -1, 1)
        rows.append(
            {
                "cylinder_length_m": length,
                "max_penetration_error_mm": float(np.abs(error).max()),
                "rms_penetration_error_mm": float(np.sqrt((error**2).mean())),
                "max_angle_error_deg": float(np.degrees(np.arccos(turned)).max()),
                "bound_mm": 1e3 * length**2 / (8 * BEND),
            }
        )
    errors = pd.DataFrame(rows)
    long = errors[errors["cylinder_length_m"] >= 1.0]
    order = log_slope(long["cylinder_length_m"], long["rms_penetration_error_mm"])
    excess = (errors["max_penetration_error_mm"] / errors["bound_mm"])[errors["cylinder_length_m"] >= 1.0]
    return Outcome(
        tables={"errors": errors},
        checks=[
            Check("order of the error in the cylinder length", order, (1.9, 2.1), "within", "",
                  "a chord misses its arc by ℓ²/8R"),
            Check("largest error over ℓ²/8R", float(excess.max()), 1.1, "at_most", "", "the same formula"),
        ],
        notes=[
            "Clearances are 50 to 100 mm: 10 m cylinders in this bend are off by about half of that, so the default "
            "length follows from a chord tolerance."
        ],
        display={"errors": "Error by cylinder length in a bend of 286 m radius"},
    )  # fmt: skip


STUDY = Study("cylinder_error", "How short must cylinders be?", run, reproduce=True)
