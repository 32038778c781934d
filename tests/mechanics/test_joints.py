"""The joint law: loads are the potential's derivatives, balanced, and do no net work."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from fctd.mechanics import joints, state
from tests.bodies import (
    AXIS,
    FORCE,
    GLOBAL_SPIN,
    ON_LOWER,
    ON_UPPER,
    PLACE,
    QUATERNION,
    VELOCITY,
    at,
    place,
    put,
    set_body,
)
from tests.compiled import kept

update_joint_loads, strain_energy = kept(joints.update_joint_loads), kept(joints.strain_energy)

STIFFNESS = {state.K_AXIAL: 4e7, state.K_SHEAR: 9e6, state.K_BEND: 4e4, state.K_TWIST: 3e4}
ABOVE, BELOW = 5.0, 4.0  # from the centres of the upper and of the lower body to their joint [m]
small = st.floats(-1, 1)
vector = st.tuples(small, small, small)


def between_centres(upper: Rotation, lower: Rotation, gap: np.ndarray) -> np.ndarray:
    """From the centre of the upper to that of the lower body [m]."""
    return ABOVE * upper.apply([0, 0, 1]) + gap + BELOW * lower.apply([0, 0, 1])


def pair(upper: Rotation, lower: Rotation, gap: np.ndarray) -> np.ndarray:
    """Two bodies whose hinge points are ``gap`` apart, all arms different; the upper one is column 1, joint is 2."""
    S = state.new_state(2)
    place(S, 1, upper, np.zeros(3))
    place(S, 2, lower, between_centres(upper, lower, gap))
    for row, value in STIFFNESS.items():
        S[row + 2] = value
    S[state.ARM_TOP + 1], S[state.ARM_BOTTOM + 1], S[state.ARM_TOP + 2], S[state.ARM_BOTTOM + 2] = (
        3.0,
        ABOVE,
        BELOW,
        6.0,
    )
    return S


def loads(S: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Force on the lower body, moments about the centres of the upper and of the lower body."""
    update_joint_loads(S, 2, 0.0, 1.0)
    return (
        at(S, 2, FORCE),
        at(S, 2, ON_UPPER),
        at(S, 2, ON_LOWER),
    )


def a_pair(bend: tuple[float, ...], gap: tuple[float, ...]) -> tuple[Rotation, Rotation, np.ndarray]:
    upper = Rotation.from_rotvec([0.7, -0.2, 0.4])
    return upper, upper * Rotation.from_rotvec(0.4 * np.array(bend)), 0.01 * np.array(gap)


@given(vector, vector)
def test_loads_are_minus_the_gradient_of_the_strain_energy(bend: tuple, gap: tuple) -> None:
    upper, lower, d = a_pair(bend, gap)
    S = pair(upper, lower, d)
    force, on_upper, on_lower = loads(S)

    def energy(move: np.ndarray, turn_upper: np.ndarray, turn_lower: np.ndarray) -> float:
        T = state.copy_state(S)
        place(T, 1, Rotation.from_rotvec(turn_upper) * upper, np.zeros(3))
        place(T, 2, Rotation.from_rotvec(turn_lower) * lower, at(S, 2, PLACE) + move)
        return float(strain_energy(T, 2))

    h = 1e-6
    for which, load in enumerate((force, on_upper, on_lower)):
        for k in range(3):
            delta = np.zeros((3, 3))
            delta[which, k] = h
            slope = (energy(*delta) - energy(*-delta)) / (2 * h)
            assert -slope == pytest.approx(load[k], rel=1e-6, abs=1e-3)


@given(vector, vector)
def test_net_force_and_moment_on_a_free_pair_vanish(bend: tuple, gap: tuple) -> None:
    upper, lower, d = a_pair(bend, gap)
    S = pair(upper, lower, d)
    force, on_upper, on_lower = loads(S)
    between = at(S, 2, PLACE) - at(S, 1, PLACE)
    net = on_upper + on_lower + np.cross(between, force)
    scale = np.linalg.norm(on_upper) + np.linalg.norm(on_lower) + np.linalg.norm(force)
    np.testing.assert_allclose(net, 0, atol=1e-12 * scale + 1e-9)


