"""What records have beside pytest-benchmark's own: machine, processor time, and a summary after the times."""

import time
from collections.abc import Iterator
from typing import Any

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from references.timing.stopwatch import machine

try:
    import resource
except ImportError:  # Windows, where processes that a benchmark starts are not counted
    resource = None  # type: ignore[assignment]

# Entry of a record -> label; a record has some of these entries.
SHOWN = {
    "processor_percent": "processor, % of wall",
    "ns_per_segment_step": "ns/segment-step",
    "ns_per_point": "ns/point",
    "real_time_factor": "× real time",
    "whole_wall_s": "whole trip, s",
    "penetration_error_m": "depth error, m",
    "missed_percent": "missed, %",
    "hookload_off_percent": "hook load off, %",
    "energy_error": "energy error",
    "compile_s": "compile, s",
    "arrays_MB": "arrays, MB",
    "peak_MB": "peak, MB",
    "growth_MB": "growth, MB",
}


@pytest.fixture
def benchmark(benchmark: BenchmarkFixture) -> Iterator[BenchmarkFixture]:
    """That of pytest-benchmark; its record also has the processor's share of the time on the wall clock."""
    clock, wall, processor = benchmark._timer, [], []

    def timer() -> float:  # called at the beginning and end of each round
        processor.append(processor_time())
        wall.append(clock())
        return float(wall[-1])

    benchmark._timer = timer
    yield benchmark
    spent = [sum(taken[1::2]) - sum(taken[: 2 * (len(taken) // 2) : 2]) for taken in (processor, wall)]
    if spent[1] > 0:
        benchmark.extra_info["processor_percent"] = 100 * spent[0] / spent[1]


def processor_time() -> float:
    """Processor time of this process and of those that it started and that have ended [s]."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN) if resource else None
    return time.process_time() + (children.ru_utime + children.ru_stime if children else 0.0)


def pytest_benchmark_update_machine_info(machine_info: dict[str, Any]) -> None:
    """Name what times depend on."""
    machine_info |= machine()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Print a line for each record with entries other than its time."""
    session = getattr(config, "_benchmarksession", None)
    lines = list(summary_lines(session.benchmarks)) if session is not None and not session.disabled else []
    if lines:
        terminalreporter.section("other results of the benchmarks")
        for line in lines:
            terminalreporter.write_line(line)


def summary_lines(benchmarks: list[Any]) -> Iterator[str]:
    """A line with name and SHOWN entries for every finished benchmark."""
    for bench in benchmarks:
        entries = bench.extra_info
        shown = [f"{heading} {entries[key]:.3g}" for key, heading in SHOWN.items() if key in entries]
        if shown and not bench.has_error:
            marked = "  (extrapolated)" if entries.get("extrapolated") else ""
            yield f"{bench.name}: {', '.join(shown)}{marked}"
