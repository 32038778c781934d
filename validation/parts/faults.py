"""Faults of disk, cache, environment and users, tried on commands: exit code, message, what is lost.

Every fault runs a small case in a folder of its own, and compares the result with that of an undisturbed run.
"""

import os
import resource
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from fctd.cli.main import app
from fctd.results.run_folder import RunFolder, run_path
from validation.harness.study import ROOT
from validation.parts.killed_runs import Command, forked, tables_of, trip

SMALL = trip("arcs", 640.0)
AT_ONCE = 16


@dataclass(frozen=True)
class Tried:
    """What came of a fault: exit code of the command and what is wrong, empty where all is as it should be."""

    fault: str
    exit_code: int
    wrong: str


class Ground:
    """A folder with a case and the tables of its undisturbed run."""

    def __init__(self, folder: Path, command: Command = SMALL) -> None:
        self.folder, self.command = folder, command
        folder.mkdir(parents=True)
        (folder / "case.toml").write_text(command.case)
        self.log, self.out = folder / "log", folder / "out"
        if code := self.run("simulate", folder / "case.toml", "--out", folder / "whole"):
            raise AssertionError(f"the undisturbed run ended with {code}: {self.said}")
        self.wanted = tables_of(folder / "whole")
        self.log.unlink()

    def run(self, *arguments: object, before: Callable[[], None] | None = None) -> int:
        """Exit code of a command in a fork."""
        return forked(app, [*map(str, arguments), "-q"], log=self.log, before=before)

    def begin(self, *more: object, before: Callable[[], None] | None = None) -> int:
        """Exit code of the case's run into ``out``."""
        return self.run(
            "simulate", self.folder / "case.toml", "--out", self.out, "--checkpoint-every", "0 s", *more, before=before
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
    """No file may be larger than 30 kB, which a chunk, a checkpoint or a table of the result is."""

    def limited() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000))

    code = ground.begin(before=limited)
    kept = any(run_path(ground.out).glob("*-history.parquet"))
    tried = ground.judge("full disk", code, 2, "File too large", "--resume" if kept else "make room", result=False)
    if not kept:
        return tried
    again = ground.run("simulate", "--resume", ground.out)
    after = ground.judge("full disk", again, 0)
    return Tried("full disk", code, "; ".join(filter(None, (tried.wrong, after.wrong))))


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
    after = ground.judge("two runs on one folder", ground.begin(), 0)
    return Tried(tried.fault, code, "; ".join(filter(None, (tried.wrong, after.wrong))))


def environment(ground: Ground, fault: str, changes: Mapping[str, str | None], *said: str) -> Tried:
    """A command in a process of its own with another environment; None removes a variable."""
    merged: dict[str, str | None] = {**os.environ, **changes}
    done = subprocess.run(
        command_line(ground), cwd=ROOT, capture_output=True, text=True, errors="replace",
        env={key: value for key, value in merged.items() if value is not None},
    )  # fmt: skip
    ground.log.write_text(done.stdout + done.stderr)
    return ground.judge(fault, done.returncode, 0, *said)


def command_line(ground: Ground) -> list[str]:
    """The run of a ground as a command of the system."""
    return [sys.executable, "-m", "fctd", "simulate", str(ground.folder / "case.toml"), "--out", str(ground.out), "-q"]


def locale_c(ground: Ground) -> Tried:
    """A locale that knows ASCII alone."""
    return environment(ground, "locale C", {"LC_ALL": "C", "LANG": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"})


def no_home(ground: Ground) -> Tried:
    """No home folder, and none for caches: compiled code is kept in a temporary folder, and the command says so."""
    changes = {"HOME": "/nonexistent", "XDG_CACHE_HOME": None, "NUMBA_CACHE_DIR": None, "USERPROFILE": None}
    return environment(ground, "no home", changes, "compiled code is not kept")


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


def at_once(folder: Path, fault: str, cache: Path) -> Tried:
    """Sixteen runs of one case at once, with one cache of compiled code."""
    first = Ground(folder / "first")
    cache.mkdir(mode=0o700, exist_ok=True)
    runs = []
    for k in range(AT_ONCE):
        out = folder / f"out-{k}"
        arguments = [*command_line(first)[:-2], str(out), "-q"]
        runs.append((out, subprocess.Popen(
            arguments, cwd=ROOT, env=os.environ | {"NUMBA_CACHE_DIR": str(cache)}, stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE, text=True,
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
    "read-only folder": read_only,
    "two runs on one folder": two_runs,
    "locale C": locale_c,
    "no home": no_home,
    "cache damaged and removed": cache_lost,
}
# Those that compile everything, which takes a minute.
SLOW = {"no home", "cache damaged and removed"}
