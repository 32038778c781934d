"""An engine's own best step, by one definition for all.

It is the largest step of a ladder that halves from FCTD's own, which is as long as its springs and inertia let any
explicit stepper go, whose run passes every check and whose loads are within CLOSE of those of the next finer step.
"""

from typing import Any

import pandas as pd

from fctd.case.load import Case
from fctd.results import ledger
from references import engines
from references.engines import Window
from references.engines.run import late

CLOSE = 0.01
LOADS = ("hookload_N", "surface_torque_N_m")


def ladder(
    name: str, case: Case, window: Window, longest: float, rungs: int, seconds: float, **options: Any
) -> pd.DataFrame:
    """Run a window of a case with steps ``longest`` [s] and its halves, a row per step.

    Columns: step_s, status, failed, hookload_N and surface_torque_N_m (means of the last ``seconds``), off (the larger
    difference of the two from the next finer step, relative; none for the finest), energy_error, wall_s.
    """
    rows = []
    for k in range(rungs):
        run = engines.build(name, **(options | {"step": longest / 2**k})).run(case, window)
        loads = late(run, seconds)
        rows.append(
            {"step_s": run.step, "status": run.status, "failed": run.message}
            | {load: loads[load] for load in LOADS}
            | {"energy_error": ledger.error(run.energy, motion=True), "wall_s": run.wall_s}
        )
    table = pd.DataFrame(rows)
    finer = table[list(LOADS)].shift(-1)
    table["off"] = (table[list(LOADS)] / finer - 1).abs().max(axis=1, skipna=False)
    return table


def best_step(table: pd.DataFrame) -> float:
    """The best step [s] of a ladder; nan where no rung but the finest will do, which nothing vouches for."""
    good = table[(table["status"] == "valid") & (table["off"] <= CLOSE)]
    return float(good["step_s"].max()) if len(good) else float("nan")
