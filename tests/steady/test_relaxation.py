"""Relaxation: steps round the wall, limits of steps, and where a string comes to rest."""

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.steady import relaxation
from fctd.steady.climb import creep_of
from fctd.steady.continuation import CONVERGED, MAX_ITERATIONS, NOT_FINITE
from fctd.steady.problem import Problem
from fctd.steady.relaxation import CLEARANCE, PLACES
from fctd.steady.tangent import FORCE
from tests.compiled import kept
from tests.steady.buckled import level_case, problem_of

find_arcs, find_places = kept(relaxation.find_arcs), kept(relaxation.find_places)
largest_move, move = kept(relaxation.largest_move), kept(relaxation.move)


@pytest.fixture
def problem() -> Problem:
    """A string that lies in a level hole."""
    found = problem_of(level_case(0.5, length=30.0, segment=3.0))
    found.lay_guess()
    assert found.relax(creep_of(found, 200))[0] == CONVERGED
    return found


def places_of(problem: Problem) -> np.ndarray:
    places = np.zeros((problem.n + 1, PLACES))
    w, geometry = problem.work, problem.laws().geometry
    find_places(w.S, problem.n, w.P, problem.hole.pieces, w.owner, geometry, places)
    return places


def aside(problem: Problem, shift: float) -> np.ndarray:
    """A step that shifts every body to the right, across a hole to the north."""
    step = np.zeros_like(problem.work.R)
    step[1 : problem.n + 1, FORCE] = 0.0, shift, 0.0
    return step


def test_places_are_offsets_and_clearances(problem: Problem) -> None:
    places = places_of(problem)[1:]
    assert places[:, CLEARANCE] == pytest.approx(0.5 * (0.2159 - 0.127))
    assert (places[3:, 2] > 0.99 * places[3:, CLEARANCE]).all()  # on the low side; z is downwards
    problem.case = problem.case.model_copy(
        update={"contact": problem.case.contact.model_copy(update={"enabled": False})}
    )
    assert (places_of(problem)[1:, CLEARANCE] == np.inf).all()


@pytest.mark.parametrize("angle", [0.01, 0.2, 0.9])
def test_a_point_on_the_wall_moves_round_it(problem: Problem, angle: float) -> None:
    """Exact: an arc of the step's length about the hole's axis, which leaves the distance from the axis as it is."""
    before, arcs, w = places_of(problem), np.zeros((problem.n + 1, 3)), problem.work
    offset = np.linalg.norm(before[1:, :3], axis=1)
    step = aside(problem, angle * float(offset.mean()))
    find_arcs(w.S, problem.n, w.P, step, 1.0, before, arcs)
    move(w.S, problem.n, w.P, step, 1.0, arcs)
    after = places_of(problem)
    # The clamped top holds the first segments off the wall.
    turned = np.arctan2(after[5:, 1], after[5:, 2])
    assert np.linalg.norm(after[5:, :3], axis=1) == pytest.approx(offset[4:], rel=1e-3)
    assert turned == pytest.approx(angle * offset.mean() / offset[4:], rel=1e-2, abs=1e-3)


def test_a_point_in_the_hole_moves_straight(problem: Problem) -> None:
    places, arcs, w = places_of(problem), np.ones((problem.n + 1, 3)), problem.work
    places[1:, :3] *= 0.5
    find_arcs(w.S, problem.n, w.P, aside(problem, 0.01), 1.0, places, arcs)
    assert (arcs == 0).all()


def test_the_largest_move_is_a_share_of_its_limit(problem: Problem) -> None:
    creep, places, w = creep_of(problem, 1), places_of(problem), problem.work
    clearance = float(places[1, CLEARANCE])
    limit = min(creep.shift, creep.share * clearance)
    assert largest_move(w.S, problem.n, w.P, aside(problem, 0.3 * limit), places, creep) == pytest.approx(0.3)
    tilt = np.zeros_like(w.R)
    tilt[4, 3] = 2 * creep.turn
    places[:, CLEARANCE] = np.inf
    reach = 1.5 * 2 * creep.turn / creep.shift  # its contact point is half a segment of 3 m away
    assert largest_move(w.S, problem.n, w.P, tilt, places, creep) == pytest.approx(max(2.0, reach))


def test_statuses(problem: Problem) -> None:
    problem.work.P[3, 1] += 0.01
    assert problem.relax(creep_of(problem, 2)) == (MAX_ITERATIONS, 2)
    problem.work.P[3, 1] = np.nan
    assert problem.relax(creep_of(problem, 10)) == (NOT_FINITE, 0)


def test_a_string_above_the_onset_snakes_and_below_it_lies_straight() -> None:
    """The onset is 2√(EI w/r) (Dawson & Paslay 1984)."""
    for times, snakes in ((0.97, False), (1.1, True)):
        problem = problem_of(level_case(times))
        problem.lay_guess()
        code, _ = problem.relax(creep_of(problem, 800))
        assert code == CONVERGED
        off = np.abs(places_of(problem)[1:, 1]).max()
        assert (off > 5e-3) == snakes, f"{1e3 * off} mm aside at {times} times the onset"


def test_friction_at_the_axis_has_no_moment_across(problem: Problem) -> None:
    """With friction at the surface each body's moments differ by r μ N, exact."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0, friction=0.3))
    problem.lay_guess()
    problem.reactions()
    at_axis = problem.work.R[2 : problem.n].copy()
    problem.at_axis = 0
    found = problem.reactions()
    differs = problem.work.R[2 : problem.n] - at_axis
    radius = state.row(problem.work.S, state.RADIUS, problem.n)[1 : problem.n - 1]
    normal = found.contacts[1 : problem.n - 1, 3]
    assert np.linalg.norm(differs[:, 3:5], axis=1) == pytest.approx(0.3 * radius * normal, rel=1e-6)
    assert np.abs(differs[:, :3]).max() < 1e-6
