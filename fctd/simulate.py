"""A whole simulation: prepare, settle, run the schedule, record (§4.6, §6.2)."""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from fctd import topdrive
from fctd.case import Case
from fctd.faults import UnstableError
from fctd.operations import Stretch
from fctd.record import Recorder
from fctd.results import SimulationResult
from fctd.ringing import expected_ringing
from fctd.run import Run, Settling, forget_start, prepare, settle
from fctd.topdrive import Motion
from fctd.wall_query import WallQuery

# Called after every record with simulated and total time [s] and the real-time factor so far.
Progress = Callable[[float, float, float], None]
# A ledger that is off by more than this share of the work gets a word of warning with the result, and so does a
# string that cylinders ring by more than this share of its hook load.
DOUBTFUL, RINGING = 0.01, 0.005


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
    run, stretches = prepare(case, contact)
    try:
        residual = settle(run, progress=settling)
    except UnstableError as error:
        return Recorder(run).result("unsettled", f"before the start: {error}", 0.0, float("nan"))
    forget_start(run)
    recorder = Recorder(run)
    status, message = "completed", ""
    total = sum(s.motion.duration for s in stretches)
    began = time.perf_counter()
    try:
        for motion, operation in stretches:
            for end in _records(motion, case.record.interval):
                run.advance(motion, end - run.top[topdrive.TOP_TIME])
                run.refresh()
                run.check()
                recorder.record(operation)
                if progress is not None:
                    now = run.top[topdrive.TOP_TIME]
                    progress(now, total, now / max(time.perf_counter() - began, 1e-9))
    except UnstableError as error:
        status, message = "unstable", f"at {run.top[topdrive.TOP_TIME]:.4g} s: {error}"
    except KeyboardInterrupt:
        status, message = "interrupted", f"at {run.top[topdrive.TOP_TIME]:.4g} s"
        if run.top[topdrive.TOP_TIME] > recorder.last_time:  # a part of a record interval
            run.refresh()
            recorder.record(operation)
    wall = time.perf_counter() - began
    result = recorder.result(status, message, wall, residual)
    return replace(result, message="; ".join(_doubts(result, run, stretches))) if status == "completed" else result


def _doubts(result: SimulationResult, run: Run, stretches: list[Stretch]) -> list[str]:
    """What the reader of a completed run should know before trusting it."""
    found = []
    if not result.run["energy_error"] < DOUBTFUL:
        off = f"the energy ledger is off by {100 * result.run['energy_error']:.2g} %"
        found.append(f"{off}: try a smaller solver.step, shorter segments, or arcs")
    swing, frequency, depth = expected_ringing(run, stretches).largest()
    if swing > RINGING * float(result.history["hookload_N"].abs().mean()):
        found.append(
            f"the string slides over the joints of the hole's cylinders in time with its own {frequency:.2f} Hz: near "
            f"{depth:.0f} m about ±{swing / 1e3:.2g} kN of hook load are not the well's; arcs have no joints"
        )
    return found


def _records(motion: Motion, interval: float) -> list[float]:
    """Times at which a stretch is recorded: the grid of the interval and its own end [s]."""
    end = motion.start + motion.duration
    grid = interval * np.arange(np.floor(motion.start / interval) + 1, np.ceil(end / interval))
    inside = grid[(grid > motion.start + 1e-6) & (grid < end - 1e-6)]
    return [*(float(t) for t in inside), end]
