"""Cost of a step over the number of segments, 10 to 10,000, and over the number of cylinders, 10² to 10⁵."""

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import COMPILED, describe, time_steps
from benchmarks.strings import LEAD, chain
from fctd.mechanics.energy import energy_of
from references.timing.workloads import energy_error, fallen, moving, touching


@pytest.mark.parametrize("segments", [10, 30, 100, 300, 1000, 3000, 10_000])
def bench_segments(benchmark: BenchmarkFixture, segments: int) -> None:
    """The chain on the wall of its hole, with all segments turning."""
    run, motion = fallen(chain(segments), 0.3)
    before = energy_of(run.S, segments)
    describe(benchmark, "step over segments, fallen", touching_percent=100 * touching(run))
    time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, max(COMPILED // segments, 20))
    run.refresh()
    benchmark.extra_info["energy_error"] = energy_error(run, before, energy_of(run.S, segments))


@pytest.mark.parametrize("length", [20.0, 2.0, 0.2, 0.02])
def bench_cylinders(benchmark: BenchmarkFixture, length: float) -> None:
    """60 segments turning in cylinders of ``length`` [m]."""
    hole = {"wellbore__chord_tolerance": None, "wellbore__cylinder_length": length}
    run, motion = moving(chain(60, **hole, wellbore__overlap=min(0.2, length / 10)), LEAD)
    before = energy_of(run.S, run.segments)
    describe(benchmark, "step over cylinders", chord_error_m=length**2 / 8 / 286.479)
    time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, COMPILED // 60)
    benchmark.extra_info["energy_error"] = energy_error(run, before, energy_of(run.S, run.segments))
