"""What a rung is: how it is measured, what makes it fail, and that the ladder has all that it must have."""

import math
from dataclasses import replace
from unittest.mock import Mock

import pandas as pd
import pytest

from validation.studies.ladder import statics
from validation.studies.ladder.mutations import LEAST, MUTATIONS, broken
from validation.studies.ladder.rung import NoAnswerError, case_of, measure, observed_order, section, worst_first
from validation.studies.ladder.study import FAMILIES, RUNGS, climbed, worst_of

DEEP, SUNK = RUNGS["deep beam"], RUNGS["penetration of the wall"]


def test_the_ladder_is_as_long_as_it_must_be():
    assert len(RUNGS) == sum(map(len, FAMILIES.values())) >= 27  # no two of one name
    assert sum(rung.order is not None for rung in RUNGS.values()) >= 10
    for rungs in FAMILIES.values():
        assert any(not rung.long for rung in rungs)  # the quick study has some of every family


@pytest.mark.parametrize("rung", RUNGS.values(), ids=RUNGS)
def test_a_rung_is_compared_on_two_segmentations(rung):
    odd, meeting = rung.cuts
    assert odd != meeting
    cases = [rung.case(cut) for cut in rung.cuts]
    assert rung.exact(cases[0]) == pytest.approx(rung.exact(cases[1]), rel=5e-3, abs=1e-12)
    assert rung.bound <= 1.0 or rung.why


def test_a_bound_beyond_one_percent_says_why():
    with pytest.raises(ValueError, match="says why"):
        replace(DEEP, bound=2.0)
    assert replace(DEEP, bound=2.0, why="shear").why == "shear"


def test_a_fault_through_the_case_breaks_a_rung():
    """The exact number stays that of the unchanged case."""
    stiffer = {"string.components[0].shear_stiffness": 1.02 * section(DEEP.case(0.5)).shear}
    right, wrong = measure(DEEP, "steady", 0.5), measure(DEEP, "steady", 0.5, stiffer)
    assert abs(right["error_percent"]) <= DEEP.bound < abs(wrong["error_percent"])
    assert wrong["exact"] == right["exact"]
    row = broken(next(each for each in MUTATIONS if each.parameter == "wall stiffness"), SUNK)
    assert row["moved_percent"] == pytest.approx(2 / 1.02, rel=1e-3)
    assert row["error_over_bound"] > 1


def test_mutations_cover_what_a_case_says():
    wanted = {
        "EA", "κGA", "EI", "GJ", "weight", "μ", "clearance", "wall stiffness", "inertia", "mud density", "bend",
        "bit torque", "weight on bit",
    }  # fmt: skip
    assert wanted <= {each.parameter for each in MUTATIONS}
    for each in MUTATIONS:
        assert each.by in RUNGS[each.rung].found
        assert RUNGS[each.rung].bound < LEAST
        rung = RUNGS[each.rung]
        cut = rung.cuts[0]
        assert rung.case(cut, each.changes(rung.case(cut))) != rung.case(cut)


def test_a_rung_without_an_answer_stands_first_and_misses():
    silent = Mock(side_effect=NoAnswerError("diverged: nowhere"))
    rows = list(climbed(replace(DEEP, found={"steady": silent}), "rest", quick=True))
    assert [row["says"] for row in rows] == ["diverged: nowhere"]
    table = worst_first(pd.DataFrame([*climbed(DEEP, "rest", quick=False), *rows]))
    assert math.isnan(table["found"].iloc[0])
    assert table["error_over_bound"].iloc[1:].is_monotonic_decreasing
    assert math.isnan(worst_of(table))


def test_an_order_is_observed_from_three_meshes():
    assert observed_order(DEEP, "steady") == pytest.approx(2.0, abs=0.01)
    first = replace(DEEP, found={"steady": lambda case: 1 + case.string.components[0].segment_length})
    assert observed_order(first, "steady") == pytest.approx(1.0)
    assert math.isnan(observed_order(replace(DEEP, found={"steady": lambda case: 1.0}), "steady"))


def test_sections_are_those_of_textbooks():
    """Of a bar of 100 mm in air: A = 78.54 cm², I = 490.9 cm⁴."""
    tables = statics.lying(5.0)
    tables["string"]["components"][0] |= {"outer_diameter": 0.1, "inner_diameter": 0.0, "youngs_modulus": 2e11}
    found = section(case_of(tables, {"mud.density": 0.0}))
    assert found.steel == pytest.approx(7.854e-3, rel=1e-4)
    assert pytest.approx(4.909e-6 * 2e11, rel=1e-4) == found.EI
    assert pytest.approx(2 * 4.909e-6 * 2e11 / 2.6, rel=1e-4) == found.GJ
    assert found.weight == pytest.approx(7850 * 7.854e-3 * 9.80665, rel=1e-4)
    assert found.inertia == pytest.approx(7850 * 2 * 4.909e-6, rel=1e-4)
