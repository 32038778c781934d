"""A process that measures the subjects of the sources on its path; two of them let two commits take turns.

When ready it prints the names of its subjects as a line of JSON; then, for every line that it reads, a line with the
cost of each subject [ns per unit] in a round.  Both sides of a race run this file of today's sources, each with its own
``benchmarks.subjects``: the technique is the same on both sides, and the work that of each commit.
"""

import json
import sys
import time
from collections.abc import Callable

from benchmarks.subjects import subjects

# A packed loop keeps some values on the stack.  Where these lie a multiple of 4096 bytes from a row of the string, the
# processor takes one for the other: joint loads then take up to 1.35 times as long.  The stack begins anywhere, so
# that one depth would mark a whole process; calls from all depths within 4096 bytes give each process the same mix.
DEPTHS = 12
STRIDE = 5  # of depths between rounds, so that neighbours in time lie apart


def spent(act: Callable[[], object], depth: int) -> float:
    """Processor time of a call [s] from ``depth`` frames further down the stack, about 340 bytes each.

    By this thread's own clock: a core that another process had meanwhile is not counted.
    """
    taken: list[float] = []

    def below(_: object) -> int:
        taken.append(spent(act, depth - 1))
        return 0

    if depth:
        max([None], key=below)
        return taken[0]
    began = time.thread_time()
    act()
    return time.thread_time() - began


def main() -> None:
    """Build and compile everything, then answer requests."""
    found = subjects()
    for one in found.values():
        one.act()
    print(json.dumps(list(found)), flush=True)
    for k, _ in enumerate(sys.stdin):
        order = reversed(found) if k % 2 else iter(found)
        depth = STRIDE * k % DEPTHS
        print(json.dumps({name: 1e9 * spent(found[name].act, depth) / found[name].count for name in order}), flush=True)


if __name__ == "__main__":
    main()
