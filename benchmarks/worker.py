"""``python -m benchmarks.worker``: one process that measures on demand.  Two releases take turns through two of them.

It prints a line when it is ready, what it measures as JSON; then a line for every line it reads: cost of each
subject [ns per unit] in a round.  A release is raced with the worker of its own sources, so that what is said here
changes only together with PROTOCOL.
"""

import hashlib
import json
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks import reference_kernel
from benchmarks.subjects import Subject, subjects
from references.timing.stopwatch import turn

PROTOCOL = 1
# A round takes the shortest of so many calls of each subject: what disturbs a call only ever adds.
CALLS = 3


def digest(*files: Path) -> str:
    """Hash of names and contents, which tells whether sources are the same."""
    found = hashlib.sha256()
    for file in sorted(files):
        found.update(file.name.encode() + file.read_bytes())
    return found.hexdigest()[:16]


def sources_digest(root: Path) -> str:
    """Hash of the engine's sources in a checkout: names relative to ``fctd/`` and contents, in rooms or all in one."""
    folder, found = root / "fctd", hashlib.sha256()
    for file in sorted(folder.rglob("*.py")):
        found.update(file.relative_to(folder).as_posix().encode() + file.read_bytes())
    return found.hexdigest()[:16]


def reference_digest() -> str:
    """Hash of the reference kernel's source: costs in units of different kernels do not compare."""
    return digest(Path(reference_kernel.__file__))


def hello(found: dict[str, Subject]) -> dict[str, Any]:
    """What the first line says."""
    return {
        "protocol": PROTOCOL,
        "reference": reference_digest(),
        "subjects": {name: {"unit": one.unit, "size": one.size} for name, one in found.items()},
    }


def one_round(found: dict[str, Subject], backwards: bool) -> dict[str, float]:
    """Cost of each subject [ns per unit]: the shortest of ``CALLS`` turns by this thread's own clock.

    Time in which another process had the core is not counted.
    """
    actions = {name: one.act for name, one in found.items()}
    counts = {name: one.count for name, one in found.items()}
    turns = [turn(actions, counts, time.thread_time, backwards) for _ in range(CALLS)]
    return {name: min(taken[name] for taken in turns) for name in actions}


def main() -> None:
    """Build and compile everything, then answer."""
    found = subjects()
    for one in found.values():
        one.act()
    print(json.dumps(hello(found)), flush=True)
    for k, _ in enumerate(sys.stdin):
        print(json.dumps(one_round(found, backwards=k % 2 == 1)), flush=True)


if __name__ == "__main__":
    main()
