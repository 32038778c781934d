"""The gate: these sources against the last release's, by the strongest comparison that this machine allows.

1. The release's sources from the checkout's history, raced against these in pairs of processes: the same machine, the
   same hour, the same libraries, whatever processor the release was recorded on.
2. Without them, the release's recorded ratios to the reference kernel, if the processor and compiler are the same.
3. Without either nothing is judged, and that is said.
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

PROCESSES = 4  # of each side to begin with
MOST = 12
# Another batch starts only before this, so that CI stays within two minutes [s].
TIME = 75.0

Tell = Callable[[str], object]


@dataclass(frozen=True)
class Outcome:
    """What the gate found: how it compared (or why not), a verdict per kernel, and this run's own ratios."""

    how: str
    verdicts: list[Verdict]
    before: Costs
    now: Costs

    @property
    def passed(self) -> bool:
        """Whether no kernel fails."""
        return not any(verdict.fails for verdict in self.verdicts)


def gate(record: Record, file: Path, tell: Tell, root: Path = ROOT) -> Outcome:
    """Compare the sources in ``root`` with a release."""
    if sources_of(root) == record.sources:
        return Outcome(f"the engine's sources are those of release {name_of(record)}: nothing to compare", [], {}, {})
    try:
        release = check_out(record, file, root)
    except NoSourcesError as missing:
        return _recorded(record, str(missing), tell)
    how = f"raced against the sources of release {name_of(record)}"
    tell(f"{how}; compiling both")
    return sampled(how, lambda: measure.side_by_side(release, PROCESSES, root), tell)


def _recorded(record: Record, missing: str, tell: Tell) -> Outcome:
    """Compare with what the release recorded, where that says something about this machine."""
    reason = record.not_here(reference_digest(), processor(), machine_versions())
    if reason:
        how = f"not compared with release {name_of(record)}: {missing}, and its record is of {reason}"
        return Outcome(how, [], {}, {})
    how = f"compared with what release {name_of(record)} recorded on such a processor ({missing})"
    tell(how)

    def more() -> tuple[Costs, Costs]:
        costs, _ = measure.alone(PROCESSES)
        return {}, measure.ratios(costs) | {REFERENCE: [1.0] * PROCESSES}

    return sampled(how, more, tell, record.ratios)


def sampled(how: str, more: Callable[[], tuple[Costs, Costs]], tell: Tell, before: Costs | None = None) -> Outcome:
    """Verdicts on batches of processes: one batch where all is well, more where a kernel may be too slow.

    more : measures a batch, before and now.  A kernel is called slower only on a second batch's evidence.
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
        late = time.monotonic() - began > TIME and processes > PROCESSES
        if not doubtful or processes >= MOST or late:
            return Outcome(f"{how}, {processes} processes", verdicts, earlier, now)
        tell(f"measured again, since it may be slower: {', '.join(doubtful)}")


def joined(first: Costs, second: Costs) -> Costs:
    """The samples of two batches."""
    return {name: first.get(name, []) + taken for name, taken in second.items()}


def name_of(record: Record) -> str:
    """Release and commit, as one says it."""
    return f"{record.release} ({record.commit or 'commit unknown'}, {record.date:%Y-%m-%d})"
