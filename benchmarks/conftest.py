"""Summary after the times of a session: accuracy, cost per step and real-time factor from its records."""

from collections.abc import Iterator
from typing import Any

import pytest

# Entry of a record -> label; a record has some of these entries.
SHOWN = {
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