def test_a_closed_path_does_no_work() -> None:
    """Bend, twist and stretch together around a loop that ends where it began."""

    def pose(t: float) -> tuple[Rotation, Rotation, np.ndarray]:
        a, b = 2 * math.pi * t, 4 * math.pi * t
        upper = Rotation.from_rotvec([0.1 * math.sin(b), 0.2 * math.cos(a), 0.1])
        lower = Rotation.from_rotvec([0.3 * math.sin(a), 0.25 * math.cos(b), 0.4 * math.sin(a)])
        return upper, lower, np.array([2e-3 * math.sin(a), 1e-3 * math.cos(b), 1e-3 * math.sin(b)])

    def power(t: float) -> tuple[float, float]:
        h = 1e-6
        (u0, l0, _), (u1, l1, _) = before, after = pose(t - h), pose(t + h)
        force, on_upper, on_lower = loads(pair(*pose(t)))
        spin_upper = (u1 * u0.inv()).as_rotvec() / (2 * h)
        spin_lower = (l1 * l0.inv()).as_rotvec() / (2 * h)
        stretched = (between_centres(*after) - between_centres(*before)) / (2 * h)
        parts = force @ stretched, on_upper @ spin_upper, on_lower @ spin_lower
        return sum(parts), sum(abs(p) for p in parts)

    # The trapezoidal rule converges faster than any power on a periodic integrand.
    samples = np.array([power(t) for t in np.arange(400) / 400])
    assert abs(samples[:, 0].mean()) < 1e-8 * samples[:, 1].mean()


def test_torque_passes_a_bent_chain_unchanged() -> None:
    """18 joints of 5 degrees: the moment about each body's own axis is k_t τ, as on a straight chain."""
    twist, kt = 0.1, 3e4
    rotation = Rotation.identity()
    previous = rotation
    for k in range(18):
        half = Rotation.from_rotvec([0, 0, twist / 2])
        plane = math.radians(20 * k)  # the bend is not planar
        swing = Rotation.from_rotvec(math.radians(5) * np.array([math.cos(plane), math.sin(plane), 0]))
        rotation = previous * half * swing * half
        _, on_upper, on_lower = loads(pair(previous, rotation, np.zeros(3)))
        assert on_upper @ previous.apply([0, 0, 1]) == pytest.approx(kt * twist, rel=1e-10)
        assert on_lower @ rotation.apply([0, 0, 1]) == pytest.approx(-kt * twist, rel=1e-10)
        previous = rotation


@given(vector, vector, vector, vector, vector)
def test_damping_acts_on_relative_motion_only(bend, gap, drift, turn, other) -> None:
    """A pair that moves as one rigid body feels no damping; one that does not loses energy."""
    upper, lower, d = a_pair(bend, gap)
    S = pair(upper, lower, d)
    springs = loads(S)
    for j in (1, 2):
        position = at(S, j, PLACE)
        put(S, j, VELOCITY, np.array(drift) + np.cross(turn, position))
        put(S, j, GLOBAL_SPIN, turn)
    update_joint_loads(S, 2, 1e-3, 1.0)
    for rows, spring in zip((FORCE, ON_UPPER, ON_LOWER), springs, strict=True):
        np.testing.assert_allclose(at(S, 2, rows), spring, atol=1e-7 * (1 + np.abs(spring).max()))
    lost = S[state.LOST_JOINT + 2]
    put(S, 2, GLOBAL_SPIN, np.array(turn) + other)
    update_joint_loads(S, 2, 1e-3, 1.0)
    assert S[state.LOST_JOINT + 2] >= lost - 1e-12


@pytest.mark.parametrize("short_of_a_turn", [0.0, 1e-9, -1e-9, 1e-12, 1e-7])
def test_a_bit_that_turned_once_has_no_load_from_the_inert_column_below(short_of_a_turn: float) -> None:
    S = state.new_state(1)
    half = math.pi - short_of_a_turn
    S[state.QW + 1], S[state.QZ + 1] = math.cos(half), math.sin(half)
    update_joint_loads(S, state.LANES, 1e-4, 1e-3)
    loads = at(S, 2, (*FORCE, *ON_UPPER, *ON_LOWER))
    np.testing.assert_array_equal(loads, 0.0)


