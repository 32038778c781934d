"""Running a window of a case in any string engine: the same start, recorder and checks for all."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.mechanics import topdrive
from fctd.results.status import RunStatus
from fctd.simulation.run import Run
from fctd.simulation.simulate import Simulation
from references.engines import EngineRun, Stepper, Window
from references.engines.checks import examine


class _InWindow:
    """An engine's stepper as ``fctd.Simulation`` wants it."""

    def __init__(self, stepper: Stepper, run: Run) -> None:
        self.own, self._run = stepper, run
        self.advance, self.energy = stepper.advance, stepper.energy

    def refresh(self) -> None:
        self.own.sync()
        self._run.refresh()


def run_window(case: Case, window: Window, begin: Callable[[Run], Stepper]) -> EngineRun:
    """Run a window with a stepper begun by ``begin``, record as ``fctd.simulate`` does, and hold it to the checks.

    Raises InputError, and UnstableError when the string does not settle before the start.
    """
    simulation = Simulation(case, window=window, stepper=lambda run: _InWindow(begin(run), run))
    run = simulation.run
    if run.string.long_segment:
        # All engines have the paper's long segment: FCTD's stepper alone knows waves within it.
        run.pipe = run.pipe._replace(beside=0.0)
        topdrive.put_long_segment(run.S, run.top[topdrive.TOP_LENGTH], run.pipe)
    simulation.start()
    assert isinstance(simulation.stepper, _InWindow)
    stepper = simulation.stepper.own
    try:
        for _ in simulation:
            pass
        if simulation.status == RunStatus.UNSTABLE:
            simulation.record_part()  # for the checks, which say how
    finally:
        stepper.close()
    broken = simulation.message
    result = simulation.result()
    checks = examine(run, window.start, result.history, result.profile, result.energy, broken)
    failed = [f"{row.check} ({row.value:.3g}, at most {row.bound:g})" for row in checks.itertuples() if not row.passed]
    message = "; ".join([*([broken] if broken else []), *failed])
    return EngineRun(
        result.history, result.profile, "invalid" if failed else "valid", message, stepper.note(), result.energy,
        checks, stepper.step, run.steps, simulation.wall_s,
    )  # fmt: skip


def check_supported(case: Case) -> None:
    """Raise InputError for what FCTD's stepper alone computes: another engine would leave it out without a word."""
    contact, drills = case.contact, any(operation.on_bottom for operation in case.operations)
    uneven = next((k for k, part in enumerate(case.string.components) if part.eccentricity), None)
    bent = next((k for k, part in enumerate(case.string.components) if part.bend), None)
    found = [
        (contact.law != "linear", "contact.law", '"linear"', contact.law),
        (contact.friction_law not in ("coulomb", "paper"), "contact.friction_law", '"coulomb"', contact.friction_law),
        (case.rig.drive != "stiff", "rig.drive", '"stiff"', case.rig.drive),
        (drills and case.bit.rock is not None, "bit.rock", "no rock", "a table"),
        (case.mud.unsteady > 0, "mud.viscosity", "0", case.mud.viscosity),
        (bent is not None, f"string.components[{bent}].bend", "0", "above 0"),
        (uneven is not None, f"string.components[{uneven}].eccentricity", "0", "above 0"),
    ]
    with naming_file(case):
        for present, key, needed, value in found:
            if present:
                raise InputError(f"{needed} in another engine than FCTD's", key=key, value=value)


class InWindows(ABC):
    """Common part of all engines: ``run_window`` runs them.

    own : whether it is FCTD's stepper, which knows every key of a case.
    """

    own: ClassVar[bool] = False

    @abstractmethod
    def begin(self, run: Run) -> Stepper:
        """See ``StringEngine.begin``."""

    def run(self, case: Case, window: Window) -> EngineRun:
        """See ``StringEngine.run``."""
        if not self.own:
            check_supported(case)
        return run_window(case, window, self.begin)


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
