"""Paths from small loads to those of the operation."""

import numpy as np
import pytest

from fctd.model.section import section_of
from fctd.steady.climb import LOW_FRICTION, Climb, Step, _next, climb, close, lock_up
from fctd.steady.problem import Share
from tests.steady.buckled import level_case, problem_of


def test_a_path_ends_with_the_loads_of_the_operation() -> None:
    problem = problem_of(level_case(1.2, length=60.0, friction=0.2))
    path = climb(problem)
    assert path.pose is not None
    assert path.sound is not None
    assert path.steps[0].share == pytest.approx(LOW_FRICTION)
    friction = [step.share for step in path.steps]
    assert friction == sorted(friction)
    problem.put_pose(path.pose)
    assert friction[-1] == 1.0
    assert problem.reactions().hookload == pytest.approx(path.steps[-1].hookload)
    assert problem.reactions().imbalance <= problem.allowed
    assert path.spent_at == pytest.approx(LOW_FRICTION)


def test_the_push_of_a_straight_string_is_its_friction() -> None:
    """Exact below the onset: the push is weight on bit and μ w L."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    s = section_of(problem.case.string.components[0], problem.case.mud.density)
    for step in climb(problem).steps[:4]:
        push = problem.weight_on_bit + 0.2 * step.share * s.weight * (60.0 - 1.5)  # half a segment lies on the clamp
        assert -step.hookload == pytest.approx(push, rel=2e-3)


def test_a_path_goes_on_by_more_than_rounding() -> None:
    """A push that has grown by thirty orders leaves no way to lock-up; steps at one share have no root between them."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0, friction=0.1))
    path = climb(problem)
    path.steps[:] = [Step(0.5, -2 * problem.weight), Step(0.6, -1e30)]
    path.balances[-1] = path.balances[-1]._replace(share=Share(0.6, 1.0))
    assert _next(problem, path, 0.1, 2.0).friction > 0.6


def test_preparation_comes_before_each_step() -> None:
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0, friction=0.1))
    seen: list[Share] = []
    path = climb(problem, seen.append)
    assert seen[0] == Share(LOW_FRICTION, 0.0)
    assert [share.friction for share in seen if share.weight == 1.0][: len(path.steps) - 1] == [
        step.share for step in path.steps[:-1]
    ]


@pytest.mark.parametrize("lock", [0.4, 0.93])
def test_lock_up_is_where_no_push_suffices(lock: float) -> None:
    """Exact for a path on which 1/push falls linearly to 0."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    friction = lock * np.array([0.5, 0.7, 0.9, 0.99])
    path = Climb(steps=[Step(float(f), -problem.weight / (3 * (1 - f / lock))) for f in friction])
    close(problem, path)
    assert path.locked_at == pytest.approx(lock)
    assert np.isnan(path.ends_at)
    path = Climb(steps=[Step(float(f), -0.1 * problem.weight * f) for f in friction])
    close(problem, path)
    assert path.ends_at == pytest.approx(friction[-1])
    assert np.isnan(path.locked_at)


def test_two_extrapolations_that_agree_by_chance_are_not_lock_up() -> None:
    """A helix that grows in 1,500 m of hole at 40°, with 250 kN at the bit: the extrapolations rise, then stand still.

    Hook loads of the string, in its weights; at friction factors nearer to its lock-up, 1.33, the path ends there.
    """
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    pushes = ((0.6, 0.1244), (0.825, 0.2139), (1.0, 0.3717), (1.1, 0.6466))
    path = Climb(steps=[Step(share, -push * problem.weight) for share, push in pushes])
    close(problem, path)
    assert np.isnan(path.locked_at)


def test_lock_up_is_not_known_where_extrapolations_differ() -> None:
    """1/push falls as (1 − f)²: by lines it seems to be 0 too early."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    steps = [Step(f, -problem.weight / (3 * (1 - f) ** 2)) for f in (0.1, 0.2, 0.3)]
    path = Climb(steps=steps)
    close(problem, path)
    assert np.isnan(path.locked_at)
    assert path.ends_at == 0.3
    # From a push beyond any rig's on it is, of 15 weights here.
    path = Climb(steps=[Step(f, -problem.weight / (3 * (1 - f) ** 2)) for f in (0.3, 0.7, 0.85)])
    close(problem, path)
    assert path.locked_at == pytest.approx(0.85 + 0.15 * 0.15**2 / (0.3**2 - 0.15**2))


def test_lock_up_does_not_hang_on_two_close_balances() -> None:
    """1/push falls linearly to 0 at 1.2; the last balance has 1 % less push than on the line, as other shapes have."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    shares = (0.6, 0.8, 0.9, 1.0, 1.005)
    steps = [Step(f, -problem.weight / (5 * (1 - f / 1.2))) for f in shares]
    path = Climb(steps=[*steps[:-1], Step(1.005, 0.99 * steps[-1].hookload)])
    close(problem, path)
    # By a line through the last two it would be 1.33.
    assert path.locked_at == pytest.approx(1.2, rel=0.01)


def test_a_string_that_is_pushed_locks_up_at_the_latest_where_it_has_no_shape() -> None:
    """The wall's springs give way under a large push, here of 1.6 weights, before the 1.2 to which 1/push falls."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    steps = [Step(f, -problem.weight / (5 * (1 - f / 1.2) ** 0.9)) for f in (0.6, 0.8, 0.95, 1.08)]
    path = Climb(steps=steps, fails_at=1.1)
    close(problem, path)
    assert path.locked_at == 1.1
    path = Climb(steps=steps, fails_at=1.1, rolls=True)
    close(problem, path)
    assert path.locked_at > 1.1


def test_a_path_that_ends_before_its_loads_says_so_beside_a_later_lock_up() -> None:
    """1/push falls linearly to 0 at 1.04, where the string is not followed beyond 0.98."""
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    steps = [Step(f, -problem.weight / (3 * (1 - f / 1.04))) for f in (0.5, 0.8, 0.9, 0.98)]
    path = Climb(steps=steps)
    close(problem, path)
    assert path.locked_at == pytest.approx(1.04)
    assert path.ends_at == 0.98
    path = Climb(steps=steps, pose=problem.copy_pose())
    close(problem, path)
    assert np.isnan(path.ends_at)


def test_slack_off_is_spent_at_the_root_of_the_hook_load() -> None:
    problem = problem_of(level_case(0.5, length=30.0, segment=3.0))
    path = Climb(steps=[Step(f, 1e5 * (0.7 - f)) for f in (0.1, 0.4, 0.6, 0.8, 1.0)])
    close(problem, path)
    assert path.spent_at == pytest.approx(0.7)


def test_a_locked_string_is_followed_to_lock_up() -> None:
    """By the reciprocal law of a helix, or later for snaking, which has less wall force."""
    problem = problem_of(level_case(1.9, friction=1.0))
    path = climb(problem)
    pose = path.pose
    assert pose is not None
    lock_up(problem, path)
    assert path.pose is pose
    assert path.locked_at > path.steps[-1].share > 1.0
    assert -path.steps[-1].hookload > problem.weight


def test_a_path_that_stops_where_the_string_is_pushed_goes_on_from_there() -> None:
    problem = problem_of(level_case(1.2, length=60.0, friction=0.2))
    whole = climb(problem)
    path = climb(problem, most=0.0)
    assert path.pose is None
    assert path.balances[-1].share == Share(LOW_FRICTION, 1.0)
    assert climb(problem, path=path) is path
    assert path.steps[-1].hookload == pytest.approx(whole.steps[-1].hookload, rel=1e-3)
