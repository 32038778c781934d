"""What a machine has: processors, disk, and limits of time and memory at which a run ends and keeps what it has."""

import os
import shutil
import sys
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic

from fctd.case.errors import InputError


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


def check_disk(place: Path, needed: float, key: str) -> None:
    """Raise InputError, which names ``key``, where the disk of a folder has less than ``needed`` [bytes]."""
    folder = next(parent for parent in (place, *place.parents) if parent.exists())
    free = shutil.disk_usage(folder).free
    if free < needed:
        expected = (
            f"a disk with {needed / 1e6:.0f} MB free (this one has {free / 1e6:.0f} MB), a longer record.interval or "
            "fewer depths of record.profile_at"
        )
        raise InputError(expected, key=key, value=place)
