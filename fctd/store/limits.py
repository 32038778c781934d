"""What a machine has: processors, and limits of time and memory, at which a long run ends and keeps what it has."""

import os
import sys
from dataclasses import dataclass, field
from time import monotonic


class LimitReached(Exception):  # noqa: N818 (no error: the run has been asked to stop)
    """A computation has reached a limit; the text says which."""


@dataclass(frozen=True)
class Limits:
    """time : wall-clock time from now on [s]; memory : of the process, at its largest [bytes]; None: no limit."""

    time: float | None = None
    memory: float | None = None
    began: float = field(default_factory=monotonic)

    def check(self) -> None:
        """Raise LimitReached where a limit is reached."""
        if self.time is not None and monotonic() - self.began >= self.time:
            raise LimitReached(f"the time limit of {self.time:g} s is reached")
        if self.memory is not None and (used := largest_memory()) >= self.memory:
            raise LimitReached(f"{used / 1e6:.0f} MB of memory are in use, the limit is {self.memory / 1e6:g} MB")


def cores() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def largest_memory() -> float:
    """The largest memory of this process so far [bytes]; 0 on systems that do not say."""
    try:
        import resource
    except ImportError:  # Windows
        return 0.0
    unit = 1 if sys.platform == "darwin" else 1024
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)
