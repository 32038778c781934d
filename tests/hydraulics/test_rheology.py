"""The flow curve of a mud."""

import numpy as np
import pytest

from fctd.hydraulics.rheology import FLATTEST, Rheology


def test_stress_is_that_of_herschel_and_bulkley() -> None:
    found = Rheology(np.array([0.0, 2.0]), np.array([0.02, 0.5]), np.array([1.0, 0.5])).stress(100.0)
    assert found.tolist() == pytest.approx([2.0, 7.0])


def test_upper_index_is_that_of_a_power_law_and_lower_with_a_yield_stress() -> None:
    assert Rheology(0.0, 0.5, 0.7).upper_index == pytest.approx(0.7)
    assert Rheology.newtonian(np.array([0.02, 0.0])).upper_index.tolist() == pytest.approx([1.0, 1.0])
    # Plastic viscosity 20 and yield point 20 of a viscometer: readings 60 and 40, n = log2(1.5).
    assert Rheology(20.0, 20 / 511, 1.0).upper_index == pytest.approx(np.log2(1.5))
    assert Rheology(10.0, 0.0, 1.0).upper_index == FLATTEST
