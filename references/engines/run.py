"""Running a window of a case in any string engine: the same start, recorder and checks for all."""

from abc import ABC, abstractmethod
from collections.abc import Collection
from typing import ClassVar, cast

import numpy as np
import pandas as pd

from fctd.case.load import Case
from fctd.mechanics import topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.faults import UnstableError
from fctd.results.status import RunStatus
from fctd.simulation.run import Run
from fctd.simulation.simulate import Simulation
from references.engines import EngineRun, Stepper, Window
from references.engines.checks import examine


def run_window(case: Case, window: Window, engine: "InWindows") -> EngineRun:
    """Run a window in an engine, record as ``fctd.simulate`` does, and hold it to the checks.

    Raises InputError, and UnstableError when the string does not settle before the start or breaks in the first step.
    """
    simulation = Simulation(case, window=window, engine=engine)
    run = simulation.run
    if run.string.long_segment:
        # All engines have the paper's long segment: FCTD's stepper alone knows waves within it.
        run.pipe = run.pipe._replace(beside=0.0)
        topdrive.put_long_segment(run.S, run.top[topdrive.TOP_LENGTH], run.pipe)
    simulation.start()
    stepper = cast(Stepper, simulation.stepper)  # the engine made it
    try:
        for _ in simulation:
            pass
        if simulation.status == RunStatus.UNSTABLE:
            simulation.record_part()  # for the checks, which say how
    finally:
        stepper.close()
    broken = simulation.message
    if not simulation.recorder.history:
        raise UnstableError(broken)
    result = simulation.result()
    checks = examine(run, window.start, result.history, result.profile, result.energy, broken)
    failed = [f"{row.check} ({row.value:.3g}, at most {row.bound:g})" for row in checks.itertuples() if not row.passed]
    message = "; ".join([*([broken] if broken else []), *failed])
    return EngineRun(
        result.history, result.profile, "invalid" if failed else "valid", message, stepper.note(), result.energy,
        checks, stepper.step, run.steps,
    )  # fmt: skip


class InWindows(ABC):
    """Common part of all engines: ``run_window`` runs them."""

    name: ClassVar[str]
    honours: ClassVar[Collection[str]]

    @abstractmethod
    def begin(self, run: Run) -> Stepper:
        """See ``StringEngine.begin``."""

    def run(self, case: Case, window: Window) -> EngineRun:
        """See ``StringEngine.run``."""
        return run_window(case, window, self)


class Around:
    """A stepper around another one, which does all that a subclass leaves to it."""

    def __init__(self, stepper: Stepper) -> None:
        self.inner, self.step = stepper, stepper.step

    def advance(self, motion: topdrive.Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        self.inner.advance(motion, duration)

    def refresh(self) -> None:
        """See ``Stepper.refresh``."""
        self.inner.refresh()

    def energy(self) -> Energy:
        """See ``Stepper.energy``."""
        return self.inner.energy()

    def note(self) -> str:
        """See ``Stepper.note``."""
        return self.inner.note()

    def close(self) -> None:
        """See ``Stepper.close``."""
        self.inner.close()


def late(run: EngineRun, seconds: float = np.inf) -> pd.Series:
    """Means of the last ``seconds`` [s] of the history under a Hann window."""
    history = run.history[run.history["time_s"] > run.history["time_s"].max() - seconds]
    return hann_means(history)


def hann_means(rows: pd.DataFrame) -> pd.Series:
    """Means of the columns of numbers under a Hann window over the rows.

    A plain mean over part of a period keeps a share of an oscillation; the window suppresses it.
    """
    numbers = rows.select_dtypes("number")
    weights = np.hanning(len(numbers) + 2)[1:-1]
    return pd.Series(numbers.mul(weights, axis=0).sum() / weights.sum())
