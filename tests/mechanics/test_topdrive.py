"""The top drive: the pipe fed in at the top, its own motion, and the reactions it reads."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd.mechanics import state, topdrive
from fctd.mechanics.topdrive import Motion, PerMetre
from tests.bodies import (
    AXIS,
    FORCE,
    GLOBAL_SPIN,
    ON_UPPER,
    PLACE,
    QUATERNION,
    SPIN,
    VELOCITY,
    Array,
    at,
    place,
    put,
)
from tests.compiled import kept

ramp = kept(topdrive.ramp)
long_segment_energy = kept(topdrive.long_segment_energy)
spring_tension = kept(topdrive.spring_tension)
planned_speeds = kept(topdrive.planned_speeds)
read_top_drive = kept(topdrive.read_top_drive)
move_top_drive = kept(topdrive.move_top_drive)

PIPE = PerMetre(
    mass=30.0, weight=250.0, axial_inertia=0.1, EA=8e8, GJ=3e6, EI=4e6, shear=1.5e8,
    mud_axial=2.0, mud_lateral=5.0, mud_spin=0.7,
)  # fmt: skip
TILT = Rotation.from_rotvec([0.4, -0.3, 0.9])
AXIAL = np.array(TILT.apply([0, 0, 1]))


def hung(length: float, stretch: float = 0.0, twist: float = 0.0) -> tuple[Array, Array]:
    """A long segment of this length under a top drive at the origin; both along one axis."""
    S, top = state.new_state(1), np.zeros(topdrive.TOP_SIZE)
    top[topdrive.TOP_LENGTH] = length
    place(S, 0, TILT, [0.0, 0.0, 0.0])
    place(S, 1, TILT * Rotation.from_rotvec([0, 0, twist]), (length + stretch) * AXIAL)
    topdrive.put_long_segment(S, length, PIPE)
    return S, top


def test_a_ramp_leads_smoothly_from_one_speed_to_the_other() -> None:
    """A cubic step: no slope at either end, symmetric about the middle, constant before and after."""
    at_time = np.linspace(-1.0, 5.0, 601)
    found = np.array([ramp(t, 0.0, 4.0, 2.0, -6.0) for t in at_time])
    assert np.all(found[at_time <= 0] == 2.0)
    assert np.all(found[at_time >= 4] == -6.0)
    inside = (at_time > 0) & (at_time < 4)
    np.testing.assert_allclose(found[inside] + found[inside][::-1], -4.0, atol=1e-12)
    slope = np.gradient(found, at_time)
    assert np.abs(slope).max() == pytest.approx(1.5 * 8 / 4, rel=1e-3)  # of the cubic step, at its middle
    assert np.abs(np.diff(slope)).max() < 0.05  # no jump of slope at either end
    late = ramp(7.0, 6.0, 4.0, 0.0, 1.0)
    assert late == pytest.approx(ramp(1.0, 0.0, 4.0, 0.0, 1.0))


def test_the_planned_speeds_are_those_in_the_middle_of_the_step() -> None:
    top = np.zeros(topdrive.TOP_SIZE)
    top[topdrive.TOP_TIME] = 12.0
    feed, rate = planned_speeds(top, Motion(10.0, 5.0, 0.0, 0.4, 3.0, 3.0), 1.0)
    assert feed == pytest.approx(0.2)  # the middle of the ramp
    assert rate == 3.0


def test_the_long_segment_is_half_its_pipe_at_the_end_of_a_spring() -> None:
    """Half of mass, weight, inertia and mud damping at the lower end; EA/L, GJ/L, EI/L, κGA/L."""
    length = 12.0
    S, _ = hung(length)
    values = {
        state.ARM_TOP: 12.0, state.MASS: 180.0, state.WEIGHT: 1500.0, state.J_AXIAL: 0.6,
        # A uniform rod of 360 kg about its end has m L²/3; half of it is carried by the clamp.
        state.J_TRANSVERSE: 0.5 * 360 * 12**2 / 3,
        state.MUD_AXIAL: 12.0, state.MUD_LATERAL: 30.0, state.MUD_SPIN: 4.2,
        state.K_AXIAL: 8e8 / 12, state.K_SHEAR: 1.5e8 / 12, state.K_BEND: 4e6 / 12, state.K_TWIST: 3e6 / 12,
    }  # fmt: skip
    for row, value in values.items():
        assert S[row + 1] == pytest.approx(value, rel=1e-12)
    for row, inverse in ((state.MASS, state.INVERSE_MASS), (state.J_TRANSVERSE, state.INVERSE_JT),
                         (state.J_AXIAL, state.INVERSE_JA)):  # fmt: skip
        assert S[row + 1] * S[inverse + 1] == pytest.approx(1.0, rel=1e-14)


def test_energy_of_the_long_segment() -> None:
    """Moving, stretched and twisted along one axis: ½mv² + ½ω·Jω − Wz + ½EA x²/L + ½GJ τ²/L."""
    length, stretch, twist = 12.0, 3e-3, 0.4
    S, _ = hung(length, stretch, twist)
    put(S, 1, VELOCITY, [0.3, -0.5, 1.1])
    put(S, 1, SPIN, [0.02, -0.03, 5.0])
    kinetic = 0.5 * 180 * (0.3**2 + 0.5**2 + 1.1**2) + 0.5 * 8640 * (0.02**2 + 0.03**2) + 0.5 * 0.6 * 5**2
    strain = 0.5 * 8e8 / length * stretch**2 + 0.5 * 3e6 / length * twist**2
    height = (length + stretch) * AXIAL[2]
    assert long_segment_energy(S) == pytest.approx(kinetic - 1500 * height + strain, rel=1e-9)


@pytest.mark.parametrize("stretch", [2e-3, -1e-3])
def test_the_spring_pulls_by_its_stretch(stretch: float) -> None:
    S, _ = hung(12.0, stretch, twist=0.3)
    assert spring_tension(S) == pytest.approx(8e8 / 12 * stretch, rel=1e-9)


def test_readings_and_ledger_of_a_turning_top_drive() -> None:
    """Hook load is the pull along the clamp and the hanging half; torque and mud times the angle are work."""
    S, top = hung(12.0)
    across = TILT.apply([1, 0, 0])
    put(S, 1, FORCE, -7000 * AXIAL + 40 * across)
    put(S, 1, ON_UPPER, -900 * AXIAL + 30 * across)
    dt, angle = 0.01, 0.05
    read_top_drive(S, top, PIPE, 0.0, angle, dt)
    assert top[topdrive.SUM_HOOKLOAD] == pytest.approx(dt * (7000 + 250 * 6))
    mud = 0.7 * 6 * angle  # impulse of the mud's torque on the half that turns with the clamp [N m s]
    assert top[topdrive.SUM_TOP_TORQUE] == pytest.approx(dt * 900 + mud)
    assert S[state.SUM_MUD_TORQUE + 1] == pytest.approx(mud)
    assert S[state.LOST_MUD + 1] == pytest.approx(mud * angle / dt)
    assert top[topdrive.TOP_WORK] == pytest.approx(900 * angle + mud * angle / dt)
    assert top[topdrive.FED_ENERGY] == 0


@pytest.mark.parametrize("fed", [2e-4, -2e-4])
def test_readings_and_ledger_of_a_top_drive_that_feeds(fed: float) -> None:
    """Work −(T + wL/2)(1 + T/EA) dL and c L/2 dL²/dt of the mud; the bodies rest while the pipe brings energy."""
    length, stretch, dt = 12.0, 1e-3, 0.01
    tension = 8e8 / length * stretch
    S, top = hung(length, stretch)
    put(S, 1, FORCE, -tension * AXIAL)
    before = state.copy_state(S)
    read_top_drive(S, top, PIPE, fed, 0.0, dt)
    drag = 2.0 * 6 * fed
    assert top[topdrive.SUM_HOOKLOAD] == pytest.approx(dt * (tension + 1500) - drag)
    raised = (tension + 1500) * fed * (1 + tension / 8e8)
    assert top[topdrive.TOP_WORK] == pytest.approx(drag * fed / dt - raised, rel=1e-9)
    assert S[state.LOST_MUD + 1] == pytest.approx(drag * fed / dt)
    # With the bodies where they are, longer pipe is slacker: U = ½ EA (stretch − dL)²/L, and half of it weighs.
    height = (length + stretch) * AXIAL[2]

    def held(by: float) -> float:
        return 0.5 * 8e8 * (stretch - by) ** 2 / (length + by) - 0.5 * 250 * (length + by) * height

    change = held(0.5 * fed) - held(-0.5 * fed)
    assert top[topdrive.FED_ENERGY] == pytest.approx(raised + change, rel=1e-6)
    # Readings change no property of the pipe: only moving does.
    for row in (state.MASS, state.WEIGHT, state.K_AXIAL, state.ARM_TOP):
        assert S[row + 1] == before[row + 1]
    # A damper's pull on the pipe that passes the clamp stores no energy.
    T, damped = before.copy(), np.zeros(topdrive.TOP_SIZE)
    damped[topdrive.TOP_LENGTH] = length
    put(T, 1, FORCE, -(tension + 500) * AXIAL)
    read_top_drive(T, damped, PIPE, fed, 0.0, dt)
    more = 500 * fed * (1 + (2 * tension + 500 + 1500) / 8e8)  # of the work of raising the stretched pipe
    assert damped[topdrive.TOP_WORK] == pytest.approx(top[topdrive.TOP_WORK] - more, rel=1e-9)
    assert damped[topdrive.FED_ENERGY] - top[topdrive.FED_ENERGY] == pytest.approx(more - 500 * fed, abs=1e-9)


@pytest.mark.parametrize("feed", [0.4, 0.0, -0.4])
def test_the_top_drive_moves(feed: float) -> None:
    """Clock, length and pipe by the step; its quaternion by the angle; the pipe in the clamp moves along its axis."""
    S, top = hung(12.0)
    move_top_drive(S, top, PIPE, feed, 6.0, 0.01)
    assert top[topdrive.TOP_TIME] == pytest.approx(0.01)
    assert top[topdrive.TOP_LENGTH] == pytest.approx(12 + 0.01 * feed)
    assert S[state.ARM_TOP + 1] == pytest.approx(12 + 0.01 * feed)
    assert S[state.K_AXIAL + 1] == pytest.approx(8e8 / (12 + 0.01 * feed))
    found = Rotation.from_quat(at(S, 0, QUATERNION), scalar_first=True)
    assert (TILT.inv() * found).as_rotvec() == pytest.approx([0, 0, 0.06], abs=1e-12)
    np.testing.assert_allclose(at(S, 0, VELOCITY), feed * AXIAL, atol=1e-15)
    np.testing.assert_allclose(at(S, 0, GLOBAL_SPIN), 6 * AXIAL, atol=1e-14)
    np.testing.assert_allclose(at(S, 0, AXIS), AXIAL)


@pytest.mark.parametrize("side", [1, -1])
def test_a_turn_moves_out_of_the_quaternions_beyond_half_a_turn_of_twist(side: int) -> None:
    """Beyond half a turn of twist a whole turn goes into TURNS and the top drive's quaternion changes sign."""
    for twist, turns in ((math.pi - 1e-6, 0), (math.pi + 1e-6, 1)):
        S, top = hung(12.0, twist=0.0)
        half = side * twist / 2
        w, x, y, z = q = at(S, 0, QUATERNION)
        c, s = math.cos(half), math.sin(half)
        put(S, 1, QUATERNION, [w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s])
        read_top_drive(S, top, PIPE, 0.0, 0.0, 0.01)
        assert S[state.TURNS + 1] == pytest.approx(side * turns * 2 * math.pi)
        sign = -1 if turns else 1
        np.testing.assert_allclose(at(S, 0, QUATERNION), sign * q)


