"""A problem: loads as shares, poses, and reactions."""

import numpy as np
import pytest

from fctd.mechanics import state
from fctd.model.operations import steady_rates
from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.climb import creep_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.equilibrium import Solver
from fctd.steady.problem import FULL, Problem, Share, Workspace
from fctd.steady.tangent import JOINT_TENSION, JOINT_TORQUE
from tests.cases import make_case, pipe
from tests.steady.buckled import level_case, problem_of


def test_loads_are_shares_of_those_of_the_operation() -> None:
    problem = problem_of(level_case(0.5, friction=0.3))
    full, part = problem.laws(), problem.laws(Share(0.5, 0.25))
    assert (full.friction_scale, part.friction_scale) == (1.0, 0.5)
    assert part.bit_x == pytest.approx(0.25 * full.bit_x)
    assert full.bit_x == pytest.approx(-problem.weight_on_bit)  # against the direction of the hole, to the north
    assert problem.bit_tension(Share(1.0, 0.25)) == pytest.approx(0.25 * problem.bit_tension())


def test_a_pose_is_copied_and_put_back() -> None:
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    problem.lay_guess()
    kept = problem.copy_pose()
    assert problem.relax(creep_of(problem, 200))[0] == CONVERGED
    assert not np.array_equal(kept.P, problem.work.P[: problem.n + 1])
    problem.put_pose(kept)
    assert np.array_equal(kept.P, problem.work.P[: problem.n + 1])
    problem.work.P[1, 0] += 1.0
    assert not np.array_equal(kept.P, problem.work.P[: problem.n + 1])


def test_reactions_balance_the_loads() -> None:
    """Exact: push at the top = weight on bit and Σ μ N; in a level hole the wall carries the weight."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    problem.lay_guess()
    assert problem.relax(creep_of(problem, 400))[0] == CONVERGED
    found = problem.reactions()
    normal = float(found.contacts[:, 3].sum())
    assert found.hookload == pytest.approx(-problem.weight_on_bit - 0.2 * normal, rel=1e-4)
    # The clamp at the axis carries what lies before the first contact.
    assert 0.8 < normal / (problem.weight - problem.weight_on_bit) < 1
    assert found.imbalance <= problem.allowed


@pytest.mark.parametrize("kind", ["trip_in", "trip_out", "rotate_off_bottom"])
def test_given_loads_are_carried_to_the_top(kind: str) -> None:
    """Exact in a straight hole, whose wall force does not depend on the tension, but where the top leaves its axis.

    A string that is laid out anew has none.
    """
    solver = Solver(make_case([[0, 40, 90], [600, 40, 90]], [pipe(600, 30)], wellbore={"geometry": "arcs"}))
    laid, rates, force, torque = solver.lay_out(600.0), steady_rates(solver.case, kind), 2e4, -1.5e3

    def solved(*given: float) -> Problem:
        problem = solver.problem(kind, rates, laid)
        for row, load in zip((state.GIVEN_FORCE, state.GIVEN_TORQUE), given, strict=False):
            problem.work.S[row + 12] = load
        assert balance(problem, ATTEMPTS)[0] == CONVERGED
        return problem

    found = solved(force, torque).reactions()
    before = solved().reactions()
    assert found.hookload - before.hookload == pytest.approx(force, rel=1e-3)
    assert found.torque - before.torque == pytest.approx(-torque, rel=1e-3)
    above = np.arange(30) < 12
    assert found.joints[:, JOINT_TENSION] - before.joints[:, JOINT_TENSION] == pytest.approx(force * above, abs=20.0)
    assert found.joints[:, JOINT_TORQUE] - before.joints[:, JOINT_TORQUE] == pytest.approx(-torque * above, abs=1.5)


def test_compression_is_that_of_the_top_and_the_contact_points() -> None:
    problem = problem_of(level_case(0.8, length=60.0, segment=3.0))
    problem.lay_guess()
    problem.relax(creep_of(problem, 400))
    here = problem.compressed(FULL)
    assert here.md.shape == here.compression.shape == here.EI.shape == (problem.n + 1,)
    assert here.compression == pytest.approx(problem.weight_on_bit, rel=1e-3)
    assert here.md[0] == 0
    assert here.md[-1] == pytest.approx(60.0, abs=0.1)


def test_a_relaxation_stays_within_the_allowance() -> None:
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    problem.lay_guess()
    problem.allowance.left = 5.5 * problem.n
    code, done = problem.relax(creep_of(problem, 200))
    assert (code == CONVERGED, done) == (False, 5)
    assert problem.allowance.left == pytest.approx(0.5 * problem.n)
    assert problem.is_spent
    assert problem.relax(creep_of(problem, 200))[1] == 0


@pytest.mark.parametrize("long", [False, True])
def test_the_weight_is_that_of_the_whole_string(long: bool) -> None:
    """Also where half of a long segment hangs on the top drive; convergence is judged by it."""
    top = pipe(None, 1) if long else pipe(None, None, segment_length=30.0)
    case = make_case(components=[pipe(100.0, 5, outer=0.16), top], bit={"weight_on_bit": 1e4})
    solver = Solver(case)
    problem = solver.problem("drill_sliding", steady_rates(case, "drill_sliding"), solver.lay_out(900.0))
    string = problem.string
    assert string.long_segment == long
    assert problem.weight == pytest.approx(float(string.weight @ string.length) + 1e4, rel=1e-12)
    assert problem.allowed == pytest.approx(1e-7 * problem.weight, rel=1e-12)


def test_a_workspace_has_room_for_its_segments_or_makes_way_for_a_larger_one() -> None:
    work = Workspace(20)
    assert (work.segments, len(work.P), len(work.owner)) == (20, 22, 22)
    assert work.for_segments(20) is work
    assert Workspace(0).for_segments(20).segments >= 20
    assert Workspace(0).for_segments(state.MAX_SEGMENTS).segments == state.MAX_SEGMENTS
