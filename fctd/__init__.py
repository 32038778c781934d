"""FCTD: fast contact torque and drag of a stiff drill string in a wellbore.

    case = fctd.load_case("well.toml")
    result = fctd.simulate(case)
    for record in fctd.Simulation(case): print(record["hookload_N"])
    point = fctd.equilibrium(case, operation="trip_out", bit_depth="8000 ft")
    chart = fctd.torque_drag(case, operation=["trip_in", "trip_out"], bit_depths=range(1750, 2451, 10))
    left = fctd.margin_table(case, bit_depths=[2450])
    lost = fctd.pressure_losses(case, flow="2000 L/min")
    trips = fctd.surge_pressures(case, speeds=[0.5])
    found = fctd.monitor(case, "readings.csv")
    finer = fctd.refine(case, tolerance=0.01).case
    fitted = fctd.calibrate(case, "measured.csv", ["friction.open", "rig.block_weight"]).case

Units are SI; x is north, y east, z down.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fctd.calibration.calibrate import calibrate, predict
    from fctd.calibration.result import Calibration
    from fctd.case.errors import InputError
    from fctd.case.load import Case, load_case
    from fctd.hydraulics.pressures import pressure_losses
    from fctd.hydraulics.surge import fastest_trips, surge_pressures
    from fctd.model.wellbore import Contacts, Wellbore, build_wellbore, find_contacts
    from fctd.monitoring.monitor import Monitored, monitor
    from fctd.results.tables import SimulationResult, open_result
    from fctd.simulation.simulate import Simulation, simulate
    from fctd.steady.equilibrium import equilibrium, lie_along
    from fctd.steady.margin_table import margin_table
    from fctd.steady.refine import Refinement, refine
    from fctd.steady.steady_string import Equilibrium
    from fctd.steady.torque_drag import torque_drag

# Where each public name stands; it is imported at its first use.
_HOMES = {
    "Calibration": "fctd.calibration.result",
    "Case": "fctd.case.load",
    "Contacts": "fctd.model.wellbore",
    "Equilibrium": "fctd.steady.steady_string",
    "InputError": "fctd.case.errors",
    "Monitored": "fctd.monitoring.monitor",
    "Refinement": "fctd.steady.refine",
    "Simulation": "fctd.simulation.simulate",
    "SimulationResult": "fctd.results.tables",
    "Wellbore": "fctd.model.wellbore",
    "build_wellbore": "fctd.model.wellbore",
    "calibrate": "fctd.calibration.calibrate",
    "equilibrium": "fctd.steady.equilibrium",
    "fastest_trips": "fctd.hydraulics.surge",
    "find_contacts": "fctd.model.wellbore",
    "lie_along": "fctd.steady.equilibrium",
    "load_case": "fctd.case.load",
    "margin_table": "fctd.steady.margin_table",
    "monitor": "fctd.monitoring.monitor",
    "open_result": "fctd.results.tables",
    "predict": "fctd.calibration.calibrate",
    "pressure_losses": "fctd.hydraulics.pressures",
    "refine": "fctd.steady.refine",
    "simulate": "fctd.simulation.simulate",
    "surge_pressures": "fctd.hydraulics.surge",
    "torque_drag": "fctd.steady.torque_drag",
}
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
    "fastest_trips",
    "find_contacts",
    "lie_along",
    "load_case",
    "margin_table",
    "monitor",
    "open_result",
    "predict",
    "pressure_losses",
    "refine",
    "simulate",
    "surge_pressures",
    "torque_drag",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = getattr(import_module(_HOMES[name]), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    """The public names."""
    return sorted(__all__)
