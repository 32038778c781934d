"""Processes that read and solve: warm, ended where they take too long, replaced where they die."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from fctd.app import pool as pools
from fctd.app.pool import Pool
from fctd.case.errors import InputError
from tests.app.made import NAME, TEXT, source
from tests.commands import HANG, until

# A process that says what it is told to, or does not come back.
SCRIPTED = """
import json, os, sys, time
if sys.argv[1] == "dies": sys.exit(3)
if sys.argv[1] == "compiles":
    print(json.dumps({"compiling": True}), flush=True)
    while not os.path.exists(ONCE): time.sleep(0.02)
print(json.dumps({"ready": True}), flush=True)
for line in sys.stdin:
    asked = json.loads(line)
    if asked["do"] == "sleep": time.sleep(3600)
    if asked["do"] == "die": os._exit(9)
    if asked["do"] == "die once" and os.path.exists(ONCE): os.remove(ONCE); os._exit(9)
    if asked["do"] == "known" and "source" not in asked: print(json.dumps({"unknown": True}), flush=True); continue
    print(json.dumps({"found": [os.getpid(), asked["do"]]}), flush=True)
"""


@contextmanager
def scripted(folder: Path, monkeypatch: pytest.MonkeyPatch, how: str = "", size: int = 1) -> Iterator[Pool]:
    monkeypatch.setattr(
        pools, "command_of", lambda _: [sys.executable, "-c", f"ONCE = {str(folder / 'once')!r}\n{SCRIPTED}", how]
    )
    pool = Pool(folder, size, longest=HANG)
    try:
        yield pool
    finally:
        pool.close()


def test_a_process_that_takes_too_long_or_dies_is_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with scripted(tmp_path, monkeypatch) as pool:
        first, _ = pool.ask("hello")
        assert pool.ask("known", source()) == [first, "known"]
        pool.longest = 0.5
        with pytest.raises(InputError, match=r"takes longer than 0\.5 s"):
            pool.ask("sleep")
        pool.longest = HANG
        second, _ = pool.ask("hello")
        with pytest.raises(InputError, match=r"was ended 2 times: try again, or a smaller survey"):
            pool.ask("die")
        third, _ = pool.ask("hello")
        assert len({first, second, third}) == 3
        assert pool.note == ""
    assert not list(tmp_path.glob("work-*"))
    with pytest.raises(InputError, match="not free"):
        pool.ask("hello")


def test_a_process_that_was_killed_is_nobodys_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """While it waits, and while it computes."""
    with scripted(tmp_path, monkeypatch) as pool:
        first, _ = pool.ask("hello")
        os.kill(first, signal.SIGKILL)
        second, _ = pool.ask("hello")
        (tmp_path / "once").touch()
        third, _ = pool.ask("die once")
        assert len({first, second, third}) == 3
        assert not (tmp_path / "once").exists()


def test_what_it_does_before_it_is_warm_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with scripted(tmp_path, monkeypatch, "compiles") as pool:
        until(lambda: pool.note == "compiling, once for this version of fctd: about a minute")
        (tmp_path / "once").touch()
        until(lambda: pool.note == "")


def test_processes_that_do_not_start_are_told_of(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with scripted(tmp_path, monkeypatch, "dies") as pool:
        with pytest.raises(InputError, match="does not start"):
            pool.ask("hello")
        assert "does not start" in pool.note


def test_scratch_of_a_pool_that_was_killed_goes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work" / "x").mkdir(parents=True)
    with scripted(tmp_path, monkeypatch, size=2) as pool:
        pool.ask("hello")
        assert [path.name for path in tmp_path.iterdir()] == [pool.folder.name]
        assert not (pool.folder / "x").exists()


@pytest.mark.slow
def test_a_real_process_reads_and_refuses(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also from the folder of the user's state, in which there is one named fctd."""
    (tmp_path / "fctd" / "app").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    pool = Pool(tmp_path, 1)
    try:
        assert pool.ask("open", source())["name"] == NAME
        with pytest.raises(InputError, match="uploaded with the case") as refused:
            pool.ask("open", source(TEXT.replace('"survey.csv"', '"/etc/passwd"')))
        assert str(refused.value).startswith('wellbore.survey = "/etc/passwd": expected the name')
        assert pool.ask("open", source())["name"] == NAME
    finally:
        pool.close()
