"""The interface of string engines, the registry of all of them, and the types of a run.

An engine advances the whole string of a case with its own inertia, contact and friction (``does`` names the
exceptions).  All engines start from the same state, which FCTD's stepper has reached, and the same recorder reads
them.
"""

from collections.abc import Collection
from typing import Any, ClassVar, NamedTuple, Protocol

import pandas as pd

from fctd.case import units
from fctd.case.errors import Table
from fctd.case.load import Case
from fctd.simulation import simulate
from fctd.simulation.intervals import Window as Window
from fctd.simulation.run import Run
from references.registry import Registry

ENGINES: dict[str, str] = {
    "fctd": "references.engines.own:Fctd",
    "bullet": "references.engines.bullet:Bullet",
    "mujoco": "references.engines.mujoco:MuJoCo",
    "mujoco_chain": "references.engines.mujoco_chain:MuJoCoChain",
    "elastica": "references.engines.elastica:Elastica",
}


class EngineRun(NamedTuple):
    """The result of a window.

    status : ``valid``, or ``invalid`` when a check failed; message names the failed checks and the error that ended
    the run.  note : a limitation of the loads, or empty.  history, profile, energy : tables as in
    ``fctd.SimulationResult``.  checks : a row per check of ``checks.examine``.  step [s], steps.
    """

    history: pd.DataFrame
    profile: pd.DataFrame
    status: str
    message: str
    note: str
    energy: pd.DataFrame
    checks: pd.DataFrame
    step: float
    steps: int


class Stepper(simulate.Stepper, Protocol):
    """A string inside an engine, started from the state of a ``Run``; it advances in equal steps of at most ``step``.

    Sums and losses go to the run at every step, poses and velocities with ``refresh``.
    """

    step: float

    def note(self) -> str:
        """A limitation of the loads, or an empty text."""

    def close(self) -> None:
        """Release the resources of the engine."""


class StringEngine(Protocol):
    """A physics engine that can run the string of a case.

    name : its key in ENGINES.  distribution : the package that provides it.  does : one line for users.
    honours : features of a case that it represents (fctd.simulation.features); it refuses the others.
    """

    name: ClassVar[str]
    distribution: ClassVar[str]
    does: ClassVar[str]
    honours: ClassVar[Collection[str]]
    Options: ClassVar[type[Table]]

    def __init__(self, options: Any) -> None: ...

    def begin(self, run: Run) -> Stepper:
        """Put the string of a run into the engine; InputError for what the engine cannot represent."""

    def run(self, case: Case, window: Window) -> EngineRun:
        """Run a window of a case; InputError for a case or a window that cannot be run."""


REGISTRY: Registry[StringEngine] = Registry(
    ENGINES, ("references.rivals", "ENGINES"), "fctd_references.engines", "engine", "engine"
)
engine_class = REGISTRY.find
installed_version = REGISTRY.installed_version
need = REGISTRY.need


def build(name: str, **options: Any) -> StringEngine:
    """Engine ``name`` with options as keys of its ``Options``, quantities as in a case file.

    Raises InputError for an unknown name, a bad option or a package that is not installed.
    """
    return engine_class(name)(REGISTRY.options(name, options))


class StepOptions(Table):
    """The step [s]; by default the engine's best step."""

    step: units.PositiveTime | None = None
