"""Chunks: rows of samples, rows in place of failures, and the end of a process whose sample does not come back."""

import multiprocessing
import os
import threading
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from fctd.case.load import Case
from fctd.sweep import chunk, work
from fctd.sweep.chunk import FAILED, TIMED_OUT, SampleRunner, Watch, from_stream
from fctd.sweep.design import Sample
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from fctd.sweep.work import Row, Task, Tick
from tests.commands import HANG, exit_code
from validation.parts.small_sweep import sweep_file


@pytest.fixture
def runner(tmp_path: Path) -> SampleRunner:
    return prepare(read_sweep(sweep_file(tmp_path, 'method = "random"\nsamples = 4\ntime_limit = 300\n')))[0]


def sample(number: int, friction: float) -> Sample:
    return Sample(number, {"friction.open": friction, "mud.density": 1.1})


def samples(count: int) -> list[Sample]:
    return [sample(k, 0.2 + 0.01 * k) for k in range(count)]


def test_a_chunk_has_the_rows_of_its_samples(runner: SampleRunner) -> None:
    done = runner.run(samples(2), lambda number: None)
    table = from_stream(done.rows).to_pandas()
    assert done.samples == (0, 1)
    assert table["sample"].tolist() == [0] * 4 + [1] * 4
    assert table["bit_depth_m"].tolist() == [600, 700, 800, 900] * 2
    assert 0 < done.solving <= done.elapsed
    (first,) = [row for row in runner.rows_of(samples(1)[0]) if row["bit_depth_m"] == 600]
    assert table["hookload_N"].iloc[0] == first["hookload_N"]


def test_a_sample_that_no_case_can_have_is_a_row_with_its_reason(runner: SampleRunner) -> None:
    table = from_stream(runner.run([sample(3, -1.0), sample(4, 0.2)], lambda number: None).rows).to_pandas()
    assert table["status"].tolist() == [FAILED] + 4 * ["converged"]
    assert "a friction factor at least 0" in table["reason"].iloc[0]


@pytest.mark.parametrize(("raised", "status"), [("time", TIMED_OUT), ("defect", FAILED)])
def test_a_sample_without_an_answer_is_a_row(raised: str, status: str, runner: SampleRunner, monkeypatch: Any) -> None:
    def fail(case: Case, task: Task, tick: Tick) -> list[Row]:
        if raised == "defect":
            raise ZeroDivisionError("by nothing")
        end = time.monotonic() + HANG
        while time.monotonic() < end:
            tick()
        return []

    monkeypatch.setitem(work.WORK, "chart", fail)  # type: ignore[arg-type]
    quick = replace(runner, time_limit=0.05)
    (row,) = quick.rows_of(samples(1)[0])
    assert row["status"] == status
    assert ("0.05 s" if status == TIMED_OUT else "ZeroDivisionError: by nothing") in row["reason"]


def hang(sender: Any, holding: bool) -> None:
    """A sample that does not come back; holding : with Python's lock, as a defect of compiled code may."""
    import ctypes

    # A sleep of the C library, with or without the lock.
    sleep = (ctypes.PyDLL if holding else ctypes.CDLL)(None).sleep
    with Watch(0.3, 1.0 if holding else HANG, sender.send).watching() as watch:
        watch.begin(7)
        sleep(3600)


@pytest.mark.slow
@pytest.mark.parametrize("holding", [False, True])
def test_a_process_ends_over_a_sample_that_does_not_come_back(holding: bool) -> None:
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=hang, args=(sender, holding))
    process.start()
    assert exit_code(process) == 1
    assert receiver.poll() is not holding
    if not holding:
        assert receiver.recv() == 7


class Clock:
    """A clock that stands until the test moves it; the news of a sample leaves once ``left`` is set."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.now, self.ended = 0.0, list[int]()  # exit codes
        self.left, self._looked = threading.Event(), threading.Event()
        paused = SimpleNamespace(monotonic=self._look, sleep=lambda _: self.left.wait(HANG))
        monkeypatch.setattr(chunk, "time", paused)
        monkeypatch.setattr(chunk, "os", SimpleNamespace(_exit=self.ended.append, devnull=os.devnull))

    def _look(self) -> float:
        if threading.current_thread() is not threading.main_thread():
            self._looked.set()
        return self.now

    def looks(self) -> None:
        """Wait until the watch has looked at it again."""
        self._looked.clear()
        assert self._looked.wait(HANG)


def test_a_process_goes_on_where_the_sample_comes_back_meanwhile(monkeypatch: pytest.MonkeyPatch) -> None:
    """Just after the news of it has left."""
    clock, told = Clock(monkeypatch), threading.Event()
    with Watch(0.8, HANG, lambda _: told.set()).watching() as watch:
        watch.begin(7)
        clock.now = 1.0
        assert told.wait(HANG)
        watch.begin(8)
        clock.left.set()
        clock.looks()
        assert clock.ended == []
        told.clear()
        clock.now = 2.0  # the next does not come back
        assert told.wait(HANG)
        clock.looks()
        assert clock.ended[0] == 1


@pytest.mark.parametrize(("limit", "expected"), [(0.1, (2.0, 3.0)), (20.0, (40.0, 60.0))])
def test_a_process_may_take_twice_the_limit_of_a_sample_and_at_least_two_seconds(
    limit: float, expected: tuple[float, float], runner: SampleRunner, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And three times the limit where no thread of Python can run."""
    given: list[tuple[float, float]] = []

    class Recorded(Watch):
        def __init__(self, overrun: float, last: float, too_long: Any) -> None:
            given.append((overrun, last))
            super().__init__(overrun, last, too_long)

    monkeypatch.setattr(chunk, "Watch", Recorded)
    replace(runner, time_limit=limit).run([], lambda number: None)
    assert given == [expected]


def test_a_watch_leaves_samples_alone_that_end_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock, told = Clock(monkeypatch), list[int]()
    with Watch(0.4, HANG, told.append).watching() as watch:
        for number in range(8):
            watch.begin(number)
            clock.now += 0.3
            clock.looks()
    assert told == []
