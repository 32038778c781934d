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

from typing import TYPE_CHECKING

from fctd.public import offer

if TYPE_CHECKING:  # what ``offer`` reads
    from fctd.answers.checked import CheckedCase as CheckedCase, check_case as check_case
    from fctd.answers.comparison import Comparison as Comparison, compare as compare
    from fctd.answers.flow import (
        fastest_trips as fastest_trips,
        hydraulics_of as hydraulics_of,
        surge_pressures as surge_pressures,
    )
    from fctd.answers.rig import (
        Calibration as Calibration,
        Monitored as Monitored,
        calibrate as calibrate,
        monitor as monitor,
    )
    from fctd.answers.run import (
        Simulation as Simulation,
        SimulationResult as SimulationResult,
        open_result as open_result,
        simulate as simulate,
    )
    from fctd.answers.steady import (
        Chart as Chart,
        Equilibrium as Equilibrium,
        Refinement as Refinement,
        chart as chart,
        equilibrium as equilibrium,
        refine as refine,
        torque_drag as torque_drag,
    )
    from fctd.answers.swept import (
        Swept as Swept,
        Uncertainty as Uncertainty,
        run_sweep as run_sweep,
        run_uncertainty as run_uncertainty,
    )
    from fctd.arrays import Contacts as Contacts
    from fctd.calibration.calibrate import predict as predict
    from fctd.case.errors import InputError as InputError
    from fctd.case.load import Case as Case, load_case as load_case
    from fctd.model.first_case import new_case as new_case
    from fctd.model.wellbore import (
        Wellbore as Wellbore,
        build_wellbore as build_wellbore,
        find_contacts as find_contacts,
    )
    from fctd.steady.equilibrium import lie_along as lie_along
    from fctd.steady.free_point import free_point as free_point
    from fctd.steady.jar import jar_forces as jar_forces
    from fctd.steady.margin_table import limits_of as limits_of
    from fctd.steady.wear import casing_wear as casing_wear
    from fctd.store.origin import __version__ as __version__

__getattr__, __dir__, __all__ = offer(__name__, "plots", "view")
