"""Percentiles of results: error bars that hold the true value as often as they say, tables, and their convergence."""

import numpy as np
import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.sweep.percentiles import columns_of, convergence_table, percentile_table, quantile


def rows(values: list[float], depth: float = 100.0) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "sample": range(len(values)),
            "operation": "trip_in",
            "bit_depth_m": depth,
            "hookload_N": values,
            "status": "a",
        }
    )


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.5, 0.95])
def test_an_error_bar_holds_the_true_percentile_in_95_of_100_cases(share: float) -> None:
    """Of 600 draws of 200 samples, within four standard errors; the binomial steps make it a little wider."""
    from scipy import stats

    draw, true, inside = np.random.default_rng(3), stats.gumbel_r.ppf(share), 0
    for _ in range(600):
        _, low, high = quantile(draw.gumbel(size=200), share)
        inside += low <= true <= high
    assert 0.95 - 4 * np.sqrt(0.95 * 0.05 / 600) <= inside / 600 <= 0.99


def test_an_error_bar_that_ends_beyond_the_samples_is_open() -> None:
    value, low, high = quantile(np.arange(20.0), 0.02)
    assert np.isnan(low)
    assert value < high
    assert np.isnan(quantile(np.array([]), 0.5)).all()


def test_a_table_has_a_row_for_every_place_column_and_percentile() -> None:
    table = pd.concat([rows([1.0, 2.0, 3.0, np.nan]), rows([5.0] * 4, 200.0)], ignore_index=True)
    found = percentile_table(table, ["hookload_N"], (10.0, 50.0))
    assert found["bit_depth_m"].tolist() == [100, 100, 200, 200]
    first = found[(found["bit_depth_m"] == 100) & (found["percentile"] == 50)].iloc[0]
    assert (first["value"], first["mean"], first["sd"]) == (2, 2, 1)
    assert (first["samples"], first["without"]) == (3, 1)


def test_convergence_is_that_of_more_and_more_samples_at_the_last_depth() -> None:
    """Its bar at the median of a normal distribution, of which any 2ᵏ samples have one in every 2ᵏ-th."""
    from scipy import stats

    values = stats.norm.ppf(stats.qmc.Halton(1, scramble=False).random(1025)[1:, 0])
    table = pd.concat([rows(values.tolist()), rows((values + 9).tolist(), 200.0)], ignore_index=True)
    found = convergence_table(table, ["hookload_N"], (50.0,))
    assert found["samples"].tolist() == [128, 256, 512, 1024]
    assert found["bit_depth_m"].tolist() == [200] * 4
    width = (found["high"] - found["low"]).to_numpy()
    # The number below the median has the deviation √n/2, and two samples are √2π/n apart: to the nearest at both ends.
    for n, found_width in zip(found["samples"], width, strict=True):
        assert found_width == pytest.approx(2 * 1.96 * np.sqrt(np.pi / 2 / n), abs=2 * np.sqrt(2 * np.pi) / n)
    assert found["value"].iloc[3] == pytest.approx(np.quantile(values, 0.5) + 9)


def test_columns_are_those_that_are_wanted_or_the_loads() -> None:
    assert columns_of(rows([1.0]), ()) == ["hookload_N"]
    assert columns_of(rows([1.0]), ("bit_depth_m",)) == ["bit_depth_m"]
    for wrong in ("hookload", "status"):
        with pytest.raises(InputError, match=r"uncertainty\.columns"):
            columns_of(rows([1.0]), (wrong,))
