"""The stopwatch of all comparisons: interleaved rounds, medians and ratios, without the time to compile or build.

On a shared machine times drift by factors within seconds.  All actions are therefore called in every round, in
alternating order, and a ratio is the median of the ratios of the rounds.
"""

import os
import platform
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from fctd.arrays import Array
from fctd.store.limits import cores
from fctd.store.origin import versions
from references.contact import METHODS, method_class
from references.engines import ENGINES, engine_class
from references.registry import version_of
from references.timing import reference_kernel

Action = Callable[[], object]
CPU, GOVERNOR = Path("/sys/devices/system/cpu/cpu0"), "cpufreq/scaling_governor"
PASSES = 200  # of the reference kernel in a call of its action


def units_for(work: Callable[[int], object], aim: float) -> int:
    """Number of units with which a call ``work(units)`` takes about ``aim`` [s]; ``work`` is compiled afterwards.

    Measured in CPU time: on a busy machine wall-clock time would give calls that are far too short.
    """
    units = 1
    work(units)
    while True:
        began = time.process_time()
        work(units)
        spent = time.process_time() - began
        if spent >= 0.5 * aim:
            return max(int(units * aim / spent), 1)
        units = max(2 * units, int(0.7 * units * aim / max(spent, 1e-9)))


def rounds(action: Action, count: int, clock: Callable[[], float] = time.process_time) -> list[float]:
    """Times [s] by ``clock`` of an action called so many times; what is compiled, was called before."""
    times = []
    for _ in range(count):
        began = clock()
        action()
        times.append(clock() - began)
    return times


def kernel() -> tuple[Action, int]:
    """The reference kernel as an action, compiled, and the columns of a call."""
    S = reference_kernel.new_buffer()

    def work() -> None:
        reference_kernel.reference_kernel(S, PASSES)

    work()
    return work, PASSES * reference_kernel.COLUMNS


def race(
    actions: Mapping[str, Action],
    counts: Mapping[str, float],
    rounds: int,
    baseline: str | Mapping[str, str],
    clock: Callable[[], float] | None = None,
) -> pd.DataFrame:
    """Time each action once per round, after one round that is not counted.

    counts : number of units (points, segment-steps, simulated seconds) in a call of each action.
    baseline : the action that is the denominator of the ratios, one for all or one for each action.  clock : [s], by
    default the processor's, which leaves out the time in which other processes have the core.
    Returns a row per action: name, units, rounds, ns (median per unit), ns_low, ns_high (quartiles), ns_least (the
    fastest round, least disturbed by other processes), and ratio, ratio_low, ratio_high to the baseline, from
    the ratios within the rounds.
    """
    per_unit = in_rounds(actions, counts, rounds, clock)
    rows = []
    for name in actions:
        low, middle, high = np.percentile(per_unit[name], [25, 50, 75])
        against = baseline if isinstance(baseline, str) else baseline[name]
        ratio = np.percentile(per_unit[name] / per_unit[against], [25, 50, 75])
        rows.append(
            {
                "name": name, "units": counts[name], "rounds": rounds,
                "ns": middle, "ns_low": low, "ns_high": high, "ns_least": per_unit[name].min(),
                "ratio": ratio[1], "ratio_low": ratio[0], "ratio_high": ratio[2],
            }
        )  # fmt: skip
    return pd.DataFrame(rows)


def in_rounds(
    actions: Mapping[str, Action], counts: Mapping[str, float], rounds: int, clock: Callable[[], float] | None = None
) -> dict[str, Array]:
    """Time of a unit of each action [ns] in each of the rounds of ``race``, which has the arguments."""
    for action in actions.values():
        action()
    turns = [turn(actions, counts, clock or time.process_time, backwards=k % 2 == 1) for k in range(rounds)]
    return {name: np.array([taken[name] for taken in turns]) for name in actions}


def turn(
    actions: Mapping[str, Action], counts: Mapping[str, float], clock: Callable[[], float], backwards: bool
) -> dict[str, float]:
    """One round: time of a call of each action in turn, by ``clock`` [s], in ns per unit."""
    taken = {}
    for name in reversed(list(actions)) if backwards else actions:
        began = clock()
        actions[name]()
        taken[name] = 1e9 * (clock() - began) / counts[name]
    return taken


def machine(more: Iterable[str] = ()) -> dict[str, str]:
    """What timings depend on: processor and its state now, the cost of the reference kernel, versions of packages.

    more : packages beside those of the suite.  What a system does not tell is "unknown".
    """
    suite = [method_class(name).distribution for name in METHODS]
    suite += [engine_class(name).distribution for name in ENGINES]
    timed = {name: version_of(name) or "not installed" for name in (*suite, *more)}
    work, columns = kernel()
    cost = min(turn({"": work}, {"": columns}, time.thread_time, backwards=False)[""] for _ in range(20))
    return {
        "processor": cpu_name(), "cores": str(cores()), "caches": caches(), "governor": _said(CPU / GOVERNOR),
        "load average": load_average(), "reference kernel": f"{cost:.4g} ns a column", **versions(), **timed,
    }  # fmt: skip


def machine_table(more: Iterable[str] = ()) -> pd.DataFrame:
    """``machine`` as a table with the columns what and value."""
    return pd.DataFrame(machine(more).items(), columns=["what", "value"])


def load_average() -> str:
    """Processes that want a core, on average over 1, 5 and 15 minutes; Windows does not count them."""
    return ", ".join(f"{each:.1f}" for each in os.getloadavg()) if hasattr(os, "getloadavg") else "unknown"


def caches() -> str:
    """Level, kind and size of the first core's caches."""
    found = [
        f"L{_said(cache / 'level')} {_said(cache / 'type').lower()} {_said(cache / 'size')}"
        for cache in sorted((CPU / "cache").glob("index*"))
    ]
    return ", ".join(found) or "unknown"


def _said(file: Path) -> str:
    try:
        return file.read_text().strip()
    except OSError:
        return "unknown"


def cpu_name() -> str:
    """Name of the processor from /proc/cpuinfo; where there is none, from Python's ``platform``."""
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text().splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
