"""FCTD: fast contact torque and drag of a stiff drill string in a wellbore.

    case = fctd.load_case("well.toml")
    result = fctd.simulate(case)
    for record in fctd.Simulation(case): print(record["hookload_N"])
    point = fctd.equilibrium(case, operation="trip_out", bit_depth="8000 ft")
    chart = fctd.torque_drag(case, operation=["trip_in", "trip_out"], bit_depths=range(1750, 2451, 10))
    found = fctd.monitor(case, "readings.csv")
    finer = fctd.refine(case, tolerance=0.01).case
    fitted = fctd.calibrate(case, "measured.csv", ["friction.open", "rig.block_weight"]).case

Units are SI; x is north, y east, z down.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from fctd.cli.interrupts import ends_program

with ends_program():
    from fctd.case.errors import InputError
    from fctd.case.load import Case, load_case
    from fctd.model.wellbore import Contacts, Wellbore, build_wellbore, find_contacts
    from fctd.results.tables import SimulationResult, open_result
    from fctd.simulation.simulate import Simulation, simulate
    from fctd.steady.equilibrium import equilibrium
    from fctd.steady.refine import Refinement, refine
    from fctd.steady.steady_string import Equilibrium
    from fctd.steady.torque_drag import torque_drag

if TYPE_CHECKING:
    from fctd.calibration.calibrate import calibrate, predict
    from fctd.calibration.result import Calibration
    from fctd.monitoring.monitor import Monitored, monitor

__all__ = [
    "Calibration",
    "Case",
    "Contacts",
    "Equilibrium",
    "InputError",
    "Monitored",
    "Refinement",
    "Simulation",
    "SimulationResult",
    "Wellbore",
    "build_wellbore",
    "calibrate",
    "equilibrium",
    "find_contacts",
    "load_case",
    "monitor",
    "open_result",
    "predict",
    "refine",
    "simulate",
    "torque_drag",
]

# Names that are imported at their first use: the commands of charts and runs start sooner without them.
_LATER = {
    "Calibration": "fctd.calibration.result",
    "Monitored": "fctd.monitoring.monitor",
    "calibrate": "fctd.calibration.calibrate",
    "monitor": "fctd.monitoring.monitor",
    "predict": "fctd.calibration.calibrate",
}


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_LATER[name]), name)


def __dir__() -> list[str]:
    """The public names."""
    return sorted(__all__)
