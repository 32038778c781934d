"""What records have beside pytest-benchmark's own: machine, processor time, and a summary after the times."""

import time
from collections.abc import Callable, Iterator
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


class TwoClocks:
    """A timer that reads the processor's clock beside another one, at the beginning and at the end of each round."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._wall: list[float] = []
        self._processor: list[float] = []

    def __call__(self) -> float:
        """The time of the other clock [s]."""
        self._processor.append(processor_time())
        self._wall.append(self._clock())
        return self._wall[-1]

    @property
    def processor_percent(self) -> float:
        """Processor time of all rounds over that of the other clock; NaN before the first round."""
        wall, processor = (sum(taken[1::2]) - sum(taken[::2]) for taken in (self._wall, self._processor))
        return 100 * processor / wall if wall > 0 else float("nan")


@pytest.fixture
def benchmark(benchmark: BenchmarkFixture) -> Iterator[BenchmarkFixture]:
    """That of pytest-benchmark; its record also has the processor's share of the time on the wall clock."""
    benchmark._timer = clocks = TwoClocks(benchmark._timer)
    yield benchmark
    if clocks.processor_percent > 0:  # not where times are switched off
        benchmark.extra_info["processor_percent"] = clocks.processor_percent


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
