"""Samples of two commits from pairs of fresh processes that take turns."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np

from benchmarks.subjects import ARCS, CYLINDERS, FREE, REFERENCE
from fctd.case.errors import InputError

ROOT = Path(__file__).parents[1]
ROUNDS = 48  # per process: four from each depth of the stack (worker.py)
# Of the rounds of a process.  Other processes can only lengthen a round, so that the shorter ones tell the cost; the
# shortest alone may have had a faster clock.  Of 0 to 0.5 this part gave pairs of equal sources the least scatter.
SHORTER = 0.15
# The cost that contact adds to a step, where a slower search or friction law shows most clearly.
ADDED = {"contact's addition, cylinders": CYLINDERS, "contact's addition, arcs": ARCS}
WORKER = Path(__file__).with_name("worker.py")

Costs = dict[str, list[float]]  # subject -> cost in each process


class Worker:
    """A process that measures the sources in ``root``; ``subjects`` : their names."""

    def __init__(self, process: "subprocess.Popen[str]", root: Path) -> None:
        self._process, self._root = process, root
        self.subjects: list[str] = json.loads(self._line())

    def round(self) -> dict[str, float]:
        """Cost of each subject [ns per unit]."""
        assert self._process.stdin is not None
        self._process.stdin.write("go\n")
        self._process.stdin.flush()
        taken: dict[str, float] = json.loads(self._line())
        return taken

    def _line(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise InputError(
                "sources whose subjects run (their error is printed above)", key="sources", value=self._root
            )
        return line


def environment(root: Path, more: Mapping[str, str] = {}) -> dict[str, str]:
    """Environment of a process that measures the sources in ``root``: one thread, whose clock gives the times."""
    single = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")
    return {**os.environ, **single, "PYTHONPATH": str(root), **more}


@contextmanager
def workers(*roots: Path, more: Sequence[Mapping[str, str]] = ({}, {})) -> Iterator[list[Worker]]:
    """A fresh process for each folder of sources, all started at once.

    more : variables of the environment of each.  InputError where one of them cannot measure.
    """
    with ExitStack() as stack:
        # -P: modules are those of the folder, none of those beside the worker's file
        processes = [
            stack.enter_context(
                subprocess.Popen(
                    [sys.executable, "-P", str(WORKER)], cwd=root, env=environment(root, extra),
                    stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                )
            )
            for root, extra in zip(roots, more, strict=False)
        ]  # fmt: skip
        for process in processes:
            stack.callback(process.terminate)
        yield [Worker(process, root) for process, root in zip(processes, roots, strict=True)]


def side_by_side(
    before: Path, now: Path, pairs: int, more: Sequence[Mapping[str, str]] = ({}, {})
) -> tuple[Costs, Costs]:
    """Costs of two folders of sources in ``pairs`` pairs of processes that take turns, the first in turns too.

    Both are in units of the mean cost of the reference kernel in both processes of the pair: a disturbance of the whole
    pair cancels, and one of a single reference kernel affects both sides alike.  The reference kernel's own cost stays
    in ns.  more : as of ``workers``, before and now.
    """
    sides: tuple[list[dict[str, float]], list[dict[str, float]]] = ([], [])
    for pair in range(pairs):
        turn = 1 if pair % 2 == 0 else -1
        with workers(*(before, now)[::turn], more=more[::turn]) as both:
            rounds = [[one.round() for one in both] for _ in range(ROUNDS)]
        taken = in_units([shorter([each[k] for each in rounds]) for k in (0, 1)])
        for side, costs in zip(sides, taken[::turn], strict=True):
            side.append(costs)
    return gathered(sides[0]), gathered(sides[1])


def shorter(rounds: Sequence[dict[str, float]]) -> dict[str, float]:
    """Cost of each subject in a process, from its rounds."""
    return {name: float(np.quantile([taken[name] for taken in rounds], SHORTER)) for name in rounds[0]}


def in_units(both: Sequence[dict[str, float]]) -> list[dict[str, float]]:
    """Costs of some processes in units of the mean cost of their reference kernels, whose own stays."""
    unit = float(np.mean([taken[REFERENCE] for taken in both]))
    return [{name: cost if name == REFERENCE else cost / unit for name, cost in taken.items()} for taken in both]


def gathered(samples: Sequence[dict[str, float]]) -> Costs:
    """Samples of all processes per subject, from one dictionary per process."""
    return {name: [sample[name] for sample in samples] for name in samples[0]}


def judged(costs: Costs) -> Costs:
    """The kernels on which the gate decides: all but the reference, and the cost that contact adds to a step."""
    own = {name: taken for name, taken in costs.items() if name != REFERENCE}
    for name, step in ADDED.items():
        if step in costs and FREE in costs:
            own[name] = [touching - free for touching, free in zip(costs[step], costs[FREE], strict=True)]
    return own


def summed(costs: Costs, kernels: Sequence[str]) -> list[float]:
    """Geometric mean over some kernels in each process: their sum of changes, in which each counts alike."""
    return [float(each) for each in np.exp(np.mean([np.log(costs[name]) for name in kernels], axis=0))]
