"""Loads of a string over a window, with another contact method in the engine's loop, or in another engine.

Both are runs of one kind: FCTD's own stepper leads the string to the start of the window, and from there on a method
or an engine has it.  Each step is timed by the processor's clock, and each contact force summed.
"""

import time
from collections.abc import Callable, Collection, Mapping
from typing import Any

import numpy as np

from fctd.arena.method import ContactMethod
from fctd.arena.result import Loads, Quartiles
from fctd.arrays import Array
from fctd.mechanics import state
from fctd.mechanics.topdrive import Motion
from fctd.results import ledger
from fctd.simulation.external_contact import QueriedWall
from fctd.simulation.features import ASKED, refuse
from fctd.simulation.run import Run
from references.engines import EngineRun, StepOptions, Stepper, StringEngine, Window
from references.engines.own import Fctd
from references.engines.run import Around, InWindows, hann_means, run_window
from references.methods.window import RECORDS, Plan
from references.timing.stopwatch import kernel

# Steps of FCTD's over which an engine is timed before its loads, in parts: the first of them may compile.
PROBE, PARTS = 20, 4
# A run that has taken so many times what was expected ends.
OVERRUN = 3.0
Tell = Callable[[float], object]  # with the share that is done


class OverrunError(Exception):
    """A run that took far longer than expected."""


class Swapped(Fctd):
    """FCTD's own stepper with another contact method from the start of the window on."""

    def __init__(self, method: ContactMethod) -> None:
        super().__init__(StepOptions())
        self._method = method

    def begin(self, run: Run) -> Any:
        """See ``StringEngine.begin``."""
        refuse(run, ASKED, "another contact method")
        run.wall = QueriedWall(self._method, run.hole, run.segments)
        return super().begin(run)


class Timed(InWindows):
    """An engine whose steps are timed, and whose contact forces are kept.

    most [s] : processor time after which it ends with OverrunError; the first record may compile, and is left out.
    """

    def __init__(self, engine: StringEngine, tell: Tell = lambda _: None, most: float = np.inf) -> None:
        self._engine, self._tell, self._most = engine, tell, most
        self.name: str = engine.name  # type: ignore[misc]
        self.honours: Collection[str] = engine.honours  # type: ignore[misc]
        self.stepper: TimedStepper | None = None

    @property
    def real_time_factors(self) -> Array:
        """Simulated over processor time of each record; NaN alone before the first."""
        if self.stepper is None or not self.stepper.costs:
            return np.array([np.nan])
        return self.stepper.step / np.array(self.stepper.costs)

    def begin(self, run: Run) -> Stepper:
        """See ``StringEngine.begin``."""
        self.stepper = TimedStepper(self._engine.begin(run), run, self._tell, self._most)
        return self.stepper


class TimedStepper(Around):
    """A stepper that times each advance.

    costs : processor time of a step in each advance [s]; kernels : the same in columns of the reference kernel, which
    is timed after it.  forces : mean contact forces (n,) [N] of each.  steps : made.
    """

    def __init__(self, stepper: Stepper, run: Run, tell: Tell, most: float) -> None:
        super().__init__(stepper)
        self._run, self._tell, self._most = run, tell, most
        self.costs: list[float] = []
        self.kernels: list[float] = []
        self._kernel, self._columns = kernel()
        self.forces: list[Array] = []
        self.steps, self._spent, self._lasted = 0, 0.0, 1.0

    def advance(self, motion: Motion, duration: float) -> None:
        """See ``Stepper.advance``."""
        before, began = self._run.steps, time.process_time()
        super().advance(motion, duration)
        spent = time.process_time() - began
        done = self._run.steps - before
        self.costs.append(spent / max(done, 1))
        began = time.process_time()
        self._kernel()
        self.kernels.append(self.costs[-1] * self._columns / max(time.process_time() - began, 1e-9))
        self.steps += done
        self._lasted = duration
        if len(self.costs) > 1:  # the first may compile the step with another contact method, which takes seconds
            self._spent += spent
        self._tell(len(self.costs) / RECORDS)
        if self._spent > self._most:
            raise OverrunError(f"{self._spent:.3g} s for {len(self.costs) - 1} of {RECORDS} records")

    def refresh(self) -> None:
        """See ``Stepper.refresh``."""
        super().refresh()
        if len(self.forces) < len(self.costs):
            sums = state.row(self._run.S, state.SUM_NORMAL, self._run.segments)
            self.forces.append(sums / self._lasted)


def timed_run(
    plan: Plan, engine: StringEngine, tell: Tell = lambda _: None, most: float = np.inf
) -> tuple[EngineRun, TimedStepper]:
    """A run of the window of a plan.

    Raises what ``run_window`` raises, whatever a foreign method raises, and OverrunError.
    """
    timed = Timed(engine, tell, most)
    run = run_window(plan.case, plan.window, timed)
    assert timed.stepper is not None
    return run, timed.stepper


def failed_checks(run: EngineRun) -> set[str]:
    """The checks that a run fails."""
    return set(run.checks.loc[~run.checks["passed"].astype(bool), "check"])


def loads_of(
    run: EngineRun, stepper: TimedStepper, own: Array | None, md: Array, shared: Collection[str] = ()
) -> Loads:
    """The loads of a run.

    own : contact forces (n,) [N] of the engine's own arcs, md (n,) of its points [m].  shared : checks that the
    engine's own run fails, so that the string and not the method is what they tell of.
    """
    valid = run.status == "valid" or failed_checks(run) <= set(shared)
    forces = mean_forces(stepper)
    means: Mapping[str, float] = dict(hann_means(run.history)) if len(run.history) else {}

    def number(value: Any) -> float | None:
        return float(value) if value is not None and np.isfinite(value) else None

    off = np.abs(forces - own) if own is not None and forces.shape == own.shape else np.full(len(md), np.nan)
    worst = int(np.nanargmax(off)) if np.isfinite(off).any() else None
    message = "; ".join(filter(None, ("" if valid else run.message, run.note)))
    return Loads(
        status="valid" if valid else run.status, message=message, hookload_N=number(means.get("hookload_N")),
        surface_torque_N_m=number(means.get("surface_torque_N_m")),
        sum_r_mu_fn_N_m=number(means.get("sum_r_mu_fn_N_m")),
        force_off_N=None if worst is None else float(off[worst]),
        force_off_md_m=None if worst is None else float(md[worst]),
        forces_N=[number(force) for force in forces], step_us=Quartiles.of(stepper.costs).times(1e6),
        step_kernels=Quartiles.of(stepper.kernels), step_s=run.step, steps=stepper.steps,
        energy_error=number(ledger.error(run.energy, motion=True)),
    )  # fmt: skip


def mean_forces(stepper: TimedStepper) -> Array:
    """Contact forces (n,) [N] under a Hann window over the records, as those of the loads."""
    weights = np.hanning(len(stepper.forces) + 2)[1:-1]
    return np.asarray(weights @ np.array(stepper.forces) / weights.sum())


def step_cost(plan: Plan, engine: StringEngine) -> float:
    """Processor time of the window in an engine [s], expected from the quickest part of PROBE steps of it."""
    lasts = PROBE * plan.described.step_s
    record = plan.case.record.model_copy(update={"interval": lasts / PARTS})
    case = plan.case.model_copy(update={"record": record})
    short = plan._replace(case=case, window=Window(plan.window.start, lasts))
    _, stepper = timed_run(short, engine)
    return min(stepper.costs) * plan.window.duration / stepper.step
