"""Samples from fresh processes: of these sources alone, or of these and a release's sources in turns."""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.subjects import ARCS, CYLINDERS, FCL, FREE, REFERENCE
from benchmarks.worker import PROTOCOL, reference_digest, sources_digest
from fctd.case.errors import InputError

ROOT = Path(__file__).parents[1]
ROUNDS = 8  # per process; processes differ by more than the rounds of a process
# The cost that contact adds to a step, where a slower search or friction law shows most clearly.
ADDED = {"contact's addition, cylinders": CYLINDERS, "contact's addition, arcs": ARCS}

Costs = dict[str, list[float]]  # subject -> cost in each process


class Worker:
    """A process that measures the sources in ``root``."""

    def __init__(self, process: "subprocess.Popen[str]", root: Path) -> None:
        self._process, self._root = process, root
        self.hello = self._read()
        if self.hello.get("protocol") != PROTOCOL or self.hello.get("reference") != reference_digest():
            raise InputError("sources with the same reference kernel and protocol", key="release", value=root)

    def round(self) -> dict[str, float]:
        """Cost of each subject [ns per unit]."""
        assert self._process.stdin is not None
        self._process.stdin.write("go\n")
        self._process.stdin.flush()
        taken: dict[str, float] = self._read()
        return taken

    def _read(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise InputError("sources whose worker runs (its error is printed above)", key="release", value=self._root)
        answer: dict[str, Any] = json.loads(line)
        return answer


def environment(root: Path) -> dict[str, str]:
    """Environment of a process that measures the sources in ``root``: one thread, and a separate compile cache.

    One thread, since times are measured with the clock of one thread.  The code that numba compiles for a kernel may
    depend on the functions compiled before it, in release 0.1.0 by 9 to 13 % in the joint loads: with separate caches
    all sources are compiled in the same order.
    """
    single = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
    try:
        own = {"NUMBA_CACHE_DIR": str(cache() / f"measured-{sources_digest(root)}")}
    except RuntimeError:  # without a home folder the process uses its parent's cache
        own = {}
    return {**os.environ, **single, **own, "PYTHONPATH": str(root)}


def cache() -> Path:
    """Folder for the sources and compiled code of releases; RuntimeError without a home folder."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "fctd"


@contextmanager
def workers(*roots: Path) -> Iterator[list[Worker]]:
    """A fresh process for each folder of sources, all started at once."""
    with ExitStack() as stack:
        processes = [
            stack.enter_context(
                subprocess.Popen(
                    [sys.executable, "-m", "benchmarks.worker"],
                    cwd=root,
                    env=environment(root),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    text=True,
                )
            )
            for root in roots
        ]
        for process in processes:
            stack.callback(process.terminate)
        yield [Worker(process, root) for process, root in zip(processes, roots, strict=True)]


def alone(processes: int, root: Path = ROOT, report: Callable[[str], object] = str) -> tuple[Costs, dict[str, Any]]:
    """Costs in ``processes`` processes [ns per unit], each the median of its rounds; unit and size of each subject.

    The reference kernel is one of the subjects.  report : prints a line of progress.
    """
    samples: list[dict[str, float]] = []
    hello: dict[str, Any] = {}
    for k in range(processes):
        report(f"process {k + 1} of {processes}")
        with workers(root) as (worker,):
            hello = worker.hello["subjects"]
            samples.append(medians([worker.round() for _ in range(ROUNDS)]))
    return gathered(samples), hello


def side_by_side(release: Path, pairs: int, root: Path = ROOT) -> tuple[Costs, Costs]:
    """Costs of a release's sources and of these in ``pairs`` pairs of processes that take turns.

    Both are in units of the mean cost of the reference kernel in the same round of both processes: a disturbance of
    the whole round cancels, and one of a single reference kernel affects both sides alike.
    """
    before: list[dict[str, float]] = []
    now: list[dict[str, float]] = []
    for pair in range(pairs):
        with workers(*((release, root) if pair % 2 == 0 else (root, release))) as pair_of:
            rounds = [[one.round() for one in pair_of] for _ in range(ROUNDS)]
        scaled = [in_units(both) for both in rounds]
        first, second = (medians([both[k] for both in scaled]) for k in (0, 1))
        before.append(first if pair % 2 == 0 else second)
        now.append(second if pair % 2 == 0 else first)
    return gathered(before), gathered(now)


def in_units(both: Sequence[dict[str, float]]) -> list[dict[str, float]]:
    """A round of some processes in units of the mean cost of their reference kernels."""
    unit = float(np.mean([taken[REFERENCE] for taken in both]))
    return [{name: cost / unit for name, cost in taken.items()} for taken in both]


def medians(rounds: Sequence[dict[str, float]]) -> dict[str, float]:
    """Median of each subject over the rounds of one process."""
    return {name: float(np.median([taken[name] for taken in rounds])) for name in rounds[0]}


def gathered(samples: Sequence[dict[str, float]]) -> Costs:
    """Samples of all processes per subject, from one dictionary per process."""
    return {name: [sample[name] for sample in samples] for name in samples[0]}


def ratios(costs: Costs) -> Costs:
    """Costs relative to the reference kernel in the same process."""
    return {name: _over(costs[name], costs[REFERENCE]) for name in costs if name != REFERENCE}


def judged(costs: Costs) -> Costs:
    """The kernels on which the gate decides: FCTD's own, and the cost that contact adds to a step."""
    own = {name: taken for name, taken in costs.items() if name not in (REFERENCE, FCL)}
    for name, step in ADDED.items():
        own[name] = [touching - free for touching, free in zip(costs[step], costs[FREE], strict=True)]
    return own


def shown(costs: Costs) -> Costs:
    """Ratios of kernels of one run, for information only: a faster denominator raises them too."""
    found = {"contact : contact-free, cylinders": _over(costs[CYLINDERS], costs[FREE])}
    found["contact : contact-free, arcs"] = _over(costs[ARCS], costs[FREE])
    if FCL in costs:
        found["FCL query from Python : step, cylinders"] = _over(costs[FCL], costs[CYLINDERS])
    return found


def _over(above: Sequence[float], below: Sequence[float]) -> list[float]:
    return [a / b for a, b in zip(above, below, strict=True)]
