"""Differential sticking: the width that a cake seals, its growth and loss, and the force that it adds to friction."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.arrays import Array
from fctd.mechanics import cake, contact, state
from fctd.mechanics.state import Laws
from tests.bodies import AXIS, SPIN, TO_WALL, VELOCITY, at, put, set_body
from tests.compiled import kept

sealed_width = kept(cake.sealed_width)
thickness = kept(cake.thickness)
press = kept(cake.press_into_cake)

MASS, HOLE, RADIUS, STIFFNESS, DT = 400.0, 0.108, 0.08, 2e7, 1e-3
PRESSURE, LENGTH, FACTOR, CAKE_FACTOR = 3e6, 10.0, 0.2, 0.1
LAWS = Laws(state.ARCS, 2, 1.0, 0.0, 0.0, 0.0, cake_thickness=2e-3, cake_time=100.0, cake_friction=CAKE_FACTOR)
OWNER = np.zeros(3, np.int64)


def table(pressure: float = PRESSURE) -> Array:
    C = np.zeros((1, contact.COLUMNS))
    C[0, contact.OVERBALANCE] = pressure
    return C


def body(depth: float = 1e-4, age: float = 0.0, stuck: float = 1.0) -> Array:
    """A body along z on the wall on its x side."""
    S = state.new_state(1)
    set_body(S, 1, MASS, 300.0, 1.5)
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.K_WALL + 1] = RADIUS, HOLE, STIFFNESS
    S[state.ARM_BOTTOM + 1], S[state.FRICTION + 1] = 0.5 * LENGTH, FACTOR
    S[state.CAKE_AGE + 1], S[state.STUCK + 1] = age, stuck
    put(S, 1, TO_WALL, [HOLE - RADIUS + depth, 0, 0])
    put(S, 1, AXIS, [0, 0, 1])
    return S


@given(hole=st.floats(0.05, 0.3), share=st.floats(0.3, 0.95), part=st.floats(0.01, 0.99))
def test_the_width_is_the_chord_of_two_circles(hole: float, share: float, part: float) -> None:
    """Its end lies on the string, which touches the rock, and on the surface of the cake."""
    radius = share * hole
    h = part * min(hole - radius, radius)
    width = sealed_width(hole, radius, h)
    if width < 2 * radius:
        y = 0.5 * width
        x = np.sqrt((hole - h) ** 2 - y**2)
        assert np.hypot(x - (hole - radius), y) == pytest.approx(radius, rel=1e-9)
    else:
        assert hole - h * (2 * hole - h) / (2 * (hole - radius)) <= hole - radius


def test_there_is_no_width_without_cake_and_none_beyond_the_string() -> None:
    assert sealed_width(HOLE, RADIUS, 0.0) == 0
    assert sealed_width(HOLE, RADIUS, 0.05) == 2 * RADIUS
    assert sealed_width(RADIUS, RADIUS, 0.002) == 2 * RADIUS  # a stabiliser of the size of the hole


def test_cake_grows_as_the_root_of_time_to_its_final_thickness() -> None:
    assert [thickness(LAWS, age) for age in (0.0, 25.0, 100.0, 1e6)] == pytest.approx([0.0, 1e-3, 2e-3, 2e-3])


def test_below_a_point_that_sticks_it_ages() -> None:
    S = body(age=5.0)
    press(S, OWNER, 1, table(), LAWS, DT)
    assert S[state.CAKE_AGE + 1] == pytest.approx(5.0 + DT)


def test_a_point_that_slides_leaves_it_behind() -> None:
    """The age falls by the share of the length that is new; turning in place slides too."""
    for motion in ({VELOCITY: [0, 0, 0.5]}, {SPIN: [0, 0, 0.5 / RADIUS]}):
        S = body(age=50.0, stuck=0.0)
        for rows, values in motion.items():
            put(S, 1, rows, values)
            if rows == SPIN:
                put(S, 1, (state.GX, state.GY, state.GZ), values)
        press(S, OWNER, 1, table(), LAWS, DT)
        assert S[state.CAKE_AGE + 1] == pytest.approx(50.0 * (1 - 0.5 * DT / LENGTH), rel=1e-12)


def test_its_force_presses_string_and_wall_together_and_moves_neither() -> None:
    """Wall force K d + Δp b L; the string feels K d as without cake; friction is that of the two factors."""
    S = body(age=1e3)
    press(S, OWNER, 1, table(), LAWS, DT)
    force = PRESSURE * LENGTH * sealed_width(HOLE, RADIUS, 2e-3)
    depth = HOLE - RADIUS + 1e-4 - S[state.HOLE + 1] + RADIUS
    assert STIFFNESS * depth == pytest.approx(STIFFNESS * 1e-4 + force)
    assert at(S, 1, VELOCITY)[0] == pytest.approx(DT * force / MASS)  # what the moved wall takes back
    assert S[state.CAKE_IMPULSE + 1] == pytest.approx((CAKE_FACTOR - FACTOR) * force * DT)
    assert S[state.CAKE_AROUND + 1] == S[state.CAKE_IMPULSE + 1]
    assert S[state.MARGIN_END + 1] == -np.inf
    S = body(age=1e3)
    S[state.FRICTION_AROUND + 1] = 0.05
    press(S, OWNER, 1, table(), LAWS._replace(orthotropic=True), DT)
    assert S[state.CAKE_IMPULSE + 1] == pytest.approx((CAKE_FACTOR - FACTOR) * force * DT)
    assert S[state.CAKE_AROUND + 1] == pytest.approx((CAKE_FACTOR - 0.05) * force * DT)  # the cake's own, all around
    assert S[state.SUM_R_MU_N + 1] == pytest.approx(RADIUS * S[state.CAKE_AROUND + 1])


@pytest.mark.parametrize(("depth", "pressure", "age"), [(1e-4, 0.0, 10.0), (-1e-4, PRESSURE, 0.0), (-0.02, 1e3, 10.0)])
def test_there_is_none_on_a_tight_wall_off_the_wall_or_once_torn_off(depth, pressure, age) -> None:
    S = body(depth, age)
    press(S, OWNER, 1, table(pressure), LAWS, DT)
    assert S[state.CAKE_AGE + 1] == S[state.CAKE_IMPULSE + 1] == 0
    assert S[state.HOLE + 1] == HOLE
    assert not at(S, 1, VELOCITY).any()


def test_it_holds_a_string_that_is_pulled_off_with_less_than_its_force() -> None:
    S = body(depth=-1e-4, age=1e3)
    press(S, OWNER, 1, table(), LAWS, DT)
    assert S[state.CAKE_AGE + 1] > 0
    assert S[state.HOLE + 1] < HOLE


def test_it_pushes_a_tilted_body_as_the_wall_pushes_back() -> None:
    """Mud moves along sideways of the body and not along it, or it would push it along the hole."""
    S, tilt = body(age=1e3), 0.03
    S[state.HELD_BACK + 1] = 0.25 / MASS
    S[state.QW + 1], S[state.QY + 1] = np.cos(0.5 * tilt), np.sin(0.5 * tilt)
    press(S, OWNER, 1, table(), LAWS, DT)
    force = PRESSURE * LENGTH * sealed_width(HOLE, RADIUS, 2e-3)
    across, along = 0.75 * np.cos(tilt), np.sin(tilt)  # of the body, over force and mass; the wall is on the x side
    c, s = np.cos(tilt), np.sin(tilt)
    expected = DT * force / MASS * np.array([across * c + along * s, 0, along * c - across * s])
    np.testing.assert_allclose(at(S, 1, VELOCITY), expected, atol=1e-12)
