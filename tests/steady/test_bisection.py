"""Balances of strings that Newton's method does not find directly, in a few trials."""

import numpy as np
import pytest

from fctd.steady.balance import ATTEMPTS, balance
from fctd.steady.bisection import ITERATIONS, TRIALS, bisect, find_anew
from fctd.steady.climb import LOW_FRICTION, climb, come_to_rest, end_of
from fctd.steady.problem import FULL, Problem, Share
from tests.steady.buckled import level_case, problem_of


def fails_beyond(monkeypatch: pytest.MonkeyPatch, problem: Problem, share: float) -> None:
    """No string comes to rest with more than a share of its friction."""
    relax, iterate = problem.relax, problem.iterate
    monkeypatch.setattr(problem, "relax", lambda creep, at=FULL: (1, 1) if at.friction > share else relax(creep, at))
    monkeypatch.setattr(problem, "iterate", lambda pace, at=FULL: (1, 1) if share < 1 else iterate(pace, at))


def has_block(monkeypatch: pytest.MonkeyPatch, problem: Problem, weight: float) -> None:
    """A block [N] above the string, that of the case being of no weight."""
    rig = problem.case.rig.model_copy(update={"block_weight": weight})
    monkeypatch.setattr(problem, "case", problem.case.model_copy(update={"rig": rig}))


def test_a_balance_at_full_loads_needs_no_other() -> None:
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    path = bisect(problem)
    assert path.pose is not None
    assert [balance.share for balance in path.balances] == [FULL]
    assert problem.reactions().imbalance <= problem.allowed
    held = problem.reactions().hookload
    problem.at_axis = 0
    balance(problem, ATTEMPTS)
    assert held == pytest.approx(problem.reactions().hookload, rel=1e-3)


def test_the_end_of_the_balances_is_found_to_an_eighth(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact: between a tenth and all of the friction, three halvings meet 0.55, 0.775 and 0.6625."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    has_block(monkeypatch, problem, 1e6)
    fails_beyond(monkeypatch, problem, 0.7)
    path = bisect(problem)
    assert path.pose is None
    assert [balance.share.friction for balance in path.balances] == pytest.approx([LOW_FRICTION, 0.55, 0.6625])
    assert path.ends_at == pytest.approx(0.6625)
    assert 0.7 - path.ends_at < (1 - LOW_FRICTION) / 2**TRIALS


def test_the_words_are_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """The last share at which a shape was found, and each beyond it at which none was."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    has_block(monkeypatch, problem, 1e6)
    fails_beyond(monkeypatch, problem, 0.7)
    path = bisect(problem)
    assert [share.friction for share in path.none_beyond()] == pytest.approx([0.775, 1.0])
    said = "the continuation found a steady shape at 66.3 % of the friction and none at 77.5 % or 100 %"
    assert end_of(problem, path) == said
    fails_beyond(monkeypatch, problem, 0.0)
    path = bisect(problem)
    assert (
        end_of(problem, path) == "the continuation found no steady shape at 10 % of the friction without weight on bit"
    )


def test_a_share_is_tried_as_a_row_of_its_own_would_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no relaxation comes to rest, Newton's method still finds the straight string."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    has_block(monkeypatch, problem, 1e6)
    relax = problem.relax
    monkeypatch.setattr(problem, "relax", lambda creep, at=FULL: (1, 1) if at.friction > 0.3 else relax(creep, at))
    path = bisect(problem)
    assert [balance.share.friction for balance in path.balances] == pytest.approx([LOW_FRICTION, 0.55, 0.775, 0.8875])
    assert end_of(problem, path).endswith("shape at 88.8 % of the friction and none at 100 %")
    path = climb(problem)
    assert path.balances[-1].share.friction <= 0.3
    pose = problem.copy_pose()
    find_anew(problem, path)
    np.testing.assert_array_equal(problem.copy_pose().P, pose.P)
    assert path.anew_at == path.none_beyond() != []
    words = " and ".join(f"{100 * share.friction:.3g} %" for share in path.anew_at)
    assert end_of(problem, path).endswith(f"; begun anew the string has one at {words}")


def test_a_string_without_a_balance_at_full_weight_on_bit_is_tried_with_less(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    relax = problem.relax
    monkeypatch.setattr(problem, "relax", lambda creep, at=FULL: (1, 1) if at.weight > 0.3 else relax(creep, at))
    monkeypatch.setattr(problem, "iterate", lambda pace, at=FULL: (1, 1))
    has_block(monkeypatch, problem, 1e6)
    path = bisect(problem)
    assert [balance.share for balance in path.balances] == [Share(LOW_FRICTION, 0.0), Share(LOW_FRICTION, 0.25)]
    assert path.of_weight


def test_a_string_without_any_balance_has_an_empty_path(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    fails_beyond(monkeypatch, problem, 0.0)
    assert bisect(problem).balances == []


def test_slack_off_is_spent_at_the_latest_where_a_line_through_hook_loads_says(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact: the pull of a straight string falls in proportion to its friction, here to 0 at nine tenths of it."""
    problem = problem_of(level_case(0.5, length=60.0, segment=3.0, friction=0.2))
    at_once, at_none = (hookload_at(problem, share) for share in (1.0, 0.0))
    has_block(monkeypatch, problem, -(at_none + 0.9 * (at_once - at_none)))
    fails_beyond(monkeypatch, problem, 0.7)
    assert bisect(problem).spent_at == pytest.approx(0.9, abs=1e-3)
    fails_beyond(monkeypatch, problem, 0.0)
    assert np.isnan(bisect(problem).spent_at)


def hookload_at(problem: Problem, friction: float) -> float:
    """Hook load of the straight string at a share of its friction."""
    share = Share(friction, 1.0)
    problem.lay_guess(share)
    come_to_rest(problem, ITERATIONS, share)
    return problem.reactions(share).hookload
