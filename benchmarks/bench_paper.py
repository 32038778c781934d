"""The paper's two timed cases: 150 m of vertical trip without contact, and the first build section in contact.

FCTD runs the whole trip, with records and ledger.  The others run a window in its middle, from FCTD's state there, and
their records are marked as extrapolated: ``whole_wall_s`` is the estimated time of the whole trip.
"""

from functools import cache
from typing import Any

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe
from benchmarks.strings import OPEN, trip
from fctd import Case, simulate
from fctd.mechanics import topdrive
from fctd.mechanics.topdrive import Motion
from fctd.simulation.run import Run
from references import contact, engines
from references.engines.free_bodies import FreeBodies
from references.timing.workloads import asking, copy_of, moving

WINDOW = 0.1  # [s]
# Contact methods run in FCTD's loop, engines run the whole string.
SWAPPED, ENGINES = ("fcl", "coal"), ("bullet", "mujoco", "elastica")
VERTICAL, BUILD = "vertical, contact-free", "first build, in contact"
# Without contact there is no contact method to compare.
ENTRIES = [*((VERTICAL, name) for name in ENGINES), *((BUILD, name) for name in (*SWAPPED, *ENGINES))]


@cache
def the_case(name: str) -> Case:
    """One of the two cases; 61 segments each, friction law coulomb, which all engines have."""
    if name == VERTICAL:
        hole = {key.replace(".", "__"): value for key, value in OPEN.items()}
        return trip(1750.0, 1900.0, **hole, wellbore__survey=None)
    return trip(1750.0, 2250.0)


@cache
def halfway(name: str) -> tuple[Run, Motion, float]:
    """The string in the middle of the trip, the motion of the top drive there, and the duration of the trip [s]."""
    case = the_case(name)
    operation = case.operations[0]
    whole = abs(operation.end_md - operation.start_md) / operation.speed + 2.0  # ramps of 2 s at both ends
    return *moving(case, whole / 2), whole


def hookload_over(advance: Any, run: Run, span: float) -> float:
    """Mean hook load [N] over a span [s]."""
    before = float(run.top[topdrive.SUM_HOOKLOAD])
    advance(span)
    return (float(run.top[topdrive.SUM_HOOKLOAD]) - before) / span


@pytest.mark.parametrize("name", [VERTICAL, BUILD])
def bench_fctd(benchmark: BenchmarkFixture, name: str) -> None:
    """The whole trip."""
    case = the_case(name)
    describe(benchmark, f"the paper's trip: {name}", engine="fctd")
    result = benchmark.pedantic(simulate, args=(case,), rounds=3, warmup_rounds=1)
    kept = ("segments", "pieces_of_hole", "steps", "simulated_s", "energy_error", "real_time_factor")
    benchmark.extra_info |= {key: result.run[key] for key in kept} | {"step_ms": 1e3 * result.run["step_s"]}
    benchmark.extra_info["status"] = result.status
    if benchmark.stats is not None:
        benchmark.extra_info["whole_wall_s"] = benchmark.stats.stats.median


@pytest.mark.parametrize(("name", "engine"), ENTRIES)
def bench_others(benchmark: BenchmarkFixture, name: str, engine: str) -> None:
    """A window; the record has the difference of its hook load from FCTD's in the same window."""
    registry = contact if engine in SWAPPED else engines
    if registry.installed_version(engine) is None:
        pytest.skip(f"the package of {engine} is not installed")
    start, motion, whole = halfway(name)
    own = copy_of(start)
    expected = hookload_over(lambda span: own.advance(motion, span), own, WINDOW)
    if engine in SWAPPED:
        run = asking(start, contact.build(engine, start.case))
        stepper: Any = engines.build("fctd").begin(run)
    else:
        run = copy_of(start)
        stepper = engines.build(engine).begin(run)
    if isinstance(stepper, FreeBodies):
        stepper.watch = False
    off = hookload_over(lambda span: stepper.advance(motion, span), run, WINDOW) / expected - 1
    describe(
        benchmark, f"the paper's trip: {name}", engine=engine, segments=run.segments, step_ms=1e3 * stepper.step,
        window_s=WINDOW, whole_s=whole, hookload_off_percent=100 * off,
    )  # fmt: skip
    benchmark.extra_info["extrapolated"] = True
    benchmark.pedantic(stepper.advance, args=(motion, WINDOW), rounds=3)
    if benchmark.stats is not None:
        median = benchmark.stats.stats.median
        benchmark.extra_info |= {"real_time_factor": WINDOW / median, "whole_wall_s": median * whole / WINDOW}
    stepper.close()
