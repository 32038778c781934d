"""A sweep: chunks of samples go to the workers, their rows into the folder, until every sample has rows.

A chunk takes long enough that sending it costs little, and comes back as rows or with the death of its worker.  A
chunk whose worker dies is halved until the sample is found that kills it.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from itertools import count
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any, Final

from fctd.case.errors import InputError, naming
from fctd.sweep.chunk import (
    CRASHED,
    NO_ROWS,
    TIMED_OUT,
    ChunkResult,
    SampleRunner,
    as_table,
    from_stream,
    without_answer,
)
from fctd.sweep.cluster import ClusterChoice, check_sources, connected, worker_count
from fctd.sweep.dataset import Dataset, alone, begin_dataset
from fctd.sweep.design import sample_of, samples_of
from fctd.sweep.spec import SweepSpec
from fctd.sweep.template import Template, template_of
from fctd.sweep.work import Task, misfit, task_of

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    from distributed import Client, Future

# Work of a chunk [s]: at least; usually; and more for each worker, since one scheduler serves them all.
LEAST, USUAL, PER_WORKER = 0.05, 0.4, 0.005
MOST_IN_CHUNK: Final = 1000
# Chunks that wait for a worker, for each worker, beside the one that it works on.
AHEAD: Final = 1
# Between two parts of rows [s].
PART = 2.0
# Deaths of workers after which a sample that was alone counts as the reason.
DEATHS: Final = 3
# Samples whose cases are made before the work begins.
TRIED: Final = 64
# Without an answer from anyone, the connection is looked at after this time [s]; a chunk that is done and does not come
# within the other one is not to be had.
PATIENCE, LOST = 1.0, 300.0


class SchedulerLostError(RuntimeError):
    """The scheduler of a sweep has ended."""


@dataclass
class Summary:
    """What a run of a sweep did, times in seconds; it is kept in ``sweep.json``.

    dashboard : address of the cluster's page; start : of cluster and workers; wall : from the first chunk to the last
    file; solving, elapsed : sums over the chunks, of their samples and of all that a worker does; writing : of files;
    shortest : least time of a chunk with as many samples as were planned; without_answer : statuses of samples of this
    run that have none, with their numbers; statuses : of all rows of the dataset, with their numbers.
    """

    samples: int
    done_before: int
    workers: int = 0
    dashboard: str = ""
    start: float = 0.0
    wall: float = 0.0
    solving: float = 0.0
    elapsed: float = 0.0
    writing: float = 0.0
    chunks: int = 0
    samples_in_chunk: int = 0
    shortest: float = math.inf
    rows: int = 0
    without_answer: dict[str, int] = field(default_factory=dict)
    statuses: dict[str, int] = field(default_factory=dict)

    @property
    def share(self) -> float:
        """Share of the workers' time that went into solving and writing."""
        whole = self.wall * self.workers  # 0 of a sweep that ends before its workers are there
        return min((self.solving + self.writing) / whole, 1.0) if whole else float("nan")


# Called when samples are done, with their number so far and in all, and how many have no answer.
SampleProgress = Callable[[int, int, int], None]


def prepare(spec: SweepSpec) -> tuple[SampleRunner, pd.DataFrame]:
    """What workers need, and the table of samples; raises InputError for a sweep that cannot be run as it is.

    The cases of some samples are made, among them those with the extremes of each parameter.
    """
    with naming(spec.file):
        samples = samples_of(spec)
        template = template_of(spec, sample_of(samples, 0))
        task = task_of(spec.work, template.base)
        check_samples(template, samples, task)
    return SampleRunner(template, task, spec.time_limit), samples


