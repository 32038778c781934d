"""A case with each feature and the same case without it, and the loads in which the feature shows."""

from collections.abc import Callable
from typing import Any, NamedTuple

from fctd import Case
from tests.cases import make_case, pipe, rotation, trip

BEND = [[0, 0, 0], [60, 0, 0], [160, 40, 30], [400, 40, 30]]
BUILD = [[0, 0, 0], [100, 0, 0], [220, 60, 0], [400, 60, 0]]
SLANT = [[0, 5, 0], [400, 5, 0]]
UPRIGHT = [[0, 0, 0], [400, 0, 0]]
LONG = {"components": [pipe(260, 13), pipe(None, 1)]}  # pipe that is fed from a long segment, which is upright


class Crossed(NamedTuple):
    """make : a case with the feature (True) or without it.  column : of the history, whose mean shows the feature."""

    make: Callable[[bool], Case]
    column: str


def case(stations: Any = BEND, **sections: Any) -> Case:
    """300 m of pipe that turn, in an 8.5 in hole."""
    given: dict[str, Any] = {
        "components": [pipe(300, 15)],
        "operations": [rotation(300, 1.5, ramp=0.5)],
        "record": {"interval": 0.25},
        "contact": {},
    }
    return make_case(stations, **(given | sections))


def _interval(**keys: Any) -> dict[str, Any]:
    return {"to_md": 400, "diameter": 0.2159, "friction": 0.2} | keys


def _hole(*intervals: dict[str, Any], **keys: Any) -> dict[str, Any]:
    return {"intervals": list(intervals), **keys}


def _stabiliser(contact: str) -> list[dict[str, Any]]:
    near_gauge = pipe(12, 1, outer=0.127, contact_diameter=0.2139, contact=contact)
    return [pipe(10, 2), near_gauge, pipe(58, 16)]


def _motor(bend: float) -> list[dict[str, Any]]:
    return [pipe(8, 4, outer=0.17, bend=bend, contact="point"), pipe(52, 13, outer=0.17)]


def _fitted(**keys: Any) -> list[dict[str, Any]]:
    centralisers = {"every": 12.0, "diameter": 0.19} | keys
    return [pipe(300, None, centralisers=centralisers)]


