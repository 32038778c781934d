"""Rows of the page's chart are those of the command, whatever was solved before them."""

import numpy as np
import pytest

import fctd
from fctd.app.rows import Rows
from fctd.model.wellbore import build_wellbore
from tests.cases import make_case, pipe
from tests.view.made import case as small_case

KINDS = ["trip_out", "trip_in", "rotate_off_bottom"]
SHARED = ["hookload_N", "surface_torque_N_m"]


def test_rows_are_those_of_the_chart_in_their_order() -> None:
    rows = Rows()
    long = make_case(
        [[0.0, 0, 0], [300, 0, 0], [500, 45, 0], [900, 45, 0]], [pipe(200, 20), pipe(None, 1)]
    )  # does not fit below 500 m
    for case, depths in ((small_case(), [400.0, 500.0, 650.0, 880.0]), (long, [280.0, 450.0, 700.0])):
        found = rows.solve(case, build_wellbore(case), KINDS, depths)
        chart = fctd.torque_drag(case, KINDS, depths)
        for column in ("operation", "bit_depth_m", "status", "buckling", "reason"):
            assert [row[column] for row in found] == chart[column].tolist()
        for column in SHARED:
            np.testing.assert_array_equal([row[column] for row in found], chart[column])
    assert "not_possible" in set(chart["status"])


@pytest.mark.parametrize("kinds", [[], ["trip_in"]])
def test_depths_that_all_do_not_fit_are_rows_without_loads(kinds: list[str]) -> None:
    case = small_case()
    found = Rows().solve(case, build_wellbore(case), kinds, [1e5, 2e5])
    assert {row["status"] for row in found} == ({"not_possible"} if kinds else set())
