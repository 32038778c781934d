"""The steady solver: one bit depth, layout included, and a whole chart."""

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe
from benchmarks.strings import BIT, trip
from fctd import torque_drag
from fctd.case.operations import KINDS
from fctd.model.operations import steady_rates
from fctd.steady.equilibrium import Solver
from fctd.steady.torque_drag import chart_rows

DEPTHS = [float(depth) for depth in range(1750, 2451, 10)]
ON_BOTTOM = {"bit__weight_on_bit": "50 kN", "bit__torque": "3 kN*m"}
LONGER = {
    "string__components[0]__segments": 41,
    "string__components[1]__segments": 306,
    "string__components[2]__segments": None,
    "string__components[2]__segment_length": BIT / 500,
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("segments", [61, 500])
def bench_depth(benchmark: BenchmarkFixture, segments: int, kind: str) -> None:
    """Paper-well with the bit at 2450 m; the record has the unbalanced force over the hook load."""
    case = trip(1750.0, BIT, **ON_BOTTOM, **({} if segments == 61 else LONGER))
    solver, rates = Solver(case), steady_rates(case, kind)
    describe(benchmark, f"steady depth, {segments} segments", pieces_of_hole=len(solver.hole.pieces))
    point = benchmark.pedantic(solver.solve, args=(kind, rates, BIT), rounds=21, warmup_rounds=2)
    string = point.profile
    benchmark.extra_info |= {
        "segments": len(string) - 1,
        "status": point.status,
        "iterations": point.iterations,
        "imbalance_over_hookload": point.imbalance / point.hookload,
    }


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("segments", [61, 500])
def bench_depths(benchmark: BenchmarkFixture, segments: int, threads: int) -> None:
    """71 bit depths of paper-well, tripping out, layout included."""
    case = trip(1750.0, BIT, **({} if segments == 61 else LONGER))
    describe(benchmark, f"chart of one operation, {segments} segments", depths=len(DEPTHS), threads=threads)
    chart = benchmark.pedantic(
        chart_rows, args=(case, "trip_out", DEPTHS), kwargs={"threads": threads}, rounds=7, warmup_rounds=1
    )
    benchmark.extra_info["converged_percent"] = 100 * float(np.mean([row["status"] == "converged" for row in chart]))


def bench_chart(benchmark: BenchmarkFixture) -> None:
    """71 bit depths of paper-well, six operations."""
    case, depths = trip(1750.0, BIT, **ON_BOTTOM), DEPTHS
    six = [kind for kind in KINDS if kind != "ream_in"]  # those of the times that are stored
    describe(benchmark, "chart", depths=len(depths), operations=len(six))
    chart = benchmark.pedantic(torque_drag, args=(case, six, depths), rounds=3, warmup_rounds=1)
    benchmark.extra_info["converged_percent"] = 100 * float((chart["status"] == "converged").mean())
