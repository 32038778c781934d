"""The table of common units against the unit registry."""

import pytest

from fctd.case.common_units import COMMON
from fctd.case.spellings import by_registry


@pytest.mark.parametrize("target", COMMON)
def test_common_units_have_the_factors_of_the_registry(target: str) -> None:
    assert {unit: by_registry(unit, target) for unit in COMMON[target]} == COMMON[target]