@pytest.mark.parametrize(("motion", "rows", "damper"), [
    ("pulled", VELOCITY, 4e7), ("sheared", VELOCITY, 9e6), ("turned", GLOBAL_SPIN, 3e4), ("bent", GLOBAL_SPIN, 4e4),
])  # fmt: skip
def test_each_damper_is_its_stiffness_by_the_damping_time(motion: str, rows: tuple[int, ...], damper: float) -> None:
    """A straight joint that moves in one way only: c v against it, and c v² lost."""
    upper = Rotation.from_rotvec([0.7, -0.2, 0.4])
    S, way = pair(upper, upper, np.zeros(3)), upper.apply([0, 0, 1] if motion in ("pulled", "turned") else [1, 0, 0])
    # Bending about the middle of the gap: the centres move with it.
    if motion == "bent":
        put(S, 2, VELOCITY, np.cross(0.3 * way, BELOW * upper.apply([0, 0, 1])))
    put(S, 2, rows, 0.3 * way)
    time, dt = 1e-3, 0.5
    update_joint_loads(S, 2, time, dt)
    drag = -time * damper * 0.3 * way
    if rows == VELOCITY:
        np.testing.assert_allclose(at(S, 2, FORCE), drag, atol=1e-6)
    else:
        np.testing.assert_allclose(at(S, 2, FORCE), 0, atol=1e-6)
        np.testing.assert_allclose(at(S, 2, ON_LOWER), drag, atol=1e-6)
        np.testing.assert_allclose(at(S, 2, ON_UPPER), -drag, atol=1e-6)
    assert S[state.LOST_JOINT + 2] == pytest.approx(dt * time * damper * 0.09, rel=1e-9)


@given(vector, vector, vector, vector, vector, vector)
def test_the_energy_lost_is_the_work_of_the_dampers_on_both_bodies(bend, gap, drift, other, spin, turn) -> None:
    """Power of their loads on the two bodies, each by its own motion; they balance as the springs do."""
    upper, lower, d = a_pair(bend, gap)
    S = pair(upper, lower, d)
    springs = loads(S)
    motions = ((np.array(drift), np.array(spin)), (np.array(other), np.array(turn)))
    for j, (velocity, rate) in zip((1, 2), motions, strict=True):
        put(S, j, VELOCITY, velocity)
        put(S, j, GLOBAL_SPIN, rate)
    update_joint_loads(S, 2, 1e-3, 1.0)
    force, on_upper, on_lower = (at(S, 2, r) - s for r, s in zip((FORCE, ON_UPPER, ON_LOWER), springs, strict=True))
    (v1, w1), (v2, w2) = motions
    power = force @ (v2 - v1) + on_upper @ w1 + on_lower @ w2
    scale = 1e-3 * 4e7 * 100
    assert S[state.LOST_JOINT + 2] == pytest.approx(-power, abs=1e-9 * scale)
    between = at(S, 2, PLACE) - at(S, 1, PLACE)
    np.testing.assert_allclose(on_upper + on_lower + np.cross(between, force), 0, atol=1e-9 * scale)


@given(vector, vector)
def test_tension_and_torque_are_summed_over_the_steps(bend: tuple, gap: tuple) -> None:
    """Tension is what the joint pulls along the half-way direction; torque what turns the lower body's axis."""
    upper, lower, d = a_pair(bend, gap)
    S, dt = pair(upper, lower, d), 0.25
    for _ in range(2):
        update_joint_loads(S, 2, 0.0, dt)
    sum_of_axes = upper.apply([0, 0, 1]) + lower.apply([0, 0, 1])
    pull = -at(S, 2, FORCE) @ sum_of_axes / np.linalg.norm(sum_of_axes)
    assert S[state.SUM_TENSION + 2] == pytest.approx(2 * dt * pull, rel=1e-9, abs=1e-6)
    # Without a gap the twist is the only load that has a moment about the axis.
    straight = pair(upper, lower, np.zeros(3))
    _, _, on_lower = loads(straight)
    assert S[state.SUM_TORQUE + 2] == pytest.approx(2 * dt * (on_lower @ lower.apply([0, 0, 1])), rel=1e-9, abs=1e-6)


def moving_pair(bend: tuple, gap: tuple, motion: list[tuple[float, ...]]) -> np.ndarray:
    """A pair of bodies of 300 and 200 kg whose velocities [m/s] and spins [rad/s] are ``motion``, shape damping on."""
    S = pair(*a_pair(bend, gap))
    for j, mass in ((1, 300.0), (2, 200.0)):
        set_body(S, j, mass, 8 * mass, 1.0)
        put(S, j, VELOCITY, list(motion[2 * j - 2]))
        put(S, j, GLOBAL_SPIN, list(motion[2 * j - 1]))
    return S


