"""FCTD as an engine with a fault, and a fault that several tests plant."""

from collections.abc import Callable
from typing import Any

import numpy as np

from fctd.mechanics import state
from fctd.model.pieces import FRICTION
from fctd.simulation.run import Run
from references.engines import StepOptions
from references.engines.own import Fctd
from references.engines.run import Around

Fault = Callable[[Run], None]
FACTOR = 0.9  # of the friction of a slippery engine


def nothing(run: Run) -> None:
    """No fault."""


class FaultyStepper(Around):
    """FCTD's stepper, with a fault added to the run after every advance."""

    def __init__(self, run: Run, fault: Fault) -> None:
        super().__init__(Fctd(StepOptions()).begin(run))
        self._run, self._fault = run, fault

    def advance(self, motion: Any, duration: float) -> None:
        super().advance(motion, duration)
        self._fault(self._run)


class Faulty(Fctd):
    """FCTD as an engine that adds a fault after every advance, or at its start, or in a stepper of its own."""

    def __init__(
        self, fault: Fault = nothing, *, at_start: Fault = nothing, stepper: type[FaultyStepper] = FaultyStepper
    ) -> None:
        super().__init__(StepOptions())
        self._fault, self._at_start, self._stepper = fault, at_start, stepper

    def begin(self, run: Run) -> Any:
        self._at_start(run)
        return self._stepper(run, self._fault)


def through_the_wall(run: Run) -> None:
    """Move the bit into the wall, if there is one, by half of its clearance."""
    if run.laws.geometry == state.OPEN:
        return
    n = run.segments
    walls = np.stack([state.row(run.S, row, n)[-1] for row in (state.PX, state.PY, state.PZ)])
    clearance = run.S[state.HOLE + n] - run.S[state.RADIUS + n]
    for row, part in zip((state.X, state.Y, state.Z), walls / np.linalg.norm(walls), strict=True):
        run.S[row + n] += 0.5 * clearance * part


def slippery(run: Run) -> None:
    """FACTOR of the friction of the case."""
    run.hole = run.hole.with_friction(FACTOR * run.hole.intervals[:, FRICTION])
    state.row(run.S, state.FRICTION, run.segments)[:] *= FACTOR
