"""FCTD: fast contact torque and drag of a stiff drill string in a wellbore.

    case = fctd.load_case("well.toml")
    told = fctd.check_case(case).warnings
    result = fctd.simulate(case)
    for record in fctd.Simulation(case): print(record["hookload_N"])
    point = fctd.equilibrium(case, operation="trip_out", bit_depth="8000 ft")
    chart = fctd.chart(case, operation=["trip_in", "trip_out"], bit_depths="shoe:td:50", friction=[0.2, 0.3])
    beside = fctd.compare([chart, fctd.chart(other, "trip_in", "shoe:td:50")])
    rows = fctd.torque_drag(case, operation=["trip_in", "trip_out"], bit_depths=range(1750, 2451, 10))
    left = fctd.limits_of(case, bit_depths="td")
    found = fctd.free_point(case, pull="200 kN", stretch="0.6 m")
    known = fctd.run_uncertainty(fctd.run_sweep("sweep.toml"))
    lost = fctd.hydraulics_of(case, flow="2000 L/min")
    trips = fctd.surge_pressures(case, speeds=[0.5])
    found = fctd.monitor(case, "readings.csv")
    finer = fctd.refine(case, tolerance=0.01).case
    fitted = fctd.calibrate(case, "measured.csv", ["friction.open", "rig.block_weight"]).case

Units are SI; x is north, y east, z down.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    __version__: str
    from fctd.answers.checked import CheckedCase, check_case
    from fctd.answers.comparison import Comparison, compare
    from fctd.answers.rig import Calibration, Monitored, calibrate, monitor
    from fctd.answers.run import Simulation, SimulationResult, open_result, simulate
    from fctd.answers.steady import Chart, Equilibrium, Refinement, chart, equilibrium, refine, torque_drag
    from fctd.answers.swept import Swept, Uncertainty, run_sweep, run_uncertainty
    from fctd.calibration.calibrate import predict
    from fctd.case.errors import InputError
    from fctd.case.load import Case, load_case
    from fctd.hydraulics.pressures import hydraulics_of
    from fctd.hydraulics.surge import fastest_trips, surge_pressures
    from fctd.model.first_case import new_case
    from fctd.model.wellbore import Contacts, Wellbore, build_wellbore, find_contacts
    from fctd.steady.equilibrium import lie_along
    from fctd.steady.free_point import free_point
    from fctd.steady.jar import jar_forces
    from fctd.steady.margin_table import limits_of
    from fctd.steady.wear import casing_wear

# Where each public name stands; it is imported at its first use.
_HOMES = {
    "Calibration": "fctd.answers.rig",
    "Case": "fctd.case.load",
    "Chart": "fctd.answers.steady",
    "CheckedCase": "fctd.answers.checked",
    "Comparison": "fctd.answers.comparison",
    "Contacts": "fctd.model.wellbore",
    "Equilibrium": "fctd.answers.steady",
    "InputError": "fctd.case.errors",
    "Monitored": "fctd.answers.rig",
    "Refinement": "fctd.answers.steady",
    "Simulation": "fctd.answers.run",
    "SimulationResult": "fctd.answers.run",
    "Swept": "fctd.answers.swept",
    "Uncertainty": "fctd.answers.swept",
    "Wellbore": "fctd.model.wellbore",
    "build_wellbore": "fctd.model.wellbore",
    "calibrate": "fctd.answers.rig",
    "casing_wear": "fctd.steady.wear",
    "chart": "fctd.answers.steady",
    "check_case": "fctd.answers.checked",
    "compare": "fctd.answers.comparison",
    "equilibrium": "fctd.answers.steady",
    "fastest_trips": "fctd.hydraulics.surge",
    "find_contacts": "fctd.model.wellbore",
    "free_point": "fctd.steady.free_point",
    "hydraulics_of": "fctd.hydraulics.pressures",
    "jar_forces": "fctd.steady.jar",
    "lie_along": "fctd.steady.equilibrium",
    "limits_of": "fctd.steady.margin_table",
    "load_case": "fctd.case.load",
    "monitor": "fctd.answers.rig",
    "new_case": "fctd.model.first_case",
    "open_result": "fctd.answers.run",
    "predict": "fctd.calibration.calibrate",
    "refine": "fctd.answers.steady",
    "run_sweep": "fctd.answers.swept",
    "run_uncertainty": "fctd.answers.swept",
    "simulate": "fctd.answers.run",
    "surge_pressures": "fctd.hydraulics.surge",
    "torque_drag": "fctd.answers.steady",
}
__all__ = [
    "Calibration",
    "Case",
    "Chart",
    "CheckedCase",
    "Comparison",
    "Contacts",
    "Equilibrium",
    "InputError",
    "Monitored",
    "Refinement",
    "Simulation",
    "SimulationResult",
    "Swept",
    "Uncertainty",
    "Wellbore",
    "build_wellbore",
    "calibrate",
    "casing_wear",
    "chart",
    "check_case",
    "compare",
    "equilibrium",
    "fastest_trips",
    "find_contacts",
    "free_point",
    "hydraulics_of",
    "jar_forces",
    "lie_along",
    "limits_of",
    "load_case",
    "monitor",
    "new_case",
    "open_result",
    "predict",
    "refine",
    "run_sweep",
    "run_uncertainty",
    "simulate",
    "surge_pressures",
    "torque_drag",
]


# Packages of public names, which need packages of their own.
_PACKAGES = ("plots", "view")


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return import_module(f"fctd.{name}")
    if name == "__version__":
        found: Any = import_module("importlib.metadata").version("fctd")
    elif name in _HOMES:
        found = getattr(import_module(_HOMES[name]), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    """The public names, and the packages of more."""
    return sorted([*__all__, *_PACKAGES])
