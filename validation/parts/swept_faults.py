"""Seeded faults of a sweep: what resumes has the rows of a run that nothing disturbed.

A fault is the death of a worker, of the client or of the scheduler (SIGKILL), a disk that is full, a sample that hangs
or crashes, and Ctrl-C.
"""

import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from fctd.cli.sweep import sweep_command  # noqa: F401 (the command that the processes run)
from fctd.sweep.dataset import open_dataset
from validation.harness.study import ROOT
from validation.parts.clusters import LONGEST, cluster, failing
from validation.parts.small_sweep import sweep_file

KINDS = ("worker", "client", "scheduler", "disk", "worker of a scheduler", "hang", "crash", "interrupt")
# Pause before each sample [s]: two workers take six seconds, the first part is written after two, and a fault comes
# at most two seconds later, before the sweep ends.
SAMPLES, PAUSE, LATER = 60, 0.2, 2.0
# No file may grow beyond this, of a process whose disk is full [B]: sweep.json has 4.8 kB, a part at least 7.4 kB.
DISK = 7_000
HEAD = f'method = "sobol"\nsamples = {SAMPLES}\ntime_limit = "3 s"\n'


@dataclass(frozen=True)
class Tried:
    """A fault: its time after the first part of rows [s], samples with rows when it was over, and what is wrong with
    the rows after resumption, empty where nothing is.
    """

    seed: int
    fault: str
    after_s: float
    samples_before: int
    wrong: str


class Sweeps:
    """A folder with a sweep, and the rows of its run that nothing disturbs."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.file = folder, sweep_file(folder, HEAD)
        # Workers that are to be disturbed are slow, so that a fault finds them at work.
        self.slow = failing(folder, pause=PAUSE)
        if code := self.start(folder / "whole").wait(timeout=LONGEST):
            raise AssertionError(f"the undisturbed sweep ended with {code}")
        self.wanted = open_dataset(folder / "whole").rows()

    def start(
        self, out: Path, *options: object, before: Callable[[], None] | None = None, preload: Path | None = None
    ) -> "subprocess.Popen[bytes]":
        """``fctd sweep`` as a process of its own; before : called in it first; preload : by its workers."""
        environment = os.environ | {"PYTHONPATH": str(ROOT)}
        if preload is not None:
            environment["DASK_DISTRIBUTED__WORKER__PRELOAD"] = f"['{preload}']"
        command = [sys.executable, "-m", "fctd", "sweep", self.file, "--out", out, "--quiet"]
        local = () if options else ("--workers", "2")
        return subprocess.Popen(
            list(map(str, (*command, *local, *options))), cwd=ROOT, env=environment, start_new_session=True,
            preexec_fn=before or _heed_interrupts, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip

    def try_fault(self, seed: int) -> Tried:
        """Run the sweep into a fault, go on with it, and compare."""
        kind, draw, out = KINDS[seed % len(KINDS)], random.Random(seed), self.folder / f"fault-{seed}"
        ill, after = draw.randrange(SAMPLES), draw.uniform(0.0, LATER)
        if wrong := self._disturb(kind, after, ill, out):
            return Tried(seed, kind, after, 0, wrong)
        done = len(open_dataset(out).done)
        code = self.start(out).wait(timeout=LONGEST)
        wanted = int(kind in ("hang", "crash"))  # 1 of a sweep with a sample without an answer
        wrong = f"the command that goes on ended with {code}" if code != wanted else self._compared(kind, ill, out)
        return Tried(seed, kind, after, done, wrong)

    def _compared(self, kind: str, ill: int, out: Path) -> str:
        """What is wrong with the rows; those of a sample that hangs or crashes say so."""
        dataset = open_dataset(out)
        if dataset.missing:
            return f"{len(dataset.missing)} samples have no rows"
        found, wanted = dataset.rows(), self.wanted
        if kind in ("hang", "crash"):
            status = found[found["sample"] == ill]["status"].tolist()
            if status != [{"hang": "timed_out", "crash": "crashed"}[kind]]:
                return f"the sample that should {kind} has the status {', '.join(status)}"
            found = found[found["sample"] != ill].reset_index(drop=True)
            wanted = wanted[wanted["sample"] != ill].reset_index(drop=True)
        try:  # numbers beside a row without them are floats
            found = found[wanted.columns].astype(wanted.dtypes)
            pd.testing.assert_frame_equal(found, wanted, check_exact=True)
        except (AssertionError, KeyError, ValueError) as error:
            return " ".join(str(error).split())
        return ""

    def _disturb(self, kind: str, after: float, ill: int, out: Path) -> str:
        """Run the sweep into a fault; returns what is wrong with its end."""
        folder = self.folder / f"{out.name}-cluster"
        folder.mkdir()
        if kind in ("hang", "crash"):
            ending = self.start(
                out,
                preload=failing(folder, hang=(ill,) if kind == "hang" else (), crash=(ill,) if kind == "crash" else ()),
            )
            return _ended(ending, (1,))
        if kind == "disk":
            return _ended(self.start(out, before=_small_disk, preload=self.slow), (2,))
        if kind in ("scheduler", "worker of a scheduler"):
            with cluster(folder, 2, self.slow) as dask:
                dask.wait_for_workers(2)  # one alone would begin with a chunk that lasts to the end
                process = self.start(out, "--scheduler-file", dask.file)
                if wrong := _wait_in(process, out, after):
                    return wrong
                dask.kill("scheduler" if kind == "scheduler" else "worker")
                return _ended(process, (1, 2) if kind == "scheduler" else (0,))
        process = self.start(out, preload=self.slow)
        if wrong := _wait_in(process, out, after):
            return wrong
        workers = _workers_of(process)
        if kind == "interrupt":
            os.killpg(process.pid, signal.SIGINT)  # as a terminal does, which tells the workers, too
            return _ended(process, (130,))
        if kind == "client":
            process.kill()
            process.wait()
            return _stayed(workers)
        os.kill(workers[0], signal.SIGKILL)
        return _ended(process, (0,))


def _ended(process: "subprocess.Popen[bytes]", codes: tuple[int, ...]) -> str:
    code = process.wait(timeout=LONGEST)
    return "" if code in codes else f"the disturbed command ended with {code}"


def _wait_in(process: "subprocess.Popen[bytes]", out: Path, after: float) -> str:
    """Wait some time [s] after the first part of a sweep, which goes on."""
    end = time.monotonic() + LONGEST
    while not list((out / "rows").glob("part-*.parquet")) and process.poll() is None and time.monotonic() < end:
        time.sleep(0.02)
    time.sleep(after)
    return "" if process.poll() is None else "the sweep ended before the fault"


def _workers_of(process: "subprocess.Popen[bytes]") -> list[int]:
    """Ids of the worker processes below a process."""
    import psutil

    below = psutil.Process(process.pid).children(recursive=True)
    return [child.pid for child in below if "spawn_main" in " ".join(child.cmdline())]


def _stayed(pids: list[int]) -> str:
    """What stays of the workers of a client that died, which end, too."""
    import psutil

    end = time.monotonic() + LONGEST
    while any(psutil.pid_exists(pid) for pid in pids) and time.monotonic() < end:
        time.sleep(0.1)
    left = [pid for pid in pids if psutil.pid_exists(pid)]
    return f"{len(left)} workers outlive the client" if left else ""


def _heed_interrupts() -> None:
    """A program that a shell runs in the background ignores Ctrl-C, and so do its children unless they are told to."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _small_disk() -> None:
    """No file of this process may grow: writing a part fails, as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (DISK, DISK))
