"""Instructions that a unit of each subject takes, counted by valgrind: whatever the load.

Compiled for one plain processor without the newest extensions, which valgrind does not know; counts therefore compare
between machines.  They do not tell time, since instructions differ in cost: they stand in where no times compare.
"""

import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmarks import measure
from benchmarks.subjects import subjects

PROCESSOR = {"NUMBA_CPU_NAME": "haswell", "NUMBA_CPU_FEATURES": ""}
# valgrind writes what it has counted whenever the inner of these functions of the C library is entered; it seeds an old
# random generator, and nothing else calls it.
MARKER, ENTERED = "lcong48", "lcong48_r"


def available() -> bool:
    """Whether valgrind and its control program are installed."""
    return all(shutil.which(tool) for tool in ("valgrind", "callgrind_control"))


def count(root: Path = measure.ROOT) -> dict[str, float]:
    """Instructions per unit of every subject; raises subprocess.CalledProcessError where valgrind fails.

    Each subject runs once and then twice; the difference is one call, without what a call from Python costs.
    """
    environment = {**measure.environment(root), **PROCESSOR, "PYTHONHASHSEED": "0"}
    program = [sys.executable, "-m", "benchmarks.instructions"]
    # At full speed first: it fills the compile cache for this processor.
    subprocess.run(program, cwd=root, env=environment, check=True, capture_output=True)
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(
            [
                "valgrind", "--tool=callgrind", "--instr-atstart=no", f"--dump-before={ENTERED}",
                f"--callgrind-out-file={scratch}/counts", *program, "--start",
            ],
            cwd=root, env=environment, check=True, capture_output=True, text=True,
        )  # fmt: skip
        units = dict(line.rsplit("=", 1) for line in done.stdout.splitlines())
        # The first dump is what went before; then two for each subject.
        counted = [_total(Path(f"{scratch}/counts.{k + 1}")) for k in range(1 + 2 * len(units))][1:]
    return {
        name: (twice - once) / int(units[name])
        for name, once, twice in zip(units, counted[::2], counted[1::2], strict=True)
    }


def _total(dump: Path) -> int:
    """Instructions of one dump."""
    found = re.search(r"^(?:summary|totals):\s*(\d+)", dump.read_text(), re.MULTILINE)
    if found is None:
        raise ValueError(f"{dump.name} holds no total")
    return int(found.group(1))


def main() -> None:
    """The counted process: every subject compiled and warm, then between markers."""
    found = subjects()
    call, seed = getattr(ctypes.CDLL(None), MARKER), ctypes.create_string_buffer(14)
    for one in found.values():
        one.act()
    if "--start" in sys.argv:
        subprocess.run(["callgrind_control", "--instr=on", str(os.getpid())], check=True, stdout=subprocess.DEVNULL)
    for one in found.values():
        one.act()  # translated by valgrind before it counts
    call(seed)
    for one in found.values():
        one.act()
        call(seed)
        one.act()
        one.act()
        call(seed)
    for name, one in found.items():
        print(f"{name}={one.count}")


if __name__ == "__main__":
    main()
