"""The processes that read and solve (worker.py), kept warm: who asks gets an answer, a refusal, or an end in time."""

import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from fctd.app.home import private_folder
from fctd.app.sessions import Source
from fctd.case.errors import InputError
from fctd.results.unit_systems import System

LONGEST: Final = 20.0  # of reading and solving [s]
WORKERS: Final = 2  # so that a file that takes its time holds up no other
TRIES: Final = 2  # processes for a request
SMALLER: Final = "a smaller survey or fewer segments if this case needs too much memory"
PATIENCE: Final = 300.0  # until a process is free [s]: the first ones compile
# Memory that a library reserves for each of its threads would count as used.
FEW_THREADS: Final = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MALLOC_ARENA_MAX": "2"}
ARROW: Final = {"ARROW_DEFAULT_MEMORY_POOL": "system"}


class Worker:
    """A process of worker.py, from its start until ``end``.

    known : digests of the sources that it has been given.
    """

    def __init__(self, folder: Path) -> None:
        self.folder, self.known = folder, set[str]()
        self.compiling = False
        # A group of its own: Ctrl-C in the terminal is for the process that serves, which ends this one.
        self._process: subprocess.Popen[bytes] = subprocess.Popen(
            command_of(folder), stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=os.environ | FEW_THREADS | ARROW,
            start_new_session=os.name == "posix", umask=0o077 if os.name == "posix" else -1,
        )  # fmt: skip

    def wait(self) -> bool:
        """Wait until it is warm; whether it is."""
        while line := self._read():
            if "ready" in line:
                return True
            self.compiling = True
        return False

    def ask(self, request: dict[str, Any], seconds: float) -> dict[str, Any] | None:
        """The answer to a request; None where it took longer, or the process has died, which then has ended."""
        timer = threading.Timer(seconds, self._process.kill)
        timer.start()
        try:
            assert self._process.stdin is not None
            self._process.stdin.write(json.dumps(request).encode() + b"\n")
            self._process.stdin.flush()
            found = self._read()
        except OSError:  # a closed pipe
            found = {}
        finally:
            timer.cancel()
        if not found:
            self.end()
            return None
        return found

    @property
    def ended(self) -> bool:
        """Whether the process has ended by itself, or by another's hand."""
        return self._process.poll() is not None

    def end(self) -> None:
        """End the process."""
        self._process.kill()
        for pipe in (self._process.stdin, self._process.stdout):
            assert pipe is not None
            with suppress(OSError):  # what could not be written any more
                pipe.close()
        self._process.wait()

    def _read(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        try:
            found: dict[str, Any] = json.loads(self._process.stdout.readline() or b"{}")
        except (OSError, ValueError):
            return {}
        return found


def command_of(folder: Path) -> list[str]:
    """The command of a process whose scratch files lie in a folder.

    It takes no module from the folder in which it starts, such as that of the user's state, which has one named fctd.
    """
    return [sys.executable, "-P", "-m", "fctd.app.worker", str(folder)]


class Pool:
    """Processes for requests; their scratch files lie below ``folder``, which this program has for itself.

    longest : of an answer [s], by default LONGEST.
    """

    def __init__(self, folder: Path, size: int = WORKERS, longest: float | None = None) -> None:
        self.folder, self.longest = folder / "work", LONGEST if longest is None else longest
        shutil.rmtree(self.folder, ignore_errors=True)  # of a program that was killed
        private_folder(self.folder)
        self._free: list[Worker] = []
        self._all: list[Worker] = []
        self._change, self._closed, self._warm = threading.Condition(), False, False
        self.trouble = ""  # why there is no process at all
        for _ in range(size):
            self._add()

    @property
    def note(self) -> str:
        """What there is to say while no process is warm, and empty afterwards."""
        with self._change:
            if self.trouble or self._warm:
                return self.trouble
            if any(worker.compiling for worker in self._all):
                return "compiling, once for this version of fctd: about a minute"
            return "starting"

    def ask(self, do: str, source: Source | None = None, units: System = "si", **given: Any) -> Any:
        """What a process answers.

        source : of a request about a well.  Raises InputError for what it refuses, and where it takes too long or too
        much memory.
        """
        digest = "" if source is None else source.digest
        request: dict[str, Any] = {"do": do, "digest": digest, "units": units, "given": given}
        why = ""
        for _ in range(TRIES):  # a process that ends may have been killed for another's sake
            worker = self._take(digest)
            began = time.monotonic()
            found = worker.ask(request, self.longest)
            if found is not None and "unknown" in found and source is not None:
                content = {"text": source.text, "name": source.survey_name}
                content["survey"] = base64.b64encode(source.survey).decode()
                found = worker.ask(request | {"source": content}, self.longest)
            if found is not None:
                break
            self._replace(worker)
            if time.monotonic() - began >= self.longest:
                why = f"this case takes longer than {self.longest:g} s: a smaller survey, or fewer segments"
                break
        if found is None:
            raise RefusedError(why or f"the process that computes was ended {TRIES} times: try again, or {SMALLER}")
        worker.known.add(digest)
        self._give(worker)
        if "refused" in found:
            raise RefusedError(found["refused"])
        return found["found"]

    def close(self) -> None:
        """End all processes."""
        with self._change:
            self._closed = True
            workers, self._all, self._free = self._all, [], []
            self._change.notify_all()
        for worker in workers:
            worker.end()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _add(self) -> None:
        """Start a process, which is free once it is warm."""
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        worker = Worker(folder)
        self._all.append(worker)

        def warm() -> None:
            ready = worker.wait()
            with self._change:
                if ready and not self._closed:
                    self._free.append(worker)
                    self._warm = True
                elif worker in self._all:
                    self._all.remove(worker)
                    worker.end()
                    if not self._all:
                        self.trouble = "the process that computes does not start; the terminal says why"
                self._change.notify_all()

        threading.Thread(target=warm, daemon=True).start()

    def _take(self, digest: str) -> Worker:
        """A free process, one that knows the source where there is one."""
        with self._change:
            if not self._change.wait_for(lambda: self._free or self._closed or self.trouble, PATIENCE) or (
                not self._free
            ):
                raise RefusedError(self.trouble or "the process that computes is not free")
            worker = next((free for free in self._free if digest in free.known), self._free[0])
            self._free.remove(worker)
        if worker.ended:  # while it waited
            self._replace(worker)
            return self._take(digest)
        return worker

    def _give(self, worker: Worker) -> None:
        with self._change:
            if not self._closed:
                self._free.append(worker)
            self._change.notify()

    def _replace(self, worker: Worker) -> None:
        worker.end()
        shutil.rmtree(worker.folder, ignore_errors=True)
        with self._change:
            if worker in self._all:
                self._all.remove(worker)
            if not self._closed:
                self._add()


class RefusedError(InputError):
    """A refusal in words that are complete."""

    def __str__(self) -> str:
        return self.expected
