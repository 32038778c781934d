"""What a step costs: with and without contact, over segments and cylinders, and the joints by themselves.

``make bench`` runs it.  One core, compile time excluded; ``ns_per_segment_step`` is in every record.
"""

from pathlib import Path
from typing import Any

import pytest
from numba import njit
from pytest_benchmark.fixture import BenchmarkFixture

from fctd import load_case, simulate
from fctd.joints import update_joint_loads
from fctd.results import versions
from fctd.run import Run, forget_start, prepare, settle
from fctd.state import OPEN
from fctd.topdrive import Motion

CASES = Path(__file__).parents[1] / "validation" / "cases"
BODY_STEPS = 200_000  # a round
ROTATION = {"kind": "rotate_off_bottom", "at_md": 2450.0, "duration": 60.0, "rpm": 60.0, "ramp_time": 4.0}


def turning(segments: int, changes: dict[str, Any]) -> tuple[Run, Motion]:
    """The curved chain cut into ``segments``, settled and turning.

    Segments and step are those of the case whatever is changed, so that only the kernel differs.
    """
    changes |= {"string.components[0].segments": segments, "operations": [ROTATION]}
    run, stretches = prepare(load_case(CASES / "curved_chain.toml", changes))
    settle(run)
    forget_start(run)
    # Long enough for the first wave to reach the bit: ahead of it velocities are denormal numbers, which
    # this processor adds many times slower than others.
    run.advance(stretches[0].motion, 4.0)
    return run, stretches[1].motion


def steps(benchmark: BenchmarkFixture, run: Run, motion: Motion) -> None:
    """Time a round of steps and record the cost of one."""
    count = BODY_STEPS // run.segments
    benchmark.extra_info |= {"segments": run.segments, "pieces_of_hole": len(run.hole.pieces), **versions()}
    benchmark.pedantic(run.advance, args=(motion, count * run.step), rounds=15, warmup_rounds=2)
    if benchmark.stats is not None:
        cost = benchmark.stats.stats.median / count / run.segments
        benchmark.extra_info["ns_per_segment_step"] = 1e9 * cost
        benchmark.extra_info["real_time_factor"] = run.step / (cost * run.segments)


@pytest.mark.parametrize("kind", ["contact-free", "cylinders", "arcs", "cylinders, law paper"])
@pytest.mark.parametrize("segments", [60, 170, 500, 1000])
def bench_step(benchmark: BenchmarkFixture, segments: int, kind: str) -> None:
    """One step: the difference to contact-free is what contact adds."""
    changes: dict[str, dict[str, Any]] = {
        "contact-free": {},
        "cylinders": {},
        "arcs": {"wellbore.geometry": "arcs"},
        "cylinders, law paper": {"contact.friction_law": "paper"},
    }
    benchmark.group = "step over segments"
    run, motion = turning(segments, changes[kind])
    if kind == "contact-free":
        # The string is settled in the hole, then the hole is taken away.
        run.laws = run.laws._replace(geometry=OPEN)
    steps(benchmark, run, motion)


@pytest.mark.parametrize("length", [20.0, 2.0, 0.2, 0.02])
def bench_cylinders(benchmark: BenchmarkFixture, length: float) -> None:
    """One step of 60 segments in 10² to 10⁵ cylinders."""
    benchmark.group = "step over cylinders"
    changes = {
        "wellbore.chord_tolerance": None,
        "wellbore.cylinder_length": length,
        "wellbore.overlap": min(0.2, length / 10),
    }
    steps(benchmark, *turning(60, changes))


@njit(error_model="numpy")
def many_joint_loads(S, n, count):  # type: ignore[no-untyped-def]
    for _ in range(count):
        update_joint_loads(S, n, 1e-5, 1e-3)


def bench_joints(benchmark: BenchmarkFixture) -> None:
    """The packed joint arithmetic by itself, springs and damping, 64 joints."""
    benchmark.group = "joints"
    run, _ = turning(60, {})
    count = BODY_STEPS // 64
    benchmark.pedantic(many_joint_loads, args=(run.S, 64, count), rounds=15, warmup_rounds=2)
    if benchmark.stats is not None:
        benchmark.extra_info["ns_per_joint"] = 1e9 * benchmark.stats.stats.median / count / 64


def bench_trip_in(benchmark: BenchmarkFixture) -> None:
    """The paper's well tripped into from 1750 to 2450 m at 0.5 m/s, records and ledger included."""
    benchmark.group = "paper-well"
    case = load_case(CASES / "paper_well.toml", {"contact.friction_law": "paper"})
    result = benchmark.pedantic(simulate, args=(case,), rounds=3, warmup_rounds=1)
    benchmark.extra_info |= {"real_time_factor": result.run["real_time_factor"], "steps": result.run["steps"]}
