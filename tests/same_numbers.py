"""Loads of the examples, steady and in time, as JSON: what processors are compared by (tests/test_same_numbers.py)."""

import json
from pathlib import Path

import fctd

EXAMPLES = Path(__file__).parents[1] / "examples"
CASES = "my_well", "horizontal_well", "floated_casing", "drilling_well"
OPERATIONS = "trip_in", "trip_out", "rotate_off_bottom", "back_ream", "drill_rotating", "drill_sliding"
SHARES = 0.4, 0.7, 1.0  # of the total depth
LOADS = "hookload_N", "surface_torque_N_m", "total_contact_force_N"
RUN = "a minute"
MINUTE = {"kind": "rotate_off_bottom", "at_md": "1500 m", "duration": "60 s", "rpm": 60, "ramp_time": "10 s"}


def steady(name: str) -> list[dict[str, object]]:
    """Rows of a chart in six operations: operation, depth, status and loads."""
    case = fctd.load_case(EXAMPLES / f"{name}.toml")
    depths = [share * float(case.wellbore.trajectory[-1, 0]) for share in SHARES]
    table = fctd.torque_drag(case, operation=OPERATIONS, bit_depths=depths)
    return table[["operation", "bit_depth_m", "status", *LOADS]].to_dict("records")


def in_time(name: str) -> list[dict[str, object]]:
    """Loads of a minute of rotation, each second."""
    case = fctd.load_case(EXAMPLES / f"{name}.toml", overrides={"operations": [MINUTE], "record.interval": "1 s"})
    return fctd.simulate(case).history[list(LOADS)].to_dict("records")


def loads() -> dict[str, list[dict[str, object]]]:
    """Both, by the example's name."""
    return {name: steady(name) for name in CASES} | {RUN: in_time("my_well")}


if __name__ == "__main__":
    print(json.dumps(loads()))
