"""The observed order: exact on powers, honest on scatter, none where there is none."""

import math

import numpy as np
import pytest

from fctd.steady.observed_order import observe

COUNTS = np.round(10 * 2 ** np.arange(0, 7, 0.5))


@pytest.mark.parametrize("order", [0.8, 1.0, 1.5, 2.0])
def test_a_power_has_its_order_and_its_end(order: float) -> None:
    found = observe(COUNTS, 800e3 - 5e4 * COUNTS**-order)
    assert found.order == pytest.approx(order, abs=0.005)
    assert found.order_high - found.order_low <= 0.02
    assert found.limit == pytest.approx(800e3, rel=1e-6)
    assert found.limit_low <= found.limit <= found.limit_high


@pytest.mark.parametrize("order", [1.0, 2.0])
def test_intervals_hold_what_they_say_where_a_load_scatters_by_whole_segments(order: float) -> None:
    """95 % of 200 sequences; a binomial of 0.95 has fewer than 180 in one of a thousand."""
    scatter = np.random.default_rng(1).standard_normal((200, len(COUNTS)))
    every = [observe(COUNTS, 100 + 50 * (COUNTS / 10) ** -order + 10 * each / COUNTS) for each in scatter]
    found = [one for one in every if np.isfinite(one.order)]
    assert len(found) > 150
    assert np.mean([one.order_low - 0.01 <= order <= one.order_high + 0.01 for one in found]) > 0.9
    assert np.mean([one.limit_low <= 100 <= one.limit_high for one in found]) > 0.9


def test_scatter_alone_has_no_order() -> None:
    scatter = np.random.default_rng(2).standard_normal((50, len(COUNTS)))
    orders = [observe(COUNTS, 100 + each / COUNTS).order for each in scatter]
    assert np.isnan(orders).mean() > 0.9


def test_few_loads_have_no_order_and_missing_ones_are_left_out() -> None:
    loads = 100 + 5 / COUNTS
    assert math.isnan(observe(COUNTS[:5], loads[:5]).order)
    assert observe(COUNTS[:6], loads[:6]).order == pytest.approx(1.0, abs=0.01)
    loads[3] = np.nan
    assert observe(COUNTS, loads).order == pytest.approx(1.0, abs=0.01)
    assert math.isnan(observe(COUNTS, np.full(len(COUNTS), np.nan)).order)
    assert math.isnan(observe(COUNTS, np.full(len(COUNTS), 3.0)).order)
