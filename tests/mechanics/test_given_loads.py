"""Loads that are given to a body: along its axis and about it, with their work in the ledger."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fctd import Simulation
from fctd.mechanics import dynamics, given_loads, state, topdrive
from fctd.mechanics.law_names import CODES
from references import contact
from tests.bodies import SPIN, VELOCITY, at, place, put, set_body
from tests.cases import make_case, pipe, rotation
from tests.compiled import kept

update_velocities, count_given = kept(dynamics.update_velocities), kept(given_loads.count_given)
GIVEN = state.Laws(state.OPEN, CODES["coulomb"], 1.0, 0.0, 0.0, 0.0, given=True)


def test_a_body_gains_what_it_is_given_and_the_ledger_counts_the_work() -> None:
    """F dt/m along its axis and T dt/J about it; the work is that at the velocities after the step."""
    S, dt, force, torque = state.new_state(2), 1e-3, 8e3, -300.0
    turned, velocity, spin = Rotation.from_rotvec([0.7, -0.4, 0.5]), np.array([0.3, -0.8, 0.2]), np.array([0.1, 0.2, 6])
    for j in (1, 2):
        set_body(S, j, 400.0, 3000.0, 1.5)
        S[state.ADDED_MASS + j], S[state.HELD_BACK + j] = 100.0, 1 / 400 - 1 / 500  # moves sideways alone
        place(S, j, turned, [0.0, 0.0, 0.0])
        put(S, j, VELOCITY, velocity)
        put(S, j, SPIN, spin)
    put(S, 1, (state.GIVEN_FORCE, state.GIVEN_TORQUE), [force, torque])
    top = np.zeros(topdrive.TOP_SIZE)
    update_velocities(S, state.LANES, GIVEN, dt)
    count_given(S, top, state.LANES, dt)
    axis = turned.apply([0.0, 0.0, 1.0])
    np.testing.assert_allclose(at(S, 1, VELOCITY), velocity + dt * force / 400 * axis, rtol=1e-12)
    np.testing.assert_allclose(at(S, 1, SPIN), spin + np.array([0, 0, dt * torque / 1.5]), rtol=1e-12)
    work = dt * (force * at(S, 1, VELOCITY) @ axis + torque * at(S, 1, SPIN)[2])
    assert top[topdrive.GIVEN_WORK] == pytest.approx(work, rel=1e-12)
    np.testing.assert_allclose(at(S, 2, VELOCITY), velocity, rtol=1e-12)
    assert not S[state.LOST_MUD : state.LOST_MUD + state.LANES].any()


@pytest.mark.parametrize("asked", [False, True])
def test_a_hanging_string_carries_them_to_its_top(asked: bool) -> None:
    """The hook load is weight and force, the torque at surface what the string's own turning lacks; the energy closes.

    With the engine's own wall, and with a contact method that is asked for it.
    """
    case = make_case(components=[pipe(100, 8)], operations=[rotation(100, 6.0, ramp=2.0)])
    simulation = Simulation(case, contact.build("cylinders", case) if asked else None)
    run = simulation.run
    run.laws = run.laws._replace(given=True)
    put(run.S, 6, (state.GIVEN_FORCE,), [2e4])
    put(run.S, 3, (state.GIVEN_TORQUE,), [-4e3])
    weight = float(run.string.weight @ run.string.length)
    list(simulation)
    result = simulation.result()
    late = result.history[result.history["time_s"] > 3]
    assert result.status == "completed"
    assert late["hookload_N"].mean() == pytest.approx(weight + 2e4, rel=1e-5)
    assert late["surface_torque_N_m"].mean() == pytest.approx(4e3, rel=1e-3)
    assert result.run["energy_error"] < 1e-3
    assert -result.energy["flow_work_J"].iloc[-1] == pytest.approx(result.energy["top_drive_work_J"].iloc[-1], rel=0.05)
