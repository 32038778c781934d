"""The profile of a string: what its rows say agrees with the loads at its ends."""

import pytest

from fctd.equilibrium import equilibrium
from fctd.simulate import simulate
from tests.cases import make_case, pipe, rotation, trip

LONG = [pipe(100, 4), pipe(None, 1)]


@pytest.mark.parametrize("components", [[pipe(None, 8)], LONG], ids=["segments", "long segment"])
@pytest.mark.parametrize("kind", ["trip_in", "rotate_off_bottom", "drill_rotating"])
def test_the_ends_carry_hook_load_and_weight_on_bit(components: list[dict[str, object]], kind: str) -> None:
    case = make_case([[0, 0, 0], [400, 0, 0]], components, bit={"weight_on_bit": 20e3, "torque": 1e3})
    point = equilibrium(case, kind, 300.0)
    top, bit = point.profile.iloc[0], point.profile.iloc[-1]
    assert top["effective_tension_N"] == pytest.approx(point.hookload, rel=1e-6)
    assert top["torque_N_m"] == pytest.approx(point.surface_torque, abs=1e-3)
    assert bit["effective_tension_N"] == (-20e3 if kind == "drill_rotating" else 0)


@pytest.mark.parametrize("operation", [rotation(300, 2), trip(300, 310, speed=0.5)], ids=["rotating", "fed"])
def test_the_stepper_s_long_segment_hangs_from_the_hook(operation: dict[str, object]) -> None:
    result = simulate(make_case([[0, 0, 0], [400, 0, 0]], LONG, [operation]))
    last = result.profile.groupby("bit_depth_m").get_group(result.profile["bit_depth_m"].max()).iloc[0]
    # The profile has the length at the interval's end, the hook load its mean: half a metre of pipe, 0.1 %.
    assert last["effective_tension_N"] == pytest.approx(result.history["hookload_N"].iloc[-1], rel=1e-3)
