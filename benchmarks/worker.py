"""``python -m benchmarks.worker``: one process that measures on request; two of them let two releases take turns.

When ready it prints its subjects as a line of JSON; then, for every line that it reads, a line with the cost of each
subject [ns per unit] in a round.  A release runs the worker of its own sources, so that a change of these lines needs a
new PROTOCOL.
"""

import hashlib
import json
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks.subjects import Subject, subjects
from references.timing import reference_kernel
from references.timing.stopwatch import turn

PROTOCOL = 1
# Calls of each subject per round, of which the shortest counts: a disturbance can only lengthen a call.
CALLS = 3


def digest(*files: Path) -> str:
    """Hash of names and contents of files."""
    found = hashlib.sha256()
    for file in sorted(files):
        found.update(file.name.encode() + file.read_bytes())
    return found.hexdigest()[:16]


def sources_digest(root: Path) -> str:
    """Hash of the engine's sources in a checkout: names relative to ``fctd/`` and contents, subfolders included."""
    folder, found = root / "fctd", hashlib.sha256()
    for file in sorted(folder.rglob("*.py")):
        found.update(file.relative_to(folder).as_posix().encode() + file.read_bytes())
    return found.hexdigest()[:16]


def reference_digest() -> str:
    """Hash of the reference kernel's source: costs relative to different kernels are not comparable."""
    return digest(Path(reference_kernel.__file__))


def hello(found: dict[str, Subject]) -> dict[str, Any]:
    """The content of the first line."""
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
    """Build and compile everything, then answer requests."""
    found = subjects()
    for one in found.values():
        one.act()
    print(json.dumps(hello(found)), flush=True)
    for k, _ in enumerate(sys.stdin):
        print(json.dumps(one_round(found, backwards=k % 2 == 1)), flush=True)


if __name__ == "__main__":
    main()
