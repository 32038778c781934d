"""A problem: loads as shares, poses, and reactions."""

import numpy as np
import pytest

from fctd.steady.climb import creep_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.problem import FULL, Share
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
