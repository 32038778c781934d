"""Resolved strings: segments short enough, and answers that do not hang on the case's own segments."""

import numpy as np
import pytest

import fctd
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.model.operations import steady_rates
from fctd.model.section import section_of
from fctd.results.status import SteadyStatus
from fctd.steady import attempts
from fctd.steady.attempts import TOO_FINE, TOO_MUCH
from fctd.steady.equilibrium import Solver
from fctd.steady.steady_string import HOMOGENISED
from tests.steady.buckled import HOLE, level_case, onset


def with_resolution(case: Case) -> Case:
    return case.model_copy(update={"solver": case.solver.model_copy(update={"buckling": "resolve"})})


@pytest.mark.parametrize(("segment", "length"), [(12.0, 120.0), (5.0, 150.0)])
def test_coarse_segments_are_cut_until_they_follow_the_shape(segment: float, length: float) -> None:
    case = level_case(1.3, length, segment, friction=0.1)
    coarse = fctd.equilibrium(case, "drill_sliding", length)
    assert coarse.status == SteadyStatus.LOCKED_UP or not coarse.buckling.resolved
    fine = fctd.equilibrium(with_resolution(case), "drill_sliding", length)
    assert fine.answered
    assert fine.buckling.resolved
    assert fine.shape == "snaking"
    # It snakes: a string that lies straight above the onset is a balance that it leaves.
    assert np.abs(fine.profile["offset_right_m"]).max() > 0.01
    assert fine.shape == "snaking"


def test_a_helix_is_the_answer_where_it_has_the_lower_energy() -> None:
    """Its transmitted force follows 1/F₀ − 1/F = μ r x/4EI; snaking has less friction, and both are in the answer."""
    mu, length = 0.4, 150.0
    point = fctd.equilibrium(with_resolution(level_case(2.0, length, 3.0, friction=mu)), "drill_sliding", length)
    assert point.status == SteadyStatus.LOCKED_UP
    assert point.shape == "helix"
    case = level_case(2.0, length)
    EI, r, F = section_of(case.string.components[0], 1200.0).EI, 0.5 * (HOLE - 0.127), 2 * onset(case)
    law = 1 / (1 / F - mu * r * length / (4 * EI))
    assert -point.hookload == pytest.approx(law, rel=0.03)
    assert point.hookload_low == point.hookload < point.hookload_high < -F
    assert np.isnan(point.slack_off_spent_at)
    assert point.message.startswith("slack-off is spent below 10 %")


def test_a_string_that_is_not_buckled_is_solved_as_it_is() -> None:
    case = level_case(0.5, 60.0, 6.0, friction=0.2)
    as_it_is = fctd.equilibrium(case, "drill_sliding", 60.0)
    resolved = fctd.equilibrium(with_resolution(case), "drill_sliding", 60.0)
    assert resolved.shape == "none"
    assert resolved.hookload == as_it_is.hookload
    assert np.isnan(resolved.hookload_low)


def test_a_string_that_needs_more_segments_than_there_may_be(monkeypatch: pytest.MonkeyPatch) -> None:
    """It keeps those of its case, and the remedy is none that the case has already."""
    monkeypatch.setattr(state, "MAX_SEGMENTS", 10)
    case = level_case(1.3, 120.0, 12.0, friction=0.0)
    pushing = case.model_copy(update={"rig": case.rig.model_copy(update={"block_weight": 1e6})})
    point = fctd.equilibrium(with_resolution(pushing), "drill_sliding", 120.0)
    assert point.status == "under_resolved"
    assert point.message.startswith(TOO_FINE)
    assert "--resolve-buckling" not in point.message


def test_a_row_whose_work_is_spent_has_homogenised_waves() -> None:
    fine = with_resolution(level_case(1.3, 120.0, 12.0, friction=0.1))
    solver = Solver(fine.model_copy(update={"solver": fine.solver.model_copy(update={"resolve_work": 50.0})}))
    cut = solver.solve("drill_sliding", steady_rates(fine, "drill_sliding"), 120.0)
    assert (cut.method, cut.status) == (HOMOGENISED, SteadyStatus.LOCKED_UP)  # this rig cannot push
    assert cut.message.endswith(f"{TOO_MUCH}, {attempts.HOMOGENISED}")
    whole = fctd.equilibrium(fine, "drill_sliding", 120.0)
    assert cut.hookload == pytest.approx(whole.hookload, rel=0.02)
