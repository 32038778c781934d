"""Ctrl-C, and the signals with which a system or a closing terminal ends a program."""

import gc
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


@contextmanager
def as_interrupts() -> Iterator[None]:
    """Inside, SIGTERM and SIGHUP raise KeyboardInterrupt as Ctrl-C does, unless the caller ignores or handles them.

    Later ones are ignored: a terminal that closes sends several, and they must not stop the writing of the results
    after the first one.  A shell ignores Ctrl-C for what a script starts in the background; it stops a command there
    too, and the processes that the command starts, and what has been computed is kept.  Does nothing outside the main
    thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
    ours = [number for number in numbers if signal.getsignal(number) == signal.SIG_DFL]

    def interrupt(number: int, frame: FrameType | None) -> None:
        for each in ours:
            signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    for number in ours:
        signal.signal(number, interrupt)
    ignored = signal.getsignal(signal.SIGINT) == signal.SIG_IGN
    if ignored:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        if ignored:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        for number in ours:
            signal.signal(number, signal.SIG_DFL)


@contextmanager
def deferred() -> Iterator[None]:
    """Inside, Ctrl-C, SIGTERM and SIGHUP wait until the block has ended, so that results are written completely.

    Ignored signals stay ignored.  Does nothing outside the main thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    arrived: list[int] = []
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    handlers = {number: signal.getsignal(number) for number in numbers if callable(signal.getsignal(number))}
    for number in handlers:
        signal.signal(number, lambda number, _: arrived.append(number))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        for number in arrived:
            signal.raise_signal(number)


@contextmanager
def ends_program() -> Iterator[None]:
    """Inside, Ctrl-C, SIGTERM or SIGHUP end a program with exit code 130, without a traceback.

    It surrounds the imports, which take a second or two.  An interactive session gets KeyboardInterrupt and continues.
    The garbage collector rests meanwhile: what is imported stays, and a tenth of the time would go into looking
    through it.
    """
    collecting = gc.isenabled()
    gc.disable()
    try:
        with as_interrupts():
            yield
    except KeyboardInterrupt:
        if hasattr(sys, "ps1"):
            raise
        sys.exit(130)
    finally:
        if collecting:
            gc.enable()
