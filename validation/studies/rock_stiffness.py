"""Effect of rock stiffness (§5.3): the paper's well with walls from 1e3 to 1e10 N/m per point."""

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from fctd.model.operations import steady_rates
from fctd.simulation.preparation import prepare
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from validation.cases import load
from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.bends import LIMIT, NARROW, PIPE, case_of

OPERATIONS = ("trip_in", "trip_out", "rotate_off_bottom", "drill_rotating")
DRILLING = {"bit__weight_on_bit": "50 kN", "bit__torque": "3 kN*m"}
STIFFEST = 1e10  # [N/m], the reference for the others
LEAST_REAL = 1e6  # [N/m]: clay or soft shale of 0.1 GPa loaded over a centimetre
HARDLY = 1.0  # percent: what counts as "would not affect" here


def numbers(point: Equilibrium) -> dict[str, float]:
    """Loads, and how far the string penetrates the wall."""
    profile = point.profile
    offset = np.hypot(profile["offset_high_m"], profile["offset_right_m"])
    return {
        "hookload_kN": point.hookload / 1e3,
        "torque_kN_m": point.surface_torque / 1e3,
        "contact_force_kN": point.total_contact_force / 1e3,
        "bending_moment_kN_m": float(profile["bending_moment_N_m"].max()) / 1e3,
        "penetration_of_clearance": float((offset / profile["clearance_m"] - 1).max()),
    }


def changes(rows: pd.DataFrame) -> pd.DataFrame:
    """Loads of each operation and depth against those of the stiffest wall, percent."""
    stiffest = rows[rows["stiffness_N_per_m"] == STIFFEST].set_index(["operation", "bit_depth_m"])
    at = pd.MultiIndex.from_frame(rows[["operation", "bit_depth_m"]])
    for name in ("hookload_kN", "torque_kN_m", "contact_force_kN", "bending_moment_kN_m"):
        truth = stiffest[name].loc[at].to_numpy()
        # A string that does not turn has no torque to change.
        known = np.abs(truth) > 1e-6
        change = np.full(len(rows), np.nan)
        change[known] = 100 * (rows[name].to_numpy()[known] / truth[known] - 1)
        rows[f"{name.rpartition('_k')[0]}_change_percent"] = change
    return rows


def in_a_sharp_bend(decades: NDArray[np.float64]) -> pd.DataFrame:
    """A stiff string in the bend of ``soft_stiff_map`` with the largest contact forces, stiffness per metre."""
    rows = []
    for decade in decades[::-1]:
        case = case_of(PIPE, LIMIT, NARROW, wall=float(10**decade))
        solver, bit = Solver(case), float(case.wellbore.trajectory[-1, 0])
        pulled = solver.solve("trip_out", steady_rates(case, "trip_out"), bit)
        turned = solver.solve("rotate_off_bottom", steady_rates(case, "rotate_off_bottom"), bit)
        rows.append(
            {
                "stiffness_N_per_m_per_m": float(10**decade),
                "pick_up_kN": pulled.hookload / 1e3,
                "torque_kN_m": turned.surface_torque / 1e3,
                "status": pulled.status if pulled.status != "converged" else turned.status,
            }
        )
    table = pd.DataFrame(rows)
    for name in ("pick_up_kN", "torque_kN_m"):
        table[f"{name.rpartition('_k')[0]}_change_percent"] = 100 * (table[name] / table[name].iloc[0] - 1)
    return table