@pytest.mark.parametrize("feed", [0.4, -0.4])
def test_a_block_moves_with_the_top_drive(feed: float) -> None:
    """It moves along its axis and does the work of the pull on it; the pipe stays as long as it is."""
    S, top = hung(12.0)
    top[[topdrive.TOP_LENGTH, topdrive.IN_DERRICK, topdrive.BLOCK_HEIGHT]] = 0.0, 1.0, 20.0
    put(S, 1, FORCE, -7000 * AXIAL + 40 * np.asarray(TILT.apply([1, 0, 0])))
    fed = 0.01 * feed
    read_top_drive(S, top, PIPE, fed, 0.0, 0.01)
    move_top_drive(S, top, PIPE, feed, 0.0, 0.01)
    assert top[topdrive.SUM_HOOKLOAD] == pytest.approx(0.01 * 7000)
    assert top[topdrive.TOP_WORK] == pytest.approx(-7000 * fed)
    assert top[topdrive.FED_ENERGY] == 0
    assert top[topdrive.BLOCK_HEIGHT] == pytest.approx(20 - fed)
    np.testing.assert_allclose(at(S, 0, PLACE), fed * AXIAL, atol=1e-15)
    np.testing.assert_allclose(at(S, 0, VELOCITY), feed * AXIAL, atol=1e-15)
    assert S[state.ARM_TOP + 1] == 12.0
