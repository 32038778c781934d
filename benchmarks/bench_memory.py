"""Memory of a run, a contact method and an engine; the times in these records are those of the whole process.

``arrays_MB`` is the exact sum of the run's buffers.  ``peak_MB`` is the largest resident memory of a process that does
nothing else, nan on systems without /proc, and ``growth_MB`` its increase by building, after all imports.
"""

import json
import subprocess
import sys

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe
from benchmarks.strings import CASES, chain
from references import contact, engines
from references.registry import absent
from references.timing.footprint import footprint

RUN = """
import json
from benchmarks.strings import chain
from fctd.simulation.preparation import prepare
run, phases = prepare(chain({segments}))
run.advance(phases[0].motion, run.step)
from fctd.mechanics.state import columns
arrays = [columns(run.S), run.top, run.owner, run.hole.pieces]
"""
MANY = """
import json
from benchmarks.strings import chain
from fctd.model.operations import steady_rates
from fctd.model.wellbore import build_wellbore
from fctd.steady.equilibrium import Solver
case = chain()
hole, rates = build_wellbore(case), steady_rates(case, "trip_out")
solvers = [Solver(case, hole) for _ in range({count})]
points = [solver.solve("trip_out", rates, 2400 + 50 * k / {count}) for k, solver in enumerate(solvers)]
"""
ENGINE = """
import json
from benchmarks.strings import chain
from references import engines
from references.timing.footprint import resident
from references.timing.workloads import moving
start, motion = moving(chain(), 1.0)
engine = engines.build("{name}")
before = resident()
stepper = engine.begin(start)
stepper.advance(motion, stepper.step)
growth = resident() - before
"""


def process(program: str, answer: str) -> dict[str, float]:
    """Run a program in a new Python process; returns the value of the expression ``answer`` at its end."""
    done = subprocess.run(
        [sys.executable, "-c", f"{program}from references.timing.footprint import peak\nprint(json.dumps({answer}))"],
        check=True, capture_output=True, text=True, cwd=CASES.parents[1],
    )  # fmt: skip
    found: dict[str, float] = json.loads(done.stdout.splitlines()[-1])
    return found


@pytest.mark.parametrize("segments", [60, 1000, 10_000])
def bench_run_memory(benchmark: BenchmarkFixture, segments: int) -> None:
    """FCTD's run of the curved chain."""
    describe(benchmark, "memory", segments=segments)
    answer = "{'arrays_MB': sum(a.nbytes for a in arrays) / 1e6, 'peak_MB': peak()}"
    benchmark.extra_info |= benchmark.pedantic(process, args=(RUN.format(segments=segments), answer), rounds=1)


@pytest.mark.parametrize("count", [100, 10_000])
def bench_many_strings(benchmark: BenchmarkFixture, count: int) -> None:
    """Strings of 60 segments in one process, each with arrays of its own, that stay after they are solved."""
    describe(benchmark, "memory", strings=count)
    answer = "{'arrays_MB': sum(solver.work.nbytes for solver in solvers) / 1e6, 'peak_MB': peak()}"
    benchmark.extra_info |= benchmark.pedantic(process, args=(MANY.format(count=count), answer), rounds=1)


@pytest.mark.parametrize("name", [*contact.METHODS, *contact.REGISTRY.plugins()])
def bench_method_memory(benchmark: BenchmarkFixture, name: str) -> None:
    """A contact method for the hole of the curved chain."""
    if contact.installed_version(name) is None:
        pytest.skip(absent(contact.method_class(name).distribution))
    describe(benchmark, "memory", method=name)
    growth, seconds = benchmark.pedantic(footprint, args=(name, chain()), rounds=1)
    benchmark.extra_info |= {"growth_MB": growth, "build_s": seconds}


@pytest.mark.parametrize("name", [name for name in engines.ENGINES if name not in ("fctd", "mujoco_chain")])
def bench_engine_memory(benchmark: BenchmarkFixture, name: str) -> None:
    """An engine with the curved chain in it, 60 segments, after a step."""
    if engines.installed_version(name) is None:
        pytest.skip(absent(engines.engine_class(name).distribution))
    describe(benchmark, "memory", engine=name)
    answer = "{'growth_MB': growth}"
    benchmark.extra_info |= benchmark.pedantic(process, args=(ENGINE.format(name=name), answer), rounds=1)
