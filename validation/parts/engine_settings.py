"""Settings of the other engines, chosen without FCTD's loads: Coulomb's law for contact, a ladder for the step."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from references.engines import Window, build
from references.engines.best_step import best_step, ladder
from references.engines.friction_law import Sliding, lean_of_two_directions, sliding
from references.engines.mujoco import IMPEDANCE
from validation.cases import load, rotation
from validation.harness.study import Check, Rows, table_of_rows

# Engine, configuration, its name and options.  PyElastica has no wall of its own.
FRICTION: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("FCTD", "fctd", {}),
    ("Bullet", "bullet", {}),
    ("Bullet, global axes", "bullet", {"axes": "global"}),
    ("MuJoCo", "mujoco", {}),
    ("MuJoCo, default", "mujoco", {"settings": "default"}),
)
AZIMUTHS = (0.0, 15.0, 30.0, 45.0, 60.0)
# Of MuJoCo's contact: its own 0.9 and less, the case's own wall and a softer one [N/m].
IMPEDANCES, STIFFNESSES = (0.9, 0.7, 0.5, 0.3, 0.1), (1e7, 1e6)
KEPT = 0.995  # least share of μN
SPIN_UP, SECONDS = Window(0.0, 10.0), 4.0
# Engines at their best configuration, and the rungs of their ladders.
RUNGS = {"FCTD": ("fctd", 3), "Bullet": ("bullet", 3), "MuJoCo": ("mujoco", 3), "PyElastica": ("elastica", 5)}


@table_of_rows
def friction(azimuths: tuple[float, ...], missing: list[str]) -> Rows:
    """Friction of a pipe turning in a straight hole in every engine, over azimuths of the hole [deg]."""
    for azimuth in azimuths:
        for label, name, options in FRICTION:
            if label.partition(",")[0] in missing:
                continue
            found = sliding(name, azimuth, **options)
            fixed = "axes" in options
            yield {
                "engine": label,
                "azimuth_deg": azimuth,
                **_cells(found),
                "two_directions_lean_deg": np.degrees(lean_of_two_directions(azimuth)) if fixed else np.nan,
            }


def _cells(found: Sliding) -> dict[str, Any]:
    return {
        "status": found.status,
        "failed": found.failed,
        "share_of_mu_n": found.share,
        "lean_deg": np.degrees(found.lean),
    }


def impedances() -> pd.DataFrame:
    """MuJoCo's contact over its impedance and the stiffness of its wall: friction of a pipe turning in a hole."""
    rows = []
    for stiffness in STIFFNESSES:
        for impedance in IMPEDANCES:
            found = sliding("mujoco", 30.0, stiffness=stiffness, impedance=impedance)
            rows.append({"stiffness_N_per_m": stiffness, "impedance": impedance, **_cells(found)})
    table = pd.DataFrame(rows)
    # The stiffest wall, and there the impedance nearest to MuJoCo's default, with enough friction: rows are in this
    # order.
    good = (table["status"] == "valid") & (table["share_of_mu_n"] >= KEPT)
    return table.assign(chosen=good & (good.cumsum() == 1))


def steps(names: tuple[str, ...]) -> pd.DataFrame:
    """Each engine's ladder of steps, the rotating chain spun up from rest; loads against FCTD at its own step."""
    case = load("curved_chain", operations=rotation(2450.0, 11.0, ramp=4.0), record__interval=0.25)
    longest = build("fctd").run(case, Window(0.0, 0.1)).step
    tables: list[pd.DataFrame] = []
    own = pd.Series(dtype=float)
    for label in names:
        engine, rungs = RUNGS[label]
        found = ladder(engine, case, SPIN_UP, longest, rungs, SECONDS)
        own = own if tables else found.iloc[0]
        tables.append(
            pd.DataFrame(
                {
                    "engine": label,
                    "step_ms": 1e3 * found["step_s"],
                    "status": found["status"],
                    "failed": found["failed"],
                    "hookload_off_percent": 100 * (found["hookload_N"] / own["hookload_N"] - 1),
                    "torque_off_percent": 100 * (found["surface_torque_N_m"] / own["surface_torque_N_m"] - 1),
                    "finer_off_percent": 100 * found["off"],
                    "energy_error_percent": 100 * found["energy_error"],
                    "best": found["step_s"] == best_step(found),
                }
            )
        )
    return pd.concat(tables, ignore_index=True)


def friction_checks(table: pd.DataFrame, missing: list[str]) -> Iterator[Check]:
    """Best configurations obey Coulomb's law; Bullet's lean off its axes follows from its two directions."""
    for label in ("Bullet", "MuJoCo"):
        if label in missing:
            continue
        own = table[table["engine"] == label]
        yield from [
            Check(f"{label}: friction of a pipe turning in a straight hole over μN",
                  float(own["share_of_mu_n"].min()), (0.98, 1.005), "within", "", "Coulomb's law: 1"),
            Check(f"{label}: angle between that friction and the sliding", float(own["lean_deg"].abs().max()), 0.5,
                  "at_most", "deg", "Coulomb's law: 0"),
        ]  # fmt: skip
    fixed = table[table["engine"] == "Bullet, global axes"]
    if len(fixed):
        wrong = (fixed["lean_deg"] - fixed["two_directions_lean_deg"]).abs().max()
        yield Check("Bullet, global axes: angle of friction to the sliding against that of two fixed directions",
                    float(wrong), 2.0, "at_most", "deg",
                    "effective masses along north and east; the angle is up to 32 deg")  # fmt: skip


def impedance_check(table: pd.DataFrame) -> Check:
    """The impedance used for MuJoCo is the one that the rule gives."""
    chosen = table.loc[table["chosen"], "impedance"]
    taken = float(chosen.iloc[0]) / IMPEDANCE if len(chosen) else np.nan
    return Check("MuJoCo: impedance by the rule over the impedance used", taken, (0.999, 1.001), "within", "",
                 "stiffest wall, then nearest to MuJoCo's default, with friction within 0.5 % of μN")  # fmt: skip


def step_checks(table: pd.DataFrame, own_steps: Mapping[str, float]) -> Iterator[Check]:
    """Each engine runs at the best step of its ladder, and agrees with FCTD when it spins up the string from rest.

    own_steps [ms] : of the engines' runs of the same chain.
    """
    for label, step in own_steps.items():
        best = table[(table["engine"] == label) & table["best"]]
        ratio = step / float(best["step_ms"].iloc[0]) if len(best) else np.nan
        yield Check(f"{label}: its own step over the best of its ladder", ratio, (0.7, 1.42), "within", "",
                    "largest step that halves from FCTD's own, passes the checks and is within 1 % of the next finer"
                    )  # fmt: skip
        if label != "FCTD":
            hookload, torque = (
                float(best[column].abs().iloc[0]) if len(best) else np.nan
                for column in ("hookload_off_percent", "torque_off_percent")
            )
            yield from [
                Check(f"{label}: spun up from rest, hook load against FCTD's over the same window", hookload, 1.0,
                      "at_most", "%", "as from the same state in motion"),
                Check(f"{label}: spun up from rest, torque against FCTD's over the same window", torque, 5.0, "at_most",
                      "%", "as from the same state in motion"),
            ]  # fmt: skip
