"""Work in several processes: studies that time nothing run side by side, and so do the parts of one of them."""

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from functools import partial
from multiprocessing import active_children, get_all_start_methods, get_context
from pathlib import Path
from typing import Any

from fctd.store.limits import cores
from validation.harness import files
from validation.harness.study import A, T

LOOK = 0.5  # [s] between two looks whether the first process is there
# What the processes of ``each`` call: they are copies of this one, and need not be sent it.
_CALLED: list[Callable[[Any], Any]] = []


def workers() -> int:
    """As many processes as this one may use processors; 1 where a process cannot be copied, as on Windows."""
    return cores() if "fork" in get_all_start_methods() else 1


def each(function: Callable[[A], T], arguments: Sequence[A], processes: int) -> Iterator[T]:
    """The results of a function for each argument, as they become ready; where it is left before, all end."""
    _CALLED.append(function)
    others = set(active_children())
    try:
        with ProcessPoolExecutor(processes, get_context("fork"), _begin, (os.getpid(),)) as pool:
            try:
                for ready in as_completed([pool.submit(_call, argument) for argument in arguments]):
                    yield ready.result()
            except BaseException:
                for process in set(active_children()) - others:
                    process.terminate()
                raise
    finally:
        _CALLED.pop()


def _call(argument: Any) -> Any:
    return _CALLED[-1](argument)


def _begin(parent: int) -> None:
    """What a process does first: the one that began it answers Ctrl-C, which reaches every process of a terminal, and
    ends it; where that one has been killed, it ends too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # a copy has the handlers of the first one

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(LOOK)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def apart(function: Callable[[A], T], arguments: Sequence[A]) -> list[T]:
    """The results of a function for each argument, in their order; see ``validation.harness.study.Apart``.

    In fresh processes: this one may have threads, which a copy would lack.
    """
    count = min(workers(), len(arguments))
    with ProcessPoolExecutor(count, get_context("spawn"), _begin, (os.getpid(),)) as pool:
        found = list(pool.map(partial(_reading, files.watched(), function), arguments))
    for _, read in found:
        files.also_read(read)
    return [result for result, _ in found]


def _reading(folders: tuple[Path, ...], function: Callable[[A], T], argument: A) -> tuple[T, dict[Path, str]]:
    """The result of a function, and what it has read."""
    with files.reading(*folders) as read:
        return function(argument), read.files
