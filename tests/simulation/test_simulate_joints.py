"""Strings that resolve their joints in time, fed at the top and stand by stand, against those that do not."""

from typing import Any

import pytest

from fctd import Case, equilibrium, simulate
from tests.cases import make_case, pipe, rotation, trip

JOINT = {"length": 9.6, "tool_joint_length": 0.5, "tool_joint_diameter": 0.165, "tool_joint_inner": 0.083}


def well(operation: dict[str, Any], cut: dict[str, Any], **more: Any) -> Case:
    """Collars and 5 inch pipe in a well that builds to 50° and turns."""
    components = [pipe(30, 6, outer=0.165), pipe(None, None, inner=0.1086, joint=JOINT) | cut]
    hole = {"intervals": [{"to_md": 700, "diameter": 0.2159, "friction": 0.25}]}
    stations = [[0, 0, 0], [150, 0, 0], [400, 50, 30], [700, 50, 60]]
    return make_case(stations, components, [operation], wellbore=hole, mud={"density": 1200.0}, **more)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("operation", "rig", "at"),
    [
        (rotation(500, 20), {}, 500.0),
        (trip(160, 161.5, ramp=2), {"feed": "long_segment"}, 161.5),
        (trip(500, 503, 0.3, ramp=2), {"feed": "stands", "stand_length": 28.8}, 503.0),
        (trip(500, 498, 0.3, ramp=2), {"feed": "stands", "stand_length": 28.8}, 498.0),
    ],
)
def test_a_run_has_the_loads_of_steady_strings(operation: dict[str, Any], rig: dict[str, Any], at: float) -> None:
    """Of the resolved one, whose hook load is that of the coarse one."""
    case = well(operation, {"joint_segments": 3}, rig=rig)
    result = simulate(case)
    assert result.status == "completed"
    resolved, coarse = (
        equilibrium(well(operation, cut), operation["kind"], at) for cut in ({"joint_segments": 3}, {"segments": 50})
    )
    assert resolved.hookload == pytest.approx(coarse.hookload, rel=0.003)
    last = result.history["hookload_N"].iloc[-5:].mean()
    assert last == pytest.approx(resolved.hookload, rel=0.05)
    table = result.segments
    table = table[table["time_s"] == table["time_s"].max()]
    assert len(table) > 40
