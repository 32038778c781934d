"""Slowdowns planted in the kernels, to show that the gate finds them.

A scratch copy of the sources calls extra work inside four compiled functions: once per step, per sweep over the joints,
per query, and per iteration of the steady solver.  A process reads the length of the work when it starts: the copy
compiles once, and each subject has a slowdown of its own, calibrated against the plain sources.
"""

import json
import re
import shutil
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from pathlib import Path

from rich.box import SIMPLE_HEAD
from rich.table import Table

from benchmarks import measure
from benchmarks.checkout import FOLDERS
from benchmarks.gate import PROCESSES, sampled
from benchmarks.measure import ROOT, Costs
from benchmarks.subjects import JOINTS, SEGMENTS
from benchmarks.verdict import Verdict, change_of, decide
from fctd.case.errors import InputError
from fctd.mechanics.state import ARCS, CYLINDERS, OPEN

SLOWDOWN = 1.15
PAIRS, RACES_OF_ONE = 2, 5  # of processes in a race that calibrates, and such races
PLANT = '''"""Extra work in compiled functions, as long as the environment says for the key of a call."""

import json
import os

import numpy as np
from llvmlite import binding
from numba import cfunc, types

TURNS = json.loads(os.environ.get("PLANTED", "{}"))
KEPT = []
ODD = np.uint64(6364136223846793005)


def site(name):
    mine = [(float(key), turns) for where, key, turns in TURNS if where == name]
    keys, counts = np.array([key for key, _ in mine] + [-1.0]), np.array([turns for _, turns in mine] + [0])

    @cfunc("float64(float64)")
    def work(key):
        # As many operations as the processor can begin: a chain of few long ones would run beside the kernel's own.
        a = b = c = d = np.uint64(key + 1.0)  # zero would stay zero, in no time
        for k in range(len(keys)):
            if keys[k] == key:
                for _ in range(counts[k]):
                    a, b, c, d = a * ODD + b, b * ODD + c, c * ODD + d, d * ODD + a
        return float(a ^ b ^ c ^ d)

    KEPT.append(work)
    binding.add_symbol("planted_" + name, work.address)
    return types.ExternalFunction("planted_" + name, types.float64(types.float64))


joints, step, query, steady = site("joints"), site("step"), site("query"), site("steady")
'''


@dataclass(frozen=True)
class Site:
    """A function of the engine: its file, the line of its body before which the work is called, and a call's key."""

    file: str
    line: str
    key: str


SITES = {
    "joints": Site("fctd/mechanics/joints.py", "    if shape_time == 0:\n        for j in range(1, n + 1):", "n"),
    "step": Site(
        "fctd/mechanics/dynamics.py",
        "    feed, rate = load(S, top, n, laws, motion, pipe, dt)",
        "10 * n + laws.geometry",
    ),
    "query": Site("fctd/mechanics/query.py", "    if geometry == CYLINDERS:\n        query_cylinders(C", "geometry"),
    "steady": Site("fctd/steady/continuation.py", "        error = imbalance(R, n, pace)", "n"),
}
TRIPPING, DRILLING = 143, 117  # segments of the strings of these two subjects
# Where the work of each subject is called: site, key, and turns of about its size.  The key of a step is ten
# times its segments and the kind of hole, that of joint loads the joints.
SUBJECTS: Mapping[str, tuple[str, int, int]] = {
    "joint loads": ("joints", JOINTS, 120),
    "step, contact-free": ("step", 10 * SEGMENTS + OPEN, 300),
    "step, cylinders": ("step", 10 * SEGMENTS + CYLINDERS, 450),
    "step, arcs": ("step", 10 * SEGMENTS + ARCS, 450),
    "step, tripping": ("step", 10 * TRIPPING + CYLINDERS, 1_000),
    "step, drilling": ("step", 10 * DRILLING + CYLINDERS, 750),
    "query, cylinders": ("query", CYLINDERS, 1_200),
    "query, arcs": ("query", ARCS, 3_000),
    "steady depth": ("steady", SEGMENTS, 9_000),
    "chart row": ("steady", SEGMENTS, 180_000),
    "limits": ("steady", SEGMENTS, 12_000),
}
# What is planted at once.  Steps have joint loads too, and the steady solver serves three subjects.
LATER = [["joint loads", "chart row"], ["limits"]]
RACES = [[name for name in SUBJECTS if name not in chain.from_iterable(LATER)], *LATER]


