"""Series of a chart: an operation with one set of friction factors."""

import numpy as np
import pandas as pd
import pytest

from fctd.results.series import FRICTION_LABEL, frictions_of, in_words, series_of

CHART = pd.DataFrame(
    {"operation": ["trip_in", "trip_in", "trip_out", "trip_in"], "friction": [0.2, 0.2, 0.2, np.nan], "row": range(4)}
)


def test_a_series_has_one_operation_and_one_factor_in_the_order_of_rows() -> None:
    found = series_of(CHART)
    assert [(one.operation, one.friction, one.columns["row"].tolist()) for one in found] == [
        ("trip_in", "0.2", [0, 1]),
        ("trip_out", "0.2", [2]),
        ("trip_in", "case's", [3]),
    ]
    assert frictions_of(found) == ["0.2", "case's"]


def test_labels_name_factors_that_differ_along_the_hole() -> None:
    chart = CHART.assign(**{FRICTION_LABEL: ["a", "b", "a", "b"], "friction": np.nan})
    assert [(one.operation, one.friction) for one in series_of(chart)] == [
        ("trip_in", "a"),
        ("trip_in", "b"),
        ("trip_out", "a"),
    ]


@pytest.mark.parametrize(
    ("friction", "words"),
    [
        ("0.25", "friction factor 0.25"),
        ("case's", "friction factors of the case"),
        ("cased 0.20, open 0.30", "friction factors: cased 0.20, open 0.30"),
    ],
)
def test_factors_in_words(friction: str, words: str) -> None:
    assert in_words(friction) == words
