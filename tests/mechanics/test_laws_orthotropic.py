"""Friction that differs along and around the string: an ellipse, and on it the force that takes most energy.

All numbers are exact: the associated law is F = −N (μ_a² v_a, μ_r² v_r)/√(μ_a² v_a² + μ_r² v_r²).
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fctd.mechanics import dynamics, state
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES, NAMES
from fctd.mechanics.laws import shares, steady_load
from fctd.mechanics.state import Laws
from references.soft_string.directions import associated, by_components, largest_turn
from tests.bodies import FORCE, ON_LOWER, SPIN, TO_WALL, VELOCITY, Array, at, place, put, set_body
from tests.compiled import kept

update_velocities = kept(dynamics.update_velocities)

NORMAL_FORCE, CONTACT = 10.0, 0.05  # [N], contact radius [m]
ONE_FORCE = [name for name in NAMES if name != "paper"]
factors = st.floats(0.02, 1.0)
angles = st.floats(0.0, 2 * np.pi)


@entry
def chosen(code, speed, spin, limit, around):
    """Steady load of a string along z that touches the wall on its x side, in a hole along z."""
    return steady_load(code, speed, spin, limit, around, CONTACT, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@entry
def share_of(code, speed, turning, limit, around):
    """Shares of the first guess."""
    return shares(code, speed, turning, limit, around)


def friction(law: str, v_a: float, v_r: float, along: float, around: float) -> Array:
    """Force along the string and around it [N] of a surface that slides with v_a and v_r [m/s]."""
    fx, fy, fz, mx, my, mz, torque = chosen(
        CODES[law], float(v_a), float(v_r) / CONTACT, along * NORMAL_FORCE, around * NORMAL_FORCE
    )
    if law != "paper":
        assert abs(fx) <= 1e-15
        assert (mx, my, mz) == pytest.approx((0.0, -CONTACT * fz, CONTACT * fy))  # the force acts at the surface
    return np.array([fz, torque / CONTACT])


def ellipse(along: float, around: float, count: int = 400) -> Array:
    """Forces (count, 2) on the ellipse [N]."""
    phi = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return NORMAL_FORCE * np.column_stack([along * np.cos(phi), around * np.sin(phi)])


@pytest.mark.parametrize("law", NAMES)
@given(along=factors, around=factors, speed=st.floats(1e-3, 10.0))
def test_pure_motions_have_their_own_factor(law, along, around, speed) -> None:
    for sign in (1, -1):
        slid = friction(law, sign * speed, 0.0, along, around)
        turned = friction(law, 0.0, sign * speed, along, around)
        assert slid == pytest.approx([-sign * along * NORMAL_FORCE, 0.0], abs=1e-12 * NORMAL_FORCE)
        assert turned == pytest.approx([0.0, -sign * around * NORMAL_FORCE], abs=1e-12 * NORMAL_FORCE)


@pytest.mark.parametrize("law", ONE_FORCE)
@given(along=factors, around=factors, psi=angles, speed=st.floats(1e-6, 10.0))
def test_the_force_is_the_associated_one(law, along, around, psi, speed) -> None:
    """On the ellipse, odd in the sliding and independent of its size; the ellipse's normal there opposes it."""
    v = speed * np.array([np.cos(psi), np.sin(psi)])
    force = friction(law, *v, along, around)
    half = NORMAL_FORCE * np.array([along, around])
    assert np.sum((force / half) ** 2) == pytest.approx(1.0, abs=1e-12)
    exact = -NORMAL_FORCE * np.array(associated(along, around, *v))
    np.testing.assert_allclose(force, exact, rtol=0, atol=1e-12 * half.max())
    np.testing.assert_allclose(friction(law, *-v, along, around), -force, rtol=0, atol=1e-12 * half.max())
    np.testing.assert_allclose(friction(law, *(3 * v), along, around), force, rtol=0, atol=1e-12 * half.max())
    np.testing.assert_allclose(
        friction(law, v[0], -v[1], along, around), force * [1, -1], rtol=0, atol=1e-12 * half.max()
    )
    # The normal of the ellipse at the force, its gradient, points against the sliding.
    gradient = force / half**2
    assert abs(gradient[0] * v[1] - gradient[1] * v[0]) <= 1e-12 * np.linalg.norm(gradient) * speed


@pytest.mark.parametrize("law", ONE_FORCE)
@given(along=factors, around=factors, psi=angles)
def test_no_other_force_in_the_ellipse_takes_more_energy(law, along, around, psi) -> None:
    v = np.array([np.cos(psi), np.sin(psi)])
    taken = -float(friction(law, *v, along, around) @ v)
    assert taken == pytest.approx(NORMAL_FORCE * np.hypot(along * v[0], around * v[1]), abs=1e-12 * NORMAL_FORCE)
    assert taken >= -1e-15
    assert (-(ellipse(along, around) @ v)).max() <= taken * (1 + 1e-12)


