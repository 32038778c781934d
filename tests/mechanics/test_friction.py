"""One body at the wall: the impulses of the normal force and of both laws of friction, and their energy losses."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.mechanics import dynamics, friction, state
from fctd.mechanics.law_names import CODES
from fctd.mechanics.laws import coulomb, paper
from fctd.mechanics.state import Laws
from tests.bodies import SPIN, TO_WALL, VELOCITY, at, place, put, set_body
from tests.compiled import kept

update_velocities = kept(dynamics.update_velocities)

MASS, INERTIA = 400.0, np.array([3000.0, 3000.0, 1.5])
HOLE, RADIUS, ARM, STIFFNESS, DT = 0.1, 0.06, 0.7, 2e6, 1e-3
unit = st.floats(-1, 1)
vector = st.tuples(unit, unit, unit)


@dataclass
class Pushed:
    """The effect of one push on a body.  Vectors are global; the wall lies at ``normal``, ``arm`` leads to T [m]."""

    S: Array
    turned: Rotation
    normal: Array
    arm: Array
    before: tuple[Array, Array]  # velocity [m/s] and spin [rad/s]
    after: tuple[Array, Array]
    impulse: Array  # change of momentum [N s] and of angular momentum about the centre [N m s]
    moment: Array

    def toward(self, motion: tuple[Array, Array]) -> float:
        """Speed of T towards the wall [m/s]."""
        return float(self.normal @ (motion[0] + np.cross(motion[1], self.arm)))

    def given(self, name: int) -> float:
        return float(self.S[name + 1])


def pushed(turn, off, velocity, spin, depth=2e-3, damping=0.0, mu=0.25, law=CODES["coulomb"]) -> Pushed:
    """A body in a hole, of any orientation and motion (global), pressed into the wall by ``depth`` [m]."""
    S = state.new_state(1)
    set_body(S, 1, MASS, INERTIA[0], INERTIA[2])
    turned = Rotation.from_rotvec(turn)
    place(S, 1, turned, [0.0, 0.0, 0.0])
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.ARM_CONTACT + 1] = RADIUS, HOLE, ARM
    S[state.K_WALL + 1], S[state.FRICTION + 1] = STIFFNESS, mu
    normal = np.array(off) / np.linalg.norm(off)
    put(S, 1, TO_WALL, (HOLE - RADIUS + depth) * normal)
    put(S, 1, VELOCITY, velocity)
    put(S, 1, SPIN, turned.inv().apply(spin))
    update_velocities(S, state.LANES, Laws(state.ARCS, law, 1.0, damping, 0.0, 0.0), DT)
    after = at(S, 1, VELOCITY), turned.apply(at(S, 1, SPIN))
    moment = turned.apply(INERTIA * turned.inv().apply(after[1] - spin))
    arm = ARM * turned.apply([0, 0, 1])
    return Pushed(S, turned, normal, arm, (np.array(velocity), np.array(spin)), after,
                  MASS * (after[0] - velocity), moment)  # fmt: skip


directions = vector.filter(lambda v: np.linalg.norm(v) > 0.1)


@given(vector, directions, vector, vector, st.floats(0, 5e4))
def test_the_wall_pushes_along_its_normal_by_spring_and_damper(turn, off, velocity, spin, damping) -> None:
    """K δ + c v with the speed v after the impulse (implicit damper), never a pull; the force acts at T."""
    body = pushed(turn, off, velocity, spin, damping=damping, mu=0.0)
    normal_impulse = body.given(state.SUM_NORMAL)
    expected = DT * (STIFFNESS * 2e-3 + damping * body.toward(body.after))
    assert normal_impulse == pytest.approx(max(expected, 0.0), rel=1e-9, abs=1e-12)
    assert normal_impulse >= 0
    np.testing.assert_allclose(body.impulse, -normal_impulse * body.normal, atol=1e-10)
    np.testing.assert_allclose(body.moment, np.cross(body.arm, body.impulse), atol=1e-9)
    # Loss in the damper: its impulse times the speed that moves the body.
    lost = (normal_impulse - DT * STIFFNESS * 2e-3) * body.toward(body.after)
    assert body.given(state.LOST_CONTACT) == pytest.approx(lost, rel=1e-8, abs=1e-10)
    assert body.given(state.LOST_FRICTION) == 0


def split(body: Pushed, loose: Pushed) -> tuple[Array, Array]:
    """Impulse and moment of friction alone: a push minus the same push without friction."""
    return body.impulse - loose.impulse, body.moment - loose.moment


@given(vector, directions, vector, vector, st.floats(0, 5e4))
def test_coulomb_friction_is_one_force_against_the_sliding_it_leaves_at_the_wall_side(
    turn, off, velocity, spin, damping
):
    """At T + r n in the plane of the wall: μN, or less if that stops the sliding; the ledger uses v after."""
    mu = 0.25
    body, loose = (pushed(turn, off, velocity, spin, damping=damping, mu=m) for m in (mu, 0.0))
    force, moment = split(body, loose)
    normal_impulse = loose.given(state.SUM_NORMAL)
    lever = body.arm + RADIUS * body.normal

    def slide(motion: tuple[Array, Array]) -> Array:
        speed = motion[0] + np.cross(motion[1], lever)
        return speed - (speed @ body.normal) * body.normal

    left, size = slide(body.after), float(np.linalg.norm(force))
    speed = float(np.linalg.norm(left))
    np.testing.assert_allclose(moment, np.cross(lever, force), atol=1e-9)
    np.testing.assert_allclose(force @ body.normal, 0.0, atol=1e-9)
    assert size <= mu * normal_impulse * (1 + 1e-9) + 1e-12
    if speed > 1e-9:
        assert size == pytest.approx(mu * normal_impulse, rel=1e-9, abs=1e-12)
        # Two iterations of Newton's method leave the direction by less than a degree.
        assert -force @ left >= np.cos(np.radians(1.0)) * size * speed - 1e-12
    assert body.given(state.SUM_R_MU_N) == pytest.approx(RADIUS * mu * normal_impulse, abs=1e-12)
    about_axis = float(moment @ body.turned.apply([0, 0, 1]))
    assert body.given(state.SUM_FRICTION_TORQUE) == pytest.approx(-about_axis, abs=1e-9)
    work = float(force @ body.after[0] + moment @ body.after[1])
    assert body.given(state.LOST_FRICTION) == pytest.approx(-work, abs=1e-9)


@given(vector, directions, vector, vector, st.sampled_from([2e-3, 2e-2, 0.3]))
def test_paper_friction_is_a_drag_along_the_axis_and_a_couple_about_it(turn, off, velocity, spin, depth) -> None:
    """Eqs 15–16: μN along the string and r μN about it, each at most what stops that motion."""
    mu = 0.25
    body, loose = (pushed(turn, off, velocity, spin, depth=depth, mu=m, law=CODES["paper"]) for m in (mu, 0.0))
    force, moment = split(body, loose)
    axis = body.turned.apply([0, 0, 1])
    limit = mu * loose.given(state.SUM_NORMAL)
    sliding, turning = (float(axis @ part) for part in loose.after)
    drag, couple = min(limit, MASS * abs(sliding)), min(RADIUS * limit, INERTIA[2] * abs(turning))
    np.testing.assert_allclose(force, -np.sign(sliding) * drag * axis, atol=1e-9)
    np.testing.assert_allclose(moment, -np.sign(turning) * couple * axis, atol=1e-9)
    assert body.given(state.SUM_FRICTION_TORQUE) == pytest.approx(np.sign(turning) * couple, abs=1e-9)
    work = float(force @ body.after[0] + moment @ body.after[1])
    assert body.given(state.LOST_FRICTION) == pytest.approx(-work, abs=1e-9)


@pytest.mark.parametrize("depth", [-1e-3, 0.0])
def test_no_impulse_clear_of_the_wall(depth: float) -> None:
    """The damper acts in contact only, whichever way the body moves."""
    S = state.new_state(1)
    set_body(S, 1, MASS, INERTIA[0], INERTIA[2])
    S[state.K_WALL + 1] = STIFFNESS
    for sign in (1, -1):
        moving = sign * 1.0, sign * 1.0, 0.0, 0.0, 0.0
        assert friction.normal_impulse(S, 1, *moving, 0.6, 0.8, 0.0, depth, 1e5, DT) == (0.0, 0.0)
    body = pushed((0.2, 0.1, 0.3), (1, 1, 0), (1, 1, 0), (1, -1, 4), depth=depth - 1e-9, damping=1e5)
    np.testing.assert_allclose(body.impulse, 0, atol=1e-11)
    np.testing.assert_allclose(body.moment, 0, atol=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("law", [coulomb.impulse, paper.impulse])
@pytest.mark.parametrize("limit", [1e-3, 1e9])
def test_friction_opposes_sliding_and_at_most_stops_it(law, limit: float) -> None:
    S = state.new_state(1)
    set_body(S, 1, 400.0, 3000.0, 1.0)
    S[state.RADIUS + 1], S[state.ARM_CONTACT + 1] = 0.06, 5.0
    motion = np.array([0.0, 0.3, 0.7, 0.0, 0.0, -4.0])  # across, along and spinning
    change = np.array(law(S, 1, 0.06, 1.0, *motion, 1.0, 0.0, 0.0, limit, None))
    after = motion + change

    def kinetic(m: np.ndarray) -> float:
        return float(200 * (m[:3] ** 2).sum() + 1500 * (m[3:5] ** 2).sum() + 0.5 * m[5] ** 2)

    assert kinetic(after) < kinetic(motion)
    if law is paper.impulse:
        assert after[2] * motion[2] >= -1e-12
        assert after[5] * motion[5] >= -1e-12
        if limit > 1:
            assert after[2] == pytest.approx(0, abs=1e-12)
            assert after[5] == pytest.approx(0, abs=1e-12)
    elif limit < 1:
        # Force and torque of one force: its share about the axis follows the direction of the sliding that is left.
        sliding = np.array([after[1] + 0.06 * after[5] - 5.0 * after[3], after[2]])
        direction = sliding / np.linalg.norm(sliding)
        assert change[2] == pytest.approx(-limit * direction[1] / 400, rel=1e-9)
        assert change[5] == pytest.approx(-limit * 0.06 * direction[0] / 1.0, rel=1e-9)


@pytest.mark.parametrize("offset", [0.0, 1e-197, 1e-165, 1e-140])
def test_a_turning_body_on_the_axis_of_its_hole_touches_nothing(offset):
    S = state.new_state(1)
    set_body(S, 1, 10.0, 1.0, 0.02)
    S[state.QW + 1] = S[state.HOLE + 1] = 1.0
    S[state.PX + 1], S[state.RADIUS + 1], S[state.WZ + 1] = offset, 0.05, 6.28
    penetration, *normal = friction.wall_normal(S, 1)
    assert penetration == pytest.approx(-0.95)
    assert np.linalg.norm(normal) <= 1 + 1e-12
    change = coulomb.impulse(S, 1, 0.05, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 6.28, *normal, 0.0, None)
    assert change == (0.0,) * 6


@pytest.mark.parametrize(("geometry", "law", "pressed", "rubbed"), [
    (state.OPEN, CODES["coulomb"], False, False), (state.OPEN, CODES["paper"], False, False),
    (state.CYLINDERS, CODES["paper"], True, False), (state.ARCS, CODES["paper"], True, False),
    (state.CYLINDERS, CODES["coulomb"], True, True), (state.ARCS, CODES["coulomb"], True, True),
])  # fmt: skip
def test_a_run_follows_its_laws(geometry: int, law: int, pressed: bool, rubbed: bool) -> None:
    """A body that slides around the wall: only ``coulomb`` friction resists that, and without a hole nothing does."""
    S = state.new_state(1)
    set_body(S, 1, MASS, INERTIA[0], INERTIA[2])
    S[state.RADIUS + 1], S[state.HOLE + 1] = RADIUS, HOLE
    S[state.K_WALL + 1], S[state.FRICTION + 1] = STIFFNESS, 0.25
    put(S, 1, TO_WALL, [HOLE - RADIUS + 2e-3, 0, 0])
    put(S, 1, VELOCITY, [0, 0.5, 0])
    update_velocities(S, state.LANES, Laws(geometry, law, 1.0, 0.0, 0.0, 0.0), DT)
    x, y, z = at(S, 1, VELOCITY)
    impulse = DT * STIFFNESS * 2e-3
    assert x == pytest.approx(-impulse / MASS if pressed else 0.0)
    assert y == pytest.approx(0.5 - 0.25 * impulse / MASS if rubbed else 0.5)
    assert z == 0
