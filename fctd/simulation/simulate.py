"""A whole simulation: prepare, settle, run the schedule, record (§4.6, §6.2)."""

import time
from collections.abc import Callable, Collection, Iterator
from dataclasses import replace
from itertools import takewhile
from typing import Any, NamedTuple, Protocol

import numpy as np

from fctd.case.friction import FrictionChoice
from fctd.case.load import Case, naming_file, with_friction
from fctd.case.message import joined
from fctd.mechanics import topdrive
from fctd.mechanics.energy import Energy
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import SAME_LENGTH
from fctd.results.run_notes import INACCURATE
from fctd.results.status import RunStatus
from fctd.results.swings import operations_table
from fctd.results.tables import SimulationResult
from fctd.simulation.ending import end_notes, spans_of
from fctd.simulation.external_contact import WallQuery
from fctd.simulation.features import refuse
from fctd.simulation.flowing_mud import is_driven
from fctd.simulation.intervals import Interval, Window, prolonged, whole_schedule, within
from fctd.simulation.preparation import prepare
from fctd.simulation.recorder import Recorder
from fctd.simulation.run import Run
from fctd.simulation.settling import Settling, settle, start_from_rest
from fctd.store.facts import Facts, Restorable
from fctd.store.limits import LimitReached

# Called after every record with simulated and total time [s] and the real-time factor so far.
RecordProgress = Callable[[float, float, float], None]
# A row of the history by its column names.
Record = dict[str, Any]
# A stroke of an autodriller takes at most so many times as long as planned.
SLOWEST = 10


class Shift(NamedTuple):
    """A change of the schedule by an autodriller, after the interval of number ``done``.

    longer : by which its stroke is longer than planned [s]; drills_on : for one more interval, or no further.
    """

    done: int
    longer: float
    drills_on: bool


class Stepper(Protocol):
    """Advances the string of a run: ``Run`` itself, or another engine in its place."""

    def advance(self, motion: Motion, duration: float) -> None:
        """Advance by ``duration`` [s]; adds to time, sums, losses and work of the run."""

    def refresh(self) -> None:
        """Update poses, velocities, axes and walls of the run to the present time."""

    def energy(self) -> Energy:
        """Energy of the string [J], after ``refresh``."""


class Engine(Protocol):
    """Makes the stepper that takes the place of a run's own; ``honours`` : its features (features.FEATURES)."""

    @property
    def name(self) -> str: ...

    @property
    def honours(self) -> Collection[str]: ...

    def begin(self, run: Run) -> Stepper:
        """A stepper at the state of a run; InputError for what it cannot represent."""


class Checkpointer(Protocol):
    """Keeps a run while it lasts, so that another process can go on with it."""

    def begin(self, simulation: "Simulation") -> None:
        """Put a run that has not started into the state in which another one stopped, if there is any."""

    def keep(self, simulation: "Simulation", *, now: bool = False) -> None:
        """Keep a run that has just recorded an interval, where it is time to, or now."""


