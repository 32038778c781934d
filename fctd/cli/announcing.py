"""The messages of all commands about compiling."""

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

from numba.core import event
from rich.console import Console

from fctd.cli.options import messages
from fctd.mechanics.compile_cache import WAITING, CompileCacheWarning, KeptCode


@contextmanager
def listening(report: Callable[[str], object], wait: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Inside, call ``report`` with the name of every cached function whose compilation begins.

    wait : called where another process compiles one, for which this one waits.
    """
    listener = _Listener(report, wait)
    with event.install_listener("numba:compile", listener), event.install_listener(WAITING, listener):
        yield


class _Listener(event.Listener):
    def __init__(self, report: Callable[[str], object], wait: Callable[[], object]) -> None:
        self._report, self._wait = report, wait

    def on_start(self, event: event.Event) -> None:
        if event.kind == WAITING:
            self._wait()
            return
        function = event.data["dispatcher"]
        if isinstance(function._cache, KeptCode):
            self._report(function.py_func.__name__)

    def on_end(self, event: event.Event) -> None:
        pass


@contextmanager
def announcing(messages: Console = messages) -> Iterator[None]:
    """Inside, print on standard error that functions are compiled, and every warning about the compile cache."""
    said = False

    def first(_: str = "") -> None:
        nonlocal said
        if not said and messages.is_terminal:
            messages.print("compiling, once for this version: about a minute", highlight=False)
        said = True

    others = warnings.showwarning

    def show(
        message: Warning | str, category: type[Warning], filename: str, lineno: int,
        file: TextIO | None = None, line: str | None = None,
    ) -> None:  # fmt: skip
        if issubclass(category, CompileCacheWarning):
            messages.print(f"warning: {message}", soft_wrap=True, highlight=False, markup=False)
        else:
            others(message, category, filename, lineno, file, line)

    warnings.showwarning = show
    try:
        with listening(first, wait=first):
            yield
    finally:
        warnings.showwarning = others
