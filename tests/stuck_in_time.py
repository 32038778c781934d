"""Random wells whose string is stuck, in time: a body of it is held, and its top is pulled or turned."""

from random import Random
from typing import Any, NamedTuple

import numpy as np

from fctd.case.load import Case
from fctd.mechanics import state, topdrive
from fctd.simulation.simulate import Simulation
from tests.cases import make_case

HELD = [state.INVERSE_MASS, state.INVERSE_JT, state.INVERSE_JA, state.HELD_BACK, state.VX, state.VY, state.VZ, state.WX,
        state.WY, state.WZ]  # fmt: skip
OF_JOINT = {"force": [state.FX, state.FY, state.FZ], "moment": [state.LX, state.LY, state.LZ]}


class Reading(NamedTuple):
    """At one time [s]: hook load [N], travel of the block upwards [m], surface torque [N m], and tension [N] and torque
    [N m] just above the stuck point."""

    time: float
    hookload: float
    travel: float
    torque: float
    tension: float
    arrived: float


def stuck_well(seed: str, operation: dict[str, Any]) -> tuple[Case, float]:
    """A random case, its operation at its bit depth [m], and that depth."""
    rng = Random(seed)
    stations = [[0.0, 0.0, 0.0], [rng.uniform(200, 500), 0.0, rng.uniform(0, 360)]]
    for _ in range(rng.randint(3, 5)):
        md, inclination, azimuth = stations[-1]
        turned = min(max(inclination + rng.uniform(-10, 30), 0.0), 70.0), azimuth + rng.uniform(-25, 25)
        stations.append([md + rng.uniform(200, 500), *turned])
    depth, drilled = float(round(stations[-1][0] - 20)), rng.uniform(0.15, 0.35)
    parts = [
        {"name": "collars", "length": 100.0, "outer_diameter": "6.5 in", "inner_diameter": "2.8125 in",
         "segment_length": 10.0},
        {"name": "pipe", "outer_diameter": "5 in", "inner_diameter": "4.276 in", "contact_diameter": "6.625 in",
         "linear_mass": "31 kg/m", "segment_length": rng.choice([12.0, 20.0, 25.0])},
    ]  # fmt: skip
    at = {"at_md": depth} if operation["kind"] == "rotate_off_bottom" else {"from_md": depth, "to_md": depth - 1.2}
    hole = {"intervals": [{"to_md": stations[-1][0], "diameter": "8.5 in", "friction": drilled}], "geometry": "arcs"}
    # The top of the uppermost stand begins at the rotary table.
    rig = {"feed": "stands", "stand_length": depth / round(depth / 28), "block_weight": 3e5}
    case = make_case(
        stations, parts, [operation | at], wellbore=hole, mud={"density": 1200.0}, rig=rig, record={"interval": 0.2}
    )
    return case, depth


def readings(case: Case, depth: float, share: float) -> tuple[float, list[Reading]]:
    """The depth at which a body of a string is held [m], about a share of its length, and what the rig then reads."""
    simulation = Simulation(case)
    simulation.start()
    run = simulation.run
    string, S = run.string, run.S
    k = int(np.argmin(abs(string.above_bit[1:] - (1 - share) * depth))) + 1
    S[[row + k for row in HELD]] = 0.0

    def along(of: str) -> float:
        load = S[[row + k for row in OF_JOINT[of]]]
        return float(load @ S[[state.AX + k, state.AY + k, state.AZ + k]])

    rows = [
        Reading(row["time_s"], row["hookload_N"], float(run.top[topdrive.BLOCK_HEIGHT]), row["surface_torque_N_m"],
                -along("force"), along("moment"))
        for row in simulation
    ]  # fmt: skip
    assert simulation.status == "completed"
    return float(depth - string.above_bit[k] - 0.5 * string.length[k - 1]), rows
