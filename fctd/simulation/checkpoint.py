"""The state of a run between two records, as numbers that can be kept: a run that takes them goes on bitwise the same.

What follows from the case (hole, laws, step, schedule, constants of the string) is prepared anew, and not kept.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics import state
from fctd.mechanics.energy import Energy
from fctd.mechanics.moving_string import Sums
from fctd.results.notes import as_metadata, from_metadata
from fctd.simulation.recorder import Recorder
from fctd.simulation.run import Run
from fctd.simulation.simulate import Shift, Simulation

Array = NDArray[Any]


@dataclass(frozen=True)
class Checkpoint:
    """A run between two records, without its records (``chunks``).

    arrays : S (ROWS, k), the first columns of the state buffer, whose others are those of a fresh one; top and owner,
    whole; mean (6, n) and ends (4,), the ``Sums`` of the last record.  facts : all else, as JSON takes it.
    """

    arrays: dict[str, Array]
    facts: dict[str, Any]

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return float(self.facts["last_time"])


def capture(simulation: Simulation) -> Checkpoint:
    """The state of a run that has just recorded an interval; the run does not change."""
    run, recorder = simulation.run, simulation.recorder
    rows = run.S.reshape(state.ROWS, state.STRIDE)
    fresh = state.new_state(1).reshape(state.ROWS, state.STRIDE)
    used = np.flatnonzero((rows.view(np.int64) != fresh.view(np.int64)).any(axis=0))
    columns = int(used[-1]) + 1 if len(used) else 0
    mean = recorder.mean
    arrays = {
        "S": rows[:, :columns].copy(),
        "top": run.top.copy(),
        "owner": run.owner.copy(),
        "mean": np.stack(mean[:6]),
        "ends": np.array(mean[6:], float),
    }
    return Checkpoint(arrays, _facts(simulation, run, recorder))


def _facts(simulation: Simulation, run: Run, recorder: Recorder) -> dict[str, Any]:
    hoist = run.hoist
    return {
        "done": simulation.done,
        "wall_s": simulation.wall_s,
        "guards": [recorder.guards.seconds, recorder.guards.residual, recorder.guards.work, *recorder.guards.swing],
        "settling_residual": simulation.settling_residual,
        "step": run.step,
        "steps": run.steps,
        "segments": run.segments,
        "pipe": [float(part) for part in run.pipe],
        "mud_at": run.mud_at,
        "hoist": None
        if hoist is None
        else {
            "strokes": len(hoist.strokes),
            "stands": hoist.stands,
            "strain": float(hoist.strain),
            "direction": hoist.direction,
            "in_slips": bool(hoist.in_slips),
            "pace": float(hoist.pace),
            "in_stroke": hoist.stroke is not None,
        },
        "shifts": [list(shift) for shift in simulation.shifts],
        "late": simulation.late,
        "start": [float(part) for part in recorder.start],
        "start_length": recorder.start_length,
        "start_depth": recorder.start_depth,
        "start_time": recorder.start_time,
        "last_time": recorder.last_time,
        "wanted": recorder.wanted,
        "notes": as_metadata(recorder.guards.notes.values()),
        "series": [recorder.series.every, recorder.series.seen],
    }


def put_back(simulation: Simulation, checkpoint: Checkpoint) -> Recorder:
    """Put a prepared run, whose case is that of the checkpoint, into its state; returns its recorder, without records.

    Raises ValueError where the state does not fit the run.
    """
    run, facts, arrays = simulation.run, checkpoint.facts, checkpoint.arrays
    S, top, owner = arrays["S"], arrays["top"], arrays["owner"]
    fits = len(S) == state.ROWS and top.shape == run.top.shape and owner.shape == run.owner.shape
    if not fits or facts["step"] != run.step or (facts["hoist"] is None) != (run.hoist is None):
        raise ValueError("the checkpoint belongs to another string or step")
    run.S[:] = state.new_state(1)
    run.S.reshape(state.ROWS, state.STRIDE)[:, : S.shape[1]] = S
    run.top[:], run.owner[:] = top, owner
    run.steps, run.segments = facts["steps"], facts["segments"]
    run.pipe = type(run.pipe)._make(facts["pipe"])
    if facts["mud_at"] is not None:
        depth, segments, rpm = facts["mud_at"]
        run.mud_at = depth, segments, rpm
    if run.hoist is not None:
        kept = facts["hoist"]
        for shift in facts["shifts"][len(simulation.shifts) :]:
            simulation.shift(Shift(*shift))
        begun = len(run.hoist.strokes) - kept["strokes"]
        run.hoist.stroke = run.hoist.strokes[begun - 1] if kept["in_stroke"] else None
        run.hoist.strokes = run.hoist.strokes[begun:]
        run.hoist.stands, run.hoist.strain, run.hoist.direction = kept["stands"], kept["strain"], kept["direction"]
        run.hoist.in_slips, run.hoist.pace = kept["in_slips"], kept["pace"]
        run.string = run.hoist.string(run)
    simulation.done, simulation.wall_s, simulation.late = facts["done"], facts["wall_s"], facts["late"]
    simulation.settling_residual = facts["settling_residual"]
    return _recorder(run, checkpoint)


def _recorder(run: Run, checkpoint: Checkpoint) -> Recorder:
    facts, arrays = checkpoint.facts, checkpoint.arrays
    recorder = Recorder(run)
    recorder.start = Energy(*facts["start"])
    recorder.start_length, recorder.start_depth = facts["start_length"], facts["start_depth"]
    recorder.start_time, recorder.last_time = facts["start_time"], facts["last_time"]
    recorder.wanted = facts["wanted"]
    guards = recorder.guards
    guards.notes = {note.code: note for note in from_metadata(facts["notes"])}
    guards.seconds, guards.residual, guards.work, *swing = facts["guards"]
    guards.swing = (swing[0], swing[1])
    recorder.mean = Sums._make([*arrays["mean"], *map(float, arrays["ends"])])
    recorder.series.every, recorder.series.seen = facts["series"]
    return recorder
