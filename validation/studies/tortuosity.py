"""How much apparent friction micro-tortuosity makes: a winding hole against one without waves, by steady charts."""

from typing import Any

import numpy as np
import pandas as pd
from scipy.optimize import brentq

from fctd import Case
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import Equilibrium
from validation.harness.study import Check, Context, Outcome, Study

FRICTION, HOLE = 0.2, 0.2159
STATIONS = [[0, 0, 0], [300, 0, 0], [750, 60, 0], [1200, 60, 0]]
BIT = 1150.0
PLAIN = 10.0  # segments in the hole without waves [m]; those of 1 m give the same loads to 0.1 kN
# Amplitude and wavelength [m].
WAVES = ((0.005, 10.0), (0.010, 10.0), (0.020, 10.0), (0.030, 10.0), (0.020, 20.0), (0.020, 40.0))
KINDS = ("trip_out", "trip_in", "rotate_off_bottom")


def well(waves: dict[str, Any] | None, segment: float, friction: float = FRICTION) -> Case:
    """5 inch pipe in an 8½ in hole built to 60°."""
    hole = {
        "stations": STATIONS, "geometry": "arcs", "stiffness_per_length": 1e7,
        "intervals": [{"to_md": STATIONS[-1][0], "diameter": HOLE, "friction": friction}],
    }  # fmt: skip
    pipe = {"name": "pipe", "outer_diameter": 0.127, "inner_diameter": 0.1086, "segment_length": segment}
    return Case.model_validate(
        {
            "name": "winding", "wellbore": hole | ({"tortuosity": waves} if waves else {}),
            "string": {"components": [pipe]}, "mud": {"density": 1200.0},
        }
    )  # fmt: skip


def solved(case: Case, kind: str) -> Equilibrium:
    """The steady string at the bit depth."""
    return Solver(case).solve(kind, steady_rates(case, kind, None, None), BIT)


def load_of(point: Equilibrium, kind: str) -> float:
    """What friction makes: hook load [N], or torque [N m] of a string that turns."""
    return point.surface_torque if kind == "rotate_off_bottom" else point.hookload


def apparent(kind: str, load: float) -> float:
    """The friction factor with which the hole without waves has this load."""

    def excess(friction: float) -> float:
        return load_of(solved(well(None, PLAIN, friction), kind), kind) - load

    return float(brentq(excess, 0.02, 1.5, xtol=1e-4))


def run(context: Context) -> Outcome:
    """Hook loads and torque of the winding hole, and the friction factor that they seem to have."""
    rows = []
    seeds = range(1) if context.quick else range(3)
    for amplitude, wavelength in WAVES[1:4:2] if context.quick else WAVES:
        segment = wavelength / 8
        for seed in seeds:
            case = well({"amplitude": amplitude, "wavelength": wavelength, "seed": seed}, segment)
            row: dict[str, Any] = {"amplitude_mm": 1e3 * amplitude, "wavelength_m": wavelength, "seed": seed}
            for kind in KINDS:
                point = solved(case, kind)
                row[f"{kind}_status"] = str(point.status)
                found = apparent(kind, load_of(point, kind)) if point.answered else float("nan")
                row[f"{kind}_friction"] = found
            rows.append(row)
    table = pd.DataFrame(rows)
    factors = [f"{kind}_friction" for kind in KINDS]
    largest = table[table["amplitude_mm"] == 30.0]
    coarse = solved(well({"amplitude": 0.02, "wavelength": 10.0}, 2.5), "trip_out")
    answered = table[[f"{kind}_status" for kind in KINDS]].isin(["converged"]).to_numpy()
    return Outcome(
        tables={"apparent_friction": table},
        checks=[
            Check("strings in a winding hole without a balance", float((~answered).sum()), 0.0, "at_most", "",
                  "every row has loads"),
            Check(f"least apparent friction factor, factor {FRICTION}", float(np.nanmin(table[factors])),
                  FRICTION - 0.002, "at_least", "", "waves add contact forces and take none away"),
            Check("apparent friction factor at 30 mm and 10 m, over the given one",
                  float(largest[factors].to_numpy().mean()) / FRICTION, 1.02, "at_least", "",
                  "the hole's waves must show"),
            Check("a string of segments of a quarter of the wave is under_resolved",
                  float(coarse.status == "under_resolved"), 1.0, "at_least", "", "it cannot follow the waves"),
        ],
        notes=[
            "The apparent friction factor is that with which the hole without waves has the hook load or "
            f"torque of the winding one; the factor itself is {FRICTION} in both. The string is 5 in pipe "
            "in an 8½ in hole, with a clearance of 44 mm.",
        ],
        display={"apparent_friction": "The friction factor that a winding hole seems to have"},
    )  # fmt: skip


STUDY = Study("tortuosity", "How much apparent friction does micro-tortuosity make?", run)
