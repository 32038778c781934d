"""One step of FCTD over the number of segments, contact-free and in contact; the difference is the cost of contact."""

from typing import Any

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import COMPILED, describe, time_steps
from benchmarks.strings import LEAD, chain, hanging
from fctd.mechanics.energy import energy_of
from references.timing.workloads import energy_error, moving, touching

KINDS: dict[str, dict[str, Any]] = {
    "cylinders": {},
    "arcs": {"wellbore__geometry": "arcs"},
    "cylinders, law paper": {"contact__friction_law": "paper"},
}


@pytest.mark.parametrize("kind", ["contact-free", *KINDS])
@pytest.mark.parametrize("segments", [60, 170, 500, 1000])
def bench_step(benchmark: BenchmarkFixture, segments: int, kind: str) -> None:
    """One step, compiled; without contact the chain hangs freely."""
    run, motion = moving(hanging(segments) if kind == "contact-free" else chain(segments, **KINDS[kind]), LEAD)
    before = energy_of(run.S, segments)
    describe(benchmark, "step over segments", kind=kind, touching_percent=100 * touching(run))
    time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, COMPILED // segments)
    benchmark.extra_info["energy_error"] = energy_error(run, before, energy_of(run.S, segments))
