"""The gate: today's sources raced against those of another commit, in pairs of processes that take turns.

Both sides run in the same hour, on the same machine and with the same libraries.
"""

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from benchmarks import checkout, history, measure
from benchmarks.history import Record
from benchmarks.measure import ADDED, ROOT, Costs
from benchmarks.subjects import REFERENCE
from benchmarks.verdict import Verdict, decide

PROCESSES = 4  # per side and batch
MOST = 12  # per side
# No new batch starts after this time [s], so that CI stays within two minutes.
TIME = 75.0
SUM = "all kernels (geometric mean)"

Report = Callable[[str], object]  # prints a line of progress
Judge = Callable[[Costs, Costs], list[Verdict]]


@dataclass(frozen=True)
class Outcome:
    """Result of a race: how it was run, a verdict per kernel, and costs before and now."""

    how: str
    verdicts: list[Verdict]
    before: Costs
    now: Costs

    @property
    def passed(self) -> bool:
        """Whether no kernel fails."""
        return not any(verdict.fails for verdict in self.verdicts)


def against_baseline(record: Record, file: Path, report: Report) -> Outcome:
    """Race the present sources against a baseline; InputError where the clone does not hold its commit.

    Sources that equal those of the baseline are not raced.
    """
    if checkout.sources_of(ROOT) == record.sources:
        return Outcome(f"the engine's sources are those of the baseline {record.name}: nothing to race", [], {}, {})
    commit = history.commit_of(record, file)
    return race(commit, f"raced against the baseline {record.name}", report, lambda before, now: decide(
        before, now, brings=checkout.brought
    ))  # fmt: skip


def against(commit: str, records: list[tuple[Path, Record]], report: Report) -> Outcome:
    """Race the present sources against any commit: on the kernels that both have, and the sum of their changes.

    records : what they accepted since the commit, raises the threshold of a kernel, and never that of the sum.
    """
    made: datetime = checkout.date_of(checkout.resolved(commit))
    since = history.accepted_since(made, records)

    def judge(before: Costs, now: Costs) -> list[Verdict]:
        both = {name: taken for name, taken in before.items() if name in now}
        return decide(both, now, since, lambda kernel: True)

    return race(commit, f"raced against {commit} of {made:%Y-%m-%d}", report, judge)


def race(commit: str, how: str, report: Report, judge: Judge) -> Outcome:
    """Race the present sources against those of a commit."""
    earlier = checkout.check_out(commit)
    report(how)
    return sampled(how, lambda: measure.side_by_side(earlier, ROOT, PROCESSES), report, judge)


def sampled(how: str, more: Callable[[], tuple[Costs, Costs]], report: Report, judge: Judge) -> Outcome:
    """Verdicts from batches of processes: one batch where no kernel looks slower, more batches otherwise.

    more : measures a batch, before and now.  A kernel is slower only if a second batch confirms it.
    """
    began = time.monotonic()
    before: Costs = {}
    now: Costs = {}
    while True:
        for costs, batch in zip((before, now), more(), strict=True):
            for name, taken in batch.items():
                costs.setdefault(name, []).extend(taken)
        verdicts = judge(with_sum(before, now), with_sum(now, before))
        processes = len(now[REFERENCE])
        doubtful = [verdict for verdict in verdicts if verdict.open]
        settled = all(verdict.fails for verdict in doubtful) or time.monotonic() - began > TIME
        if not doubtful or processes >= MOST or (settled and processes > PROCESSES):
            return Outcome(f"{how}, {processes} pairs of processes", verdicts, before, now)
        report(f"measuring again, since these kernels may be slower: {', '.join(each.kernel for each in doubtful)}")


def with_sum(costs: Costs, other: Costs) -> Costs:
    """The judged kernels of a side, and the geometric mean of those that both sides measure."""
    judged = measure.judged(costs)
    shared: Iterable[str] = [name for name in judged if name in other and name not in ADDED]
    return judged | {SUM: measure.summed(costs, list(shared))}