def damped(S: np.ndarray, time: float, dt: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """What shape damping adds to the loads of joint 2 (force, moments on upper and lower body), and the power lost."""
    found = []
    for shape_time in (time, 0.0):
        S[state.LOST_JOINT + 2] = 0.0
        update_joint_loads(S, 2, 0.0, dt, 0.0, shape_time)
        found.append((at(S, 2, FORCE), at(S, 2, ON_UPPER), at(S, 2, ON_LOWER), S[state.LOST_JOINT + 2] / dt))
    return tuple(a - b for a, b in zip(*found, strict=True))  # type: ignore[return-value]


@given(vector, vector, st.lists(vector, min_size=4, max_size=4), st.floats(1e-4, 1.0), st.floats(1e-5, 1e-2))
def test_shape_damping_loses_the_work_of_its_loads_and_reverses_nothing(bend, gap, motion, time, dt) -> None:
    """Its loads do the work −P < 0, and their impulses over a step, alone, leave less energy than before."""
    S = moving_pair(bend, gap, motion)
    force, upper, lower, power = damped(S, time, dt)
    v0, g0, v1, g1 = (np.array(part) for part in motion)
    work = force @ (v1 - v0) + upper @ g0 + lower @ g1
    assert work == pytest.approx(-power, rel=1e-8, abs=1e-7)
    assert power >= -1e-9
    after = v0 - dt * force / 300, g0 + dt * upper / 2400, v1 + dt * force / 200, g1 + dt * lower / 1600

    def kinetic(a, b, c, d) -> float:
        return float(150 * a @ a + 1200 * b @ b + 100 * c @ c + 800 * d @ d)

    # As far as the moments are across the axes: a body has another inertia along its own.
    axes = [Rotation.from_quat(S[[q + j for q in QUATERNION]], scalar_first=True).apply([0, 0, 1]) for j in (1, 2)]
    assert abs(upper @ axes[0]) + abs(lower @ axes[1]) < 1e-9 * (1 + np.linalg.norm(upper) + np.linalg.norm(lower))
    assert kinetic(*after) <= kinetic(v0, g0, v1, g1) * (1 + 1e-9)


@given(vector, vector, st.floats(-30, 30))
def test_a_bent_string_that_turns_steadily_is_not_damped(bend: tuple, gap: tuple, spin: float) -> None:
    """Each body spins about its own axis, so that axes and hinge points stay where they are; damping of the joint
    itself takes power from it."""
    upper, lower, _ = a_pair(bend, gap)
    axes = upper.apply([0, 0, 1]), lower.apply([0, 0, 1])
    S = moving_pair(bend, gap, [(0, 0, 0), tuple(spin * axes[0]), (0, 0, 0), tuple(spin * axes[1])])
    force, on_upper, on_lower, power = damped(S, 0.1, 1e-3)
    for part in (force, on_upper, on_lower):
        np.testing.assert_allclose(part, 0.0, atol=1e-7)
    assert power == pytest.approx(0.0, abs=1e-9)


def test_shape_damping_is_in_proportion_to_stiffness_where_the_step_is_short() -> None:
    """The upper end of the lower body tilts at 0.01 rad/s about its hinge: the couple is τ k_b 0.01."""
    spin = np.array([0.01, 0.0, 0.0])
    S = moving_pair((0, 0, 0), (0, 0, 0), [(0, 0, 0)] * 4)
    axis = at(S, 2, AXIS)
    spin -= (spin @ axis) * axis
    put(S, 2, GLOBAL_SPIN, spin)
    put(S, 2, VELOCITY, np.cross(spin, BELOW * axis))
    force, on_upper, on_lower, _ = damped(S, 3e-3, 1e-9)
    np.testing.assert_allclose(force, 0.0, atol=1e-9)
    np.testing.assert_allclose(on_lower, -3e-3 * STIFFNESS[state.K_BEND] * spin, rtol=1e-5)  # τ k_b dt/J off
    np.testing.assert_allclose(on_upper, -on_lower, atol=1e-9)
