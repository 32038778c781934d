"""The dice of a draw: a numpy generator with the few throws that cases need."""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

Item = TypeVar("Item")


class Dice:
    """The dice of a seed and an index: equal ones throw the same."""

    def __init__(self, seed: int, index: int, salt: int = 0) -> None:
        self._rng = np.random.default_rng([seed, index, salt])

    def chance(self, share: float) -> bool:
        """True with this probability."""
        return bool(self._rng.random() < share)

    def pick(self, items: Sequence[Item]) -> Item:
        """One of the items."""
        return items[int(self._rng.integers(len(items)))]

    def number(self, low: float, high: float, digits: int = 4) -> float:
        """A number with few digits, so that a drawn case reads well."""
        return float(f"{self._rng.uniform(low, high):.{digits}g}")

    def whole(self, low: int, high: int) -> int:
        """A whole number from low to high, both included."""
        return int(self._rng.integers(low, high + 1))
