"""The paper's well tripped into and rotated at depth after depth (§6.2, Fig. 12)."""

from typing import Any

import numpy as np
import pandas as pd

from fctd import SimulationResult, simulate
from validation.cases import load, rotation
from validation.harness.study import Check, Context, Outcome, Study, in_columns, quartiles_of, ratio_check
from validation.parts.windows import in_parts, last_seconds

VARIANTS = {"paper-well": "paper_well", "paper-well-b": "paper_well_b"}
PROFILE_DEPTHS = [1900.0, 2200.0]  # and the last one, 2450 m
FIRST_METRES = "1752 m"  # of the trips, from 1750 m
HISTORY = [
    "bit_depth_m", "hookload_N", "surface_torque_N_m", "sum_r_mu_fn_N_m", "sum_r_ft_N_m",
    "contact_count", "total_contact_force_N",
]  # fmt: skip
PROFILE = [
    "operation", "bit_depth_m", "md_m", "inclination_deg", "effective_tension_N",
    "contact_force_N", "contact_angle_deg", "offset_high_m", "clearance_m",
]  # fmt: skip


def numbers(name: str, result: SimulationResult, factors: list[float]) -> dict[str, Any]:
    """Row of the run table."""
    wanted = ("segments", "step_s", "steps", "simulated_s", "wall_s", "energy_error")
    parts = in_columns({"real_time_factor": factors})
    return {"run": name, **{key: result.run[key] for key in wanted}, **parts, "status": result.status}


def run(context: Context) -> Outcome:
    """Reading (a): law ``paper``, tripping in, Σ rμF_n.  Reading (b): law ``coulomb``, rotating at each depth."""
    depths = np.arange(1750.0, 2450.1, 100.0 if context.quick else 25.0)
    trips: dict[str, pd.DataFrame] = {}
    turns, profiles, runs = [], [], []
    balance = [0.0]
    for variant, file in VARIANTS.items():
        # The first run of a process also loads or compiles code; the table gives later runs.
        law = {"contact__friction_law": "paper"}
        simulate(load(file, **law, operations__0__to_md=FIRST_METRES))
        # A record interval short enough to resolve swings with a period of 2 s.
        result, factors = in_parts(load(file, **law, record__profile_at=PROFILE_DEPTHS, record__interval=0.5))
        runs.append(numbers(f"{variant}: trip in, law paper", result, factors))
        trips[variant] = result.history
        profiles.append(result.profile[PROFILE].assign(variant=variant))
        for depth in context.progress(depths, f"{variant}: rotating"):
            turning = rotation(float(depth), duration=60.0, ramp=20.0)
            result, factors = in_parts(load(file, operations=turning, record__interval=0.25))
            end = last_seconds(result, 35.0)
            turns.append({name: end[name] for name in HISTORY} | {"variant": variant})
            if depth >= 1900:  # above this depth the torque is hardly larger than its swing
                balance.append(abs(end["sum_r_ft_N_m"] / end["surface_torque_N_m"] - 1))
        runs.append(numbers(f"{variant}: rotating at {depth:.0f} m, law coulomb", result, factors))
    table, rotating = pd.DataFrame(runs), pd.DataFrame(turns)
    return Outcome(
        tables={
            "trip_in": pd.concat(history[HISTORY].assign(variant=variant) for variant, history in trips.items()),
            "rotating": rotating,
            "profiles": pd.concat(profiles),
            "runs": table,
        },
        checks=[
            Check("runs that did not complete", float((table["status"] != "completed").sum()), 0, "at_most", "",
                  "every run must complete"),
            ratio_check("real-time factor, slowest run",
                        quartiles_of(table.iloc[int(table["real_time_factor"].argmin())], "real_time_factor"), 1.0,
                        "at_least", "§7: faster than real time"),
            Check("energy error, largest", float(table["energy_error"].max()), 1e-3, "at_most", "",
                  "target: 0.1 % of the work done"),
            Check("Σ r F_t against surface torque below 1900 m, largest difference", 100 * max(balance), 0.5,
                  "at_most", "%", "torque balance at steady rotation, no dampers"),
        ],
        notes=[
            "The well and the string are our reconstruction: the paper prints no hole size, mud, inclination "
            "between the builds or tripping speed; the case file marks every assumption.",
            "The measured torque of the paper's Fig. 12 is not public, so agreement with the field cannot be "
            "tested on this well.",
            "Reading (a) sums rμF_n while tripping in, where the string does not turn and the surface torque is "
            "zero; reading (b) is the torque a driller would measure off bottom. The paper does not say which it "
            "plots.",
            "The hook load of well b swings by some 15 kN between 2150 and 2300 m: all collars pass seams between "
            "cylinders at the same time, at a natural frequency of the string (study cylinder_ringing). The well "
            "itself has no seams, and arcs show no such swing.",
        ],
        display={"runs": "Runs on one core: real-time factors by processor time, quartiles of tenths of a run"},
    )  # fmt: skip


STUDY = Study(
    "paper_well",
    "What are torque and hook load in the paper's well, and where does the string touch the wall?",
    run,
    reproduce=True,
    timed=True,
)
