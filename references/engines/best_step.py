"""The best step of an engine, by one definition for all engines.

Runs are made with FCTD's step, near the stability limit of any explicit stepper for these springs and masses, and
with its successive halves.  The best step is the largest whose run passes every check and whose loads are within
TOLERANCE of those of the next finer step.
"""

from typing import Any

import pandas as pd

from fctd.case.load import Case
from fctd.results import ledger
from references import engines
from references.engines import Window
from references.engines.run import late

TOLERANCE = 0.01  # relative
LOADS = ("hookload_N", "surface_torque_N_m")


def ladder(
    name: str, case: Case, window: Window, longest: float, rungs: int, seconds: float, **options: Any
) -> pd.DataFrame:
    """Run a window of a case with the step ``longest`` [s] and its successive halves, ``rungs`` in all; a row per step.

    Columns: step_s, status, failed, hookload_N and surface_torque_N_m (means of the last ``seconds`` [s]), off (the
    larger relative difference of the two from the next finer step; NaN for the finest), energy_error.
    """
    rows = []
    for k in range(rungs):
        run = engines.build(name, **(options | {"step": longest / 2**k})).run(case, window)
        loads = late(run, seconds)
        rows.append(
            {"step_s": run.step, "status": run.status, "failed": run.message}
            | {load: loads[load] for load in LOADS}
            | {"energy_error": ledger.error(run.energy, motion=True)}
        )
    table = pd.DataFrame(rows)
    finer = table[list(LOADS)].shift(-1)
    table["off"] = (table[list(LOADS)] / finer - 1).abs().max(axis=1, skipna=False)
    return table


def best_step(table: pd.DataFrame) -> float:
    """The best step [s] of a ladder; nan if there is none.  The finest has no finer step to confirm it."""
    good = table[(table["status"] == "valid") & (table["off"] <= TOLERANCE)]
    return float(good["step_s"].max()) if len(good) else float("nan")
