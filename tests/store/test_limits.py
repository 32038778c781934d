"""What a machine has: processors, time and memory, and what is said where they are spent."""

import shutil
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from fctd.case.errors import InputError
from fctd.store import limits
from fctd.store.limits import LimitReached, Limits, check_disk, cores, largest_memory


def test_the_time_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(limits, "monotonic", lambda: now[0])
    watched = Limits(time=60.0, began=100.0)
    now[0] = 159.0
    watched.check()
    now[0] = 160.0
    with pytest.raises(LimitReached, match="the time limit of 60 s"):
        watched.check()


def test_the_memory_limit() -> None:
    Limits(memory=1e15).check()
    if sys.platform != "win32":
        assert 2e7 < largest_memory() < 1e12  # bytes, not kilobytes
        with pytest.raises(LimitReached, match="MB of memory are in use, the limit is 10 MB"):
            Limits(memory=1e7).check()


def test_there_is_a_processor() -> None:
    assert cores() >= 1


def test_a_disk_that_is_too_small_is_refused_before(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shutil, "disk_usage", lambda _: SimpleNamespace(free=1e8))
    check_disk(tmp_path / "not" / "yet", 0.9e8, "--out")
    with pytest.raises(InputError, match=r"150 MB free \(this one has 100 MB\)") as refused:
        check_disk(tmp_path / "not" / "yet", 1.5e8, "--out")
    assert refused.value.key == "--out"
