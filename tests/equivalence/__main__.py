"""Judge the statements of the table on many drawn cases, and report those that do not hold.

    python -m tests.equivalence --draws 200 --seed 1
    python -m tests.equivalence --seed 1 --only 17 --statement "azimuth turned"

Exit code 1 where a statement failed. With --slow: those that run commands, write files or take longer, too.
"""

import argparse
import sys
import time
import warnings

from tests.equivalence.campaign import EXCEPTED, EXCEPTIONS, FAILED, HELD, NOT_APPLICABLE, Tally, campaign, fast
from tests.equivalence.draws import draw
from tests.equivalence.table import STATEMENTS
from tests.strategies import write_case


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.equivalence", description=__doc__.splitlines()[0])
    parser.add_argument("--draws", type=int, default=100, help="cases")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start", type=int, default=0, help="index of the first case")
    parser.add_argument("--only", type=int, help="index of a single case, which is printed")
    parser.add_argument("--statement", default="", help="those whose names contain this")
    parser.add_argument("--slow", action="store_true", help="those that run commands, write files or take longer, too")
    arguments = parser.parse_args()
    warnings.simplefilter("error")
    table = STATEMENTS.values() if arguments.slow else fast()
    chosen = [of for of in table if arguments.statement in of.name]
    indices = range(arguments.start, arguments.start + arguments.draws)
    if arguments.only is not None:
        indices = range(arguments.only, arguments.only + 1)
        print(write_case(draw(arguments.seed, arguments.only).raw))
    began = time.perf_counter()
    tally = campaign(arguments.seed, indices, chosen, lambda text: print(text, flush=True))
    show(tally, time.perf_counter() - began)
    return 1 if tally.failures else 0


def show(tally: Tally, took: float) -> None:
    """Print the table of statements."""
    width = max((len(name) for name, _ in tally.counts), default=0)
    print(f"{'':{width}} {HELD:>7} {FAILED:>7} {EXCEPTED:>9} {NOT_APPLICABLE:>13} {'ms each':>8}")
    for name in dict.fromkeys(name for name, _ in tally.counts):
        counts = [tally.counts[name, outcome] for outcome in (HELD, FAILED, EXCEPTED, NOT_APPLICABLE)]
        each = 1e3 * tally.took[name] / max(sum(counts[:3]), 1)
        print(f"{name:{width}} {counts[0]:7d} {counts[1]:7d} {counts[2]:9d} {counts[3]:13d} {each:8.1f}")
    for one in EXCEPTIONS:
        if tally.counts[one.name, EXCEPTED]:
            print(f"excepted: {one.name}: {one.cause}")
    for seed, index, words in tally.refusals:
        print(f"refused: --seed {seed} --only {index}: {words}")
    used = sum(tally.took.values())
    print(
        f"{tally.held} statements held, {len(tally.failures)} failed, in {took:.0f} s ({used:.0f} s of the processor)"
    )


if __name__ == "__main__":
    sys.exit(main())
