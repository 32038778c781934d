"""Runs in time that pages have begun: each is a process of ``fctd simulate`` in the folder of its session."""

import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from fctd.app.home import PRIVATE, private_folder
from fctd.app.sessions import Session
from fctd.case.errors import InputError
from fctd.store.run_folder import progress_of, writer_of
from fctd.store.whole_file import write_whole

MOST_RUNS: Final = 2  # at a time
LONGEST: Final = "1 h"
MEMORY: Final = "1 GiB"
KEPT_EVERY: Final = "1 s"
# A page that is loaded again asks within this time [s]; one that is hidden asks once a minute.
CLOSED_FOR, SILENT_FOR = 5.0, 180.0
LOG_LINES: Final = 8
NOTHING: Final = "the run ended before anything was recorded"


class Run:
    """A process, its own or one that an earlier server has begun; seen, closed : when its page asked, or said so."""

    def __init__(self, folder: Path, process: "subprocess.Popen[bytes] | None" = None) -> None:
        self.folder, self.process = folder, process
        self.seen, self.closed = time.monotonic(), float("inf")

    @property
    def number(self) -> int | None:
        """The number of the process, None once it has ended."""
        if self.process is not None:
            return self.process.pid if self.process.poll() is None else None
        holder = writer_of(target_of(self.folder))
        return None if holder is None else holder.process or None

    def stop(self) -> None:
        """End it as Ctrl-C does: what it has recorded is written."""
        number = self.number
        if number is not None:
            with suppress(OSError):
                os.kill(number, signal.SIGTERM)  # Ctrl-C is ignored until its imports begin, where this process does


class Runs:
    """The runs of all sessions; those that an earlier server has left are gone on with."""

    def __init__(self, folders: Iterable[Path] = ()) -> None:
        self._runs = {path.name: Run(path) for path in folders if writer_of(target_of(path)) is not None}
        self._lock, self._ended = threading.Lock(), threading.Event()
        threading.Thread(target=self._watch, daemon=True).start()

    def start(self, session: Session, text: str, survey_name: str, survey: bytes) -> None:
        """Begin a run of a case; text : that names ``survey_name`` as its survey.

        Raises InputError while the session has a run, and where ``MOST_RUNS`` others run.
        """
        with self._lock:
            running = self._going()
            if session.key in running:
                raise InputError("a page without a run: stop it first, or wait for its end")
            if len(running) >= MOST_RUNS:
                raise InputError(f"at most {MOST_RUNS} runs at a time: stop one on another page")
            folder = session.folder / "run"
            shutil.rmtree(folder, ignore_errors=True)
            private_folder(folder)
            write_whole(folder / "case.toml", text.encode(), mode=PRIVATE)
            if survey_name:
                write_whole(folder / survey_name, survey, mode=PRIVATE)
            with open(os.open(folder / "log", os.O_WRONLY | os.O_CREAT, PRIVATE), "wb") as log:
                process = subprocess.Popen(
                    command(), cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                    start_new_session=os.name == "posix", umask=0o077 if os.name == "posix" else -1,
                )  # fmt: skip
            self._runs[session.key] = Run(session.folder, process)

    def running(self) -> set[str]:
        """The keys of the sessions whose run goes on."""
        with self._lock:
            return self._going()

    def _going(self) -> set[str]:
        return {key for key, run in self._runs.items() if run.number is not None}

    def state(self, session: Session) -> dict[str, Any]:
        """Whether a session's run goes on, how far it is, and what its process has said; its page asks."""
        with self._lock:
            run = self._runs.get(session.key)
            if run is not None:
                run.seen, run.closed = time.monotonic(), float("inf")
        target = target_of(session.folder)
        going = run is not None and run.number is not None
        began, progress = (session.folder / "run").is_dir(), progress_of(target)
        # A word that changes when there is something new to show.
        kept = str(progress.kept) if progress else "result" if (target / "history.parquet").exists() else ""
        log = "" if going or not began else _tail(session.folder / "run" / "log") or NOTHING
        share = progress.done / progress.total if going and progress and progress.total > 0 else 0.0
        return {"running": going, "share": share, "began": began, "kept": kept, "log": log}

    def stop(self, session: Session) -> None:
        """Stop a session's run."""
        with self._lock:
            run = self._runs.get(session.key)
        if run is not None:
            run.stop()

    def closed(self, session: Session) -> None:
        """A page of the session was closed, or is loaded again."""
        with self._lock:
            if session.key in self._runs:
                self._runs[session.key].closed = time.monotonic()

    def close(self) -> None:
        """Stop all runs and wait for them."""
        self._ended.set()
        runs = list(self._runs.values())
        for run in runs:
            run.stop()
        for run in runs:
            if run.process is not None:
                try:
                    run.process.wait(30)
                except subprocess.TimeoutExpired:
                    run.process.kill()
                    run.process.wait()

    def _watch(self) -> None:
        while not self._ended.wait(1.0):
            self.look()

    def look(self) -> None:
        """Stop the runs whose pages were closed or are silent."""
        with self._lock:
            runs = list(self._runs.values())
        now = time.monotonic()
        for run in runs:
            if now - run.closed > CLOSED_FOR or now - run.seen > SILENT_FOR:
                run.stop()
                run.seen, run.closed = now, float("inf")


def command() -> list[str]:
    """The command of a run, in the folder of its case."""
    return [
        sys.executable, "-P", "-m", "fctd", "simulate", "case.toml", "--out", "result", "--quiet", "--restart",
        "--checkpoint-every", KEPT_EVERY, "--time-limit", LONGEST, "--memory-limit", MEMORY,
    ]  # fmt: skip


def target_of(folder: Path) -> Path:
    """Where the result of a session's run lies."""
    return folder / "run" / "result"


def _tail(path: Path) -> str:
    """The last lines of what a process has printed."""
    try:
        lines = path.read_text("utf-8", "replace").splitlines()
    except OSError:
        return ""
    return "\n".join(lines[-LOG_LINES:])
