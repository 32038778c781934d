"""Errors of an engine on one window of one string: against truth, against itself, and against a shifted start."""

from collections.abc import Iterable
from typing import Any

import pandas as pd

from fctd import Case, equilibrium
from fctd.mechanics import state
from fctd.simulation.run import Run
from references import engines
from references.engines import EngineRun, Stepper, StringEngine, Window
from references.engines.run import InWindows, late
from references.methods.loop import Timed
from validation.cases import load, rotation
from validation.harness.study import Rows, in_columns, table_of_rows

BIT = 2450.0
FINER = 16  # steps of the finer run in one of an engine's own
SHIFT = 1e-6  # of the start [m]
PERIODS = 3.8  # two periods of the chain's twist [s], over which a mean keeps none of its swing
LOADS = {"hookload": "hookload_N", "torque": "surface_torque_N_m"}


class Shifted(InWindows):
    """An engine whose string starts with every second segment shifted north by SHIFT, a micrometre."""

    def __init__(self, engine: StringEngine) -> None:
        self._engine = engine
        self.name, self.honours = engine.name, engine.honours  # type: ignore[misc]

    def begin(self, run: Run) -> Stepper:
        """See ``StringEngine.begin``."""
        state.row(run.S, state.X, run.segments)[::2] += SHIFT
        run.refresh()
        return self._engine.begin(run)


def the_case(window: Window) -> Case:
    """The curved chain rotating over a window."""
    operations = rotation(BIT, window.start + window.duration + 1, ramp=4.0)
    return load("curved_chain", operations=operations, record__interval=0.05)


@table_of_rows
def engine_errors(names: Iterable[tuple[str, str]], window: Window) -> Rows:
    """A row per engine: its name in the table, and its name in the registry.

    Differences in percent of hook load and torque: of a run from the steady solver's answer; from the same engine at a
    sixteenth of its step; and of a run whose start is shifted from one whose start is not.
    """
    case = the_case(window)
    steady = equilibrium(case, "rotate_off_bottom", BIT)
    truth = pd.Series({"hookload": steady.hookload, "torque": steady.surface_torque})
    for label, name in names:
        timed = Timed(engines.build(name))
        own = timed.run(case, window)
        fine = engines.build(name, step=own.step / FINER).run(case, window)
        loads, finer, aside = (_loads(run) for run in (own, fine, Shifted(engines.build(name)).run(case, window)))
        row: dict[str, Any] = {
            "engine": label,
            "name": name,
            "status": own.status,
            "failed": own.message,
            "step_ms": 1e3 * own.step,
        }
        for load_name in LOADS:
            row[f"{load_name}_off_truth_percent"] = 100 * (loads[load_name] / truth[load_name] - 1)
            row[f"{load_name}_off_itself_percent"] = 100 * (loads[load_name] / finer[load_name] - 1)
            row[f"{load_name}_spread_percent"] = 100 * (aside[load_name] / loads[load_name] - 1)
        yield row | {"finer_status": fine.status} | in_columns({"real_time_factor": timed.real_time_factors})


def _loads(run: EngineRun) -> pd.Series:
    means = late(run)
    return pd.Series({name: means[column] for name, column in LOADS.items()})
