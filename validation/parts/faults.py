"""Faults of disk, cache, environment and users, tried on commands: exit code, message, what is lost.

Every fault runs a small case in a folder of its own, and compares the result with that of an undisturbed run.
"""

import errno
import io
import itertools
import os
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fctd.cli.main import app
from fctd.store import whole_file
from fctd.store.run_folder import RunFolder, run_path
from validation.harness.study import ROOT
from validation.parts.killed_runs import Command, forked, tables_of, trip

SMALL = trip("arcs", 620.0)
AT_ONCE = 16
# The largest file [bytes] on a disk that is full from the start, which a checkpoint of the small case exceeds, and on
# one that is full at the end, which only a table of its result exceeds.  Bytes of all files until a disk fails.
FULL_AT_START, FULL_AT_END, UNTIL_FAILURE = 20_000, 60_000, 50_000


# Nobody can make this folder, a superuser neither.
NO_HOME: dict[str, str | None] = {
    "HOME": "/dev/null/home", "XDG_CACHE_HOME": None, "NUMBA_CACHE_DIR": None, "USERPROFILE": None,
}  # fmt: skip


@dataclass(frozen=True)
class Tried:
    """What came of a fault: exit code of the command and what is wrong, empty where all is as it should be."""

    fault: str
    exit_code: int
    wrong: str


class Ground:
    """A folder with a case; wanted : the tables of its undisturbed run, which is run where they are not given."""

    def __init__(self, folder: Path, command: Command = SMALL, wanted: Mapping[str, bytes] | None = None) -> None:
        self.folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.toml").write_text(command.case)
        self.log, self.out = folder / "log", folder / "out"
        if wanted is None:
            if code := self.run("simulate", folder / "case.toml", "--out", folder / "whole"):
                raise AssertionError(f"the undisturbed run ended with {code}: {self.said}")
            wanted = tables_of(folder / "whole")
            self.log.unlink()
        self.wanted = wanted

    def run(self, *arguments: object, before: Callable[[], None] | None = None) -> int:
        """Exit code of a command in a fork."""
        return forked(app, [*map(str, arguments), "-q"], log=self.log, before=before)

    def begin(self, *more: object, before: Callable[[], None] | None = None) -> int:
        """Exit code of the case's run into ``out``."""
        return self.run(
            "simulate",
            self.folder / "case.toml",
            "--out",
            self.out,
            "--checkpoint-every",
            "0.01 s",  # a fast machine computes for 0.04 s
            *more,
            before=before,
        )

    @property
    def said(self) -> str:
        """All that has been printed."""
        return self.log.read_text(errors="replace") if self.log.exists() else ""

    def judge(self, fault: str, code: int, wanted: int, *messages: str, result: bool = True) -> Tried:
        """A fault with the exit code and the messages that it should have; result : whether there is to be one."""
        wrong = [] if code == wanted else [f"exit code {code} in place of {wanted}"]
        wrong += [f"no word of {text!r}" for text in messages if text not in self.said]
        wrong += ["a traceback"] if "Traceback" in self.said else []
        if result and (not self.out.is_dir() or tables_of(self.out) != self.wanted):
            wrong.append("another result")
        return Tried(fault, code, "; ".join(wrong))


def full_disk(ground: Ground) -> Tried:
    """A disk that is full from the start: nothing is kept, and nothing is left in the way."""
    code = ground.begin(before=no_larger_than(FULL_AT_START))
    tried = ground.judge("full disk", code, 2, "File too large", "make room", result=False)
    left = "something is left in the way" if run_path(ground.out).exists() else ""
    return Tried(tried.fault, code, "; ".join(filter(None, (tried.wrong, left))))


def full_at_the_end(ground: Ground) -> Tried:
    """A disk that is full when the result is written: the run goes on once there is room."""
    code = ground.begin(before=no_larger_than(FULL_AT_END))
    return _gone_on(ground, ground.judge("disk full at the end", code, 2, "File too large", "--resume", result=False))


