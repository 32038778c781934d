"""Ctrl-C while a library of others computes: some catch what it raises, and go on."""

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from fctd.cli.interrupts import ENDING


@contextmanager
def remembering() -> Iterator[Callable[[], None]]:
    """Inside, Ctrl-C and the signals that end a program are remembered; yields what raises them once more.

    trimesh catches any exception around its optional parts, a KeyboardInterrupt too.  Does nothing outside the main
    thread.
    """
    seen: list[int] = []

    def again() -> None:
        if seen:
            seen.clear()
            raise KeyboardInterrupt

    if threading.current_thread() is not threading.main_thread():
        yield again
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, *ENDING)}
    handlers: dict[int, Callable[[int, FrameType | None], Any]] = {
        number: handler for number, handler in before.items() if callable(handler)
    }

    def remember(number: int, frame: FrameType | None) -> None:
        try:
            handlers[number](number, frame)
        except KeyboardInterrupt:
            seen.append(number)
            raise

    for number in handlers:
        signal.signal(number, remember)
    try:
        yield again
    finally:
        for number, handler in handlers.items():
            if signal.getsignal(number) is remember:
                signal.signal(number, handler)
