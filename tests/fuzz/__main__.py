"""Run fctd on many case and survey files of a seed, and report all that give neither an answer nor an InputError.

    python -m tests.fuzz --count 21000 --seed 1
    python -m tests.fuzz --seed 1 --only 17 --out folder
    python -m tests.fuzz --office --count 20000 --seed 1

With --office: survey files as offices write them, each of which must be read as it is meant, or refused.
Exit code 1 after any offence.
"""

import argparse
import faulthandler
import resource
import sys
import time
import warnings
from collections import Counter
from pathlib import Path
from random import Random

from tests.fuzz import offices
from tests.fuzz.campaign import Outcome, judge, make, write

# Memory of a case before it counts as an offence (a MemoryError), and time before the program ends with a traceback.
MOST_MEMORY = 6 * 2**30
LONGEST = 300


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--count", type=int, default=1000, help="items; every 25th is a plausible well, solved six times"
    )
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--start", type=int, default=0, help="index of the first item")
    parser.add_argument("--only", type=int, help="index of a single item, which is written into a folder")
    parser.add_argument("--out", type=Path, default=Path("."), help="the folder for --only")
    parser.add_argument("--office", action="store_true", help="survey files of known stations alone")
    arguments = parser.parse_args()
    warnings.simplefilter("error")
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    if arguments.only is not None:
        return show(arguments.seed, arguments.only, arguments.out)
    if arguments.office:
        return of_offices(arguments.seed, range(arguments.start, arguments.start + arguments.count))
    return campaign(arguments.seed, range(arguments.start, arguments.start + arguments.count))


def of_offices(seed: int, indices: range) -> int:
    """Count the files of offices that are read and refused, and print what was read in another way than it is meant."""
    began = time.perf_counter()
    read, refused, offences = offices.campaign(seed, indices)
    for offence in offences:
        print(offence)
    took = time.perf_counter() - began
    print(f"{len(indices)} files of seed {seed} in {took:.0f} s: {read} read, {refused} refused, {len(offences)} wrong")
    return 1 if offences else 0


def outcome_of(seed: int, index: int) -> Outcome:
    """The outcome of the item of a seed and an index."""
    faulthandler.dump_traceback_later(LONGEST, exit=True, file=sys.__stderr__)
    outcome = judge(make(seed, index), Random(f"{seed}:{index}:solve"))
    faulthandler.cancel_dump_traceback_later()
    return outcome


def show(seed: int, index: int, folder: Path) -> int:
    """Write an item and print its outcome."""
    item = make(seed, index)
    folder.mkdir(parents=True, exist_ok=True)
    print(f"wrote {write(item, folder)}")
    for text in item.overrides:
        print(f"  --set {text!r}"[:500])
    outcome = outcome_of(seed, index)
    print(f"load {outcome.load_s:.3f} s, solve {outcome.solve_s:.3f} s, {dict(outcome.tally)}")
    for offence in outcome.offences:
        print(f"offence: {offence}")
    return 1 if outcome.offences else 0


def campaign(seed: int, indices: range) -> int:
    """Count the outcomes of many items; offences are printed as they occur."""
    tally: Counter[str] = Counter()
    loads, solves, offences = [], [], 0
    began = time.perf_counter()
    for index in indices:
        outcome = outcome_of(seed, index)
        tally += outcome.tally
        loads.append((outcome.load_s, index))
        solves.append((outcome.solve_s, index))
        for offence in outcome.offences:
            offences += 1
            print(f"{seed}:{index} {offence}", flush=True)
        if sys.stderr.isatty():
            print(f"\r{index - indices.start + 1} of {len(indices)}, {offences} offences", end="\r", file=sys.stderr)
    print(f"{len(indices)} items of seed {seed} in {time.perf_counter() - began:.0f} s, {offences} offences")
    for what, count in sorted(tally.items()):
        print(f"  {count:7d} {what}")
    for name, times in (("loads", loads), ("solves", solves)):
        slowest = ", ".join(f"{seconds:.3g} s ({seed}:{index})" for seconds, index in sorted(times, reverse=True)[:5])
        print(f"  slowest {name}: {slowest}")
    return 1 if offences else 0


if __name__ == "__main__":
    sys.exit(main())
