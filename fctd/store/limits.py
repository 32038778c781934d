"""What a machine has: processors, disk, and limits of time and memory at which a run ends and keeps what it has."""

import os
import platform
import shutil
from dataclasses import dataclass, field
from math import ceil
from pathlib import Path
from time import monotonic

from fctd.case.errors import InputError

CPU_QUOTA = Path("/sys/fs/cgroup/cpu.max")  # processor time [µs] in a period [µs], as a container sees it


class LimitReached(Exception):  # noqa: N818 (no error: the run has been asked to stop)
    """A computation has reached a limit; the text says which."""


@dataclass
class Limits:
    """time : wall-clock time from now on [s]; memory : that the process takes from now on [bytes]; None: no limit."""

    time: float | None = None
    memory: float | None = None
    began: float = field(default_factory=monotonic)

    def __post_init__(self) -> None:
        """What the process holds at the beginning is not the run's."""
        self._held = 0 if self.memory is None else resident_memory()

    def check(self) -> None:
        """Raise LimitReached where a limit is reached."""
        if self.time is not None and monotonic() - self.began >= self.time:
            raise LimitReached(f"the time limit of {self.time:g} s is reached")
        if self.memory is not None and (taken := resident_memory() - self._held) >= self.memory:
            most = f"{self.memory / 1e6:g} MB"
            raise LimitReached(f"the run has taken {taken / 1e6:.0f} MB of memory, the limit is {most}")


def cores() -> int:
    """Number of processors that this process may use, by its affinity and by the quota of a container."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    try:
        quota, period = map(int, CPU_QUOTA.read_text(encoding="ascii").split())
    except (OSError, ValueError):  # no container, or no quota ("max 100000")
        return usable
    return min(usable, ceil(quota / period))


def resident_memory() -> int:
    """Memory of this process at present [bytes].

    Its largest, ``ru_maxrss``, is of no use: Linux hands that of a parent down to the program that it starts.
    """
    if platform.system() == "Linux":
        return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * os.sysconf("SC_PAGE_SIZE")
    import psutil

    return int(psutil.Process().memory_info().rss)


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
