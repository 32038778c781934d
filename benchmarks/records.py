"""Entries of every record besides its time, and the timing of a round of steps."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from pytest_benchmark.fixture import BenchmarkFixture

from fctd.mechanics import state, topdrive
from fctd.mechanics.faults import UnstableError
from fctd.simulation.run import Run
from references.timing.stopwatch import machine

# Segment-steps per round of compiled code, fixed so that rounds of two sessions are comparable.
COMPILED = 200_000


@cache
def origin() -> dict[str, str]:
    """Versions, commit, processor and cores."""
    return machine()


def describe(benchmark: BenchmarkFixture, group: str, **facts: Any) -> None:
    """Set the group of a benchmark, and record the machine, versions and ``facts``."""
    benchmark.group = group
    benchmark.extra_info |= origin() | {"extrapolated": False} | facts


def time_steps(
    benchmark: BenchmarkFixture, advance: Callable[[float], object], run: Run, step: float, count: int, rounds: int = 15
) -> None:
    """Time rounds of ``count`` steps of ``step`` [s]; the recorded costs are per step.

    advance : advances the string of ``run`` by a time [s] in equal steps.  Raises UnstableError.
    """
    began, hookload = float(run.top[topdrive.TOP_TIME]), float(run.top[topdrive.SUM_HOOKLOAD])
    benchmark.pedantic(advance, args=(count * step,), rounds=rounds, warmup_rounds=1)
    simulated = float(run.top[topdrive.TOP_TIME]) - began
    off = (float(run.top[topdrive.SUM_HOOKLOAD]) - hookload) / simulated / vertical_weight(run) - 1
    if not np.isfinite(off):
        raise UnstableError("the timed run is unstable, its hook load is not finite: take a shorter step")
    facts = {
        "segments": run.segments,
        "pieces_of_hole": len(run.hole.pieces),
        "step_ms": 1e3 * step,
        "steps_per_round": count,
        "simulated_s": simulated,
        "hookload_off_percent": 100 * off,
    }
    if benchmark.stats is not None:
        cost = benchmark.stats.stats.median / count
        facts |= {"ns_per_segment_step": 1e9 * cost / run.segments, "real_time_factor": step / cost}
    benchmark.extra_info |= facts


def vertical_weight(run: Run) -> float:
    """Weight of a uniform string over its vertical depth [N], the exact hook load while it rotates in place."""
    bottom = state.row(run.S, state.Z, run.segments)[-1]
    per_metre = float(run.string.weight[0])
    half = 0.5 * run.string.length[-1] * state.row(run.S, state.AZ, run.segments)[-1]
    return per_metre * float(bottom + half - run.S[state.Z])