@given(along=factors, psi=angles)
def test_equal_factors_are_coulombs_law(along, psi) -> None:
    v = np.array([np.cos(psi), np.sin(psi)])
    one = chosen(CODES["coulomb"], float(v[0]), float(v[1]) / CONTACT, along * NORMAL_FORCE, None)
    two = chosen(CODES["coulomb"], float(v[0]), float(v[1]) / CONTACT, along * NORMAL_FORCE, along * NORMAL_FORCE)
    np.testing.assert_allclose(two, one, rtol=0, atol=1e-12 * NORMAL_FORCE)


@pytest.mark.parametrize("law", ONE_FORCE)
def test_a_direction_without_friction_takes_nothing(law) -> None:
    """Of a string that turns in place only a rounding error slides along it, and has no friction."""
    for v_a, v_r, along, around in ((0.0, 1.0, 0.3, 0.0), (1e-17, 1.0, 0.3, 0.0), (1.0, 0.0, 0.0, 0.3)):
        assert np.abs(friction(law, v_a, v_r, along, around)).max() < 1e-6 * NORMAL_FORCE
    assert friction(law, 1e-3, 1.0, 0.3, 0.0) == pytest.approx([-0.3 * NORMAL_FORCE, 0.0], abs=1e-11)
    assert friction(law, 1.0, 1.0, 0.0, 0.0).tolist() == [0.0, 0.0]
    assert friction(law, 0.0, 0.0, 0.3, 0.2).tolist() == [0.0, 0.0]


@pytest.mark.parametrize("law", NAMES)
@given(along=factors, around=factors, psi=angles)
def test_the_first_guess_has_the_same_shares(law, along, around, psi) -> None:
    v_a, v_r = float(np.cos(psi)), float(np.sin(psi))
    force = friction(law, v_a, v_r, along, around) / NORMAL_FORCE
    down, about, climbs = share_of(CODES[law], v_a, v_r, along, around)
    np.testing.assert_allclose([-down, -about], force, rtol=0, atol=1e-12)
    assert climbs == (0.0 if law == "paper" else about)


@pytest.mark.slow
@given(ratio=st.floats(0.05, 20.0))
def test_the_law_of_components_lies_on_the_same_ellipse_and_takes_less(ratio) -> None:
    along, around = 0.3, 0.3 * ratio
    psi = np.linspace(0.01, np.pi / 2 - 0.01, 501)
    turn = []
    for angle in psi:
        v = np.array([np.cos(angle), np.sin(angle)])
        one, other = (np.array(law(along, around, *v)) for law in (associated, by_components))
        assert np.sum((other / [along, around]) ** 2) == pytest.approx(1.0, abs=1e-12)
        assert 0 <= other @ v <= one @ v * (1 + 1e-12)
        turn.append(abs(np.arctan2(one[1] / around, one[0] / along) - angle))
    assert max(turn) == pytest.approx(largest_turn(ratio), abs=1e-4)
    tangent = 1 / np.sqrt(ratio)
    one, other = (law(along, around, 1.0, tangent) for law in (associated, by_components))
    assert one.along / other.along == pytest.approx(tangent, rel=1e-9)


# One body at the wall, in time.
MASS, INERTIA, HOLE, RADIUS, DEPTH, STIFFNESS, DT = 400.0, np.array([300.0, 300.0, 1.5]), 0.1, 0.06, 2e-3, 2e6, 1e-3
NORMAL = STIFFNESS * DEPTH  # force of the wall [N]
IMPULSE = DT * NORMAL  # [N s]


def body(
    along: float, around: float, turn: Array | None = None, arm: float = 0.0, tilt: float = 0.0
) -> tuple[Array, Rotation, Array]:
    """A body of any orientation that is pressed into the wall: buffer, orientation, and normal (global).

    tilt [rad] : of the string against the wall.
    """
    S, turned = state.new_state(1), Rotation.from_rotvec(np.zeros(3) if turn is None else turn)
    set_body(S, 1, MASS, INERTIA[0], INERTIA[2])
    place(S, 1, turned, [0.0, 0.0, 0.0])
    S[state.RADIUS + 1], S[state.HOLE + 1], S[state.ARM_CONTACT + 1] = RADIUS, HOLE, arm
    S[state.K_WALL + 1], S[state.FRICTION + 1], S[state.FRICTION_AROUND + 1] = STIFFNESS, along, around
    normal = turned.apply(Rotation.from_rotvec([0.0, tilt, 0.0]).apply([1.0, 0.0, 0.0]))
    put(S, 1, TO_WALL, (HOLE - RADIUS + DEPTH) * normal)
    return S, turned, normal


def laws(law: str) -> Laws:
    return Laws(state.ARCS, CODES[law], 1.0, 0.0, 0.0, 0.0, orthotropic=True)


