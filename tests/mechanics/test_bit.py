"""The bit on the bottom of the hole: one body, one step."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.mechanics import bit, state, topdrive
from fctd.mechanics.rock import DRAG_BIT, GIVEN_LOADS, Rock
from fctd.mechanics.topdrive import Motion
from tests.bodies import AXIS, FORCE, ON_LOWER, ON_UPPER, VELOCITY, at, place, put, set_body
from tests.compiled import kept

press_bit, drill = kept(bit.press_bit), kept(bit.drill)
DT, INERTIA = 1e-3, 5.0
LOADED = Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, bit_from=1.0, bit_to=1.0)
GIVEN = Rock(GIVEN_LOADS, weight=8e4, torque=3e3)
DRAG = Rock(DRAG_BIT, stiffness=1e8, worn=5e3, advance=2e-7, cutting=0.09, rubbing=0.03)


def bit_with(spin: float, torque: float = 0.0, speed: float = 0.0) -> tuple[Array, Array]:
    """A tilted body with a spin [rad/s], a torque of the joint above [N m] and a speed along its axis [m/s]."""
    S, top = state.new_state(1), np.zeros(topdrive.TOP_SIZE)
    place(S, 1, Rotation.from_rotvec([0.4, -0.3, 0.9]), [0.0, 0.0, 0.0])
    set_body(S, 1, 1000.0, 5000.0, INERTIA)
    S[state.WZ + 1] = spin
    put(S, 1, ON_LOWER, torque * at(S, 1, AXIS))
    put(S, 1, VELOCITY, speed * at(S, 1, AXIS))
    return S, top


def test_the_rock_pushes_along_the_bit_and_against_its_spin() -> None:
    S, top = bit_with(spin=10.0)
    press_bit(S, top, 1, GIVEN, LOADED, DT)
    assert at(S, 2, FORCE) == pytest.approx(8e4 * at(S, 1, AXIS))  # on the rock below the joint
    assert at(S, 2, ON_UPPER) == pytest.approx(-3e3 * at(S, 1, AXIS))
    S, top = bit_with(spin=-10.0)
    press_bit(S, top, 1, GIVEN, LOADED, DT)
    assert at(S, 2, ON_UPPER) == pytest.approx(3e3 * at(S, 1, AXIS))


def test_the_rock_pushes_along_the_hole_at_the_bit_and_not_along_a_bit_that_is_tilted() -> None:
    """In an arc of 100 m radius that begins downwards and builds to the north; the bit is 20 m along it."""
    S, top = bit_with(spin=10.0)
    S[state.ARM_BOTTOM + 1] = 4.0
    bottom, angle = at(S, 1, AXIS) * S[state.ARM_CONTACT + 1], 0.2
    put(S, 1, (state.TX, state.TY, state.TZ), np.array([0.0, 0.0, 1.0]))
    put(S, 1, (state.NX, state.NY, state.NZ), np.array([1.0, 0.0, 0.0]))
    S[state.CURVE + 1] = 0.01
    put(S, 1, (state.OX, state.OY, state.OZ), bottom - 100 * np.array([1 - np.cos(angle), 0.0, np.sin(angle)]))
    along = np.array([np.sin(angle), 0.0, np.cos(angle)])
    press_bit(S, top, 1, GIVEN, LOADED, DT)
    assert at(S, 2, FORCE) == pytest.approx(8e4 * along)
    lever = 4.0 * at(S, 1, AXIS)
    assert at(S, 2, ON_UPPER) == pytest.approx(-3e3 * at(S, 1, AXIS) + np.cross(lever, -8e4 * along))
    put(S, 1, VELOCITY, np.array([0.3, 0.0, 0.0]))
    S[state.WZ + 1] = 0.0
    drill(S, top, 1, DRAG, 1.0)
    assert top[topdrive.PRESSED] == pytest.approx(0.3 * np.sin(angle))


@pytest.mark.parametrize(("spin", "torque"), [(0.1, 0.0), (0.0, 2e3), (0.0, -2.9e3), (-0.2, 0.0)])
def test_a_torque_within_the_limit_stops_the_bit_and_does_not_turn_it(spin: float, torque: float) -> None:
    """The joint above and the rock together leave no spin at the end of the step."""
    S, top = bit_with(spin, torque)
    press_bit(S, top, 1, GIVEN, LOADED, DT)
    both = at(S, 1, ON_LOWER) + at(S, 2, ON_UPPER)
    assert spin + DT / INERTIA * float(both @ at(S, 1, AXIS)) == pytest.approx(0.0, abs=1e-12)


def test_a_motor_turns_the_bit_of_a_string_at_rest() -> None:
    S, top = bit_with(spin=0.0)
    press_bit(S, top, 1, GIVEN._replace(motor=12.0), LOADED, DT)
    assert at(S, 2, ON_UPPER) == pytest.approx(-3e3 * at(S, 1, AXIS))  # the string is twisted backwards


def test_the_bottom_moves_on_while_the_bit_turns() -> None:
    """In steady state it moves as the bit does; the depth of cut is (W − W_f) times the advance."""
    S, top = bit_with(spin=12.0, speed=0.004)
    for _ in range(20_000):
        press_bit(S, top, 1, DRAG, LOADED, DT)
        drill(S, top, 1, DRAG, DT)
    weight = 5e3 + 2 * math.pi * 0.004 / (12 * 2e-7)
    assert top[topdrive.BIT_WEIGHT] == pytest.approx(weight, rel=1e-6)
    assert top[topdrive.BIT_TORQUE] == pytest.approx(-0.09 * (weight - 5e3) - 0.03 * 5e3, rel=1e-6)
    assert top[topdrive.HOLE_MADE] == pytest.approx(20 * 0.004 - weight / 1e8, abs=1e-9)


@pytest.mark.parametrize("spin", [0.0, -12.0])
def test_nothing_is_drilled_at_rest_or_backwards(spin: float) -> None:
    S, top = bit_with(spin, speed=0.004)
    drill(S, top, 1, DRAG, 0.5)
    assert top[topdrive.HOLE_MADE] == 0.0
    assert top[topdrive.PRESSED] == pytest.approx(0.002)


def test_under_given_loads_the_bottom_is_the_deepest_point_of_the_bit() -> None:
    S, top = bit_with(spin=12.0, speed=0.01)
    top[topdrive.PRESSED] = -0.015
    found = []
    for speed in (0.01, 0.01, -0.01, 0.01, 0.01):
        put(S, 1, VELOCITY, speed * at(S, 1, AXIS))
        drill(S, top, 1, GIVEN, 1.0)
        found.append(float(top[topdrive.HOLE_MADE]))
    assert found == pytest.approx([0.0, 0.005, 0.005, 0.005, 0.015])