def run(context: Context) -> Outcome:
    """Steady strings of four operations at three depths, and the stepper's step, for every stiffness; a sharp bend."""
    decades = np.arange(3.0, 10.01, 1.0 if context.quick else 0.25)
    depths = (2450.0,) if context.quick else (1900.0, 2200.0, 2450.0)
    rows: list[dict[str, Any]] = []
    for stiffness in context.progress([float(10**decade) for decade in decades], "stiffnesses"):
        case = load("paper_well", wellbore__stiffness=stiffness, **DRILLING)
        solver, step = Solver(case), prepare(case)[0].step
        for operation in OPERATIONS:
            for depth in depths:
                point = solver.solve(operation, steady_rates(case, operation), depth)
                rows.append(
                    {
                        "stiffness_N_per_m": stiffness,
                        "operation": operation,
                        "bit_depth_m": depth,
                        "status": point.status,
                        **numbers(point),
                        "step_ms": 1e3 * step,
                    }
                )
    table = changes(pd.DataFrame(rows))
    columns = ["hookload_change_percent", "torque_change_percent"]
    both = table[columns].abs().max(axis=1)
    real = table["stiffness_N_per_m"] >= LEAST_REAL
    bad = (both > HARDLY) | (table["status"] != "converged")
    softest = float(table.loc[~table["stiffness_N_per_m"].isin(table.loc[bad, "stiffness_N_per_m"]),
                              "stiffness_N_per_m"].min())  # fmt: skip
    summary = (
        table.assign(
            loads_change_percent=both, contact_force_change_percent=table["contact_force_change_percent"].abs()
        )
        .groupby("stiffness_N_per_m")
        .agg(
            rows=("status", "size"),
            without_answer=("status", lambda s: int((s != "converged").sum())),
            loads_change_percent=("loads_change_percent", "max"),
            contact_force_change_percent=("contact_force_change_percent", "max"),
            penetration_of_clearance=("penetration_of_clearance", "max"),
            step_ms=("step_ms", "min"),
        )
        .reset_index()
    )
    sharp = in_a_sharp_bend(np.arange(6.0, 10.1, 2.0 if context.quick else 0.5))
    return Outcome(
        tables={"stiffness": table, "summary": summary, "sharp_bend": sharp},
        checks=[
            Check("largest change of hook load or torque, 1e6 to 1e10 N/m", float(both[real].max()), HARDLY, "at_most",
                  "%", "§5.3: minor inaccuracies would not affect; 1 % counts as no effect here"),
            Check("largest change of contact force, 1e6 to 1e10 N/m",
                  float(table.loc[real, "contact_force_change_percent"].abs().max()), HARDLY, "at_most", "%",
                  "§5.3; 1 % counts as no effect here"),
            Check("softest wall with hook load and torque within 1 %", softest, LEAST_REAL, "at_most", "N/m",
                  "§5.3: unless unrealistically low; clay of 0.1 GPa loaded over 1 cm gives 1e6 N/m"),
            Check("largest change of hook load or torque in a bend of 30°/100 ft, 1e6 to 1e10 N/m per metre",
                  float(sharp.filter(like="_change_percent").abs().to_numpy().max()), HARDLY, "at_most", "%",
                  "§5.3, where the penetration is no longer small against the clearance"),
            Check("deepest penetration over clearance at 1e7 N/m", float(
                table.loc[np.isclose(table["stiffness_N_per_m"], 1e7), "penetration_of_clearance"].max()),
                0.1, "at_most", "", "a tenth: the default wall should not widen the hole"),
        ],
        notes=[
            "Loads of a steady string come from its weight and the bends of the hole; in a softer wall it only lies "
            "slightly further out. Rows whose string lies more than a hole's radius outside the hole have no "
            "solution.",
            "A stiff wall shortens the stepper's step, which falls with the square root of the stiffness where the "
            "wall is stiffer than the string's own springs.",
            "The paper's segments of 10 and 37.5 m concentrate the force of a whole segment at one point. Shorter "
            "segments distribute it over more points, and penetrate less in proportion.",
        ],
        display={
            "summary": "Largest changes against 1e10 N/m over all operations and depths",
            "sharp_bend": "A bend of 30°/100 ft with 5 mm of clearance, against 1e10 N/m per metre",
        },
    )  # fmt: skip


STUDY = Study("rock_stiffness", "How much does the stiffness of the rock change the loads?", run, reproduce=True)
