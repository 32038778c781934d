"""A range of counts: its strings, the counts that a tolerance takes, and what is refused."""

from typing import Any

import numpy as np
import pytest

import fctd
from fctd import InputError
from fctd.model.layouts import uniform, with_components
from fctd.model.operations import steady_rates
from fctd.steady.counts import GROWTH, ends_of
from fctd.steady.levels import relative_difference
from tests.cases import make_case, pipe

BUILD = [[0, 0, 0], [400, 0, 0], [800, 60, 0], [1300, 60, 0]]
KINDS = ["rotate_off_bottom", "trip_out"]


@pytest.mark.parametrize(
    "given", ["10", "10:50", "1:100", "0:100", "10:20000", "ten:1000", "10:100:1", "1e1:1e3", "", (10,), 10, (1, 80)]
)
def test_another_range_is_refused(given: Any) -> None:
    with pytest.raises(InputError, match="FROM:TO") as refused:
        ends_of(given)
    assert refused.value.key == "segments"


def test_a_range_is_a_text_or_a_pair() -> None:
    assert ends_of("10:1000") == ends_of((10, 1000)) == (10, 1000)


def test_the_counts_of_a_range_and_what_they_say() -> None:
    case = make_case(
        BUILD, [pipe(None, None, segment_length=10.0)], mud={"density": 1200.0}, wellbore={"geometry": "arcs"}
    )
    found = fctd.refine(case, 0.01, KINDS, 1300.0, segments="8:400")
    assert found.orders is not None
    plain = fctd.refine(case, 0.01, KINDS, 1300.0)
    assert (found.segments, found.error, plain.orders) == (plain.segments, plain.error, None)

    steps = found.steps[(found.steps["stage"] == "counts") & (found.steps["operation"] == KINDS[0])]
    exact = {kind: fctd.equilibrium(with_components(case, uniform(case, 1300.0, 0.7)), kind, 1300.0) for kind in KINDS}
    for layout in ("uniform", "graded"):
        counts = steps.loc[steps["layout"] == layout, "segments"].to_numpy()
        assert (counts.min() >= 8, counts.max() <= 400, counts.max() * GROWTH > 390) == (True, True, True)
        assert (np.diff(counts) > 0).all()
        assert np.diff(np.log(counts)) == pytest.approx(np.log(GROWTH), abs=0.35)
    default = steps[steps["layout"] == "default"]
    assert len(default) == 1
    by_default = make_case(BUILD, [pipe(None, None)], mud={"density": 1200.0}, wellbore={"geometry": "arcs"})
    assert default["segments"].iloc[0] == len(fctd.equilibrium(by_default, KINDS[0], 1300.0).profile) - 1
    assert default["torque_error"].iloc[0] < 0.01

    # Each error is at least the distance from a string of 1,857 segments, within the uncertainty of that.
    table = found.steps[found.steps["stage"] == "counts"]
    for kind, fine in exact.items():
        rows = table[table["operation"] == kind]
        off = abs(rows["hookload_N"] / fine.hookload - 1)
        assert (off <= rows["hookload_error"] + 2e-4).all()
    for row in found.orders.to_dict("records"):
        kind, length = row["operation"], 1300.0 / max(row["hookload_segments"], row["torque_segments"])
        if row["layout"] == "uniform":
            point = fctd.equilibrium(with_components(case, uniform(case, 1300.0, length)), kind, 1300.0)
            assert max(relative_difference(point, exact[kind], steady_rates(case, kind).spin)) <= 0.01
        assert row["hookload_limit_low_N"] <= row["hookload_limit_N"] <= row["hookload_limit_high_N"]
        assert row["hookload_limit_N"] == pytest.approx(exact[kind].hookload, rel=1e-3)


def test_a_tolerance_that_no_count_reaches_takes_more_than_were_tried() -> None:
    case = make_case(BUILD, [pipe(None, None, segment_length=10.0)], wellbore={"geometry": "arcs"})
    found = fctd.refine(case, 1e-7, KINDS[0], 1300.0, most=64, segments=(8, 64))
    assert found.orders is not None
    assert found.orders["torque_segments"].isna().all()
