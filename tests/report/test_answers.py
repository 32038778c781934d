"""What a report computes: the same numbers as the commands that its sections are named after."""

import numpy as np
import pandas as pd
import pytest

import fctd
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet
from fctd.case.load import Case, load_case
from fctd.report.answers import Answers, Asked, answer
from fctd.steady.margin_table import limits_of
from tests.report.conftest import DEPTHS, KINDS, WELL


@pytest.mark.slow
def test_the_chart_is_that_of_torque_drag(well: Case, answers: Answers) -> None:
    pd.testing.assert_frame_equal(answers.chart, fctd.torque_drag(well, list(KINDS), list(DEPTHS)))
    assert answers.acceptable


def test_margins_are_those_of_limits_of(well: Case, answers: Answers) -> None:
    """Those over depth go up to buckling, and their deepest ones are those at the bottom."""
    assert answers.margins is not None
    assert answers.lines is not None
    pd.testing.assert_frame_equal(answers.margins, limits_of(well, KINDS, DEPTHS[-1]))
    deepest = answers.lines[answers.lines["bit_depth_m"] == DEPTHS[-1]].set_index(["operation", "limit"])
    common = answers.margins.set_index(["operation", "limit"]).loc[deepest.index]
    np.testing.assert_allclose(deepest["hookload_N"], common["hookload_N"])
    assert set(answers.lines["bit_depth_m"]) == set(DEPTHS)


def test_strings_and_mud_are_those_of_the_deepest_bit(well: Case, answers: Answers) -> None:
    points = {point.operation: point for point in answers.points}
    alone = fctd.equilibrium(well, operation="trip_out", bit_depth=DEPTHS[-1])
    pd.testing.assert_frame_equal(points["trip_out"].profile, alone.profile)
    table = fctd.hydraulics_of(well, answers.flow, list(DEPTHS))
    found = pd.DataFrame([one.summary() for one in answers.circulations])
    pd.testing.assert_frame_equal(found, table, check_names=False, check_dtype=False)


def test_a_flow_that_is_asked_for_is_that_of_the_whole_report() -> None:
    """Also where the case's own operation pumps more."""
    asked = Asked(["trip_out"], [DEPTHS[-1]], drive={"flow": 0.01}, limits=False)
    found = answer(load_case(WELL, {"operations[0].flow": "1500 L/min"}), asked)
    assert found.flow == found.rates["trip_out"].flow == found.circulations[0].flow == 0.01


def test_depths_that_do_not_fit_are_left_out_but_in_the_chart() -> None:
    """The casing ends above a hole that the collars do not enter."""
    parts = {"string.components[0].length": "150 m", "wellbore.intervals[1].diameter": "6.5 in"}
    case = load_case(WELL, parts | {"operations": None})
    found = answer(case, Asked(["trip_out"], [400.0, 1000.0], limits=False))
    assert found.chart["status"].tolist() == ["converged", "not_possible"]
    assert found.points[0].bit_depth == 400.0
    assert (found.circulations, found.dry) == ((), "no operation has a flow")
    assert found.acceptable is False
    with pytest.raises(InputError, match="components"):
        answer(case, Asked(["trip_out"], [900.0, 1000.0], limits=False))


def test_mud_without_rheology_is_no_error() -> None:
    found = answer(load_case(WELL, {"mud.fann": None}), Asked(["trip_in"], [500.0], limits=False))
    assert found.circulations == ()
    assert found.dry.startswith("mud.fann is missing: readings of a viscometer")


def test_a_column_that_falls_freely_is_no_error() -> None:
    heavier = {"mud.inside": [{"density": "2 sg"}], "mud.float": True}
    found = answer(load_case(WELL, heavier), Asked(["rotate_off_bottom"], [900.0], drive={"flow": 0.01}, limits=False))
    assert found.circulations == ()
    assert "at which the denser fluid inside falls freely" in found.dry
    assert [note.code for note in found.points[0].notes] == ["falling"]


def test_the_first_of_several_factors_are_those_of_all_but_the_chart(well: Case) -> None:
    sets = [FrictionSet(every=0.1), FrictionSet(every=0.4)]
    seen: list[tuple[str, int, int]] = []
    found = answer(well, Asked(["trip_out"], [500.0, 900.0], sets, limits=False), lambda *told: seen.append(told))
    assert found.chart["friction"].tolist() == [0.1, 0.1, 0.4, 0.4]
    assert {interval.friction for interval in found.case.wellbore.intervals} == {0.1}
    assert found.points[0].hookload == found.chart["hookload_N"][1]
    assert seen[-1] == ("hydraulics", 2, 2)
