"""One step of every engine, contact-free and in contact, each with its own step length."""

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import COMPILED, describe, time_steps
from benchmarks.strings import LEAD, chain, hanging
from references import engines
from references.engines import gate
from references.engines.free_bodies import FreeBodies
from references.registry import absent
from references.timing.workloads import moving

# Steps per round.
STEPS = {"fctd": COMPILED // 60, "bullet": 10, "mujoco": 10, "mujoco_chain": 10, "elastica": 200}


# The chain of ball joints has no contact.
ENTRIES = [
    (name, state)
    for state in ("contact-free", "contact")
    for name in engines.ENGINES
    if (name, state) != ("mujoco_chain", "contact")
]


@pytest.mark.parametrize(("name", "state"), ENTRIES)
def bench_engine(benchmark: BenchmarkFixture, name: str, state: str) -> None:
    """60 segments of the curved chain, turning in the hole or hanging freely; contacts are not read for checks.

    The record has the verdict of the gate before any speed.
    """
    if engines.installed_version(name) is None:
        pytest.skip(absent(engines.engine_class(name).distribution))
    case = hanging() if state == "contact-free" else chain()
    run, motion = moving(case, 0.0 if name == "mujoco_chain" else LEAD)
    stepper = engines.build(name).begin(run)
    if isinstance(stepper, FreeBodies):
        stepper.watch = False
    if name == "mujoco_chain":  # it starts at rest: let the first wave pass the string
        stepper.advance(motion, 1.0)
    held = gate.verdict(gate.examine(engines.build(name)), touching=state == "contact")
    describe(benchmark, f"step of every engine, {state}", engine=name, does=engines.engine_class(name).does, gate=held)
    time_steps(benchmark, lambda span: stepper.advance(motion, span), run, stepper.step, STEPS[name], rounds=9)
    stepper.close()
