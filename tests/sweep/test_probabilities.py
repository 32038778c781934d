"""Probabilities: what counts as an event, where, and intervals."""

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.sweep.limits import LimitSpec
from fctd.sweep.probabilities import interval, probability_table

ROWS = pd.DataFrame(
    {
        "sample": [0, 0, 1, 1, 2, 2, 3],
        "operation": ["trip_in"] * 6 + [None],
        "bit_depth_m": [100.0, 200.0] * 3 + [np.nan],
        "hookload_N": [5.0, 6.0, 5.0, np.nan, 5.0, 9.0, np.nan],
        "buckling": ["none", "sinusoidal", "none", "unknown", "none", "helical", None],
        "status": ["converged", "converged", "converged", "locked_up", "converged", "converged", "failed"],
    }
)


@pytest.mark.parametrize(
    ("event", "depth", "expected", "count"),
    [
        ("buckled", 200.0, 0.5, 2),
        ("buckled", 100.0, 0.0, 0),
        ("buckled", None, 0.5, 2),
        ("buckled helically", None, 0.25, 1),
        ("locked up", 200.0, 0.25, 1),
        ("hookload_N above 5.5", None, 0.5, 2),
        # A sample without rows.
        ("no answer", None, 0.25, 1),
        ("no answer", 100.0, 0.25, 1),
    ],
)
def test_events_are_counted_at_a_depth_and_anywhere(
    event: str, depth: float | None, expected: float, count: int
) -> None:
    table = probability_table(ROWS, [LimitSpec(column="hookload_N", above=5.5)], 4)
    here = table["bit_depth_m"].isna() if depth is None else table["bit_depth_m"] == depth
    (row,) = table[here & (table["event"] == event)].to_dict("records")
    assert row["low"] <= row["probability"] <= row["high"]
    assert (row["probability"], row["count"]) == (expected, count)


def test_answers_that_are_to_be_doubted_are_events() -> None:
    doubtful = ROWS.assign(
        status=["under_resolved", "converged", "converged", "unstable", "converged", "converged", "failed"]
    )
    table = probability_table(doubtful, [], 4)
    counts = table[table["bit_depth_m"].isna()].set_index("event")["count"]
    assert (counts["under resolved"], counts["unstable"]) == (1, 1)
    assert "inaccurate" not in counts


def test_limits_of_string_and_rig_are_events_where_a_sample_has_their_note() -> None:
    noted = ROWS.assign(notes=["none", "yield, buckling", "tensile_capacity, hoist", "none", "yield", "none", None])
    table = probability_table(noted, [], 4)
    counts = table[table["bit_depth_m"].isna()].set_index("event")["count"]
    assert (counts["beyond yield"], counts["beyond tensile capacity"], counts["beyond hoist"]) == (2, 1, 1)
    assert not {"beyond penetration", "beyond buckling"} & set(counts.index)


def test_a_limit_of_a_column_that_is_not_there_is_refused() -> None:
    limits = [LimitSpec(column="hookload_N", below=1), LimitSpec(column="hookloads_N", below=1)]
    with pytest.raises(InputError, match=r"uncertainty\.limits\[1\]\.column = .*the column hookload_N"):
        probability_table(ROWS, limits, 4)


def test_a_limit_has_a_unit() -> None:
    table = probability_table(ROWS, [LimitSpec(column="hookload_N", above="0.0055 kN")], 4)
    here = table[(table["event"] == "hookload_N above 0.0055 kN") & table["bit_depth_m"].isna()]
    assert here["count"].tolist() == [2]  # as above 5.5


def test_intervals_are_those_of_wilson() -> None:
    """Published example: 10 of 100 is 5.52 to 17.44 % (Newcombe 1998)."""
    assert interval(10, 100) == pytest.approx((0.0552, 0.1744), abs=1e-4)
    assert interval(0, 50)[0] == 0
    assert 0.05 < interval(0, 50)[1] < 0.08
