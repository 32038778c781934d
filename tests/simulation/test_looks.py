"""The compiled looks of the guards: they miss nothing that a note would say."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.mechanics import readings, state, topdrive
from fctd.mechanics.query import walls_in
from fctd.results.notes import MOST_BEND, MOST_TWIST, beyond_joints, string_notes
from fctd.results.profile import Loads
from fctd.simulation.looks import LISTEN, is_sound, listen, may_have_notes
from fctd.simulation.run import Run
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe, rotation
from tests.compiled import kept
from tests.simulation.kept import BUILD

drain_swing = kept(readings.drain_swing)


def run_of(segments: int) -> Run:
    """A run of a string on the wall of a build, at its start."""
    simulation = Simulation(make_case(BUILD, [pipe(None, segments)], [rotation(100, 2, ramp=1)]))
    simulation.start()
    return simulation.run


@given(bend=st.floats(0, 2 * MOST_BEND), twist=st.floats(0, 2 * MOST_TWIST))
def test_a_sound_state_has_no_note_on_its_joints(bend: float, twist: float) -> None:
    """Two segments along z, the lower one bent and then twisted."""
    S = state.new_state(2)
    state.row(S, state.QW, 2)[:] = math.cos(twist / 2), 1.0
    state.row(S, state.QZ, 2)[:] = math.sin(twist / 2), 0.0
    state.row(S, state.AX, 2)[:] = 0.0, math.sin(bend)
    state.row(S, state.AZ, 2)[:] = 1.0, math.cos(bend)
    noted = beyond_joints(bend, twist, (2, 2)) is not None
    assert not (is_sound(S, 2) and noted)
    assert is_sound(S, 2) or max(bend / MOST_BEND, twist / MOST_TWIST) > 0.99


@pytest.mark.parametrize("spoil", [{state.X: math.nan}, {state.VX: math.inf}, {state.HOLE: 0.1, state.PX: 0.3}])
def test_a_state_that_is_not_finite_or_outside_is_not_sound(spoil: dict[int, float]) -> None:
    S = state.new_state(2)
    assert is_sound(S, 2)
    for offset, value in spoil.items():
        state.row(S, offset, 2)[1] = value
    assert not is_sound(S, 2)


@given(
    depth=st.floats(-0.05, 0.03), pull=st.floats(-6e6, 6e6), twist=st.floats(-2e5, 2e5), bend=st.floats(0, 3e5),
    hookload=st.floats(-1e5, 9e6),
)  # fmt: skip
def test_the_look_at_walls_and_loads_misses_no_note(
    depth: float, pull: float, twist: float, bend: float, hookload: float
) -> None:
    run = Simulation(make_case(BUILD, [pipe(None, 3)], [rotation(100, 2, ramp=1)])).run
    string, radius = run.string, state.row(run.S, state.RADIUS, 3)
    place = 0.108 - radius[0] + depth
    walls = walls_in(np.array([[0.0, place, 0.0, 0.108, 1e7, 0.2, md, 0.2] for md in (30.0, 60.0, 100.0)]))
    loads = Loads(
        tension=np.array([pull, 0.0, 0.0]), torque=np.array([0.0, twist, 0.0]), bending=np.array([0.0, 0.0, bend]),
        normal=np.zeros(3),
    )  # fmt: skip
    found = string_notes(string, loads, hookload, walls, radius)
    looked = may_have_notes(
        run.S, walls.offset, walls.radius, loads.tension, loads.torque, loads.bending, 0.0, 0.0, string.table,
        string.component, hookload,
    )  # fmt: skip
    assert looked or not found


@pytest.mark.parametrize(("hole", "most"), [(0.108, 0.01), (0.0835, 0.005), (0.065, 0.002)])
def test_the_look_at_walls_finds_what_is_deeper_than_the_note_allows(hole: float, most: float) -> None:
    """A quarter of the clearance of pipe of 127 mm, from 2 to 10 mm; without loads."""
    run, none = Simulation(make_case(BUILD, [pipe(None, 3)], [rotation(100, 2, ramp=1)])).run, np.zeros(3)
    radius = state.row(run.S, state.RADIUS, 3)
    assert radius[0] == pytest.approx(0.0635)
    for depth, expected in ((0.99 * most, False), (1.001 * most, True)):
        places = [0.0, hole - radius[0] + depth, 0.0]
        walls = walls_in(np.array([[*place, hole, 1e7, 0.2, 30.0, 0.2] for place in (np.zeros(3), places, np.zeros(3))]))
        table, component = run.string.table, run.string.component
        looked = may_have_notes(run.S, walls.offset, walls.radius, none, none, none, 0.0, 0.0, table, component, 0.0)
        assert looked == expected
        assert bool(string_notes(run.string, Loads(none, none, none, none), 0.0, walls, radius)) == expected


def test_the_hook_load_is_heard_after_a_while_and_then_anew() -> None:
    """Half of the pipe at the top is the hoist's; the second body is the slowest on its wall, and muddy."""
    run = run_of(4)
    run.top[topdrive.TOP_LENGTH] = 12.0
    state.row(run.S, state.K_WALL, 4)[:] *= 1.0, 0.3, 0.0, 1.0
    state.row(run.S, state.HELD_BACK, 4)[1] = 0.4 * state.row(run.S, state.INVERSE_MASS, 4)[1]
    weight = float(state.row(run.S, state.WEIGHT, 4).sum()) + 0.5 * 100.0 * float(run.top[topdrive.TOP_LENGTH])
    stiffness, mass = state.row(run.S, state.K_WALL, 4), state.row(run.S, state.INVERSE_MASS, 4)
    square = stiffness[1] * 0.6 * mass[1]
    run.top[[topdrive.PULL_STEPS, topdrive.CHANGES, topdrive.BENDS]] = 100.0, 2e6, 5e6
    run.top[topdrive.PULL_TIME] = 0.99 * LISTEN
    weighed, on_wall, heard, swing = listen(run.S, run.top, 4, 100.0)
    assert weighed == pytest.approx(weight, rel=1e-12)
    assert on_wall == pytest.approx(math.sqrt(square) / (2 * math.pi), rel=1e-12)
    assert (heard, swing) == (0.0, (0.0, 0.0))
    run.top[topdrive.PULL_TIME] = 1.01 * LISTEN
    top = run.top.copy()
    assert listen(run.S, run.top, 4, 100.0)[2:] == (1.01 * LISTEN, drain_swing(top))
    assert listen(run.S, run.top, 4, 100.0)[2] == 0.0


def test_without_walls_no_frequency_on_the_wall() -> None:
    S = state.new_state(2)
    assert listen(S, np.zeros(topdrive.TOP_SIZE), 2, 0.0)[1] == math.inf
