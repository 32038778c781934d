"""The guards of a record: joints beyond their range, the ledger so far, and a look that misses no note."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.mechanics import state
from fctd.mechanics.query import walls_in
from fctd.results import ledger
from fctd.results.notes import MOST_BEND, MOST_TWIST, beyond_joints, string_notes
from fctd.results.profile import Loads
from fctd.simulation.guards import may_have_notes
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe, rotation
from tests.simulation.kept import BUILD, tripping


def test_the_ledger_so_far_is_that_of_the_result() -> None:
    simulation = Simulation(tripping())
    for k, _ in enumerate(simulation, start=1):
        if k in (3, 30):
            guards, energy = simulation.recorder.guards, simulation.result().energy
            assert guards.work == pytest.approx(ledger.work(energy), rel=1e-12)
            assert guards.residual / guards.work == pytest.approx(ledger.error(energy), rel=1e-12)


def test_a_run_that_ends_early_has_the_note_on_its_ledger() -> None:
    simulation = Simulation(tripping())
    for _ in range(3):
        next(simulation)
    assert "ledger" not in {note.code for note in simulation.result().notes}
    simulation.recorder.guards.residual = 0.05 * simulation.recorder.guards.work
    assert "ledger" in {note.code for note in simulation.result().notes}


@pytest.mark.parametrize(("bend", "twist"), [(1.01 * MOST_BEND, 0.1), (0.1, 1.5 * MOST_TWIST)])
def test_joints_beyond_their_range(bend: float, twist: float) -> None:
    """Turned by hand: the state of a run whose one joint bends or twists by an angle."""
    simulation = Simulation(make_case(BUILD, [pipe(None, 10)], [rotation(100, 2, ramp=1)]))
    simulation.start()
    run = simulation.run
    for j in range(6, 11):
        run.S[state.AX + j], run.S[state.AZ + j] = np.sin(bend), np.cos(bend)
        turned = [np.cos(twist / 2), 0.0, 0.0, np.sin(twist / 2)]
        upper = [run.S[q + 5] for q in (state.QW, state.QX, state.QY, state.QZ)]
        w, z = upper[0] * turned[0] - upper[3] * turned[3], upper[0] * turned[3] + upper[3] * turned[0]
        for q, value in zip((state.QW, state.QX, state.QY, state.QZ), (w, 0.0, 0.0, z), strict=True):
            run.S[q + j] = value
    guards = simulation.recorder.guards
    guards.check_state(100.0)
    note = guards.notes["joint"]
    assert note.excess == pytest.approx(max(bend / MOST_BEND, twist / MOST_TWIST), rel=0.02)
    assert "segment 6" in note.text
    assert ("bends" in note.text) == (bend > MOST_BEND)
    assert "with the bit at 100 m" in note.text
    assert "use shorter segments" in note.remedy


def test_joints_within_their_range_have_no_note() -> None:
    assert beyond_joints(0.99 * MOST_BEND, 0.99 * MOST_TWIST, (3, 4)) is None


@given(
    depth=st.floats(-0.05, 0.03), pull=st.floats(-6e6, 6e6), twist=st.floats(-2e5, 2e5), bend=st.floats(0, 3e5),
    hookload=st.floats(-1e5, 9e6),
)  # fmt: skip
def test_the_look_misses_no_note(depth: float, pull: float, twist: float, bend: float, hookload: float) -> None:
    simulation = Simulation(make_case(BUILD, [pipe(None, 3)], [rotation(100, 2, ramp=1)]))
    string = simulation.run.string
    radius = np.full(3, 0.0635)
    place = 0.108 - 0.0635 + depth
    walls = walls_in(np.array([[0.0, place, 0.0, 0.108, 1e7, 0.2, md] for md in (30.0, 60.0, 100.0)]))
    loads = Loads(
        tension=np.array([pull, 0.0, 0.0]), torque=np.array([0.0, twist, 0.0]), bending=np.array([0.0, 0.0, bend]),
        normal=np.zeros(3),
    )  # fmt: skip
    found = string_notes(string, loads, hookload, walls, radius)
    looked = may_have_notes(
        walls.offset, walls.radius, radius, loads.tension, loads.torque, loads.bending, 0.0, 0.0, string.table,
        int(string.component[0]), hookload,
    )  # fmt: skip
    assert looked or not found