NARROW = _hole(_interval(diameter=0.18))
CROSSED: dict[str, Crossed] = {
    "wall": Crossed(lambda on: case(wellbore=_hole(_interval(friction=0.2 if on else 0.0))), "surface_torque_N_m"),
    "no_wall": Crossed(
        lambda on: case(
            SLANT, components=[pipe(60, 6)], operations=[rotation(60, 1.5, ramp=0.5)], contact={"enabled": not on}
        ),
        "surface_torque_N_m",
    ),
    "wall_law": Crossed(
        lambda on: case(contact={"law": "power", "exponent": 3.0, "reference_penetration": 1e-3} if on else {}),
        "contact_J",
    ),
    "stiffness_along_hole": Crossed(
        lambda on: case(wellbore=_hole(_interval(to_md=150), _interval(**({"stiffness": 4e5} if on else {})))),
        "contact_J",
    ),
    "friction_law": Crossed(
        lambda on: case(
            contact={"friction_law": "paper"} if on else {},
            operations=[trip(300, 302, 0.5, 1.0) | {"rpm": 60}],
            **LONG,
        ),
        "surface_torque_N_m",
    ),
    "sticking": Crossed(
        lambda on: case(
            wellbore=_hole(_interval(static_friction=0.4, decay_speed="5 m/s") if on else _interval()),
            contact={"friction_law": "stribeck"} if on else {},
        ),
        "surface_torque_N_m",
    ),
    "friction_along_hole": Crossed(
        lambda on: case(wellbore=_hole(_interval(to_md=150), _interval(friction=0.4 if on else 0.2))),
        "surface_torque_N_m",
    ),
    "orthotropic": Crossed(
        lambda on: case(wellbore=_hole(_interval(**({"rotational_friction": 0.1} if on else {})))),
        "surface_torque_N_m",
    ),
    "cake": Crossed(
        lambda on: case(
            wellbore=_hole(_interval(overbalance=2e6 if on else 0.0)),
            mud={"density": 1200.0, "viscosity": 0.0, "cake": {"friction": 0.1, "rested": 7200.0}},
            contact={"friction_law": "karnopp"},
        ),
        "surface_torque_N_m",
    ),
    "middle_contact": Crossed(
        lambda on: case(
            BUILD,
            components=_stabiliser("point" if on else "sleeve"),
            operations=[rotation(200, 1.5, ramp=0.5)],
            top_md=120.0,
        ),
        "surface_torque_N_m",
    ),
    "bends": Crossed(
        lambda on: case(UPRIGHT, components=_motor(0.03 if on else 0.0), operations=[rotation(60, 1.0, ramp=0.3)]),
        "surface_torque_N_m",
    ),
    "unbalance": Crossed(
        lambda on: case(
            UPRIGHT,
            components=[pipe(60, 12, outer=0.17, eccentricity=0.03 if on else 0.0)],
            wellbore=NARROW,
            operations=[rotation(60, 4.0, rpm=240, ramp=1.0)],
        ),
        "contact_J",
    ),
    "drive": Crossed(
        lambda on: case(rig={"drive": "speed_control", "control": {"inertia": 5000.0}} if on else {}),
        "top_rpm",
    ),
    "bit_loads": Crossed(
        lambda on: case(
            bit={"weight_on_bit": 3e4, "rock": {}},
            operations=[
                {"kind": "drill_rotating", "from_md": 300, "to_md": 300.05, "speed": 0.01, "rpm": 60, "ramp_time": 1.0}
                if on
                else trip(300, 300.05, 0.01, 1.0) | {"rpm": 60}
            ],
            **LONG,
        ),
        "hookload_N",
    ),
    "stands": Crossed(
        lambda on: case(
            rig={"feed": "stands" if on else "long_segment", "connection_time": 2.0},
            operations=[trip(300, 303, 0.5, 1.0)],
            **LONG,
        ),
        "hookload_N",
    ),
    "feed": Crossed(
        lambda on: case(operations=[trip(301, 300, 0.5, 0.5) if on else rotation(301, 2.0, ramp=0.5)], **LONG),
        "hookload_N",
    ),
    "incline": Crossed(lambda on: case(BEND if on else UPRIGHT), "surface_torque_N_m"),
    "mud_moves": Crossed(
        lambda on: case(
            mud={"density": 1200.0, "viscosity": 0.5 if on else 0.0}, operations=[trip(302, 300, 0.5, 0.1)], **LONG
        ),
        "hookload_max_N",
    ),
    "flow": Crossed(
        lambda on: case(
            UPRIGHT,
            mud={"density": 1200.0, "viscosity": 0.02},
            operations=[rotation(300, 1.5, ramp=0.5) | {"flow": 0.03 if on else 0.0}],
        ),
        "hookload_N",
    ),
    "mud_axial": Crossed(
        lambda on: case(mud={"axial_damping": 20.0 if on else 0.0}, operations=[trip(302, 300, 0.5, 1.0)], **LONG),
        "hookload_N",
    ),
    "mud_lateral": Crossed(
        lambda on: case(
            UPRIGHT,
            components=[pipe(60, 12, outer=0.17, eccentricity=0.03)],
            mud={"lateral_damping": 3000.0 if on else 0.0},
            operations=[rotation(60, 4.0, rpm=240, ramp=1.0)],
        ),
        "lateral_speed_m_s",
    ),
    "mud_spin": Crossed(lambda on: case(mud={"rotational_damping": 1.0 if on else 0.0}), "surface_torque_N_m"),
    "joint_damping": Crossed(
        lambda on: case(
            [[0, 0, 0], [60, 0, 0], [160, 40, 30], [300, 80, 30], [400, 80, 30]],
            solver={"joint_damping": 3e-3 if on else 1e-5},
            operations=[rotation(300, 1.5, rpm=180, ramp=0.5)],
        ),
        "surface_torque_N_m",
    ),
    "loss_factor": Crossed(
        lambda on: case(
            UPRIGHT, solver={"loss_factor": 0.2 if on else 0.0}, operations=[rotation(300, 1.5, rpm=120, ramp=0.2)]
        ),
        "surface_torque_max_N_m",
    ),
    "caliper": Crossed(  # a short hole: it is meshed, and the mesh is queried in every step
        lambda on: case(
            [[0, 0, 0], [20, 0, 0], [60, 20, 0], [100, 20, 0]],
            components=[pipe(80, 4)],
            operations=[rotation(80, 1.0, ramp=0.5)],
            wellbore=_hole(
                _interval(to_md=100),
                geometry="sampled",
                caliper={"rows": [[md, 0.2159, 0.4 if on else 0.2159] for md in (10, 90)]},
            ),
        ),
        "gravity_J",
    ),
    "own_friction": Crossed(
        lambda on: case(components=_fitted(**({"friction": 0.05} if on else {}))), "surface_torque_N_m"
    ),
    "bows": Crossed(
        lambda on: case(
            components=_fitted(diameter=0.23, stiffness=4e5, starting_force=500.0) if on else _fitted(diameter=0.21)
        ),
        "surface_torque_N_m",
    ),
    "swivel": Crossed(lambda on: case(components=[pipe(60, 6, swivel=on), pipe(240, 12)]), "surface_torque_N_m"),
    "overpull": Crossed(lambda on: case(bit={"overpull": 1e5} if on else {}), "hookload_N"),
    "fluids": Crossed(
        lambda on: case(
            mud={"density": 1200.0} | ({"inside": [{"density": 0.0}], "float": True} if on else {}),
        ),
        "hookload_N",
    ),
    "packer": Crossed(lambda on: case(mud={"packer_bore": 0.1} if on else {}), "hookload_N"),
    "temperature": Crossed(
        lambda on: case(UPRIGHT, temperature=[{"tvd": 0, "change": 80.0}] if on else []), "bit_md_m"
    ),
    "helical_force": Crossed(
        lambda on: case(contact={"helical_force": "analytic"} if on else {}), "total_contact_force_N"
    ),
}


def shown(result: Any, column: str) -> float:
    """The mean of a column of the history, or of the energies, of a result or of an engine's run."""
    table = result.history if column in result.history else result.energy
    return float(table[column].mean())