def slid(turned: Rotation, normal: Array, velocity: Array, spin: Array, arm: float = 0.0) -> Array:
    """Sliding of the surface along the string and around it [m/s]; velocity and spin are global."""
    axis = turned.apply([0, 0, 1])
    speed = velocity + np.cross(spin, arm * axis + RADIUS * normal)
    e_a = axis - (axis @ normal) * normal
    e_a /= np.linalg.norm(e_a)
    return np.array([speed @ e_a, speed @ np.cross(e_a, normal)])


def rubbed(law: str, along: float, around: float, turn, velocity, spin, arm: float = 0.7):
    """Impulse of friction (along, around) [N s], what is left of the sliding [m/s], and the buffer."""
    after, frames = [], None
    for factors_here in ((0.0, 0.0), (along, around)):
        S, turned, normal = body(*factors_here, turn, arm, tilt=0.03)
        put(S, 1, VELOCITY, velocity)
        put(S, 1, SPIN, turned.inv().apply(spin))
        update_velocities(S, state.LANES, laws(law), DT)
        after.append((at(S, 1, VELOCITY), turned.apply(at(S, 1, SPIN))))
        frames = turned, normal
    assert frames is not None
    turned, normal = frames
    axis = turned.apply([0, 0, 1])
    e_a = axis - (axis @ normal) * normal
    e_a /= np.linalg.norm(e_a)
    change = MASS * (after[1][0] - after[0][0])
    assert abs(change @ normal) <= 1e-9 * IMPULSE
    impulse = np.array([change @ e_a, change @ np.cross(e_a, normal)])
    torque = INERTIA[2] * float((after[1][1] - after[0][1]) @ axis)
    # The torque about the string is that of the component around it alone.
    assert torque == pytest.approx(RADIUS * impulse[1] * np.linalg.norm(np.cross(axis, normal)), abs=1e-9 * IMPULSE)
    before = slid(turned, normal, *after[0], arm)
    return impulse, slid(turned, normal, *after[1], arm), before, S


unit = st.floats(-1, 1)
vector = st.tuples(unit, unit, unit)


@pytest.mark.parametrize("law", ONE_FORCE)
@settings(max_examples=60)  # a dozen of each pair of factors
@given(
    turn=vector, velocity=vector, spin=vector, arm=st.sampled_from([0.0, 0.7, 1.4]),
    factors=st.sampled_from([(0.3, 0.1), (0.1, 0.3), (0.25, 0.2), (0.3, 0.03), (0.03, 0.3)]),
)  # fmt: skip
def test_an_impulse_is_the_associated_one_of_the_sliding_that_it_leaves(
    law, turn, velocity, spin, arm, factors
) -> None:
    along, around = factors
    impulse, left, before, S = rubbed(law, along, around, np.array(turn), velocity, np.array(spin) * [1, 1, 5], arm)
    half = IMPULSE * np.array([along, around])
    size = np.hypot(*(impulse / half))
    assert impulse @ left <= 1e-12
    assert impulse @ before <= 1e-12
    if np.linalg.norm(left) < 1e-12:
        assert size <= 1 + 1e-9
        return
    assert size == pytest.approx(1.0, abs=1e-9)
    # In the coordinates in which the ellipse is a circle the impulse opposes what is left.
    one, other = -impulse / half, half * left
    angle = np.arctan2(abs(one[0] * other[1] - one[1] * other[0]), one @ other)
    barely = np.linalg.norm(half * left) < 1e-6 * np.linalg.norm(half * before)  # rounding is all that is left
    assert np.degrees(angle) < 0.05 or barely
    lost = float(S[state.LOST_FRICTION + 1])
    assert lost >= -1e-12


@pytest.mark.parametrize("law", ["karnopp", "stribeck", "coulomb"])
@given(phi=angles, size=st.floats(0.0, 0.999))
def test_a_body_at_rest_stays_within_the_ellipse(law, phi, size) -> None:
    along, around = 0.3, 0.12
    S, turned, normal = body(along, around)
    axis = turned.apply([0, 0, 1])
    e_a = axis - (axis @ normal) * normal
    e_a /= np.linalg.norm(e_a)
    force = size * NORMAL * (along * np.cos(phi) * e_a + around * np.sin(phi) * np.cross(e_a, normal))
    put(S, 1, FORCE, force)  # at the centre; with its moment about it, as if it pushed at the surface
    put(S, 1, ON_LOWER, np.cross(RADIUS * normal, force))
    update_velocities(S, state.LANES, laws(law), DT)
    velocity, spin = at(S, 1, VELOCITY), turned.apply(at(S, 1, SPIN))
    np.testing.assert_allclose(slid(turned, normal, velocity, spin), 0.0, atol=1e-15)


