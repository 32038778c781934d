"""The stepper: exact statics, conservation at its order, friction that stops but does not reverse."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.mechanics import dynamics, joints, state, topdrive
from fctd.mechanics.contact import COLUMNS
from fctd.mechanics.faults import UnstableError
from fctd.mechanics.law_names import CODES
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from fctd.simulation.settling import settle, start_from_rest
from tests.bodies import (
    AXIS,
    FORCE,
    GLOBAL_SPIN,
    ON_LOWER,
    ON_UPPER,
    PLACE,
    QUATERNION,
    SPIN,
    VELOCITY,
    at,
    place,
    put,
    set_body,
)
from tests.cases import make_case, pipe, rotation
from tests.compiled import kept

push_freely, move_bodies = kept(dynamics.push_freely), kept(dynamics.move_bodies)
update_velocities = kept(dynamics.update_velocities)
read_top_drive = kept(topdrive.read_top_drive)
strain_energy, joint_twist = kept(joints.strain_energy), kept(joints.joint_twist)

FREE = state.Laws(state.OPEN, CODES["coulomb"], 1.0, 0.0, 0.0, 0.0)
STILL = topdrive.Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0)
NO_PIPE = topdrive.PerMetre(*[0.0] * 10)._replace(EA=1.0)
NO_HOLE = np.zeros((1, COLUMNS))


def run_free(S: np.ndarray, n: int, step: float, time: float) -> None:
    """Advance free bodies without joints to a top drive and without a wall."""
    top = np.zeros(topdrive.TOP_SIZE)
    owner = np.zeros(n + 2, np.int64)
    dynamics.advance(S, top, owner, n, NO_HOLE, FREE, STILL, NO_PIPE, step, round(time / step))


@pytest.mark.parametrize("top_segments", [10, 1])
def test_hanging_chain_stretches_by_the_closed_form(top_segments: int) -> None:
    """Tapered string in mud: each part stretches by the load below and by half its own weight; pressure squeezes it.

    ``top_segments = 1`` without a length is the paper's long segment.
    """
    lower, upper = pipe(150, 6, outer=0.159), pipe(None, top_segments)
    case = make_case(
        components=[lower, upper], mud={"density": 1200}, operations=[rotation(1000, 10)]
    )  # fmt: skip
    run, _ = prepare(case)
    assert run.string.long_segment == (top_segments == 1)
    settle(run, tolerance=6e-10)
    run.refresh()
    below, stretch = 0.0, 0.0
    for length, section in ((150.0, run.string.sections[0]), (850.0, run.string.sections[1])):
        stretch += (below + 0.5 * section.weight * length) * length / section.EA
        below += section.weight * length
    stretch -= 0.4 / 206.8e9 * 1200 * topdrive.GRAVITY * 1000.0**2 / 2  # (1 − 2ν) ∫p/E
    n = run.segments
    bit = run.S[state.Z + n] + run.S[state.ARM_BOTTOM + n] * run.S[state.AZ + n]
    assert bit - 1000 == pytest.approx(stretch, rel=1e-8)


def spinning_top(step: float, time: float = 2.0) -> tuple[float, float]:
    """Relative error of angular momentum and energy of a free long body that spins and tumbles."""
    S = state.new_state(1)
    set_body(S, 1, 400.0, 3000.0, 1.0)
    S[[state.WX + 1, state.WY + 1, state.WZ + 1]] = 0.3, -0.2, 8.0

    def momentum_energy() -> tuple[np.ndarray, float]:
        q = S[[state.QW + 1, state.QX + 1, state.QY + 1, state.QZ + 1]]
        spin = S[[state.WX + 1, state.WY + 1, state.WZ + 1]]
        inertia = np.array([3000.0, 3000.0, 1.0])
        turned = Rotation.from_quat(q, scalar_first=True).apply(inertia * spin)
        return turned, float(0.5 * (inertia * spin**2).sum())

    before, energy = momentum_energy()
    run_free(S, 1, step, time)
    after, energy_after = momentum_energy()
    return float(np.linalg.norm(after - before) / np.linalg.norm(before)), abs(energy_after / energy - 1)


def test_torque_free_top_keeps_momentum_at_second_order_and_energy_exactly() -> None:
    coarse, fine = spinning_top(8e-3), spinning_top(4e-3)
    assert math.log2(coarse[0] / fine[0]) > 1.9
    assert fine[0] < 5e-4
    assert max(coarse[1], fine[1]) < 1e-12


@pytest.mark.parametrize("added", [0.0, 250.0])
def test_loads_weight_and_mud_on_one_body(added: float) -> None:
    """Δv = (F − F_below + W) dt/m and ΔL = M dt, then each motion slowed by 1/(1 + c dt/m): global vectors by scipy.

    Mud that moves sideways with the body adds to its mass there.  Spread along the body as the mud's drag is, it slows
    the spin across the axis by the same factor.
    """
    S, dt, settling = state.new_state(1), 0.01, 3.0
    set_body(S, 1, 400.0, 3000.0, 1.5)
    mass = np.array([400.0 + added, 400.0 + added, 400.0])
    S[state.ADDED_MASS + 1], S[state.HELD_BACK + 1] = added, 1 / 400 - 1 / mass[0]
    turned = Rotation.from_rotvec([0.7, -0.4, 0.5])
    place(S, 1, turned, [1.0, 2.0, 3.0])
    velocity, spin = np.array([0.3, -0.8, 1.7]), np.array([0.02, -0.03, 6.0])
    above, below, weight = np.array([500.0, -300.0, -4000.0]), np.array([-200.0, 100.0, -2500.0]), 3500.0
    lower, upper = np.array([40.0, -900.0, 25.0]), np.array([-300.0, 70.0, 60.0])
    drag_across, drag_along, drag_about = 60.0, 25.0, 0.8
    put(S, 1, VELOCITY, velocity)
    put(S, 1, SPIN, spin)
    put(S, 1, FORCE, above)
    put(S, 2, FORCE, below)
    put(S, 1, ON_LOWER, lower)
    put(S, 2, ON_UPPER, upper)
    put(S, 1, (state.WEIGHT, state.MUD_LATERAL, state.MUD_AXIAL, state.MUD_SPIN),
        [weight, drag_across, drag_along, drag_about])  # fmt: skip
    free = turned.inv().apply(velocity) + dt / mass * turned.inv().apply(above - below + [0, 0, weight])
    free_spin = spin + dt * turned.inv().apply(lower + upper) / [3000, 3000, 1.5]
    left = free / (1 + dt * settling + dt * np.array([drag_across, drag_across, drag_along]) / mass)
    across = drag_across / mass[0]
    left_spin = free_spin / (1 + dt * settling + dt * np.array([across, across, drag_about / 1.5]))

    push_freely(S, state.LANES, FREE._replace(settling=settling), dt)
    np.testing.assert_allclose(at(S, 1, VELOCITY), turned.apply(left), rtol=1e-12)
    np.testing.assert_allclose(at(S, 1, SPIN), left_spin, rtol=1e-12)
    lost = mass * (free - left) @ left + [3000, 3000, 1.5] * (free_spin - left_spin) @ left_spin
    assert S[state.LOST_MUD + 1] == pytest.approx(lost, rel=1e-12)
    assert S[state.SUM_MUD_TORQUE + 1] == pytest.approx(1.5 * (free_spin[2] - left_spin[2]), rel=1e-12)
    assert at(S, 1, PLACE).tolist() == [1.0, 2.0, 3.0]


def test_mud_losses_are_those_of_its_dampers_at_the_velocity_after() -> None:
    """c v² dt and c ω² dt with the velocity after the impulse, with which the body moves; c L²/12 against tumbling."""
    S, dt, length = state.new_state(1), 0.02, 9.0
    set_body(S, 1, 400.0, 400.0 * length**2 / 12, 1.5)
    put(S, 1, (state.MUD_LATERAL, state.MUD_AXIAL, state.MUD_SPIN), [60.0, 25.0, 0.8])
    put(S, 1, VELOCITY, [0.3, -0.8, 1.7])
    put(S, 1, SPIN, [0.02, -0.03, 6.0])
    push_freely(S, state.LANES, FREE, dt)
    x, y, z = at(S, 1, VELOCITY)
    a, b, c = at(S, 1, SPIN)
    tumbling = 60 * length**2 / 12 * (a * a + b * b)
    expected = dt * (60 * (x * x + y * y) + 25 * z * z + 0.8 * c * c + tumbling)
    assert S[state.LOST_MUD + 1] == pytest.approx(expected, rel=1e-12)
    assert S[state.SUM_MUD_TORQUE + 1] == pytest.approx(dt * 0.8 * c, rel=1e-12)


def test_a_moving_body_keeps_its_axis_and_global_spin_up_to_date() -> None:
    S, dt = state.new_state(1), 0.01
    set_body(S, 1, 400.0, 3000.0, 1.5)
    turned = Rotation.from_rotvec([0.7, -0.4, 0.5])
    place(S, 1, turned, [1.0, 2.0, 3.0])
    put(S, 1, VELOCITY, [0.3, -0.8, 1.7])
    put(S, 1, SPIN, [0.2, -0.3, 6.0])
    move_bodies(S, state.LANES, dt)
    np.testing.assert_allclose(at(S, 1, PLACE), [1.003, 1.992, 3.017], rtol=1e-14)
    after = Rotation.from_quat(at(S, 1, QUATERNION), scalar_first=True)
    np.testing.assert_allclose(at(S, 1, AXIS), after.apply([0, 0, 1]), atol=1e-14)
    np.testing.assert_allclose(at(S, 1, GLOBAL_SPIN), after.apply(at(S, 1, SPIN)), atol=1e-13)
    # Euler's equations: the transverse spin of a body without load turns about its axis by (1 − Ja/Jt) ω dt.
    angle = -(1 - 1.5 / 3000) * 6.0 * dt
    expected = Rotation.from_rotvec([0, 0, angle]).apply([0.2, -0.3, 6.0])
    np.testing.assert_allclose(at(S, 1, SPIN), expected, atol=1e-5)


def swinging_chain(step: float, time: float = 0.4) -> tuple[np.ndarray, float]:
    """Positions of a hanging three-body chain let go while bent, and its relative energy error."""
    n = 3
    S = state.new_state(n)
    S[state.AZ] = 1.0
    tilt = [Rotation.from_rotvec([0.1 * k, 0.05 * k, 0]) for k in range(n + 1)]
    end = np.zeros(3)
    for j in range(1, n + 1):
        set_body(S, j, 100.0, 900.0, 0.3)
        S[state.WEIGHT + j] = 980.0
        S[state.ARM_TOP + j] = S[state.ARM_BOTTOM + j] = 5.0
        S[state.K_AXIAL + j], S[state.K_SHEAR + j] = 4e5, 1e5
        S[state.K_BEND + j], S[state.K_TWIST + j] = 5e4, 3e2
        axis = tilt[j].apply([0, 0, 1])
        S[[state.X + j, state.Y + j, state.Z + j]] = end + 5 * axis
        S[[state.QW + j, state.QX + j, state.QY + j, state.QZ + j]] = tilt[j].as_quat(scalar_first=True)
        S[[state.AX + j, state.AY + j, state.AZ + j]] = axis
        end = end + 10 * axis

    def energy() -> float:
        dynamics.update_axes(S, n)
        rows = {r: state.row(S, r, n) for r in (state.VX, state.VY, state.VZ, state.WX, state.WY, state.WZ)}
        kinetic = 50 * sum((rows[r] ** 2).sum() for r in (state.VX, state.VY, state.VZ))
        kinetic += 450 * sum((rows[r] ** 2).sum() for r in (state.WX, state.WY))
        kinetic += 0.15 * (rows[state.WZ] ** 2).sum()
        strain = sum(strain_energy(S, j) for j in range(1, n + 1))
        return float(kinetic + strain - 980 * state.row(S, state.Z, n).sum())

    before = energy()
    run_free(S, n, step, time)
    positions = np.stack([state.row(S, r, n) for r in (state.X, state.Y, state.Z)])
    return positions, abs(energy() - before) / abs(before)


def test_stepper_converges_at_first_order() -> None:
    """Symplectic Euler: positions and energy error halve with the step."""
    reference, _ = swinging_chain(1e-5)
    errors = [np.abs(swinging_chain(h)[0] - reference).max() for h in (2e-3, 1e-3, 5e-4)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(orders > 0.9), orders
    assert np.all(orders < 1.3), orders
    drift = [swinging_chain(h)[1] for h in (1e-3, 5e-4)]
    assert math.log2(drift[0] / drift[1]) > 0.8


@pytest.mark.parametrize("sign", [1, -1])
def test_turns_at_the_top_are_counted(sign: int) -> None:
    """The twist below the top drive goes on past half a turn, where the quaternions alone would turn back."""
    S, top = state.new_state(1), np.zeros(topdrive.TOP_SIZE)
    for twist in np.arange(0.0, 20.0, 0.5):
        S[state.QW + 1], S[state.QZ + 1] = math.cos(twist / 2), sign * math.sin(twist / 2)
        read_top_drive(S, top, NO_PIPE, 0.0, 0.0, 1e-3)
        assert joint_twist(S, 1) == pytest.approx(sign * twist, abs=1e-5)
        assert abs(sign * twist - S[state.TURNS + 1]) <= math.pi


def test_the_largest_step_is_stable_and_hardly_more_is_not() -> None:
    """Without wall and shape damping the axial mode of a uniform string sets the limit, and its bound is exact."""

    def pulled(step: float | str, longer: float = 1.0) -> Run:
        case = make_case(
            operations=[rotation(1000, 1)], contact={"enabled": False}, solver={"step": step, "shape_damping": 0}
        )
        run, _ = prepare(case)
        run.step *= longer
        with np.errstate(over="ignore", invalid="ignore"):  # the unstable run grows without bound
            run.advance(STILL, 3000 * run.step)
            run.refresh()
        return run

    largest = pulled("largest")
    largest.check()
    assert pulled("auto").step == pytest.approx(0.8 * largest.step)
    with pytest.raises(UnstableError, match=r"finite|folded|left"):
        pulled("largest", 1.02).check()


@pytest.mark.slow
@pytest.mark.parametrize("shape", [3e-3, 0.1, 10.0])
@pytest.mark.parametrize("length", [0.3, 1.0, 10.0, 25.0])
def test_the_largest_step_holds_with_shape_damping_of_any_size(shape: float, length: float) -> None:
    """A kicked string loses energy at the largest step, which is that without this damping."""

    def hung(**solver: Any) -> Run:
        depth = min(200.0, 100 * length)
        components = [pipe(depth, None, segment_length=length)]
        case = make_case([[0, 0, 0], [200, 0, 0]], components, [rotation(depth, 1)], contact={"enabled": False},
                         solver={"step": "largest", **solver})  # fmt: skip
        return prepare(case)[0]

    run = hung(shape_damping=shape)
    settle(run)
    start_from_rest(run)
    assert run.step == hung(shape_damping=0).step
    rng, n = np.random.default_rng(4), run.segments
    for row in (state.VX, state.VY, state.WX, state.WY):
        state.row(run.S, row, n)[:] = 1e-3 * rng.standard_normal(n)
    run.refresh()
    before = run.energy().kinetic
    run.advance(STILL, 3000 * run.step)
    run.refresh()
    run.check()
    assert run.energy().kinetic < before


@pytest.mark.slow
def test_boundary_layers_drag_a_swinging_body_as_stokes_says_and_a_sliding_one_not_at_all() -> None:
    """At the layers' rate ω drag and mass are those of a plane wall, c/2 and c/2ω: work and phase of a forced swing."""
    drag, rate, dt = 40.0, 3.0, 4e-4
    S = state.new_state(1)
    set_body(S, 1, 1e9, 1.0, 1.0)  # so heavy that it swings as it is told
    S[state.LAYER_DRAG + 1] = drag
    laws = state.Laws(state.OPEN, 0, 1.0, 0.0, 0.0, 0.0, layer_rate=rate)

    def losses(speeds: np.ndarray) -> np.ndarray:
        """Energy lost to the mud up to the end of each step."""
        lost = np.empty(len(speeds))
        for k, speed in enumerate(speeds):
            S[state.VZ + 1] = speed
            update_velocities(S, state.LANES, laws, dt)
            lost[k] = S[state.LOST_MUD + 1]
        return lost

    period = round(2 * np.pi / rate / dt)
    swing = np.cos(rate * dt * np.arange(6 * period))
    lost = losses(swing)
    per_period = lost[-1] - lost[-1 - period]
    assert per_period == pytest.approx(0.5 * drag * 0.5 * 2 * np.pi / rate, rel=1e-3)
    # The mass of the layer turns with the swing: what it holds at full speed is c∞/2ω, half of it kinetic energy.
    assert S[state.LAYER_SPEED + 1] == pytest.approx(0.5, abs=0.01)
    steady = losses(np.ones(20 * period))
    assert steady[-1] - steady[-1 - period] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("segment", [7.0, 5.0])
def test_waves_enter_a_long_straight_chain_without_offsets(segment: float) -> None:
    """On the axis offsets are exactly 0, and the front of a wave brings offsets of 1e-300 m, 1e-290 m, ..."""
    stations = [[0, 0, 45], [1750, 0, 45], [2200, 90, 45], [2450, 90, 45]]
    collars = pipe(200, None, outer=0.158, segment_length=2.5)
    upper = pipe(None, None, outer=0.102, segment_length=segment)
    run, _ = prepare(make_case(stations, [collars, upper], [rotation(2450, 10)], wellbore={"geometry": "arcs"}))
    run.advance(STILL, 0.25)
    run.refresh()
    run.check()  # finite, in the hole, neither folded nor twisted
    motion = (state.PX, state.PY, state.PZ, state.VX, state.VY, state.VZ, state.WX, state.WY, state.WZ)
    assert all(np.isfinite(state.row(run.S, offset, run.segments)).all() for offset in motion)
