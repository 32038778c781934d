"""How often a computation is saved on disk: as often as wanted, within a small share of its time."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from fctd.store.facts import Restorable

# Of the time of a computation, at most this share goes into saving it.
SHARE = 0.01
# The next time is expected to take so many times as long as the last one, since there may be more to write and the disk
# may be busier; the first time, so long [s].
DEARER, FIRST = 2.0, 0.02


def clocks() -> NDArray[np.float64]:
    """Times (2,) [s]: on the wall, which runs on while a process waits for the disk, and of the processor."""
    return np.array([time.monotonic(), time.process_time()])


class SaveInterval(Restorable):
    """When a computation is saved, from now on.

    every : least time between two times [s].  passed, spent (2,) : time of the computation so far, and that of saving
    it.  By both clocks, saving takes at most ``SHARE`` of the time: on a busy machine that of the processor runs out
    first, with a slow disk that on the wall.  A process that goes on with a computation counts on.
    """

    FACTS = ("passed", "spent")

    def __init__(self, every: float) -> None:
        self.every, self.spent = every, np.zeros(2)
        self.passed = np.zeros(2)
        self._last, self._expected = clocks()[0], np.full(2, FIRST)

    @property
    def passed(self) -> NDArray[np.float64]:
        """Time of the computation so far."""
        return clocks() - self._began

    @passed.setter
    def passed(self, passed: NDArray[np.float64]) -> None:
        self._began = clocks() - passed

    def due(self) -> bool:
        """Whether it is time to save the computation."""
        if clocks()[0] - self._last < self.every:
            return False
        return bool((self.spent + self._expected <= SHARE * self.passed).all())

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """Add the time of what is done within."""
        before = clocks()
        try:
            yield
        finally:
            self.spent = self.spent + clocks() - before

    @contextmanager
    def saving(self) -> Iterator[None]:
        """Add the time of what is done within, which saves the computation; it is due again later."""
        before = self.spent
        with self.reporting():
            yield
        self._last, self._expected = clocks()[0], DEARER * (self.spent - before)