def check_samples(template: Template, samples: pd.DataFrame, task: Task) -> None:
    """Raise InputError, which names sample and values, where one of some samples has no case; where such samples are to
    be rows, if none of them has one; and where string and hole fit at no depth of the first of them.
    """
    rows, first = template.spec.bad_samples == "rows", True
    refusal: InputError | None = None
    tried = {0, len(samples) - 1, *range(0, len(samples), max(len(samples) // TRIED, 1))}
    for key in template.units:
        numbers = samples[key]
        if numbers.dtype.kind in "if":
            tried |= {int(numbers.argmin()), int(numbers.argmax())}
    for number in sorted(tried):
        sample = sample_of(samples, number)
        try:
            case = template.case(*sample)
        except InputError as error:
            pairs = sample.by_key.items()
            values = ", ".join(f"{key} = {value} {template.units[key]}".rstrip() for key, value in pairs)
            expected = "values that a case can have" + ("" if rows else ', or bad_samples = "rows"')
            refusal = InputError(f"{expected}; sample {number} has none: {error}", key="parameters", value=values)
            if not rows:
                raise refusal from None
            continue
        if first and (reason := misfit(case, task)) is not None:
            expected = f"a depth at which string and hole of sample {number} fit ({reason})"
            key = "depths" if template.spec.work.depths is not None else "bit_depth"
            raise InputError(expected, key=f"work.{key}", value=getattr(template.spec.work, key))
        first = False
    if first and refusal is not None:
        raise refusal


def sweep(
    spec: SweepSpec,
    folder: Path,
    cluster: ClusterChoice | None = None,
    progress: SampleProgress | None = None,
    on_client: Callable[[Client], None] | None = None,
) -> Summary:
    """Compute all samples of a sweep that have no rows yet, and write them into the folder; see ``Dataset``.

    progress, on_client : called with what is done, and once with the cluster's client.  Raises InputError for a sweep,
    folder or cluster that cannot be used, before any work; SchedulerLostError where the scheduler ends.  What was
    written stays, and another call goes on with it.
    """
    runner, samples = prepare(spec)
    with alone(folder):
        dataset = begin_dataset(folder, runner.template, samples)
        if not dataset.missing:
            return Summary(len(dataset.samples), len(dataset.done), statuses=dataset.statuses())
        began = time.perf_counter()
        with connected(cluster or ClusterChoice()) as client:
            if on_client is not None:
                on_client(client)
            running = _Running(client, runner, dataset, progress)
            running.summary.dashboard = str(client.dashboard_link)
            try:
                running.warm_up()
                running.summary.start = time.perf_counter() - began
                running.run()
            except (OSError, CancelledError) as error:  # TimeoutError is an OSError
                if not _lost(client, error):
                    raise
                raise SchedulerLostError from error
            finally:
                running.finish()
        running.summary.statuses = dataset.statuses()
    return running.summary


class _Running:
    """A sweep while it runs."""

    def __init__(self, client: Client, runner: SampleRunner, dataset: Dataset, progress: SampleProgress | None) -> None:
        self.client, self.runner, self.dataset, self.progress = client, runner, dataset, progress
        self.summary = Summary(len(dataset.samples), len(dataset.done))
        self.waiting = deque(dataset.missing)
        self.again: deque[tuple[int, ...]] = deque()  # halves of chunks whose worker died
        self.flying: dict[Future[ChunkResult], tuple[int, ...]] = {}
        self.ended: SimpleQueue[Any] = SimpleQueue()
        self.suspects: set[int] = set()  # samples of these
        self.deaths: dict[int, int] = {}
        self.tables: list[pa.Table] = []
        self.taken = set(dataset.done)
        self.each = float("nan")  # time of a sample [s]
        self.name = f"fctd-{dataset.about['identity'][:16]}"
        self.numbers = count()
        self.workers = 0
        self.began = self.written = time.perf_counter()

    def warm_up(self) -> None:
        """Bring the sweep to all workers, let them compile, and learn how long a sample takes."""
        from fctd.sweep.plugin import Carrier, warm_up

        self.client.register_plugin(Carrier(self.runner), name=self.name)
        self.client.subscribe_topic(self.name, self.ended.put)
        addresses = list(self.client.nthreads())
        trials = [
            self.client.submit(warm_up, self.name, key=f"{self.name}-warm-{k}", workers=[address], pure=False,
                               allow_other_workers=True)
            for k, address in enumerate(addresses)
        ]  # fmt: skip
        times = self.client.gather(trials, errors="skip")
        self.workers = self.summary.workers = len(addresses)
        self.each = max((seconds for seconds in times if seconds > 0), default=float("nan"))

    def run(self) -> None:
        """Send chunks and take their rows until all samples have them."""
        self.began = self.written = time.perf_counter()
        looked = self.began
        while self.waiting or self.again or self.flying:
            while (self.waiting or self.again) and len(self.flying) < self._room:
                self._send(self._next_chunk())
            try:
                event = self.ended.get(timeout=PATIENCE)
            except Empty:
                event = None
            if event is not None:
                self._take(event)
            now = time.perf_counter()
            if now - looked > PATIENCE:
                looked = now
                if self.client.status != "running":
                    raise SchedulerLostError
                self.workers = max(worker_count(self.client), 1)
                self.summary.workers = max(self.summary.workers, self.workers)
            if now - self.written > PART:
                self._write()
        self._write()
        self.summary.wall = time.perf_counter() - self.began

    def finish(self) -> None:
        """Keep the rows that have come, and take back what has not."""
        if self.client.status == "running":
            with suppress(OSError, TimeoutError, CancelledError):
                self.client.cancel(list(self.flying))
        self._write()
        if not self.summary.wall:
            self.summary.wall = time.perf_counter() - self.began
        kept = asdict(self.summary) | {"share": self.summary.share}
        self.dataset.keep_run({key: None if value in (math.inf,) else value for key, value in kept.items()})

    @property
    def _room(self) -> int:
        """Most chunks at a time: one a worker while one of them may kill its worker, and those that wait there."""
        suspected = self.again or any(number in self.suspects for of in self.flying.values() for number in of)
        return self.workers * (1 if suspected else 1 + AHEAD)

    def _next_chunk(self) -> tuple[int, ...]:
        if self.again:
            return self.again.popleft()
        size = self._size()
        return tuple(self.waiting.popleft() for _ in range(min(size, len(self.waiting))))

    def _size(self) -> int:
        """Samples of the next chunk: fewer at the end, so that all workers end at the same time."""
        if not self.each > 0:
            return 1
        most = max(USUAL, PER_WORKER * self.workers) / self.each
        even = len(self.waiting) / (2 * self.workers)
        least = LEAST / self.each
        self.summary.samples_in_chunk = max(self.summary.samples_in_chunk, min(math.ceil(most), MOST_IN_CHUNK))
        return max(min(math.ceil(max(min(most, even), least)), MOST_IN_CHUNK), 1)

    def _send(self, numbers: tuple[int, ...]) -> None:
        from fctd.sweep.plugin import run_chunk

        samples = [sample_of(self.dataset.samples, number) for number in numbers]
        future = self.client.submit(run_chunk, self.name, samples, key=f"{self.name}-{next(self.numbers)}", pure=False)
        self.flying[future] = numbers
        future.add_done_callback(self.ended.put)

    def _take(self, event: Any) -> None:
        """A chunk has ended, or a worker says that a sample takes too long."""
        if isinstance(event, tuple):
            self._give_up(int(event[1]))
            return
        numbers = self.flying.pop(event, None)
        if numbers is None:  # taken back before
            return
        try:
            done = event.result(timeout=LOST)
        except (Exception, CancelledError) as error:
            if _lost(self.client, error) or isinstance(error, TimeoutError):
                raise SchedulerLostError from None
            if not _died(error):
                raise
            self._halve(numbers)
            return
        check_sources(done.sources, "a worker")  # one that came later has not been asked
        self.summary.chunks += 1
        self.summary.solving += done.solving
        self.summary.elapsed += done.elapsed
        if len(numbers) == self.summary.samples_in_chunk:
            self.summary.shortest = min(self.summary.shortest, done.elapsed)
        each = done.solving / len(numbers)
        self.each = each if math.isnan(self.each) else 0.9 * self.each + 0.1 * each
        self._keep(from_stream(done.rows), numbers)

    def _keep(self, table: pa.Table, numbers: Sequence[int]) -> None:
        assert self.taken.isdisjoint(numbers)
        self.taken.update(numbers)
        self.suspects.difference_update(numbers)
        self.tables.append(table)
        for status in table["status"].to_pylist():
            if status in NO_ROWS:
                self.summary.without_answer[status] = self.summary.without_answer.get(status, 0) + 1
        if self.progress is not None:
            self.progress(len(self.taken), self.summary.samples, sum(self.summary.without_answer.values()))

    def _give_up(self, sample: int) -> None:
        """A sample overruns its time; its worker is about to end."""
        for future, numbers in self.flying.items():
            if sample in numbers:
                del self.flying[future]
                future.cancel()
                limit = self.runner.time_limit
                self._without_answer(sample, TIMED_OUT, f"did not end within {limit:g} s; its worker was ended")
                others = tuple(number for number in numbers if number != sample)
                if others:
                    self.again.append(others)
                return

    def _halve(self, numbers: tuple[int, ...]) -> None:
        """A chunk's worker has died: by one of its samples, or by another chunk's, or for a reason of its own."""
        self.suspects.update(numbers)
        if len(numbers) > 1:
            middle = len(numbers) // 2
            self.again += [numbers[:middle], numbers[middle:]]
            return
        (sample,) = numbers
        self.deaths[sample] = self.deaths.get(sample, 0) + 1
        if self.deaths[sample] < DEATHS:
            self.again.append(numbers)
        else:
            reason = f"ended its worker {DEATHS} times: it crashed or needed too much memory"
            self._without_answer(sample, CRASHED, reason)

    def _without_answer(self, sample: int, status: str, reason: str) -> None:
        self._keep(as_table([{"sample": sample, **without_answer(status, reason)}]), [sample])

    def _write(self) -> None:
        if self.tables:
            began = time.perf_counter()
            tables, self.tables = self.tables, []
            self.dataset.write(tables)
            self.summary.rows += sum(len(table) for table in tables)
            self.summary.writing += time.perf_counter() - began
        self.written = time.perf_counter()


def _lost(client: Client, error: BaseException) -> bool:
    """Whether a call failed because the scheduler ended; a call that is under way may see that before the client."""
    from distributed.comm.core import CommClosedError

    return client.status != "running" or isinstance(error, CommClosedError)


def _died(error: BaseException) -> bool:
    """Whether a future failed because its worker ended."""
    from distributed.client import FutureCancelledError
    from distributed.scheduler import KilledWorker

    return isinstance(error, KilledWorker | FutureCancelledError | CancelledError)