@dataclass(frozen=True)
class Finding:
    """What became of a planted slowdown: the gate's verdict, and the costs before and now in each process."""

    verdict: Verdict
    before: list[float]
    now: list[float]

    @property
    def found(self) -> bool:
        """Whether the gate fails for it."""
        return self.verdict.status == "slower"


def search(report: Callable[[str], object]) -> list[Finding]:
    """Plant slowdowns in all subjects, race each against the plain sources, and look what the gate says."""
    with tempfile.TemporaryDirectory() as scratch:
        slow = Path(scratch)
        plant(slow)
        found = []
        for targets in RACES:
            turns = calibrated(slow, targets)
            outcome = sampled("planted", partial(side_by_side, slow, turns, PROCESSES), report, decide)
            verdicts = {each.kernel: each for each in outcome.verdicts}
            for subject in targets:
                found.append(Finding(verdicts[subject], outcome.before[subject], outcome.now[subject]))
                report(f"{subject}: {verdicts[subject].status}")
    return found


def side_by_side(slow: Path, turns: Mapping[str, int], pairs: int) -> tuple[Costs, Costs]:
    """Race the plain sources against those with extra work: turns by subject."""
    planted = [(*SUBJECTS[subject][:2], count) for subject, count in turns.items()]
    return measure.side_by_side(ROOT, slow, pairs, ({}, {"PLANTED": json.dumps(planted)}))


def plant(folder: Path) -> None:
    """Write the sources with extra work into a folder; InputError where a function has other lines than ``SITES``."""
    for name in FOLDERS:
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "fctd" / "mechanics" / "planted.py").write_text(PLANT)
    for name, site in SITES.items():
        path = folder / site.file
        text = path.read_text()
        if text.count(site.line) != 1:
            raise InputError("a function whose body begins as benchmarks/planted.py says", key=name, file=site.file)
        indent = " " * (len(site.line) - len(site.line.lstrip()))
        text = text.replace(site.line, f"{indent}planted.{name}({site.key})\n{site.line}")
        path.write_text(re.sub("^(?=from |import )", "from fctd.mechanics import planted\n", text, count=1, flags=re.M))


def calibrated(slow: Path, targets: Sequence[str]) -> dict[str, int]:
    """Turns of extra work by which each subject takes ``SLOWDOWN`` times as long, by the method of false position.

    A line alone is wrong: 32 turns beside the joint loads cost nothing, as a processor foresees the end of so short a
    loop, and 36 cost 11 %.
    """
    tried: dict[str, list[tuple[int, float]]] = {subject: [] for subject in targets}
    turns = dict.fromkeys(targets, 0)
    for k in range(RACES_OF_ONE):
        before, now = side_by_side(slow, turns, PAIRS)
        for subject, count in turns.items():
            tried[subject].append((count, change_of(before[subject], now[subject])[0]))
        turns = {subject: false_position(tried[subject]) if k else SUBJECTS[subject][2] for subject in targets}
    return {subject: min(of, key=lambda point: abs(point[1] - SLOWDOWN))[0] for subject, of in tried.items()}


def false_position(tried: Sequence[tuple[int, float]]) -> int:
    """Where the line through the nearest two of points (turns, change) on either side of SLOWDOWN reaches it.

    Where all points lie on one side, the line through the first and the farthest.
    """
    faster, slower = ([each for each in tried if (each[1] >= SLOWDOWN) == beyond] for beyond in (False, True))
    below, above = (max(faster), min(slower)) if faster and slower else (min(tried), max(tried))
    rise = max(above[1] - below[1], 0.01)
    return max(round(below[0] + (above[0] - below[0]) * (SLOWDOWN - below[1]) / rise), 0)


def table(found: list[Finding]) -> Table:
    """A row per subject: what was planted, what the gate measured, and whether it failed."""
    shown = Table(box=SIMPLE_HEAD, pad_edge=False)
    for column in ("subject", "planted", "measured", "80 % interval", "pairs", "found"):
        shown.add_column(column, justify="left" if column == "subject" else "right")
    for each in found:
        verdict = each.verdict
        shown.add_row(
            verdict.kernel, f"{SLOWDOWN - 1:+.0%}", f"{verdict.change - 1:+.1%}",
            f"{verdict.low - 1:+.1%} to {verdict.high - 1:+.1%}", str(len(each.now)), "yes" if each.found else "NO",
        )  # fmt: skip
    return shown
