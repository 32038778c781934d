"""FCTD's own stepper with the interface of the other engines, which are compared with it."""

from collections.abc import Collection
from typing import ClassVar

from fctd.case.errors import Table
from fctd.mechanics.energy import Energy, energy_of
from fctd.mechanics.topdrive import Motion
from fctd.simulation.features import OWN
from fctd.simulation.run import Run
from references.engines import StepOptions
from references.engines.run import InWindows


class _Stepper:
    def __init__(self, run: Run, step: float) -> None:
        self._run, self.step = run, step
        run.step = step

    def advance(self, motion: Motion, duration: float) -> None:
        self._run.advance(motion, duration)

    def refresh(self) -> None:
        """See ``Stepper.refresh``."""
        self._run.refresh()

    def energy(self) -> Energy:
        return energy_of(self._run.S, self._run.segments, self._run.laws.wall_exponent)

    def note(self) -> str:
        """See ``Stepper.note``."""
        return ""

    def close(self) -> None:
        """Nothing to release."""


class Fctd(InWindows):
    """FCTD's compiled stepper."""

    name: ClassVar[str] = "fctd"
    honours: ClassVar[Collection[str]] = OWN - {"stands"}  # all engines start with the same long segment
    distribution: ClassVar[str] = "fctd"
    does: ClassVar[str] = "rigid segments, point-in-cylinder contact, symplectic Euler, compiled"
    Options: ClassVar[type[Table]] = StepOptions

    def __init__(self, options: StepOptions) -> None:
        self.options = options

    def begin(self, run: Run) -> _Stepper:
        """See ``StringEngine.begin``."""
        return _Stepper(run, self.options.step or run.step)
