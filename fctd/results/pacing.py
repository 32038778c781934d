"""How often a computation is kept on disk: as often as wanted, within a small share of its time."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

# Of the time of a computation, at most this share goes into keeping it.
SHARE = 0.01
# The next time is expected to take so many times as long as the last one, since there may be more to write and the disk
# may be busier; the first time, so long [s].
DEARER, FIRST = 2.0, 0.02


class Clocks(NamedTuple):
    """Times [s]: wall, which runs on while a process waits for the disk; own, that of the processor spent on it."""

    wall: float
    own: float

    @classmethod
    def now(cls) -> "Clocks":
        """Both clocks, from moments of their own."""
        return cls(time.monotonic(), time.process_time())

    def since(self, before: "Clocks") -> "Clocks":
        """The times from one moment to this one."""
        return Clocks(self.wall - before.wall, self.own - before.own)

    def plus(self, more: "Clocks") -> "Clocks":
        """The sums."""
        return Clocks(self.wall + more.wall, self.own + more.own)


class Pace:
    """When a computation is kept, from now on.

    every : least time between two times [s].  spent : that keeping took so far.  By both clocks, keeping takes at most
    ``SHARE`` of the time: on a busy machine that of the processor runs out first, with a slow disk that on the wall.
    """

    def __init__(self, every: float) -> None:
        self.every, self.spent = every, Clocks(0.0, 0.0)
        self._began = Clocks.now()
        self._last, self._expected = self._began.wall, Clocks(FIRST, FIRST)

    @property
    def took(self) -> float:
        """Time on the wall so far [s]."""
        return Clocks.now().wall - self._began.wall

    def due(self) -> bool:
        """Whether it is time to keep the computation."""
        now = Clocks.now()
        if now.wall - self._last < self.every:
            return False
        passed, then = now.since(self._began), self.spent.plus(self._expected)
        return then.wall <= SHARE * passed.wall and then.own <= SHARE * passed.own

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """Add the time of what is done within."""
        before = Clocks.now()
        try:
            yield
        finally:
            self.spent = self.spent.plus(Clocks.now().since(before))

    @contextmanager
    def keeping(self) -> Iterator[None]:
        """Add the time of what is done within, which keeps the computation; it is due again later."""
        before = self.spent
        with self.reporting():
            yield
        took = self.spent.since(before)
        self._last, self._expected = Clocks.now().wall, Clocks(DEARER * took.wall, DEARER * took.own)
