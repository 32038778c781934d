"""What a worker does: chunks of samples, each sample within its time, and rows in place of answers that fail."""

from __future__ import annotations

import faulthandler
import os
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from fctd.case.errors import InputError
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.sweep.design import Sample
from fctd.sweep.template import Template
from fctd.sweep.work import WORK, Row, Task, TooLongError, begin_run

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pyarrow as pa

FAILED, TIMED_OUT, CRASHED = "failed", "timed_out", "crashed"
NO_ROWS = (FAILED, TIMED_OUT, CRASHED)
"""Statuses of samples without an answer, each a row with its ``reason``."""
# Times the limit of a sample after which its process is ended: by a thread of Python, and where that cannot run, too.
OVERRUN, LAST = 2.0, 3.0
# A limit below this [s] ends no process: a sample looks at the clock itself, and says that its time was up.
BRIEF = 1.0
# Pause between two looks at the clock of a sample [s], and before the end of a process, in which the news leaves it.
LOOK, LEAVE = 0.05, 0.3


class ChunkResult(NamedTuple):
    """A chunk's rows as an Arrow stream, with the time that its samples took and that of the chunk [s].

    sources : hash of those of the program that computed them; none of a program that is too old to say.
    """

    samples: tuple[int, ...]
    rows: bytes
    solving: float
    elapsed: float
    sources: str = ""


@dataclass(frozen=True)
class SampleRunner:
    """Makes the rows of a sweep's samples, on any worker; time_limit [s] : of a sample."""

    template: Template
    task: Task
    time_limit: float

    def rows_of(self, sample: Sample) -> list[Row]:
        """The rows of a sample; one row with its reason where it fails."""
        end = time.monotonic() + self.time_limit

        def tick() -> None:
            if time.monotonic() > end:
                raise TooLongError

        try:
            case = self.template.case(*sample)
            rows = WORK[self.task.spec.kind](case, self.task, tick)
        except TooLongError:
            rows = [without_answer(TIMED_OUT, f"more than {self.time_limit:g} s")]
        except InputError as error:
            rows = [without_answer(FAILED, str(error))]
        except Exception as error:  # a sample is a row, also where the program has a defect
            rows = [without_answer(FAILED, f"{type(error).__name__}: {error}")]
        return [{"sample": sample.number, **row} for row in rows]

    def warm_up(self) -> float:
        """Compile and import what samples need; returns how long one takes [s], NaN for work that is too long to try.

        It works on the sweep's case itself, as no sample's clock may count it, and no sample may end the process.
        """
        case, spec = self.template.base, self.task.spec
        try:
            if spec.kind == "simulate":
                begin_run(case)
                return float("nan")
            if spec.kind == "refine":
                replace(self, task=replace(self.task, spec=spec.model_copy(update={"kind": "equilibrium"}))).warm_up()
                return float("nan")
            took = float("nan")
            for _ in range(2):  # the first compiles and imports
                began = time.perf_counter()
                as_stream(WORK[spec.kind](case, self.task, lambda: None))
                took = time.perf_counter() - began
            return took
        except InputError:  # as of a case that only its samples complete
            return float("nan")

    def run(self, samples: Sequence[Sample], too_long: Callable[[int], None]) -> ChunkResult:
        """The rows of samples; too_long : called with a sample's number before this process ends over it."""
        began, rows, solving = time.perf_counter(), list[Row](), 0.0
        limit = max(self.time_limit, BRIEF)
        with Watch(OVERRUN * limit, LAST * limit, too_long).watching() as watch:
            for sample in samples:
                watch.begin(sample.number)
                start = time.perf_counter()
                rows += self.rows_of(sample)
                solving += time.perf_counter() - start
        stream = as_stream(rows)
        elapsed = time.perf_counter() - began
        return ChunkResult(tuple(s.number for s in samples), stream, solving, elapsed, hash_of_sources())


def without_answer(status: str, reason: str) -> Row:
    """The row of a sample without an answer."""
    return {"status": status, "reason": reason}


class Watch:
    """Ends this process where a sample does not come back: compiled code cannot be interrupted in another way.

    A thread tells which sample it was and ends the process after ``overrun`` [s].  Code that keeps Python's lock keeps
    that thread from running, too; then the interpreter's own watchdog ends the process after ``last`` [s].
    """

    def __init__(self, overrun: float, last: float, too_long: Callable[[int], None]) -> None:
        self._overrun, self._last, self._too_long = overrun, last, too_long
        self._sample, self._began, self._armed = -1, 0.0, -float("inf")
        self._ended = threading.Event()

    @contextmanager
    def watching(self) -> Iterator[Watch]:
        """Watch the samples that begin inside."""
        thread = threading.Thread(target=self._look, name="fctd-watch", daemon=True)
        with open(os.devnull, "w") as nowhere:
            self._nowhere: Any = nowhere
            thread.start()
            try:
                yield self
            finally:
                self._ended.set()
                faulthandler.cancel_dump_traceback_later()
        thread.join()

    def begin(self, sample: int) -> None:
        """A sample begins."""
        self._sample, self._began = sample, time.monotonic()
        # The watchdog is a thread of its own each time: it is set anew only where a sixth of its time has gone.
        if self._began - self._armed > self._last / 6:
            faulthandler.dump_traceback_later(self._last, exit=True, file=self._nowhere)
            self._armed = self._began

    def _look(self) -> None:
        while not self._ended.wait(min(LOOK, 0.1 * self._overrun)):
            sample, began = self._sample, self._began
            if sample >= 0 and time.monotonic() - began > self._overrun:
                self._too_long(sample)
                time.sleep(LEAVE)
                if not self._ended.is_set() and self._sample == sample:
                    os._exit(1)


def as_table(rows: Sequence[Mapping[str, Any]]) -> pa.Table:
    """Rows as an Arrow table, whose columns are those of all rows."""
    import pyarrow as pa

    names = dict.fromkeys(name for row in rows for name in row)
    return pa.table({name: [row.get(name) for row in rows] for name in names})


def as_stream(rows: Sequence[Mapping[str, Any]]) -> bytes:
    """Rows as an Arrow stream."""
    import pyarrow as pa

    table, sink = as_table(rows), pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table)
    return bytes(sink.getvalue())


def from_stream(stream: bytes) -> pa.Table:
    """The table of an Arrow stream."""
    import pyarrow as pa

    return pa.ipc.open_stream(stream).read_all()
