"""The process that reads and solves: ``python -m fctd.app.worker FOLDER``, a request and an answer a line, as JSON.

It is warm before the first request: all that a steady string needs is compiled and loaded.  Then its memory gets a
limit; its time is limited by the process that asks (pool.py), which ends it.
"""

import base64
import json
import os
import sys
from collections import OrderedDict
from collections.abc import Callable
from pathlib import Path
from typing import Any, BinaryIO, Final

from numba.core import event

from fctd.app import downloads, well
from fctd.app.case_text import from_upload
from fctd.app.runs_view import records
from fctd.app.sessions import Source
from fctd.app.warm_up import warm_up
from fctd.case.errors import InputError
from fctd.case.systems import System
from fctd.case.text import printable_lines
from fctd.mechanics.compile_cache import WAITING, KeptCode

MOST_MEMORY: Final = 2**30  # bytes of addresses
KEPT_WELLS: Final = 12
Request = dict[str, Any]


class Wells:
    """The wells that were asked for last, by the digests of their sources."""

    def __init__(self, folder: Path) -> None:
        self.folder, self._wells = folder, OrderedDict[str, well.Well]()

    def get(self, request: Request) -> well.Well | None:
        """The well of a request; None where it names only the digest of a source that is not known."""
        digest, given = request["digest"], request.get("source")
        if digest not in self._wells:
            if given is None:
                return None
            source = Source(given["text"], given["name"], base64.b64decode(given["survey"]))
            self._wells[digest] = well.Well(source, self.folder, request["units"])
        self._wells.move_to_end(digest)
        while len(self._wells) > KEPT_WELLS:
            self._wells.popitem(last=False)
        return self._wells[digest]


def answer(wells: Wells, request: Request) -> dict[str, Any]:
    """The answer to a request: what it ``found``, why it was ``refused``, or that the source is ``unknown``."""
    try:
        do, given = request["do"], request.get("given", {})
        if do in OF_WELLS:
            of = wells.get(request)
            return {"unknown": True} if of is None else {"found": OF_WELLS[do](of, **given)}
        return {"found": OTHERS[do](wells.folder, **given)}
    except InputError as error:
        return {"refused": printable_lines(str(error))}
    except (MemoryError, RecursionError):
        return {"refused": f"it needs more memory than the {MOST_MEMORY >> 20} MiB that a case may take"}
    except Exception as error:  # a defect: the page says so and goes on
        return {"refused": f"fctd cannot work with this ({type(error).__name__}: {printable_lines(str(error))})"}


def new_case(folder: Path, name: str, survey: str, given_units: System) -> dict[str, str]:
    """The text of a case for an uploaded survey, and a note about it."""
    source, note = from_upload(name, base64.b64decode(survey), given_units, folder)
    return {"text": source.text, "note": note}


OF_WELLS: Final[dict[str, Callable[..., Any]]] = {
    "open": well.Well.opened,
    "solve": well.Well.solved,
    "text": downloads.text,
    "file": downloads.file,
    "measured": well.Well.check_measured,
}
OTHERS: Final[dict[str, Callable[..., Any]]] = {"new_case": new_case, "records": records}


def limit_memory(most: int) -> None:
    """Limit the addresses of this process, where the system can."""
    try:
        import resource
    except ImportError:  # Windows
        return
    hard = resource.getrlimit(resource.RLIMIT_AS)[1]
    most = most if hard == resource.RLIM_INFINITY else min(most, hard)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))


class _Compiling(event.Listener):
    """Says once that a function is compiled that is kept on disk, here or by another process."""

    def __init__(self, say: Callable[[dict[str, Any]], None]) -> None:
        self._say, self._said = say, False

    def on_start(self, event: event.Event) -> None:
        kept = event.kind == WAITING or isinstance(event.data["dispatcher"]._cache, KeptCode)
        if kept and not self._said:
            self._said = True
            self._say({"compiling": True})

    def on_end(self, event: event.Event) -> None:
        pass


def serve(folder: Path, asked: BinaryIO, answers: BinaryIO) -> None:
    """Answer requests until there are no more."""

    def say(content: dict[str, Any]) -> None:
        answers.write(json.dumps(content).encode() + b"\n")
        answers.flush()

    compiling = _Compiling(say)
    with event.install_listener("numba:compile", compiling), event.install_listener(WAITING, compiling):
        warm_up()
    limit_memory(MOST_MEMORY)
    say({"ready": True})
    wells = Wells(folder)
    for line in asked:
        say(answer(wells, json.loads(line)))


if __name__ == "__main__":
    channel = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what a library prints is no answer
    serve(Path(sys.argv[1]), sys.stdin.buffer, channel)
