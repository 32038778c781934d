"""The energy ledger: work, stored energy, losses, and the residual over the time step."""

from typing import Any

import pandas as pd

from fctd import simulate
from fctd.simulation.preparation import prepare
from validation.cases import load, rotation, trip
from validation.harness.study import Check, Context, Outcome, Study, log_slope

# A build of 60° in 50 m, turning by 30°: far sharper than in drilled wells.
SHARP = [[0, 0, 0], [1700, 0, 350], [1750, 60, 20], [2600, 60, 20]]
SHARPEST = "chain in a sharp bend, picking up, cylinders"
# Name, case file and what is changed.  Trips of the paper's well feed pipe in at the top.
RUNS: dict[str, tuple[str, dict[str, Any]]] = {
    "chain, rotating, arcs": (
        "curved_chain",
        {"wellbore__geometry": "arcs", "operations": rotation(2450.0, 40.0, ramp=15.0)},
    ),
    "chain, picking up, arcs": (
        "curved_chain",
        {"wellbore__geometry": "arcs", "operations": trip(2450.0, 2440.0, 0.2, ramp=10.0)},
    ),
    "paper-well, tripping in, arcs": (
        "paper_well",
        {"wellbore__geometry": "arcs", "operations": trip(2100.0, 2150.0, 0.5, ramp=10.0)},
    ),
    "chain in mud, rotating, arcs": (
        "curved_chain",
        {
            "wellbore__geometry": "arcs",
            "operations": rotation(2450.0, 40.0, ramp=15.0),
            "mud__rotational_damping": 0.5,
            "mud__lateral_damping": 5.0,
        },
    ),
    "paper-well, tripping in, cylinders": (
        "paper_well",
        {"operations": trip(2100.0, 2150.0, 0.5, ramp=10.0)},
    ),
    SHARPEST: (
        "curved_chain",
        {"wellbore__stations": SHARP, "operations": trip(2450.0, 2440.0, 0.2, ramp=10.0)},
    ),
}
# Steps, over the default, from which on the stiffest modes are resolved.
FINE = 0.5


def run(context: Context) -> Outcome:
    """The ledger at the default step and at fractions of it."""
    fractions = (1.0, 0.5, 0.125) if context.quick else (1.0, 0.5, 0.25, 0.125, 0.0625)
    ledger, closure = [], []
    for name, (file, changes) in context.progress(RUNS.items(), "runs"):
        default = prepare(load(file, **changes))[0].step
        for fraction in fractions:
            result = simulate(load(file, **changes, solver__step=fraction * default))
            last = result.energy.iloc[-1]
            ledger += [
                {"case": name, "step_fraction": fraction, "term": str(term).removesuffix("_J"), "energy_J": value}
                for term, value in last.items()
                if str(term).endswith("_J")
            ]
            closure.append(
                {
                    "case": name,
                    "step_s": result.run["step_s"],
                    "step_fraction": fraction,
                    "work_J": result.run["work_J"],
                    "residual_J": result.run["energy_error"] * result.run["work_J"],
                    "relative_residual": result.run["energy_error"],
                }
            )
    table = pd.DataFrame(closure)
    at_default = table[table["step_fraction"] == 1.0].set_index("case")["relative_residual"]
    fine = table[table["case"].str.endswith("arcs") & (table["step_fraction"] <= FINE)]
    orders = {name: log_slope(part["step_s"], part["residual_J"]) for name, part in fine.groupby("case")}
    return Outcome(
        tables={"ledger": pd.DataFrame(ledger), "closure": table},
        checks=[
            Check("residual over work at the default step, largest", float(at_default.drop(SHARPEST).max()),
                  1e-3, "at_most", "", "target: 0.1 %"),
            Check("residual over work in cylinders of a very sharp bend", float(at_default[SHARPEST]),
                  1e-3, "at_most", "", "target: 0.1 %"),
            Check("order of the largest residual from half the default step down, arcs, least of the cases",
                  min(orders.values()), 0.8, "at_least", "",
                  "theory: first order; sticking and slipping differ from step size to step size"),
        ],
        notes=[
            "Work is the work of the top drive less that of lifting or lowering the string, or the sum of the "
            "losses, whichever is larger: the work of the weight alone would hide any error.",
            "In the overlap of two cylinders the blend of Eq. 24 changes the penetration along the hole, and the wall "
            "pushes along the hole too: its force is the gradient of its energy, so that the residual falls with the "
            "step there as in arcs, which have no seams.",
            "The residual is the largest of a run: its sign changes with the swing of the string. At the default "
            "step the phase of the stiffest modes advances by more than a radian per step and no order can be "
            "observed; the fit uses smaller steps only.",
        ],
        display={"closure": "Residual of the energy ledger"},
    )  # fmt: skip


STUDY = Study("energy_ledger", "How well does the energy ledger close?", run, reproduce=True)