class Simulation(Iterator[Record], Restorable):
    """A case's operations, one record at a time: ``for record in Simulation(case): ...``.

    contact : another contact method, built for the hole of this case, that finds the wall at every step;
    friction, force law and step stay the same.  window : the part of the schedule that is run and recorded, as start
    and duration [s]; the string is advanced to its start without a record.  engine : makes the stepper that moves the
    string from the start on, in place of the run's own.  settling : called while the string settles.

    A record is a row of the history.  The string settles before the first one.  Ctrl-C leaves the iteration with its
    KeyboardInterrupt; ``record_part`` then records the elapsed part of a record interval.  ``result`` may be called at
    any time and returns the records so far.  Raises InputError for a case or a window that cannot be simulated.

    What a checkpoint keeps follows from neither case nor window; a run that takes it goes on bitwise the same.
    """

    FACTS = ("done", "late", "wall_s", "settling_residual", "run")

    def __init__(
        self,
        case: Case,
        contact: WallQuery | None = None,
        *,
        window: tuple[float, float] | None = None,
        engine: Engine | None = None,
        settling: Settling | None = None,
    ) -> None:
        self.case, self.window = case, None if window is None else Window(*window)
        self.run, self.phases = prepare(case, contact)
        with naming_file(case):
            if engine is not None:
                refuse(self.run, engine.honours, f"engine {engine.name}")
            self.intervals = (
                whole_schedule(self.phases, case.record.interval)
                if self.window is None
                else within(self.phases, self.window, case.record.interval)
            )
        self.done = 0  # number of completed intervals
        self.status, self.message = RunStatus.INTERRUPTED, "before the start"  # until the run ends in another way
        self.late = 0.0  # by which a stroke of an autodriller is longer than planned [s]
        self.shifts: list[Shift] = []  # by an autodriller so far
        self.wall_s = 0.0  # wall-clock time since the start
        self.saving = np.zeros(2)  # time that a checkpointer has spent beside it, by clock and processor [s]
        self.settling_residual = float("nan")
        self.stepper: Stepper = self.run
        self._engine, self._settling = engine, settling
        self._recorder: Recorder | None = None

    @property
    def started(self) -> bool:
        """Whether the string has been settled and brought to the start."""
        return self._recorder is not None

    @property
    def recorder(self) -> Recorder:
        """The records of a run that has started."""
        assert self._recorder is not None
        return self._recorder

    def facts(self) -> Facts:
        """See ``Restorable.facts``; of a run that has started."""
        return super().facts() | {"shifts": self.shifts, "recorder": self.recorder.facts()}

    def restore(self, facts: Facts) -> None:
        """Start where another process stopped, without its records."""
        for shift in facts["shifts"][len(self.shifts) :]:
            self.shift(Shift(*shift))
        super().restore(facts)
        self._recorder = Recorder(self.run)
        self._recorder.restore(facts["recorder"])

    @property
    def _longest(self) -> float:
        """For how long the mud's flow may be taken as steady [s]."""
        return self.case.record.interval if is_driven(self.case) else float("inf")

    @property
    def end(self) -> float:
        """Simulated time at which the last record is due [s]."""
        return self.intervals[-1].end

    def start(self) -> None:
        """Settle the string and bring it to the start of the first record interval; later calls have no effect.

        Raises UnstableError when the string does not settle.
        """
        if self.started:
            return
        try:
            self.settling_residual = settle(self.run, progress=self._settling)
        except UnstableError as error:
            self.status, self.message = RunStatus.UNSETTLED, f"before the start: {error}"
            raise
        start_from_rest(self.run)
        start = 0.0 if self.window is None else self.window.start
        if start > 0:
            for motion, operation, end in within(self.phases, Window(0.0, start), self._longest):
                self.run.take_mud_along(self.case.operations[operation])
                self.run.let_mud_flow(motion, end)
                self.run.advance(motion, end - self.run.time)
            self.run.refresh()
            self.run.clear()
        if self._engine is not None:
            with naming_file(self.case):
                self.stepper = self._engine.begin(self.run)
        self.run.upper_end.begin(self.run)
        self._recorder = Recorder(self.run, start, self.stepper.energy)

    def __next__(self) -> Record:
        """Run to the end of the next interval and record it; the iteration also ends where the run becomes unstable."""
        if self.status != RunStatus.INTERRUPTED:
            raise StopIteration
        try:
            self.start()
            if self.done == len(self.intervals):
                self._complete()
                raise StopIteration
            return self._record_next()
        except UnstableError as error:
            if self.started:
                self.status, self.message = RunStatus.UNSTABLE, f"at {self.run.time:.4g} s: {error}"
            raise StopIteration from None

    def _record_next(self) -> Record:
        motion, operation, end = self.intervals[self.done]
        began = time.perf_counter()
        try:
            self.run.take_mud_along(self.case.operations[operation])
            self.run.let_mud_flow(motion, end)
            self.stepper.advance(motion, end - self.run.time)
            self.stepper.refresh()
            self.recorder.guards.timed(self.recorder.guards.check_state, self.run.bit_depth)
            record = self._record()
            self._follow_driller()
        finally:
            self.wall_s += time.perf_counter() - began
        self.done += 1
        return record

    def _record(self) -> Record:
        self.recorder.record(self.intervals[self.done].operation, self.run.drain())
        return self.recorder.history[-1]

    def _follow_driller(self) -> None:
        """End the stroke of an autodriller where the block is down, or go on, and move the rest of the schedule.

        Raises UnstableError where it takes ``SLOWEST`` times as long as the law of the bit says.
        """
        now = self.intervals[self.done]
        drills_on = None if self.window is not None else self.run.upper_end.drills_on(self.run, now.motion)
        if drills_on is None:
            return
        planned = self._planned(self.done)
        if not drills_on:
            self.late = 0.0
        if drills_on == bool(planned):
            return
        longer = self.case.record.interval if drills_on else now.end - planned[-1].end
        self.late += longer if drills_on else 0.0
        self.shift(Shift(self.done, longer, drills_on))
        if self.late > (SLOWEST - 1) * (now.motion.duration - self.late):
            raise UnstableError(
                f"the bit drills {SLOWEST} times more slowly than its law says: raise bit.weight_on_bit or the rotation"
            )

    def shift(self, shift: Shift) -> None:
        """Move the rest of the schedule; another process does it again before it goes on."""
        done, longer, drills_on = shift
        now = self.intervals[done]
        self.shifts.append(shift)
        del self.intervals[done + 1 : done + 1 + len(self._planned(done))]
        self.intervals, self.phases = prolonged(self.intervals, self.phases, now.motion, longer)
        self.run.upper_end.delay(longer)
        if drills_on:
            motion = self.intervals[done].motion
            self.intervals.insert(done + 1, Interval(motion, now.operation, now.end + longer))

    def _planned(self, done: int) -> list[Interval]:
        """The intervals that follow one with its motion."""
        now, later = self.intervals[done], self.intervals[done + 1 :]
        return list(takewhile(lambda one: one.motion == now.motion, later))

    def record_part(self) -> None:
        """Record the elapsed part of an interval that was interrupted before its end, if there is any.

        Further iteration continues with the rest of the interval.
        """
        if self._recorder is not None and self.run.time > self._recorder.last_time:
            self.stepper.refresh()
            self._record()

    def stop(self, reason: str) -> None:
        """End a run before its end, at a limit."""
        where = f"at {self.run.time:.4g} s" if self.started else "before the start"
        self.status, self.message = RunStatus.STOPPED, f"{where}: {reason}"

    def result(self) -> SimulationResult:
        """The records so far, with status ``interrupted`` before the end.  A complete schedule gets its final notes."""
        if self._recorder is None:
            return Recorder(self.run).result(self.status, self.message, 0.0, float("nan"))
        message = f"at {self.run.time:.4g} s" if self.status == RunStatus.INTERRUPTED else self.message
        result = self._recorder.result(self.status, message, self.wall_s, self.settling_residual)
        result.run["checkpoints_wall_s"], result.run["checkpoints_s"] = map(float, self.saving)
        table = operations_table(
            result.history, self._recorder.start_time, self.run.upper_end.start_depth, spans_of(self.run, self.phases)
        )
        result = replace(result, operations=table)
        if self.status == RunStatus.COMPLETED:
            return self._judged(result) if self.window is None else result
        note = self.recorder.guards.of_the_ledger()
        return result if note is None else replace(result, notes=(note, *result.notes))

    def _complete(self) -> None:
        if self.window is None:
            self._check_fed()
        self.status, self.message = RunStatus.COMPLETED, ""

    def _check_fed(self) -> None:
        """Raise AssertionError when the fed string of a finished run does not reach the scheduled bit depth.

        An autodriller has none.
        """
        if any(motion.driller.by_weight for motion, _ in self.phases):
            return
        run, end = self.run, self.case.operations[-1].end_md
        depth, length = run.bit_depth, float(run.top[topdrive.TOP_LENGTH])
        # A step feeds with the speed at its middle.  The error is h²/24 times the change of the ramp's slope, which is
        # at most 3 Δv/T, and the rounding of the length.
        allowed = SAME_LENGTH + run.steps * float(np.spacing(length))
        allowed += sum(run.step**2 * abs(m.feed_to - m.feed_from) / (8 * m.duration) for m, _ in self.phases)
        if not abs(depth - end) <= allowed:
            raise AssertionError(f"the string ends at {depth:.6f} m, the schedule at {end:.6f} m")

    def _judged(self, result: SimulationResult) -> SimulationResult:
        """The result of a completed run, with the notes of its end, and its final status."""
        ledger, ended = end_notes(self.run, self.phases, result, self.recorder.start_time)
        found = (*ended, *result.notes)
        if ledger is not None and not result.run["energy_error"] <= INACCURATE:
            return replace(result, status=RunStatus.INACCURATE, message=str(ledger), notes=found)
        return replace(result, message=joined(note.message for note in found), notes=found)


