"""The guards of a record: joints beyond their range, the ledger so far, and flutter."""

from typing import Any

import numpy as np
import pytest

from fctd import SimulationResult, simulate
from fctd.mechanics import state
from fctd.results import ledger
from fctd.results.run_notes import MOST_BEND, MOST_TWIST, beyond_joints
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe, rotation, trip
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


UNDAMPED: Any = {"solver": {"shape_damping": 0.0}, "contact": {"damping": 1e4}}


def pulled(friction: float, **more: Any) -> SimulationResult:
    """5 in pipe in segments of 28.5 m, pulled through a build of 90° in 600 m with 0.5 m/s."""
    return simulate(
        make_case(
            [[0, 0, 0], [300, 0, 0], [900, 90, 0], [1600, 90, 0]],
            [pipe(None, None, inner=0.1086, segment_length=28.5)], [trip(1500, 1488, speed=0.5, ramp=3.0)],
            wellbore={"geometry": "arcs", "intervals": [{"to_md": 1600.0, "diameter": 0.2159, "friction": friction}]},
            mud={"density": 1200.0}, rig={"feed": "stands"}, **more,
        )
    )  # fmt: skip


@pytest.mark.parametrize("friction", [0.35, 0.5])
def test_the_default_dampings_end_the_flutter(friction: float) -> None:
    """The swing falls to less than a quarter, the mean changes by less than 2 %, and the note is gone."""
    wild, tame = pulled(friction, **UNDAMPED), pulled(friction)
    codes = {note.code: note for note in wild.notes}
    assert "solver.shape_damping" in codes["flutter"].remedy
    assert "flutter" not in {note.code for note in tame.notes}
    means, swings = [], []
    for result in (wild, tame):
        steady = result.history[result.history["time_s"] > 8.0]
        means.append(steady["hookload_N"].mean())
        swings.append(steady["hookload_max_N"].max() - steady["hookload_min_N"].min())
    assert swings[1] < 0.25 * swings[0]
    assert means[0] == pytest.approx(means[1], rel=0.02)


def test_the_same_trip_with_less_friction_has_no_note() -> None:
    assert "flutter" not in {note.code for note in pulled(0.2).notes}


def test_a_jolt_that_nothing_damps_flutters_and_a_soft_start_does_not() -> None:
    """0.5 m/s within 0.1 s, down a gentle slope."""

    def codes(ramp: float, **mud: Any) -> set[str]:
        case = make_case(
            [[0, 0, 0], [300, 0, 0], [900, 30, 0], [1600, 30, 0]], [pipe(None, None, segment_length=28.5)],
            [trip(1490, 1500, speed=0.5, ramp=ramp)], mud={"density": 1200.0, **mud}, rig={"feed": "stands"},
            wellbore={"geometry": "arcs"},
        )  # fmt: skip
        return {note.code for note in simulate(case).notes}

    assert "flutter" in codes(0.1, viscosity=0)
    assert not {"flutter", "push"} & codes(3.0, viscosity=0)
    assert not {"flutter", "push"} & codes(0.1)
