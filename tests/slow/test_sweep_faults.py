"""Seeded faults of a sweep: what resumes has the rows of a run that nothing disturbed.

A fault is the death of a worker, of the client or of the scheduler (SIGKILL), a disk that is full, or a sample that
hangs or crashes; and Ctrl-C.  Eight faults, one of each kind, take a minute or two; the environment variable
FCTD_FAULTS sets another number.
"""

import os
import random
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pandas as pd
import pytest

from fctd.sweep.dataset import open_dataset
from tests.sweep import clusters
from tests.sweep.made import sweep_file

pytest.importorskip("distributed")
psutil = pytest.importorskip("psutil")
pytestmark = pytest.mark.slow

# Pause before each sample [s]: two workers take six seconds, the first part is written after two, and a fault comes
# at most two seconds later, before the sweep ends.
SAMPLES, PAUSE, LATER = 60, 0.2, 2.0
KINDS = ("worker", "client", "scheduler", "disk", "worker of a scheduler", "hang", "crash", "interrupt")
# Each takes half a minute: FCTD_FAULTS=20 tries all kinds, more than twice each.
SEEDS = range(int(os.environ.get("FCTD_FAULTS", 1)))
LONGEST = 240.0  # of a sweep [s]


@pytest.fixture(scope="module")
def sweep(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sweep file; what its workers preload lies beside it, and makes them slow, so that a fault finds them busy."""
    folder = tmp_path_factory.mktemp("sweep")
    clusters.faults(folder, pause=PAUSE)
    return sweep_file(folder, f'method = "sobol"\nsamples = {SAMPLES}\ntime_limit = "3 s"\n')


@pytest.fixture(scope="module")
def undisturbed(sweep: Path) -> pd.DataFrame:
    """The rows of a run that nothing disturbs."""
    process = start(sweep, sweep.parent / "undisturbed")
    assert process.wait(timeout=LONGEST) == 0
    return rows_of(sweep.parent / "undisturbed")


def rows_of(folder: Path) -> pd.DataFrame:
    """The rows of a complete dataset."""
    dataset = open_dataset(folder)
    assert dataset.missing == []
    return dataset.rows()


def start(
    sweep: Path, out: Path, *options: object, before: Callable[[], None] | None = None, faults: Path | None = None
) -> "subprocess.Popen[bytes]":
    """``fctd sweep`` as a process of its own; faults : that its workers preload."""
    preload = faults or sweep.parent / "faults.py"
    environment = os.environ | {"DASK_DISTRIBUTED__WORKER__PRELOAD": f"['{preload}']"}
    environment |= {"PYTHONPATH": str(clusters.ROOT)}
    local = () if options else ("--workers", "2")
    command = [sys.executable, "-m", "fctd", "sweep", str(sweep), "--out", str(out), "--quiet"]
    return subprocess.Popen(
        [*command, *local, *map(str, options)], cwd=clusters.ROOT, env=environment, preexec_fn=before,
        start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip


def parts(out: Path) -> int:
    """Number of the parts that are written."""
    return len(list((out / "rows").glob("part-*.parquet")))


def until(true: Callable[[], bool], process: "subprocess.Popen[bytes]") -> None:
    """Wait for something while a process runs."""
    end = time.monotonic() + LONGEST
    while not true() and process.poll() is None and time.monotonic() < end:
        time.sleep(0.02)


def workers_of(process: "subprocess.Popen[bytes]") -> list[int]:
    """Ids of the worker processes below a process."""
    try:
        below = psutil.Process(process.pid).children(recursive=True)
        return [child.pid for child in below if "spawn_main" in " ".join(child.cmdline())]
    except psutil.NoSuchProcess:
        return []


def small_disk() -> None:
    """No file of this process may grow beyond some kB: writing a part fails, as on a full disk."""
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (9_000, 9_000))


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sweep_resumes_after_a_fault_with_the_rows_of_one_undisturbed(
    seed: int, sweep: Path, undisturbed: pd.DataFrame, tmp_path: Path
) -> None:
    """A sample that hangs or crashes is a row, and the others are as they were."""
    kind, draw, out = KINDS[seed % len(KINDS)], random.Random(seed), tmp_path / "out"
    ill = draw.randrange(SAMPLES)
    disturb(kind, draw.uniform(0.0, LATER), ill, sweep, out, tmp_path)
    again = start(sweep, out)
    assert again.wait(timeout=LONGEST) == 0
    found = rows_of(out)
    if kind in ("hang", "crash"):
        (row,) = found[found["sample"] == ill].to_dict("records")
        assert row["status"] == {"hang": "timed_out", "crash": "crashed"}[kind]
        found = found[found["sample"] != ill].reset_index(drop=True)
        undisturbed = undisturbed[undisturbed["sample"] != ill].reset_index(drop=True)
    found = found[undisturbed.columns].astype(undisturbed.dtypes)  # numbers beside a row without them are floats
    pd.testing.assert_frame_equal(found, undisturbed, check_exact=True)


def disturb(kind: str, wait: float, ill: int, sweep: Path, out: Path, folder: Path) -> None:
    """Run a sweep into a fault, some time [s] after its first part; ill : the sample that hangs or crashes."""
    if kind in ("hang", "crash"):
        process = start(sweep, out, faults=clusters.faults(folder, **{kind: (ill,)}))
        assert process.wait(timeout=LONGEST) == 1
        return
    if kind in ("scheduler", "worker of a scheduler"):
        with clusters.cluster(folder, 2, sweep.parent / "faults.py") as file:
            process = start(sweep, out, "--scheduler-file", file)
            wait_in(process, out, wait)
            clusters.kill(file, "scheduler" if kind == "scheduler" else "worker")
            end(process)
        return
    process = start(sweep, out, before=small_disk if kind == "disk" else None)
    if kind == "disk":
        assert process.wait(timeout=LONGEST) == 2
        return
    wait_in(process, out, wait)
    if kind == "interrupt":
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does, which tells the workers, too
        assert process.wait(timeout=LONGEST) == 130
        return
    if kind == "client":
        below = workers_of(process)
        process.kill()
        process.wait()
        until_gone(below)
        return
    for pid in workers_of(process)[:1]:
        os.kill(pid, signal.SIGKILL)
    end(process)


def wait_in(process: "subprocess.Popen[bytes]", out: Path, wait: float) -> None:
    """Wait some time [s] after the first part of a sweep, which goes on."""
    until(lambda: parts(out) > 0, process)
    time.sleep(wait)
    assert process.poll() is None


def end(process: "subprocess.Popen[bytes]") -> None:
    """Wait until a disturbed sweep ends by itself."""
    assert process.wait(timeout=LONGEST) in (0, 1, 2)


def until_gone(pids: list[int]) -> None:
    """The workers of a client that died end, too."""
    last = time.monotonic() + 60
    while any(psutil.pid_exists(pid) for pid in pids) and time.monotonic() < last:
        time.sleep(0.1)
    assert not [pid for pid in pids if psutil.pid_exists(pid)]


@pytest.fixture(autouse=True)
def _no_process_stays() -> Iterator[None]:
    yield
    left = [child for child in psutil.Process().children(recursive=True) if child.is_running()]
    psutil.wait_procs(left, timeout=20)
