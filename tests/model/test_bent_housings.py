"""Bent housings in time: at rest those of the steady string, and they turn with the string."""

from typing import Any

import numpy as np
import pytest

from fctd import equilibrium, simulate
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.energy import penetration
from fctd.mechanics.joints import find_bends
from fctd.model.bent_housings import bent_joints
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import settle
from tests.cases import make_case, pipe

BEND = np.radians(1.5)


def bent(toolface: float = 0.0, friction: float = 0.0, inclination: float = 60.0, **more: Any) -> Case:
    """60 m of collars in a straight hole; a housing of 1.5 deg 6 m above the bit."""
    turning = {"kind": "rotate_off_bottom", "at_md": 60, "duration": 12.0, "rpm": 30, "ramp_time": 2.0}
    motor = pipe(6, 4, outer=0.165, bend=BEND, toolface=toolface)
    return make_case(
        [[0, inclination, 0], [120, inclination, 0]],
        [motor, pipe(None, None, outer=0.165, segment_length=1.5)],
        [turning],
        wellbore={"geometry": "arcs", "intervals": [{"to_md": 120, "diameter": 0.2159, "friction": friction}]},
        **({"mud": {"density": 1200.0}} | more),
    )


def settled(case: Case, tolerance: float = 1e-6) -> Run:
    run, _ = prepare(case)
    settle(run, tolerance)
    return run


def pressed(run: Run) -> np.ndarray:
    """Contact forces (n,) [N]."""
    return np.maximum(penetration(run.S, run.segments), 0.0) * state.row(run.S, state.K_WALL, run.segments)


@pytest.mark.parametrize("toolface", [0.0, 2.0, np.pi])
def test_a_string_at_rest_presses_as_the_steady_one(toolface: float) -> None:
    """Up, sideways and down; the steady string is compared with beams by the study ``beam_in_hole``."""
    case = bent(toolface)
    run = settled(case)
    steady = equilibrium(case, operation="rotate_off_bottom", bit_depth=60.0)
    found, wanted = pressed(run), steady.profile["contact_force_N"].to_numpy()[1:]
    assert wanted.max() > 5e3
    np.testing.assert_allclose(found, wanted, atol=1e-3 * wanted.max())


def test_a_free_string_takes_the_shape_of_its_housing() -> None:
    """Hanging vertically without a wall, in mud so heavy that its weight hardly bends it back."""
    run = settled(bent(inclination=0.0, contact={"enabled": False}, mud={"density": 7000.0}), 1e-5)
    (joint,) = bent_joints(run.string)
    axes = np.array([[run.S[row + j] for row in (state.AX, state.AY, state.AZ)] for j in (joint - 1, joint)])
    assert np.arccos(axes[0] @ axes[1]) == pytest.approx(BEND, rel=1e-2)
    # Towards the high side, north in a vertical hole.
    assert axes[1][0] - axes[0][0] == pytest.approx(BEND, rel=1e-2)
    assert abs(axes[1][1]) < 1e-6
    bends = np.empty(run.segments)
    find_bends(run.S, run.segments, bends)
    assert bends.max() < 1e-2 * BEND


def test_a_housing_turns_with_the_string_and_its_energy_is_in_the_ledger() -> None:
    """In a slant hole the housing points up and down by turns, and the torque swings."""
    result = simulate(bent(friction=0.2))
    assert result.status == "completed"
    assert result.run["energy_error"] < 1e-3
    straight = simulate(bent(friction=0.2).model_copy(update={"string": make_case(
        components=[pipe(6, 4, outer=0.165), pipe(None, None, outer=0.165, segment_length=1.5)]
    ).string}))  # fmt: skip
    row, other = (r.operations.iloc[0] for r in (result, straight))
    assert row["surface_torque_mean_N_m"] > 1.1 * other["surface_torque_mean_N_m"]
    assert row["surface_torque_swing_N_m"] > 5 * other["surface_torque_swing_N_m"]


def test_half_a_turn_of_the_string_is_half_a_turn_of_the_tool_face() -> None:
    """Turned by half a turn and at rest again, the string presses as one that was laid with the opposite tool face."""
    run = settled(bent(0.7))
    n = run.segments
    q = [state.row(run.S, row, n).copy() for row in (state.QW, state.QX, state.QY, state.QZ)]
    # A half turn about the own axis of the bodies, the top drive's column included: q ⊗ k.
    for row, value in zip((state.QW, state.QX, state.QY, state.QZ), (-q[3], q[2], -q[1], q[0]), strict=True):
        state.row(run.S, row, n)[:] = value
    top = [float(run.S[row]) for row in (state.QW, state.QX, state.QY, state.QZ)]
    for row, value in zip((state.QW, state.QX, state.QY, state.QZ), (-top[3], top[2], -top[1], top[0]), strict=True):
        run.S[row] = value
    run.refresh()
    settle(run)
    opposite = settled(bent(0.7 + np.pi))
    np.testing.assert_allclose(pressed(run), pressed(opposite), atol=5.0)
