"""Random wells, tripped in and out by stands and drilled: a run completes with its ledger, or says why not."""

from random import Random
from typing import Any

import pytest

from fctd import SimulationResult, simulate
from fctd.case.load import Case
from validation.parts.random_wells import well

LEDGER = 1e-3


def moving(seed: int, operations: list[dict[str, Any]], **tables: Any) -> SimulationResult:
    """The result of a random well whose string hangs from a block; depths of the operations are above the bit's."""
    rng = Random(1000 * seed)
    raw = well(rng, simulated=True)
    bit = round(raw["wellbore"]["stations"][-1][0] * rng.uniform(0.6, 0.95), 1)
    raw["string"]["top_md"] = 0.0
    raw["rig"] = raw.get("rig", {}) | {"feed": "stands", "connection_time": 10.0}
    depths = ("from_md", "to_md")
    raw["operations"] = [{k: v + bit if k in depths else v for k, v in move.items()} for move in operations]
    return simulate(Case.model_validate(raw | tables))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 3, 5])
def test_a_trip_in_and_out(seed: int) -> None:
    moves = {"speed": 0.5, "ramp_time": 5.0}
    result = moving(seed, [
        {"kind": "trip_in", "from_md": -30.0, "to_md": 0.0, **moves}, {"kind": "trip_out", "to_md": -30.0, **moves},
    ])  # fmt: skip
    assert result.status == "completed"
    assert result.run["energy_error"] <= LEDGER
    assert result.history["in_slips"].any()


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 3, 5])
def test_drilling(seed: int) -> None:
    move = {"kind": "drill_rotating", "from_md": 0.0, "to_md": 0.8, "speed": 0.02, "rpm": 100, "ramp_time": 5.0}
    result = moving(seed, [move], bit={"rock": {"wear_flat": "0.5 mm"}})
    assert result.status == "completed"
    assert result.run["energy_error"] <= LEDGER
    assert result.history["hole_made_m"].iloc[-1] > 0.1
