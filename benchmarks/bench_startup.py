"""Time of whole processes: Python alone, the import, the command line, and compiling with an empty cache."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from benchmarks.records import describe
from benchmarks.strings import CASES

CHAIN, WELL = str(CASES / "curved_chain.toml"), str(CASES / "paper_well.toml")
# 71 bit depths, three operations and three friction factors: 639 strings of at most 61 segments.
KINDS = [part for kind in ("trip_in", "trip_out", "rotate_off_bottom") for part in ("--operation", kind)]
FAN = ["--depths", "1750:2450:10", *KINDS, "--friction", "0.2,0.3,0.4"]
COMMANDS = {
    "python alone": ["-c", "pass"],
    "import numba": ["-c", "import numba"],
    "import fctd": ["-c", "import fctd"],
    "fctd --help": ["-m", "fctd", "--help"],
    "fctd equilibrium": ["-m", "fctd", "equilibrium", CHAIN, "--operation", "trip_out", "--bit-depth", "2450"],
    "fctd chart": ["-m", "fctd", "chart", WELL, *FAN],
}
COMPILED = {
    "stepper": ["-c", f"import fctd; fctd.simulate(fctd.load_case({CHAIN!r}, {{'operations[0].duration': 1.0}}))"],
    "steady solver": ["-c", f"import fctd; fctd.equilibrium(fctd.load_case({CHAIN!r}), 'rotate_off_bottom', 2450.0)"],
}


def start(arguments: list[str], **environment: str) -> None:
    """Run a Python process to its end."""
    subprocess.run(
        [sys.executable, *arguments], check=True, capture_output=True, env=os.environ | environment,
        cwd=CASES.parents[1],
    )  # fmt: skip


@pytest.mark.parametrize("name", COMMANDS)
def bench_start(benchmark: BenchmarkFixture, name: str) -> None:
    """A process with compiled code in its cache."""
    describe(benchmark, "start-up", command=name)
    benchmark.pedantic(start, args=(COMMANDS[name],), rounds=5, warmup_rounds=1)


@pytest.mark.parametrize("name", COMPILED)
def bench_compile(benchmark: BenchmarkFixture, name: str, tmp_path: Path) -> None:
    """A process with an empty cache, and again with the cache that it filled; ``compile_s`` is the difference."""
    describe(benchmark, "compile", what=name)
    benchmark.pedantic(start, args=(COMPILED[name],), kwargs={"NUMBA_CACHE_DIR": str(tmp_path)}, rounds=1)
    if benchmark.stats is None:
        return
    began = time.perf_counter()
    start(COMPILED[name], NUMBA_CACHE_DIR=str(tmp_path))
    warm = time.perf_counter() - began
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    benchmark.extra_info |= {
        "warm_s": warm,
        "compile_s": benchmark.stats.stats.median - warm,
        "cache_MB": sum(path.stat().st_size for path in files) / 1e6,
    }
