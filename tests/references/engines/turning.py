"""What the tests of the engines share: a turning string, and engines that may not be installed."""

from typing import Any

import pytest

from fctd import Case, Simulation
from fctd.simulation.run import Run
from references import engines
from references.engines import EngineRun, Window
from references.registry import absent
from tests.cases import make_case, pipe, rotation

STATIONS = [[0, 0, 0], [100, 0, 0], [400, 60, 30], [600, 60, 30]]
WINDOW = Window(5.0, 1.0)


def needs(name: str) -> None:
    """Skip the test of an engine whose package is missing, and name the package."""
    if engines.installed_version(name) is None:
        pytest.skip(f"package {absent(engines.engine_class(name).distribution)}")


BULLET = pytest.mark.usefixtures("bullet")


def turning(stations: Any = STATIONS, **sections: Any) -> Case:
    sections = {"record": {"interval": 0.1}} | sections
    return make_case(stations, **{"components": [pipe(500, 16)], "operations": [rotation(500, 8, ramp=1)]} | sections)


def begun(case: Case, window: Window) -> Run:
    """The string of a case at the start of a window."""
    simulation = Simulation(case, window=window)
    simulation.start()
    return simulation.run


def mean(run: EngineRun, column: str) -> float:
    return float(run.history[column].mean())
