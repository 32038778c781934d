"""Rows of strings that are fed: one answer from every mesh, and what the row says."""

import numpy as np
import pytest

import fctd
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.steady import feed
from fctd.steady.attempts import TOO_FINE
from fctd.steady.steady_string import Equilibrium
from tests.steady.buckled import level_case, with_tables


def resolved(case: Case, length: float = 150.0, **tables: dict[str, object]) -> Equilibrium:
    return fctd.equilibrium(with_tables(case, **({"solver": {"buckling": "feed"}} | tables)), "drill_sliding", length)


@pytest.mark.slow
@pytest.mark.parametrize("times_onset", [1.3, 2.5])
def test_every_mesh_has_the_same_answer(times_onset: float) -> None:
    points = [
        resolved(level_case(times_onset, 150.0, segment, 0.2), rig={"block_weight": 1e6}) for segment in (9.0, 6.0, 4.0)
    ]
    assert {(point.method, point.status) for point in points} == {("fed", "converged")}
    loads = [point.hookload for point in points]
    assert np.ptp(loads) < 0.01 * max(np.abs(loads))


@pytest.mark.slow
@pytest.mark.parametrize("times_onset", [1.3, 1.6, 2.5])
def test_damping_does_not_decide_the_row(times_onset: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """The pseudo-time with which a string comes to rest, three values."""
    loads = []
    for time in (0.1, 0.2, 0.8):
        monkeypatch.setattr(feed, "FIRST_TIME", time)
        loads.append(resolved(level_case(times_onset, 150.0, 6.0, 0.2), rig={"block_weight": 1e6}).hookload)
    assert np.ptp(loads) < 0.01 * max(np.abs(loads))


def test_rounding_does_not_decide_the_row() -> None:
    """A string that left its balance in steps longer than its mode takes to grow came to rest 3 % apart."""
    case = level_case(1.8, 150.0, 6.0, 0.2)
    loads = [
        resolved(case, rig={"block_weight": 1e6}, solver={"buckling": "feed", "perturbed": seed}).hookload
        for seed in (1, 2, 3)
    ]
    assert np.ptp(loads) < 1e-4 * max(np.abs(loads))


def test_a_row_has_the_path_by_which_it_was_fed() -> None:
    point = resolved(level_case(2.0, 150.0, 6.0, 0.2), rig={"block_weight": 1e6})
    table = point.feeding
    assert list(table) == ["feed_m", "hookload_N", "bit_moved_m", "weight_on_bit_N", "snapped"]
    assert (table["feed_m"].diff().dropna() >= 0).all()
    assert table["weight_on_bit_N"].iloc[-1] == pytest.approx(point.case.bit.weight_on_bit, rel=0.01)
    as_cut = fctd.equilibrium(level_case(0.5, 60.0, 6.0, 0.2), "drill_sliding", 60.0)
    assert as_cut.feeding.empty


def test_a_string_that_locks_up_says_how_feeding_ended() -> None:
    point = resolved(level_case(3.0, 150.0, 6.0, 3.0))
    assert point.status == "locked_up"
    assert not point.answered
    assert point.message.startswith("fed from rest, ")
    assert "slack-off is spent" in point.message


@pytest.mark.slow
def test_the_friction_of_the_case_is_the_limit_of_a_fed_string() -> None:
    """More friction, more push; with as much along the hole and less around it, hardly another."""
    loads = [
        resolved(level_case(1.6, 150.0, 6.0, friction), rig={"block_weight": 1e6}).hookload
        for friction in (0.1, 0.2, 0.3)
    ]
    assert loads[0] > loads[1] > loads[2]


def test_a_string_that_turns_or_meets_no_friction_is_not_fed() -> None:
    assert resolved(level_case(1.6, 120.0, 6.0, 0.0), 120.0).feeding.empty
    case = with_tables(level_case(1.3, 120.0, 6.0, 0.1), solver={"buckling": "feed"})
    assert fctd.equilibrium(case, "drill_rotating", 120.0).feeding.empty


def test_a_string_of_too_many_segments_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(state, "MAX_SEGMENTS", 10)
    point = resolved(level_case(1.6, 120.0, 12.0, 0.1), 120.0, rig={"block_weight": 1e6})
    assert point.status == "under_resolved"
    assert point.message.startswith(TOO_FINE)
