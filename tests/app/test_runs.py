"""Runs that pages begin: two at most, stopped as Ctrl-C does, ended with their page."""

import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from fctd.app import runs as module
from fctd.app.runs import Runs, target_of
from fctd.app.sessions import Session, Sessions
from fctd.case.errors import InputError
from fctd.results.tables import open_result
from tests.app.made import SURVEY, TEXT
from tests.commands import until

# A run that waits for its end, without the seconds of importing the engine.
WAITING = """
import signal, sys, time
signal.signal(signal.SIGTERM, signal.default_int_handler)  # as fctd.cli.interrupts does
try:
    print("begun", flush=True)
    time.sleep(3600)
except KeyboardInterrupt:
    print("interrupted"); sys.exit(130)
"""


@pytest.fixture
def runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Runs]:
    monkeypatch.setattr(module, "command", lambda: [sys.executable, "-c", WAITING])
    found = Runs()
    yield found
    found.close()


def begin(runs: Runs, session: Session) -> None:
    runs.start(session, TEXT, "survey.csv", SURVEY)
    until(lambda: (session.folder / "run" / "log").read_text() == "begun\n")


def test_two_at_a_time_and_one_a_page(runs: Runs, tmp_path: Path) -> None:
    sessions = Sessions(tmp_path)
    first, second, third = (sessions.new() for _ in range(3))
    assert not runs.state(first)["began"]
    begin(runs, first)
    begin(runs, second)
    files = {path.name: path.stat().st_mode & 0o777 for path in (first.folder / "run").iterdir()}
    assert files == {"case.toml": 0o600, "survey.csv": 0o600, "log": 0o600}
    with pytest.raises(InputError, match="at most 2 runs"):
        runs.start(third, TEXT, "", b"")
    with pytest.raises(InputError, match="stop it first"):
        runs.start(first, TEXT, "", b"")
    assert runs.state(first)["running"]
    runs.stop(first)
    until(lambda: not runs.state(first)["running"])
    assert runs.state(first)["log"] == "begun\ninterrupted"
    begin(runs, third)
    begin_again = runs.state(second)
    assert begin_again["running"]


def test_the_run_of_a_closed_page_ends_and_that_of_a_page_that_asks_again_does_not(
    runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, stopped = [0.0], list[module.Run]()
    monkeypatch.setattr(module, "time", SimpleNamespace(monotonic=lambda: now[0]))
    stop = module.Run.stop
    monkeypatch.setattr(module.Run, "stop", lambda run: stopped.append(run) or stop(run))
    session = Sessions(tmp_path).new()
    begin(runs, session)
    runs.closed(session)
    assert runs.state(session)["running"]  # loaded again
    now[0] = 2 * module.CLOSED_FOR
    runs.look()
    assert not stopped
    runs.closed(session)
    now[0] += 2 * module.CLOSED_FOR
    runs.look()
    until(lambda: "interrupted" in (session.folder / "run" / "log").read_text())


def test_a_run_that_recorded_nothing_says_so(runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    session = Sessions(tmp_path).new()
    assert runs.state(session)["log"] == ""
    monkeypatch.setattr(module, "command", lambda: [sys.executable, "-c", ""])
    runs.start(session, TEXT, "survey.csv", SURVEY)
    until(lambda: not runs.state(session)["running"])
    assert runs.state(session)["log"] == "the run ended before anything was recorded"


def test_the_run_of_a_silent_page_ends(runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    session = Sessions(tmp_path).new()
    begin(runs, session)
    monkeypatch.setattr(module, "SILENT_FOR", 0.2)
    until(lambda: "interrupted" in (session.folder / "run" / "log").read_text())


@pytest.fixture
def background() -> Iterator[None]:
    """This process ignores Ctrl-C, as one that a script starts in the background, and those that it starts do too."""
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("background")
def test_a_run_streams_and_is_stopped_with_its_records_kept(tmp_path: Path) -> None:
    text = TEXT.replace('duration = "2 s"', 'duration = "1 h"')
    session, found = Sessions(tmp_path).new(), Runs()
    try:
        found.start(session, text, "survey.csv", SURVEY)
        until(lambda: found.state(session)["kept"] not in ("", "0", "0.0") or not found.state(session)["running"])
        state = found.state(session)
        assert 0 < state["share"] < 1, state
        other = Runs([session.folder])  # a server that was killed and started again
        assert other.state(session)["running"]
        other.stop(session)
        until(lambda: not other.state(session)["running"])
        other.close()
        result = open_result(target_of(session.folder))
        assert len(result.history)
        assert result.status == "interrupted"
    finally:
        found.close()
