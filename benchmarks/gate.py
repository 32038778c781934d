"""The gate: compare these sources with those of the last release, by the best method possible on this machine.

1. The release's sources from the checkout's history are raced against these in pairs of processes: same machine, same
   hour and same libraries, independent of the processor on which the release was recorded.
2. Without the release's sources, its recorded ratios to the reference kernel are used, if processor and compiler are
   the same.
3. Otherwise the gate makes no comparison, and reports why.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from benchmarks import measure
from benchmarks.history import Record, machine_versions, processor, sources_of
from benchmarks.measure import ROOT, Costs
from benchmarks.release import NoSourcesError, check_out
from benchmarks.subjects import REFERENCE
from benchmarks.verdict import Verdict, decide
from benchmarks.worker import reference_digest

PROCESSES = 4  # per side and batch
MOST = 12  # per side
# No new batch starts after this time [s], so that CI stays within two minutes.
TIME = 75.0

Report = Callable[[str], object]  # prints a line of progress


@dataclass(frozen=True)
class Outcome:
    """Result of the gate: the method (or why there is none), a verdict per kernel, and costs before and now."""

    how: str
    verdicts: list[Verdict]
    before: Costs
    now: Costs

    @property
    def passed(self) -> bool:
        """Whether no kernel fails."""
        return not any(verdict.fails for verdict in self.verdicts)


def gate(record: Record, file: Path, report: Report, root: Path = ROOT) -> Outcome:
    """Compare the sources in ``root`` with a release."""
    if sources_of(root) == record.sources:
        return Outcome(f"the engine's sources are those of release {name_of(record)}: nothing to compare", [], {}, {})
    try:
        release = check_out(record, file, root)
    except NoSourcesError as missing:
        return _recorded(record, str(missing), report)
    how = f"raced against the sources of release {name_of(record)}"
    report(f"{how}; compiling both")
    return sampled(how, lambda: measure.side_by_side(release, PROCESSES, root), report)


def _recorded(record: Record, missing: str, report: Report) -> Outcome:
    """Compare with the recorded ratios of the release, if processor, compiler and reference kernel are the same."""
    reason = record.not_here(reference_digest(), processor(), machine_versions())
    if reason:
        how = f"not compared with release {name_of(record)}: {missing}, and the record is from {reason}"
        return Outcome(how, [], {}, {})
    how = f"compared with the record of release {name_of(record)} from the same kind of processor ({missing})"
    report(how)

    def more() -> tuple[Costs, Costs]:
        costs, _ = measure.alone(PROCESSES)
        return {}, measure.ratios(costs) | {REFERENCE: [1.0] * PROCESSES}

    return sampled(how, more, report, record.ratios)


def sampled(how: str, more: Callable[[], tuple[Costs, Costs]], report: Report, before: Costs | None = None) -> Outcome:
    """Verdicts from batches of processes: one batch if no kernel looks slower, more batches otherwise.

    more : measures a batch, before and now.  A kernel is slower only if a second batch confirms it.
    """
    began = time.monotonic()
    fixed = before is not None
    earlier: Costs = dict(before or {})
    now: Costs = {}
    while True:
        batch_before, batch_now = more()
        if not fixed:
            earlier = joined(earlier, batch_before)
        now = joined(now, batch_now)
        verdicts = decide(measure.judged(earlier), measure.judged(now))
        processes = len(now[REFERENCE])
        doubtful = [verdict.kernel for verdict in verdicts if verdict.open]
        timed_out = time.monotonic() - began > TIME and processes > PROCESSES
        if not doubtful or processes >= MOST or timed_out:
            return Outcome(f"{how}, {processes} processes", verdicts, earlier, now)
        report(f"measuring again, since these kernels may be slower: {', '.join(doubtful)}")


def joined(first: Costs, second: Costs) -> Costs:
    """The samples of two batches, joined per subject."""
    return {name: first.get(name, []) + taken for name, taken in second.items()}


def name_of(record: Record) -> str:
    """Release, commit and date as text."""
    return f"{record.release} ({record.commit or 'commit unknown'}, {record.date:%Y-%m-%d})"
