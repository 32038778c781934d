"""Ctrl-C, and the signals with which a system or a closing terminal ends a program."""

import gc
import os
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


def listens() -> None:
    """From now on Ctrl-C is a KeyboardInterrupt: there is somebody who answers it."""
    if signal.getsignal(signal.SIGINT) == leave:
        signal.signal(signal.SIGINT, signal.default_int_handler)


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


def leave(number: int, frame: FrameType | None) -> None:
    """What Ctrl-C does before the commands begin: it ends the program with exit code 130."""
    sys.exit(130)


def is_fctd() -> bool:
    """Whether the program that runs is the command, not another one that imports the package."""
    command = os.path.splitext(os.path.basename(sys.argv[0]))[0] if sys.argv else ""
    return command == "fctd" or sys.orig_argv[1:3] == ["-m", "fctd"]


@contextmanager
def ends_program() -> Iterator[None]:
    """Inside, Ctrl-C, SIGTERM or SIGHUP end a program with exit code 130, without a traceback.

    It surrounds the imports, which take a second or two.  An interactive session gets KeyboardInterrupt and continues.
    For the command itself, Ctrl-C does so between two such blocks too, until it `listens`.
    The garbage collector rests meanwhile: what is imported stays, and a tenth of the time would go into looking
    through it.
    """
    if is_fctd() and signal.getsignal(signal.SIGINT) == signal.default_int_handler:
        signal.signal(signal.SIGINT, leave)
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
