"""The helix of a level string against its closed forms."""

import numpy as np
import pytest

from fctd.model.section import section_of
from fctd.steady.climb import creep_of
from fctd.steady.continuation import CONVERGED
from fctd.steady.helix import LOWER_ENERGY, Helix
from fctd.steady.problem import FULL, Share
from fctd.steady.tangent import JOINT_BENDING, NORMAL_FORCE
from tests.steady.buckled import HOLE, level_case, problem_of


def test_a_helix_has_its_wall_force_pitch_and_moment() -> None:
    """r F²/4EI, θ′ = √(F/2EI) and r F/2 (Lubinski, Althouse & Logan 1962) without friction."""
    problem = problem_of(level_case(2.2, length=200.0))
    problem.lay_guess(Share(1.0, 0.1))
    problem.relax(creep_of(problem, 800))
    helix = Helix(problem)
    assert helix.prepare(FULL)
    code, _ = problem.relax(creep_of(problem, 800))
    assert code == CONVERGED
    assert helix.stands()
    EI, F, r = section_of(problem.case.string.components[0], 1200.0).EI, problem.weight_on_bit, 0.5 * (HOLE - 0.127)
    found, middle = problem.reactions(), slice(problem.n // 4, 3 * problem.n // 4)
    length = problem.string.length[middle].sum()
    assert found.contacts[middle, NORMAL_FORCE].sum() / length == pytest.approx(r * F**2 / (4 * EI), rel=0.04)
    assert found.joints[middle, JOINT_BENDING].mean() == pytest.approx(r * F / 2, rel=0.03)
    walls = problem.walls(found.contacts)
    angle = np.unwrap(np.arctan2(walls.offset[middle, 1], walls.offset[middle, 2]))
    assert abs(angle[-1] - angle[0]) / (length - 1.5) == pytest.approx(np.sqrt(F / (2 * EI)), rel=0.03)


@pytest.mark.parametrize("times", [0.9, LOWER_ENERGY - 0.02])
def test_no_helix_is_laid_where_snaking_has_the_lower_energy(times: float) -> None:
    problem = problem_of(level_case(times, length=60.0))
    problem.lay_guess()
    problem.relax(creep_of(problem, 800))
    helix = Helix(problem)
    assert not helix.prepare(FULL)
    assert helix.turns == 0
    assert not helix.stands()
