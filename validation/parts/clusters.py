"""Schedulers and workers of Dask as processes of their own, and workers that fail on purpose."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from fctd.sweep.cluster import ClusterChoice, connected
from validation.harness.study import ROOT

LONGEST = 300.0  # [s]: what takes longer hangs
# A worker that preloads this hangs or dies in samples of given numbers.
_FAILING = """
import os, time, ctypes
from fctd.sweep import chunk
def failing(own):
    def rows_of(self, sample):
        if sample.number in HANG:
            ctypes.CDLL(None).sleep(3600)
        if sample.number in CRASH:
            os._exit(1)
        time.sleep(PAUSE)
        return own(self, sample)
    return rows_of
def paused(own):  # so that chunks are as short as for samples that take so long
    return lambda self: own(self) + PAUSE
runner = chunk.SampleRunner
if runner.rows_of.__module__ == chunk.__name__:  # a preloaded file is read twice
    runner.rows_of, runner.warm_up = failing(runner.rows_of), paused(runner.warm_up)
"""


def failing(folder: Path, hang: tuple[int, ...] = (), crash: tuple[int, ...] = (), pause: float = 0.0) -> Path:
    """A file that workers preload; hang, crash : numbers of samples; pause [s] : before every other sample."""
    path = folder / "failing.py"
    path.write_text(f"HANG, CRASH, PAUSE = {hang}, {crash}, {pause}\n{_FAILING}", encoding="utf-8")
    return path


class Cluster:
    """A scheduler and nannies of workers, all on the loopback; ``file`` is that of the scheduler.

    program : the folder of the package that they import.
    """

    def __init__(self, folder: Path, tls: Sequence[object] = (), program: Path = ROOT) -> None:
        self.file, self._tls, self._program = folder / "scheduler.json", tls, program
        encrypted = ["--protocol", "tls"] if tls else []
        self.processes = [
            self._dask("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", *encrypted)
        ]  # fmt: skip

    def add_workers(self, count: int, threads: int = 1, preload: Path | None = None) -> None:
        """Start workers, once the scheduler has written its file."""
        end = time.monotonic() + LONGEST
        while not self.file.exists() and time.monotonic() < end:
            time.sleep(0.1)
        options: list[object] = ["--nthreads", threads, "--host", "127.0.0.1", "--no-dashboard"]
        if preload is not None:
            options += ["--preload", preload]
        self.processes += [self._dask("worker", *options) for _ in range(count)]

    def wait_for_workers(self, count: int) -> None:
        """Return once so many workers have joined; without TLS."""
        with connected(ClusterChoice(scheduler_file=self.file)) as client:
            client.wait_for_workers(count, timeout=LONGEST)

    def kill(self, role: str) -> None:
        """Kill the scheduler, or a worker process, which its nanny starts again."""
        import psutil

        scheduler, *nannies = self.processes
        if role == "scheduler":
            scheduler.kill()
            return
        below = psutil.Process(nannies[0].pid).children(recursive=True)
        next(child for child in below if "spawn_main" in " ".join(child.cmdline())).kill()

    def end(self) -> None:
        """End all processes, the scheduler last: a worker that has just lost it may not end by itself."""
        scheduler, *workers = self.processes
        for processes in (workers, [scheduler]):
            for process in processes:
                process.terminate()
            for process in processes:
                process.wait(timeout=LONGEST)

    def _dask(self, role: str, *options: object) -> "subprocess.Popen[bytes]":
        """A scheduler or a worker, without its messages."""
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.dask_{role}", "--scheduler-file", str(self.file),
             *map(str, (*options, *self._tls))],
            cwd=self._program, env=os.environ | {"PYTHONPATH": str(self._program)},
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip


@contextmanager
def cluster(
    folder: Path,
    workers: int = 1,
    preload: Path | None = None,
    threads: int = 1,
    tls: Sequence[object] = (),
    program: Path = ROOT,
) -> Iterator[Cluster]:
    """A scheduler with workers that end with it; tls : options of both that name the files of TLS."""
    found = Cluster(folder, tls, program)
    try:
        found.add_workers(workers, threads, preload)
        yield found
    finally:
        found.end()
