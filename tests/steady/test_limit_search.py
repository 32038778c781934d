"""The load at a limit: the root of an excess, also where some loads have no steady string."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.steady.limit_search import CLOSE, MOST_CAPACITY, last_of, root_of

SCALE = 1e6


@given(limit=st.floats(1e-3, 3.9), power=st.floats(0.5, 3.0))
def test_the_root_of_an_excess_that_grows(limit: float, power: float) -> None:
    assert root_of(lambda load: (load / (limit * SCALE)) ** power - 1, SCALE) == pytest.approx(limit * SCALE, rel=1e-6)


@given(limit=st.floats(0.05, 3.0), at=st.floats(0.7, 1.3), width=st.floats(1e-6, 1e-3))
def test_loads_without_a_string_are_passed(limit: float, at: float, width: float) -> None:
    """The answer is on the side of the string, within the gap."""

    def excess(load: float) -> float:
        share = load / (limit * SCALE)
        return float("nan") if abs(share - at) < width else share - 1

    found = root_of(excess, SCALE) / (limit * SCALE)
    assert 1 - 2.1 * width <= found <= 1 + 1e-6
    assert np.isfinite(excess(found * limit * SCALE))


def test_a_string_beyond_its_limit_or_without_one_has_no_load() -> None:
    assert np.isnan(root_of(lambda load: load / SCALE + 0.1, SCALE))
    assert np.isnan(root_of(lambda load: -1.0, SCALE))
    assert np.isnan(root_of(lambda load: -1.0 if load == 0 else float("nan"), SCALE))
    assert np.isnan(root_of(lambda load: load / (2 * MOST_CAPACITY * SCALE) - 1, SCALE))


@given(limit=st.floats(1e-3, 0.999))
def test_the_last_load_up_to_which_something_holds(limit: float) -> None:
    found = last_of(lambda load: load <= limit * SCALE, SCALE)
    assert found <= limit * SCALE <= found * (1 + 2 * CLOSE)


def test_nothing_is_looked_for_beyond_the_largest_load() -> None:
    seen: list[float] = []

    def holds(load: float) -> bool:
        seen.append(load)
        return True

    assert np.isnan(last_of(holds, SCALE))
    assert max(seen) == SCALE
    assert last_of(lambda load: False, SCALE) == 0.0
