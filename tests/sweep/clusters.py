"""Schedulers and workers of Dask as processes of their own, and workers that fail on purpose."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parents[2]
# Scheduler and nannies of every cluster, by its file.
PROCESSES: dict[Path, list["subprocess.Popen[bytes]"]] = {}
# A worker that preloads this hangs or dies in samples of given numbers.
FAULTS = """
import os, time, ctypes
from fctd.sweep import chunk
def failing(own):
    def rows_of(self, sample):
        if sample.number in HANG:
            ctypes.CDLL(None).sleep(600)
        if sample.number in CRASH:
            os._exit(1)
        time.sleep(PAUSE)
        return own(self, sample)
    return rows_of
if chunk.Bench.rows_of.__module__ == chunk.__name__:  # a preloaded file is read twice
    chunk.Bench.rows_of = failing(chunk.Bench.rows_of)
"""


def faults(folder: Path, hang: tuple[int, ...] = (), crash: tuple[int, ...] = (), pause: float = 0.0) -> Path:
    """A file that workers preload; pause [s] : before every other sample."""
    path = folder / "faults.py"
    path.write_text(f"HANG, CRASH, PAUSE = {hang}, {crash}, {pause}\n{FAULTS}", encoding="utf-8")
    return path


@contextmanager
def cluster(folder: Path, workers: int = 1, preload: Path | None = None, threads: int = 1) -> Iterator[Path]:
    """The file of a scheduler with workers, all of them on the loopback."""
    file = folder / "scheduler.json"
    PROCESSES[file] = processes = [
        dask("scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", file)
    ]
    options = ["--nthreads", threads, "--host", "127.0.0.1", "--no-dashboard", "--scheduler-file", file]
    if preload is not None:
        options += ["--preload", preload]
    try:
        end = time.monotonic() + 30
        while not file.exists() and time.monotonic() < end:
            time.sleep(0.1)
        processes += [dask("worker", *options) for _ in range(workers)]
        yield file
    finally:
        for process in processes:
            process.terminate()
        for process in processes:
            process.wait(timeout=30)


def kill(file: Path, role: str) -> None:
    """Kill the scheduler of a cluster, or one of its worker processes, which its nanny starts again."""
    import psutil

    scheduler, *nannies = PROCESSES[file]
    if role == "scheduler":
        scheduler.kill()
        return
    below = psutil.Process(nannies[0].pid).children(recursive=True)
    next(child for child in below if "spawn_main" in " ".join(child.cmdline())).kill()


def dask(role: str, *options: object) -> "subprocess.Popen[bytes]":
    """A scheduler or a worker, without its messages."""
    return subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_" + role, *map(str, options)],
        cwd=ROOT, env=os.environ | {"PYTHONPATH": str(ROOT)}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