def simulate(
    case: Case,
    progress: RecordProgress | None = None,
    *,
    contact: WallQuery | None = None,
    settling: Settling | None = None,
    checkpointer: Checkpointer | None = None,
    friction: FrictionChoice | None = None,
) -> SimulationResult:
    """Simulate a case's operations.

    contact : another contact method, built for the hole of this case, that finds the wall at every step;
    friction, force law and step stay the same.  settling : called while the string settles before the start.
    checkpointer : keeps the run while it lasts.  friction : kinetic factors as of ``fctd.equilibrium``, along which
    static ones are scaled; None for the case's own.

    Returns all records up to the end of the run: ``status`` is ``completed`` or the reason for the stop, ``message``
    its time.  Raises InputError for a case that cannot be simulated.
    """
    with naming_file(case):
        case = with_friction(case, friction)
    simulation = Simulation(case, contact, settling=settling)
    try:
        if checkpointer is not None:
            checkpointer.begin(simulation)
        for record in simulation:
            if checkpointer is not None:
                checkpointer.keep(simulation)
            if progress is not None:
                now = record["time_s"]
                progress(now, simulation.end, now / max(simulation.wall_s, 1e-9))
    except KeyboardInterrupt:
        if not simulation.started:
            raise
        simulation.record_part()
    except LimitReached as limit:
        simulation.stop(str(limit))
        if checkpointer is not None and simulation.started:
            checkpointer.keep(simulation, now=True)
    return simulation.result()