def no_larger_than(most: int) -> Callable[[], None]:
    """Limits the size of files that a process writes [bytes]."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))


def failing_disk(ground: Ground) -> Tried:
    """A disk on which every write fails after the first ones."""
    left = UNTIL_FAILURE

    class Failing(io.FileIO):
        def write(self, content: Any) -> int:
            nonlocal left
            left -= len(content)
            if left < 0:
                raise OSError(errno.EIO, os.strerror(errno.EIO))
            return super().write(content) or 0

    def failing() -> None:
        vars(whole_file)["open_file"] = lambda path: Failing(path, "wb")

    fault = "disk that fails halfway"
    tried = ground.judge(
        fault, ground.begin(before=failing), 2, "Input/output error", "make room", "--resume", result=False
    )
    return _gone_on(ground, tried)


def _gone_on(ground: Ground, tried: Tried, before: Callable[[], None] | None = None) -> Tried:
    """What has been tried, and what came of going on."""
    after = ground.judge(tried.fault, ground.run("simulate", "--resume", ground.out, before=before), 0)
    return Tried(tried.fault, tried.exit_code, "; ".join(filter(None, (tried.wrong, after.wrong))))


def jumping_clock(ground: Ground) -> Tried:
    """The clock on the wall is set back by a day and on by a year, again and again, as the run begins and goes on."""
    real, jumps = time.time, itertools.cycle([0.0, -86400.0, 3e7])

    def jumping() -> None:
        vars(time)["time"] = lambda: real() + next(jumps)

    def full() -> None:
        no_larger_than(FULL_AT_END)()
        jumping()

    tried = ground.judge("clock that jumps", ground.begin(before=full), 2, "--resume", result=False)
    return _gone_on(ground, tried, before=jumping)


def read_only(ground: Ground) -> Tried:
    """The place may only be read; a superuser may write there, and has a file in the way instead."""
    place = ground.folder / "locked"
    place.mkdir()
    out = place / "out"
    if os.geteuid() == 0:
        out = ground.folder / "case.toml" / "out"
    else:
        place.chmod(0o555)
    code = ground.run("simulate", ground.folder / "case.toml", "--out", out)
    return ground.judge("read-only folder", code, 2, "--out = ", "a folder that can be written", result=False)


def two_runs(ground: Ground) -> Tried:
    """A second run on the folder of a first one is refused with its process number; the first ends."""
    folder = RunFolder.take(ground.out)
    code = ground.begin()
    folder.leave(remove=True)
    tried = ground.judge("two runs on one folder", code, 2, f"process {os.getpid()} does", result=False)
    after = ground.judge(tried.fault, ground.begin(), 0)
    return Tried(tried.fault, code, "; ".join(filter(None, (tried.wrong, after.wrong))))


def environment(ground: Ground, fault: str, changes: Mapping[str, str | None], *said: str) -> Tried:
    """A command in a process of its own with another environment."""
    done = subprocess.run(
        command_line(ground), cwd=ROOT, capture_output=True, text=True, errors="replace", env=environment_of(changes)
    )
    ground.log.write_text(done.stdout + done.stderr)
    return ground.judge(fault, done.returncode, 0, *said)


def environment_of(changes: Mapping[str, str | None]) -> dict[str, str]:
    """The environment with changes; None removes a variable."""
    merged: dict[str, str | None] = {**os.environ, **changes}
    return {key: value for key, value in merged.items() if value is not None}


def command_line(ground: Ground) -> list[str]:
    """The run of a ground as a command of the system."""
    return [sys.executable, "-m", "fctd", "simulate", str(ground.folder / "case.toml"), "--out", str(ground.out), "-q"]


def locale_c(ground: Ground) -> Tried:
    """A locale that knows ASCII alone."""
    return environment(ground, "locale C", {"LC_ALL": "C", "LANG": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"})


def no_home(ground: Ground) -> Tried:
    """No home folder, and none for caches: compiled code is kept in a temporary folder, and the command says so."""
    return environment(ground, "no home", NO_HOME, "compiled code is not kept")


def cache_lost(ground: Ground) -> Tried:
    """The folder of compiled code is damaged, and then removed, while the command runs."""
    cache = ground.folder / "cache"
    cache.mkdir(mode=0o700)
    started = subprocess.Popen(
        command_line(ground), cwd=ROOT, env=os.environ | {"NUMBA_CACHE_DIR": str(cache)},
        stdout=(log := ground.log.open("w")), stderr=log,
    )  # fmt: skip
    files: list[Path] = []
    while started.poll() is None and len(files) < 4:
        files = [path for path in cache.glob("fctd.*") if path.is_file()]
        time.sleep(0.05)
    for path in files:
        path.write_bytes(path.read_bytes()[:100])
    time.sleep(0.5)
    shutil.rmtree(cache, ignore_errors=True)
    code = started.wait()
    log.close()
    return ground.judge("cache damaged and removed", code, 0)


def at_once(folder: Path, fault: str, cache: Path | None) -> Tried:
    """Sixteen runs of one case at once, with one cache of compiled code; None: that of the user."""
    first = Ground(folder / "first")
    own: dict[str, str | None] = {}
    if cache is not None:
        cache.mkdir(mode=0o700, exist_ok=True)
        own["NUMBA_CACHE_DIR"] = str(cache)
    runs = []
    for k in range(AT_ONCE):
        out = folder / f"out-{k}"
        arguments = [*command_line(first)[:-2], str(out), "-q"]
        runs.append((out, subprocess.Popen(
            arguments, cwd=ROOT, env=environment_of(own), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        )))  # fmt: skip
    wrong = []
    for out, process in runs:
        _, said = process.communicate()
        if process.returncode or "Traceback" in said:
            wrong.append(f"exit code {process.returncode}: {said[-200:]}")
        elif tables_of(out) != first.wanted:
            wrong.append("another result")
    return Tried(fault, max(process.returncode for _, process in runs), "; ".join(wrong))


FAULTS: dict[str, Callable[[Ground], Tried]] = {
    "full disk": full_disk,
    "disk full at the end": full_at_the_end,
    "disk that fails halfway": failing_disk,
    "clock that jumps": jumping_clock,
    "read-only folder": read_only,
    "two runs on one folder": two_runs,
    "locale C": locale_c,
    "no home": no_home,
    "cache damaged and removed": cache_lost,
}
# Those that compile everything, which takes a minute.
SLOW = {"no home", "cache damaged and removed"}
