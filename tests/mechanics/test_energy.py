"""The energy of one body, of a joint and of a wall, by hand."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.mechanics import state
from fctd.mechanics.energy import Energy, energy_of, penetration
from tests.bodies import PLACE, SPIN, TO_WALL, VELOCITY, place, put, set_body


def one_body() -> state.np.ndarray:
    """A buffer with one body at rest at the origin: 3 kg, 2 and 0.5 kg m²."""
    S = state.new_state(1)
    set_body(S, 1, 3.0, 2.0, 0.5)
    return S


def test_a_body_in_motion() -> None:
    """½ · 3 · (1 + 4 + 9) + ½ · 2 · (16 + 25) + ½ · 0.5 · 36 = 21 + 41 + 9 J."""
    S = one_body()
    put(S, 1, VELOCITY, [1.0, -2.0, 3.0])
    put(S, 1, SPIN, [4.0, 5.0, -6.0])
    assert energy_of(S, 1) == Energy(71.0, 0.0, 0.0, 0.0)


def test_a_body_below_the_rotary_table() -> None:
    """Its buoyed weight times its depth, which counts downwards."""
    S = one_body()
    put(S, 1, PLACE, [7.0, 8.0, 100.0])
    S[state.WEIGHT + 1] = 25.0
    assert energy_of(S, 1) == Energy(0.0, -2500.0, 0.0, 0.0)


def test_a_stretched_and_sheared_joint() -> None:
    """½ · 1000 · 0.02² + ½ · 400 · 0.03² J."""
    S = one_body()
    S[state.ARM_TOP + 1] = 0.5
    S[state.K_AXIAL + 1], S[state.K_SHEAR + 1] = 1000.0, 400.0
    put(S, 1, PLACE, [0.03, 0.0, 0.52])
    assert energy_of(S, 1).strain == pytest.approx(0.2 + 0.18, rel=1e-12)


@pytest.mark.parametrize(("axis", "stiffness"), [([0, 0, 1], 300.0), ([1, 0, 0], 500.0), ([0.6, 0.8, 0], 500.0)])
def test_a_twisted_or_bent_joint(axis: list[float], stiffness: float) -> None:
    """½ k φ² of the angle, about the string's axis or across it."""
    S = one_body()
    S[state.K_TWIST + 1], S[state.K_BEND + 1] = 300.0, 500.0
    place(S, 1, Rotation.from_rotvec(0.2 * np.array(axis)), [0.0, 0.0, 0.0])
    assert energy_of(S, 1).strain == pytest.approx(0.5 * stiffness * 0.2**2, rel=1e-12)


def test_whole_turns_of_twist_count() -> None:
    S = one_body()
    S[state.K_TWIST + 1], S[state.TURNS + 1] = 300.0, 2 * np.pi
    assert energy_of(S, 1).strain == pytest.approx(150 * (2 * np.pi) ** 2, rel=1e-12)


def test_a_body_pressed_into_the_wall() -> None:
    """10 mm deep: ½ · 10⁶ · 0.01² = 50 J; nothing with clearance, and nothing without a wall."""
    S = one_body()
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.K_WALL + 1] = 0.06, 0.1, 1e6
    put(S, 1, TO_WALL, [0.03, 0.04, 0.0])
    assert energy_of(S, 1).contact == pytest.approx(50.0, rel=1e-12)
    assert penetration(S, 1) == pytest.approx([0.01], rel=1e-12)
    S[state.RADIUS + 1] = 0.04
    assert energy_of(S, 1).contact == 0.0
    assert penetration(S, 1) == pytest.approx([-0.01], rel=1e-12)
    S[state.RADIUS + 1], S[state.HOLE + 1] = 0.06, 0.0
    assert energy_of(S, 1).contact == 0.0
    assert penetration(S, 1).tolist() == [-np.inf]


def test_the_parts_add_up_over_the_bodies() -> None:
    S = state.new_state(3)
    for j in (1, 2, 3):
        set_body(S, j, float(j), 1.0, 1.0)
        put(S, j, VELOCITY, [2.0, 0.0, 0.0])
        put(S, j, PLACE, [0.0, 0.0, 10.0 * j])
        S[state.WEIGHT + j] = 5.0
    assert energy_of(S, 3) == Energy(2.0 * (1 + 2 + 3), -5.0 * 10.0 * (1 + 2 + 3), 0.0, 0.0)
    assert energy_of(S, 1) == Energy(2.0, -50.0, 0.0, 0.0)
