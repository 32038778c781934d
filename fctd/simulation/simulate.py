"""A whole simulation: prepare, settle, run the schedule, record (§4.6, §6.2)."""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import topdrive
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.topdrive import Motion
from fctd.model.drillstring import SAME_LENGTH
from fctd.model.operations import Phase
from fctd.results import notes
from fctd.results.status import RunStatus
from fctd.results.tables import SimulationResult
from fctd.simulation.external_contact import WallQuery
from fctd.simulation.recorder import Recorder
from fctd.simulation.ringing import expected_ringing
from fctd.simulation.run import Run, Settling, prepare, settle, start_from_rest

# Called after every record with simulated and total time [s] and the real-time factor so far.
Progress = Callable[[float, float, float], None]
# A string that cylinders ring by more than this share of its hook load gets a note.
RINGING = 0.005


def simulate(
    case: Case,
    progress: Progress | None = None,
    *,
    contact: WallQuery | None = None,
    settling: Settling | None = None,
) -> SimulationResult:
    """Simulate a case's operations.

    contact : another contact method, built for the hole of this case, that answers for the wall at every step;
    friction, force law and step stay the same.  settling : called while the string settles before the start.

    Returns whatever was reached: ``status`` is ``completed``, or says why it stopped and ``message`` when.
    Raises InputError for a case that cannot be simulated.
    """
    run, phases = prepare(case, contact)
    try:
        residual = settle(run, progress=settling)
    except UnstableError as error:
        return Recorder(run).result(RunStatus.UNSETTLED, f"before the start: {error}", 0.0, float("nan"))
    start_from_rest(run)
    recorder = Recorder(run)
    status, message = RunStatus.COMPLETED, ""
    total = sum(s.motion.duration for s in phases)
    began = time.perf_counter()
    try:
        for motion, operation in phases:
            for end in _records(motion, case.record.interval):
                run.advance(motion, end - run.top[topdrive.TOP_TIME])
                run.refresh()
                run.check()
                recorder.record(operation)
                if progress is not None:
                    now = run.top[topdrive.TOP_TIME]
                    progress(now, total, now / max(time.perf_counter() - began, 1e-9))
        _check_fed(run, phases)
    except UnstableError as error:
        status, message = RunStatus.UNSTABLE, f"at {run.top[topdrive.TOP_TIME]:.4g} s: {error}"
    except KeyboardInterrupt:
        status, message = RunStatus.INTERRUPTED, f"at {run.top[topdrive.TOP_TIME]:.4g} s"
        if run.top[topdrive.TOP_TIME] > recorder.last_time:  # a part of a record interval
            run.refresh()
            recorder.record(operation)
    wall = time.perf_counter() - began
    result = recorder.result(status, message, wall, residual)
    return _finished(result, run, phases) if status.acceptable else result


def _check_fed(run: Run, phases: list[Phase]) -> None:
    """Raise AssertionError when the string of a finished run is not as long as its bit should be deep."""
    end = run.case.operations[-1].end_md
    length = float(run.top[topdrive.TOP_LENGTH])
    fed = length - float(run.string.length[0]) if run.string.long_segment else 0.0
    # A step feeds by the speed in its middle, exact but for h²/24 times the change of the ramp's slope, at most
    # 3 Δv/T, and rounds the length.
    allowed = SAME_LENGTH + run.steps * float(np.spacing(length))
    allowed += sum(run.step**2 * abs(m.feed_to - m.feed_from) / (8 * m.duration) for m, _ in phases)
    if not abs(run.string.bit_depth + fed - end) <= allowed:
        raise AssertionError(f"the fed string ends at {run.string.bit_depth + fed:.6f} m, the schedule at {end:.6f} m")


def _finished(result: SimulationResult, run: Run, phases: list[Phase]) -> SimulationResult:
    """A run that came to its end, with what can be said of all of it."""
    error = result.run["energy_error"]
    swing, frequency, depth = expected_ringing(run, phases).largest()
    bound = RINGING * float(result.history["hookload_N"].abs().mean())
    ledger, ringing = notes.ledger_off(error), notes.rings(swing, frequency, depth, bound)
    found = tuple(note for note in (ledger, ringing, *result.notes) if note is not None)
    if ledger is not None and not error <= notes.INACCURATE:
        return replace(result, status=RunStatus.INACCURATE, message=str(ledger), notes=found)
    return replace(result, message="; ".join(map(str, found)), notes=found)


def _records(motion: Motion, interval: float) -> list[float]:
    """Times at which a phase is recorded: the grid of the interval and its own end [s]."""
    end = motion.start + motion.duration
    grid = interval * np.arange(np.floor(motion.start / interval) + 1, np.ceil(end / interval))
    inside = grid[(grid > motion.start + 1e-6) & (grid < end - 1e-6)]
    return [*(float(t) for t in inside), end]
