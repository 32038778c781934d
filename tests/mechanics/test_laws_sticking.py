"""Friction that sticks, one body at the wall: at rest up to the static limit, and less friction once it slides."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.arrays import Array
from fctd.mechanics import dynamics, state
from fctd.mechanics.law_names import CODES
from fctd.mechanics.state import Laws
from tests.bodies import FORCE, ON_LOWER, SPIN, TO_WALL, VELOCITY, at, put, set_body
from tests.compiled import kept

update_velocities = kept(dynamics.update_velocities)

MASS, HOLE, RADIUS, ARM, DEPTH, STIFFNESS, DT = 400.0, 0.1, 0.06, 0.7, 2e-3, 2e6, 1e-3
KINETIC, STATIC, DECAY = 0.2, 0.3, 0.1
NORMAL = STIFFNESS * DEPTH  # [N]
LAWS = [CODES["karnopp"], CODES["stribeck"]]
IMPLICIT = [CODES["coulomb"], *LAWS]


def body(stuck: float = 1.0, arm: float = ARM) -> Array:
    """A body along z at rest, pressed into the wall on its x side."""
    S = state.new_state(1)
    set_body(S, 1, MASS, 300.0, 1.5)
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.ARM_CONTACT + 1] = RADIUS, HOLE, arm
    S[state.K_WALL + 1], S[state.FRICTION + 1] = STIFFNESS, KINETIC
    S[state.EXCESS + 1], S[state.DECAY + 1], S[state.STUCK + 1] = STATIC / KINETIC - 1, DECAY, stuck
    put(S, 1, TO_WALL, [HOLE - RADIUS + DEPTH, 0, 0])
    return S


def push(S: Array, law: int, force: list[float], moment: list[float]) -> None:
    """One step under a force on the body [N] and a moment about its centre [N m]."""
    put(S, 1, FORCE, force)
    put(S, 1, ON_LOWER, moment)
    update_velocities(S, state.LANES, Laws(state.ARCS, law, 1.0, 0.0, 0.0, 0.0), DT)


def slide(S: Array, arm: float = ARM) -> Array:
    """Velocity of the body's surface along the wall (y, z) [m/s]."""
    speed = at(S, 1, VELOCITY) + np.cross(at(S, 1, SPIN), [RADIUS, 0, arm])
    return speed[1:]


small = st.floats(-1, 1)


@pytest.mark.parametrize("law", LAWS)
@given(force=st.tuples(small, small, small), moment=st.tuples(small, small, small))
def test_a_body_at_rest_does_not_move_below_the_static_limit(law: int, force, moment) -> None:
    """Whatever the direction of force and moment: the stopping impulse has two components, and no sliding is left."""
    S = body()
    push(S, law, [100 * f for f in force], [5 * m for m in moment])
    assert S[state.STUCK + 1] == 1
    np.testing.assert_allclose(slide(S), 0.0, atol=1e-16)
    assert S[state.LOST_FRICTION + 1] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("share", "stuck", "sticks"), [
    (0.999 * STATIC, 1.0, True), (1.001 * STATIC, 1.0, False),
    (0.999 * KINETIC, 0.0, True),
])  # fmt: skip
def test_it_breaks_away_at_the_static_limit(law: int, share: float, stuck: float, sticks: bool) -> None:
    S = body(stuck, arm=0.0)
    set_body(S, 1, MASS, 1e15, 1.5)  # does not tilt
    push(S, law, [0.0, 0.0, share * NORMAL], [0.0, 0.0, 0.0])
    assert S[state.STUCK + 1] == sticks
    assert (abs(at(S, 1, VELOCITY)[2]) < 1e-15) == sticks


@pytest.mark.parametrize(("law", "decay", "speed", "factor"), [
    ("karnopp", 0.0, 0.0, KINETIC), ("karnopp", 0.0, 0.5, KINETIC),
    ("stribeck", DECAY, DECAY, 0.5 * (KINETIC + STATIC)), ("stribeck", DECAY, 1e4 * DECAY, KINETIC),
])  # fmt: skip
def test_a_sliding_body_feels_the_kinetic_factor_after_the_decay_speed(law, decay, speed, factor) -> None:
    """Once it slides, a force between kinetic and static limit does not stop it."""
    S = body(stuck=0.0, arm=0.0)
    set_body(S, 1, MASS, 1e15, 1.5)
    S[state.DECAY + 1] = decay
    force = 0.5 * (KINETIC + STATIC) * NORMAL if speed == 0 else 0.0
    # The law takes the speed that static friction leaves.
    put(S, 1, VELOCITY, [0.0, 0.0, speed + (DT / MASS * STATIC * NORMAL if decay else 0.0)])
    speed = at(S, 1, VELOCITY)[2]
    push(S, CODES[law], [0.0, 0.0, force], [0.0, 0.0, 0.0])
    change = at(S, 1, VELOCITY)[2] - speed
    assert change == pytest.approx(DT / MASS * (force - factor * NORMAL), rel=1e-6)
    assert S[state.STUCK + 1] == 0


@pytest.mark.parametrize("law", IMPLICIT)
@given(velocity=st.tuples(small, small), spin=st.tuples(small, small, small), arm=st.floats(0.0, 1.4))
def test_friction_opposes_the_sliding_that_it_leaves(law: int, velocity, spin, arm) -> None:
    """A body that is held at its end yields up to five times more across than along: an impulse against the sliding
    before it would leave sliding in another direction."""
    S = body(arm=arm)
    S[state.EXCESS + 1] = 0.0
    put(S, 1, VELOCITY, [0.0, *velocity])
    put(S, 1, SPIN, [spin[0], spin[1], 5 * spin[2]])
    before = at(S, 1, VELOCITY)
    push(S, law, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    impulse, left = MASS * (at(S, 1, VELOCITY) - before)[1:], slide(S, arm)
    limit = KINETIC * NORMAL * DT
    if np.linalg.norm(left) < 1e-14:
        assert np.linalg.norm(impulse) <= limit * (1 + 1e-9)
    else:
        assert np.linalg.norm(impulse) == pytest.approx(limit, rel=1e-9)
        angle = np.arctan2(abs(impulse[0] * left[1] - impulse[1] * left[0]), -impulse @ left)
        assert np.degrees(angle) < 0.5


def test_without_friction_a_point_slides_on() -> None:
    S = body(stuck=0.0)
    S[state.FRICTION + 1] = 0.0
    put(S, 1, VELOCITY, [0.0, 0.3, 0.4])
    push(S, LAWS[0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert at(S, 1, VELOCITY)[1:].tolist() == [0.3, 0.4]
    assert S[state.STUCK + 1] == 0


def test_a_body_off_the_wall_does_not_stick() -> None:
    S = body()
    S[state.HOLE + 1] = 2 * HOLE
    push(S, LAWS[0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0])
    assert at(S, 1, VELOCITY)[2] == pytest.approx(DT / MASS)


def test_the_factor_of_mud_cake_changes_the_limit_and_never_below_zero() -> None:
    for more, sticks in ((DT * NORMAL, True), (-2 * KINETIC * DT * NORMAL, False)):
        S = body(stuck=0.0, arm=0.0)
        S[state.CAKE_IMPULSE + 1] = more
        push(S, LAWS[0], [0.0, 0.0, (KINETIC + 0.5) * NORMAL if sticks else 1.0], [0.0, 0.0, 0.0])
        assert S[state.STUCK + 1] == sticks
        if not sticks:
            assert at(S, 1, VELOCITY)[2] == pytest.approx(DT / MASS, rel=1e-9)
