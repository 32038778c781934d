"""What a machine has: processors, time and memory, and what is said where they are spent."""

import mmap
import os
import platform
import shutil
from collections.abc import Iterator
from multiprocessing import get_all_start_methods, get_context
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.store import limits
from fctd.store.limits import LimitReached, Limits, check_disk, cores, resident_memory


def test_the_time_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(limits, "monotonic", lambda: now[0])
    watched = Limits(time=60.0, began=100.0)
    now[0] = 159.0
    watched.check()
    now[0] = 160.0
    with pytest.raises(LimitReached, match="the time limit of 60 s"):
        watched.check()


# What a process holds, what a run may take, and what it takes too much [bytes].
HELD, MOST, TOO_MUCH = 300_000_000, 200_000_000, 270_000_000


@pytest.fixture(scope="module")
def large() -> Iterator[None]:
    """This process holds more than a run may take, as a notebook does."""
    held = np.ones(HELD, np.uint8)
    yield
    assert held.all()


def run() -> None:
    """A run that takes little, then too much, and gives it back."""
    watched = Limits(memory=MOST)
    watched.check()
    taken = np.ones(TOO_MUCH, np.uint8)
    with pytest.raises(LimitReached, match=r"the run has taken 2\d\d MB of memory, the limit is 200 MB"):
        watched.check()
    del taken
    watched.check()


@pytest.mark.usefixtures("large")
def test_the_memory_limit_counts_what_is_taken_since_the_run_began() -> None:
    run()


@pytest.mark.usefixtures("large")
@pytest.mark.parametrize("method", sorted({"fork", "spawn"} & set(get_all_start_methods())))
def test_a_process_that_a_large_one_starts_counts_its_own_memory(method: str) -> None:
    """A copy of the large one, ``fork``, and another program, ``spawn``."""
    process = get_context(method).Process(target=run)
    process.start()
    process.join()
    assert process.exitcode == 0


def test_every_system_says_how_much_memory_a_process_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    """What is reserved, and not used yet, is not held."""
    pytest.importorskip("psutil")
    with mmap.mmap(-1, 2**30):
        here = resident_memory()
        assert 2e7 < here < 1e12  # bytes, not kilobytes
        monkeypatch.setattr(platform, "system", lambda: "Darwin")
        assert resident_memory() == pytest.approx(here, rel=0.3)


def test_processors_are_those_that_may_be_used(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(limits, "CPU_QUOTA", tmp_path / "cpu.max")
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: {3, 5, 6, 7}, raising=False)
    assert cores() == 4
    for quota, expected in (("max 100000", 4), ("250000 100000", 3), ("5000 100000", 1), ("900000 100000", 4)):
        limits.CPU_QUOTA.write_text(f"{quota}\n")
        assert cores() == expected


def test_a_disk_that_is_too_small_is_refused_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=1e8))
    check_disk(tmp_path / "not" / "yet", 0.9e8, "--out")
    with pytest.raises(InputError, match=r"150 MB free \(this one has 100 MB\)") as refused:
        check_disk(tmp_path / "not" / "yet", 1.5e8, "--out")
    assert refused.value.key == "--out"
