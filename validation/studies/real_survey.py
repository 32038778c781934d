"""A real survey of 8,161 m with a string from surface to bottom, rotated for a minute."""

import pandas as pd

from fctd import simulate
from references.soft_string.integration import soft_string
from validation.cases.wells import real_well
from validation.harness.study import Check, Context, Outcome, Study


def run(context: Context) -> Outcome:
    """The full-length string of 200 segments in the surveyed hole."""
    case = real_well(context)
    result = simulate(case)
    end = result.history[result.history["time_s"] > 50].mean(numeric_only=True)
    soft = soft_string(case, "rotate_off_bottom", case.operations[0].end_md)
    summary = pd.DataFrame(
        [
            {
                "model": "FCTD, mean of the last 10 s",
                "hookload_kN": end["hookload_N"] / 1e3,
                "surface_torque_kN_m": end["surface_torque_N_m"] / 1e3,
                "total_contact_force_kN": end["total_contact_force_N"] / 1e3,
            },
            {
                "model": "soft string",
                "hookload_kN": soft.hookload / 1e3,
                "surface_torque_kN_m": soft.surface_torque / 1e3,
                "total_contact_force_kN": soft.total_contact_force / 1e3,
            },
        ]
    )
    run_table = pd.DataFrame([{**result.run, "status": result.status}])
    return Outcome(
        tables={
            "history": result.history[["time_s", "surface_torque_N_m", "hookload_N"]],
            "profiles": result.profile[["md_m", "contact_force_N", "contact_angle_deg"]],
            "summary": summary,
            "run": run_table,
        },
        checks=[
            Check("simulated time", float(result.run["simulated_s"]), 60.0 - 1e-6, "at_least", "s",
                  "one minute without failure"),
            Check("energy error", float(result.run["energy_error"]), 1e-3, "at_most", "", "target: 0.1 %"),
            Check("Σ r F_t against surface torque",
                  100 * abs(float(end["sum_r_ft_N_m"] / end["surface_torque_N_m"]) - 1), 0.5, "at_most", "%",
                  "torque balance, no dampers"),
        ],
        notes=[
            "Hole size, string, mud and friction are assumed, the survey is real: the study shows that the engine "
            "runs on a real survey; it does not give the torque of this well.",
        ],
        display={"summary": "Loads at the end of the minute", "run": "The run"},
    )  # fmt: skip


STUDY = Study(
    "real_survey",
    "Does a simulation on a real survey of eight kilometres run to its end?",
    run,
    needs=("data",),
)
