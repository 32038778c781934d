"""The one way in which every string engine is run: the same start, the same recorder, the same checks."""

import time
from abc import ABC, abstractmethod
from collections.abc import Callable

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.mechanics import state, topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.faults import UnstableError
from fctd.model.operations import Phase
from fctd.results.status import RunStatus
from fctd.simulation.recorder import LOSSES, Recorder
from fctd.simulation.run import Run, prepare, settle, start_from_rest
from references.engines import EngineRun, Stepper, Window
from references.engines.checks import examine


def legs(case: Case, phases: list[Phase], start: float, end: float, interval: float) -> list[tuple[Phase, float]]:
    """Parts of a schedule between two times, and the time at which each ends, no longer than ``interval`` [s]."""
    parts = []
    now = start
    for phase in phases:
        last = min(phase.motion.start + phase.motion.duration, end)
        if last <= now + 1e-9:
            continue
        count = max(int(np.ceil((last - now) / interval - 1e-9)), 1)
        parts += [(phase, float(t)) for t in np.linspace(now, last, count + 1)[1:]]
        now = last
    if now < end - 1e-9:
        raise InputError(
            f"a window within the schedule of {case.name}, which ends after {now:g} s", key="window", value=f"{end:g} s"
        )
    return parts


def begin_run(case: Case, window: Window) -> tuple[Run, list[Phase]]:
    """The string of a case at the start of a window, sums and losses cleared; raises InputError."""
    if not (window.start >= 0 and window.duration > 0):
        raise InputError("a start of at least 0 s and a duration above 0 s", key="window", value=str(tuple(window)))
    run, phases = prepare(case)
    settle(run)
    start_from_rest(run)
    if window.start > 0:
        for phase, until in legs(case, phases, 0.0, window.start, np.inf):
            run.advance(phase.motion, until - float(run.top[topdrive.TOP_TIME]))
    run.refresh()
    run.S[state.SUM_NORMAL : state.LOST_JOINT + state.STRIDE] = 0.0
    run.top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE, topdrive.TOP_WORK, topdrive.FED_ENERGY]] = 0.0
    run.steps = 0
    return run, phases


def run_window(case: Case, window: Window, begin: Callable[[Run], Stepper]) -> EngineRun:
    """Run a window with a stepper begun by ``begin``, record as ``fctd.simulate`` does, and hold it to the checks."""
    with naming_file(case):
        run, phases = begin_run(case, window)
        parts = legs(case, phases, window.start, window.start + window.duration, case.record.interval)
        recorder = Recorder(run)
        recorder.start_depth += float(run.top[topdrive.TOP_LENGTH]) - (
            run.string.length[0] if run.string.long_segment else 0.0
        )
        recorder.last_time = window.start
        stepper = begin(run)
    broken = ""
    began = time.perf_counter()
    held = [stepper.energy()]
    try:
        for (motion, operation), until in parts:
            stepper.advance(motion, until - float(run.top[topdrive.TOP_TIME]))
            stepper.sync()
            run.refresh()
            recorder.record(operation)
            held.append(stepper.energy())
            run.check()
    except UnstableError as error:
        broken = f"at {float(run.top[topdrive.TOP_TIME]):.3g} s: {error}"
    finally:
        stepper.close()
    wall = time.perf_counter() - began
    result = recorder.result(RunStatus.COMPLETED, "", wall, 0.0)
    ledger = _ledger(result.energy, held)
    checks = examine(run, window.start, result.history, result.profile, ledger, broken)
    failed = [f"{row.check} ({row.value:.3g}, at most {row.bound:g})" for row in checks.itertuples() if not row.passed]
    message = "; ".join([*([broken] if broken else []), *failed])
    return EngineRun(
        result.history, result.profile, "invalid" if failed else "valid", message, stepper.note(), ledger, checks,
        stepper.step, run.steps, wall,
    )  # fmt: skip


class InWindows(ABC):
    """What all engines share: they are run by ``run_window``."""

    @abstractmethod
    def begin(self, run: Run) -> Stepper:
        """See ``StringEngine.begin``."""

    def run(self, case: Case, window: Window) -> EngineRun:
        """See ``StringEngine.run``."""
        return run_window(case, window, self.begin)


def late(run: EngineRun, seconds: float = np.inf) -> pd.Series:
    """Means of the history under a Hann window, of its last seconds."""
    history = run.history[run.history["time_s"] > run.history["time_s"].max() - seconds]
    return hann_means(history)


def hann_means(rows: pd.DataFrame) -> pd.Series:
    """Means of the columns of numbers under a Hann window over the rows.

    A plain mean keeps a share of whatever swings about it; the window leaves next to none.
    """
    numbers = rows.select_dtypes("number")
    weights = np.hanning(len(numbers) + 2)[1:-1]
    return pd.Series(numbers.mul(weights, axis=0).sum() / weights.sum())


def _ledger(table: pd.DataFrame, held: list[Energy]) -> pd.DataFrame:
    """The recorder's ledger with what the engine itself says that the string holds."""
    ledger = table.copy()
    for name in Energy._fields:
        ledger[f"{name}_J"] = [getattr(now, name) - getattr(held[0], name) for now in held[1:]]
    kept = ledger[[f"{name}_J" for name in Energy._fields]].sum(axis=1)
    lost = ledger[list(LOSSES)].sum(axis=1)
    ledger["residual_J"] = kept + lost - ledger["top_drive_work_J"] - ledger["fed_pipe_J"]
    return ledger
