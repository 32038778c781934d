"""A run that is put back into a checkpoint goes on bitwise the same, whatever moves, with every wall."""

from collections import deque
from functools import cache

import numpy as np
import pytest

from fctd.case.load import Case
from fctd.mechanics import state, waves
from fctd.results.tables import SimulationResult
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe, rotation, trip
from tests.simulation.kept import BUILD, drilling, drilling_on, gone_on, same, stopped, tripping

CASES = {"trip": tripping, "drill": drilling, "drill on": drilling_on}


def finished(simulation: Simulation) -> SimulationResult:
    """The result of a run that is run to its end."""
    deque(simulation, maxlen=0)
    return simulation.result()


@cache
def undisturbed(name: str, geometry: str) -> SimulationResult:
    return finished(Simulation(CASES[name](geometry)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "geometry", "share"),
    [(name, "arcs", share) for name in CASES for share in (0.0, 0.4, 0.75, 1.0)] + [("trip", "cylinders", 0.4)],
)
def test_a_run_goes_on_bitwise_the_same(name: str, geometry: str, share: float) -> None:
    """Stopped after the first record, among connections, on bottom, and after the last record."""
    whole = undisturbed(name, geometry)
    case = CASES[name](geometry)
    checkpoint, chunks = stopped(Simulation(case), max(round(share * len(whole.history)), 1))
    same(finished(gone_on(case, checkpoint, chunks)), whole)


def test_waves_within_a_long_segment_go_on_bitwise_the_same() -> None:
    case = make_case([[0, 0, 0], [1200, 0, 0]], [pipe(200, 20), pipe(None, 1)], [trip(900, 903, 0.5, 1.0)])
    checkpoint, chunks = stopped(Simulation(case), 4)
    again = gone_on(case, checkpoint, chunks)
    assert again.run.S[state.WAVES + waves.INERTIA] > 0
    assert again.run.S[state.WAVES + waves.RATE] != 0
    same(finished(again), finished(Simulation(case)))


@pytest.mark.slow
def test_the_shifts_of_an_autodriller_are_made_again() -> None:
    """Stopped before and after the first and the last shift, and in the slips; the schedule is the same one too."""
    whole, case = Simulation(drilling_on()), drilling_on()
    slips = next(k for k, record in enumerate(whole, start=1) if record["in_slips"])
    for _ in whole:
        pass
    shifts = whole.shifts
    assert {shift.drills_on for shift in shifts} == {True, False}
    assert shifts[0].done < slips < shifts[-1].done
    for record in sorted({shift.done + k for shift in (shifts[0], shifts[-1]) for k in (0, 1)} | {slips}):
        again = gone_on(case, *stopped(Simulation(case), record))
        assert again.shifts == [shift for shift in shifts if shift.done < record]
        same(finished(again), whole.result())
        assert (again.intervals, again.phases, again.shifts) == (whole.intervals, whole.phases, shifts)


@pytest.mark.parametrize(("name", "first", "then"), [("trip", 20, 30), ("drill on", 27, 20)])
def test_a_run_that_is_stopped_twice(name: str, first: int, then: int) -> None:
    case = CASES[name]()
    checkpoint, chunks = stopped(Simulation(case), first)
    more, rest = stopped(gone_on(case, checkpoint, chunks), then)
    same(finished(gone_on(case, more, [*chunks, *rest])), undisturbed(name, "arcs"))


def short() -> Case:
    return make_case(BUILD, [pipe(None, 12)], [rotation(500, 3, ramp=1)], record={"interval": 0.25})


@pytest.mark.slow
@pytest.mark.parametrize("method", ["fcl", "arcs"])
def test_with_the_contact_of_others(method: str) -> None:
    """FCL's triangle mesh, and the paper's search through its own interface."""
    pytest.importorskip("fcl" if method == "fcl" else "trimesh")
    from references.contact import build

    case = short()

    checkpoint, chunks = stopped(Simulation(case, build(method, case)), 5, chunk=2)
    again = gone_on(case, checkpoint, chunks, build(method, case))
    same(finished(again), finished(Simulation(case, build(method, case))))


def test_capturing_changes_nothing_and_keeps_the_columns_that_are_used() -> None:
    simulation = Simulation(short())
    next(simulation)
    before = state.copy_state(simulation.run.S)
    kept = simulation.facts()
    np.testing.assert_array_equal(state.columns(simulation.run.S), state.columns(before))
    assert 12 < kept["run"]["S"].shape[1] <= 12 + 2 * state.LANES
    assert kept["recorder"]["last_time"] == pytest.approx(0.25)


def test_a_checkpoint_of_another_string_is_refused() -> None:
    simulation = Simulation(short())
    next(simulation)
    other = Simulation(make_case(BUILD, [pipe(None, 13)], [rotation(500, 3, ramp=1)]))
    with pytest.raises(ValueError, match="another string"):
        other.restore(simulation.facts())
