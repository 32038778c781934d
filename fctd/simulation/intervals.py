"""The intervals of a schedule at whose ends a run is recorded."""

from typing import NamedTuple

import numpy as np

from fctd.arrays import ceiling
from fctd.case.errors import InputError
from fctd.mechanics.topdrive import Motion
from fctd.model.operations import Phase


class Interval(NamedTuple):
    """A part of a phase: motion of the top drive, index of the operation, and time at the interval's end [s]."""

    motion: Motion
    operation: int
    end: float


class Window(NamedTuple):
    """A part of a schedule: its start and its duration [s]."""

    start: float
    duration: float


def whole_schedule(phases: list[Phase], interval: float) -> list[Interval]:
    """A whole schedule, recorded at the multiples of an interval [s] and at the end of every phase."""
    parts = []
    for motion, operation in phases:
        end = motion.start + motion.duration
        grid = interval * np.arange(np.floor(motion.start / interval), np.ceil(end / interval))
        inside = grid[(grid > motion.start + 1e-6) & (grid < end - 1e-6)]
        parts += [Interval(motion, operation, float(t)) for t in [*inside, end]]
    return parts


def within(phases: list[Phase], window: Window, longest: float) -> list[Interval]:
    """A window of a schedule, every phase in equal intervals no longer than ``longest`` [s].

    Raises InputError for a window that is empty or not within the schedule.
    """
    start, duration = window
    if not (start >= 0 and duration > 0):
        raise InputError("a start of at least 0 s and a duration above 0 s", key="window", value=str((start, duration)))
    parts: list[Interval] = []
    now, end = start, start + duration
    for motion, operation in phases:
        last = min(motion.start + motion.duration, end)
        if last <= now + 1e-9:
            continue
        count = max(int(ceiling((last - now) / longest)), 1)
        parts += [Interval(motion, operation, float(t)) for t in np.linspace(now, last, count + 1)[1:]]
        now = last
    if now < end - 1e-9:
        raise InputError(f"a window within the schedule, which ends after {now:g} s", key="window", value=f"{end:g} s")
    return parts


def prolonged(
    intervals: list[Interval], phases: list[Phase], motion: Motion, by: float
) -> tuple[list[Interval], list[Phase]]:
    """The schedule in which one motion lasts longer by so much [s], and what comes after it starts later."""

    def moved(other: Motion) -> Motion:
        if other == motion:
            return other._replace(duration=other.duration + by)
        return other._replace(start=other.start + by) if other.start > motion.start else other

    return (
        [
            Interval(moved(part.motion), part.operation, part.end + by * (part.motion.start > motion.start))
            for part in intervals
        ],
        [Phase(moved(phase.motion), phase.operation) for phase in phases],
    )
