"""One step of FCTD's loop with every contact method, called from Python once per step for all points."""

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe, time_steps
from benchmarks.strings import LEAD, chain
from fctd.mechanics.energy import energy_of
from references import contact
from references.registry import absent
from references.timing.workloads import NoWall, asking, energy_error, moving, without_wall

# Steps per round: FCTD's methods take some hundred nanoseconds per point, libraries ten microseconds or more.
OWN, OTHERS = 300, 15


@pytest.mark.parametrize("name", ["no contact", *contact.METHODS, *contact.REGISTRY.plugins()])
def bench_swapped_step(benchmark: BenchmarkFixture, name: str) -> None:
    """60 segments turning; ``no contact`` is a query without contacts, in a run without the hole."""
    if name != "no contact" and contact.installed_version(name) is None:
        pytest.skip(absent(contact.method_class(name).distribution))
    start, motion = moving(chain(), LEAD)
    own = name == "no contact" or contact.method_class(name).distribution == "fctd"
    run = (
        asking(without_wall(start), NoWall())
        if name == "no contact"
        else asking(start, contact.build(name, start.case))
    )
    before = energy_of(run.S, run.segments)
    describe(benchmark, "step, contact method swapped", method=name)
    time_steps(benchmark, lambda span: run.advance(motion, span), run, run.step, OWN if own else OTHERS, rounds=9)
    run.refresh()
    benchmark.extra_info["energy_error"] = energy_error(run, before, energy_of(run.S, run.segments))