@pytest.mark.parametrize(("share", "sticks"), [(0.999, True), (1.001, False)])
@given(phi=angles)
def test_the_static_factor_scales_the_ellipse(share, sticks, phi) -> None:
    along, around, static = 0.3, 0.12, 0.4
    S, turned, normal = body(along, around)
    S[state.EXCESS + 1], S[state.STUCK + 1] = static / along - 1, 1.0
    axis = turned.apply([0, 0, 1])
    e_a = axis - (axis @ normal) * normal
    e_a /= np.linalg.norm(e_a)
    size = share * static / along * NORMAL
    force = size * (along * np.cos(phi) * e_a + around * np.sin(phi) * np.cross(e_a, normal))
    put(S, 1, FORCE, force)
    put(S, 1, ON_LOWER, np.cross(RADIUS * normal, force))
    update_velocities(S, state.LANES, laws("karnopp"), DT)
    assert S[state.STUCK + 1] == sticks


@pytest.mark.parametrize("speed", [0.05, 0.1, 1e3])
@pytest.mark.parametrize("phi", [0.0, 0.5 * np.pi])
def test_friction_falls_with_the_size_of_the_sliding(speed, phi) -> None:
    """Law ``stribeck`` along and around: μ_k + (μ_s − μ_k)/(1 + (v/v_s)²) with the true v, not the scaled one."""
    along, around, more, decay = 0.2, 0.1, 0.5, 0.1
    S, _, _ = body(along, around)
    set_body(S, 1, MASS, 1e15, 1e15)  # moves without turning
    put(S, 1, TO_WALL, [HOLE - RADIUS + DEPTH, 0, 0])
    S[state.EXCESS + 1], S[state.DECAY + 1] = more, decay
    factor = along if phi == 0 else around
    # The law takes the speed that static friction leaves.
    v = speed + DT / MASS * factor * (1 + more) * NORMAL
    put(S, 1, VELOCITY, [0.0, v * np.sin(phi), v * np.cos(phi)])
    update_velocities(S, state.LANES, laws("stribeck"), DT)
    taken = MASS / DT * (v - np.linalg.norm(at(S, 1, VELOCITY)[1:]))
    assert taken == pytest.approx(factor * NORMAL * (1 + more / (1 + (speed / decay) ** 2)), rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("law", ONE_FORCE)
@given(velocity=vector, spin=vector)
def test_one_factor_may_be_zero(law, velocity, spin) -> None:
    for along, around in ((0.3, 0.0), (0.0, 0.3), (0.0, 0.0), (0.3, 1e-12), (1e-200, 0.3)):
        impulse, left, _, S = rubbed(law, along, around, np.zeros(3), velocity, spin)
        assert np.isfinite(state.columns(S)).all()
        free = int(along > 1e-9), int(around > 1e-9)
        for k in range(2):
            limit = IMPULSE * (along, around)[k]
            assert abs(impulse[k]) <= limit + 1e-9 * IMPULSE
        if sum(free) == 1:
            k = free.index(1)
            if abs(left[k]) > 1e-12:
                assert abs(impulse[k]) == pytest.approx(IMPULSE * (along, around)[k], rel=1e-9)
                assert impulse[k] * left[k] < 0


def test_a_body_off_the_wall_is_not_stuck() -> None:
    S, _, _ = body(0.3, 0.1)
    S[state.HOLE + 1] = 2 * HOLE
    put(S, 1, VELOCITY, [0.0, 0.2, 0.3])
    S[state.STUCK + 1] = 1.0
    S[state.HOLE + 2], S[state.RADIUS + 2] = 0.0, 1.0  # the body beside it in the operation is at the wall
    update_velocities(S, state.LANES, laws("karnopp"), DT)
    assert S[state.STUCK + 1] == 0
    assert at(S, 1, VELOCITY).tolist() == [0.0, 0.2, 0.3]


def test_paper_has_the_one_for_its_force_and_the_other_for_its_couple() -> None:
    S, _, _ = body(0.3, 0.1)
    put(S, 1, TO_WALL, [HOLE - RADIUS + DEPTH, 0, 0])
    put(S, 1, VELOCITY, [0.0, 0.0, 1.0])
    put(S, 1, SPIN, [0.0, 0.0, 1.0])
    update_velocities(S, state.LANES, laws("paper"), DT)
    assert MASS * (1.0 - at(S, 1, VELOCITY)[2]) == pytest.approx(0.3 * IMPULSE)
    assert INERTIA[2] * (1.0 - at(S, 1, SPIN)[2]) == pytest.approx(0.1 * IMPULSE * RADIUS)
    assert S[state.SUM_R_MU_N + 1] == pytest.approx(0.1 * IMPULSE * RADIUS)
    assert S[state.SUM_FRICTION_TORQUE + 1] == pytest.approx(0.1 * IMPULSE * RADIUS)
