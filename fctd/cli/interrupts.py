"""Ctrl-C, and the signals with which a system or a closing terminal ends a program."""

import atexit
import gc
import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Final

# Code that must not be left for a signal: Python drops what is raised in finalizers and in functions that C calls, some
# packages what is raised while they are imported, and the lock around calls to LLVM would stay taken.
FINALIZERS: Final = ("__del__", "weakref.py")
GUARDED: Final = ("<frozen importlib", f"{os.sep}llvmlite{os.sep}", os.path.join("numba", "core", "event.py"))
# Where the command lies that ``python -m fctd`` runs.
AS_MODULE: Final = os.path.join("fctd", "__main__.py")
# Signals beside Ctrl-C that end a program.
ENDING: Final = tuple(getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name))
# Time until a signal comes once more that such code has got [s].
PAUSE: Final = 0.02
_LATER: Final[list[tuple[int, Any]]] = []  # such a signal, and the handler of the alarm before it


@contextmanager
def as_interrupts() -> Iterator[None]:
    """Inside, SIGTERM and SIGHUP raise KeyboardInterrupt as Ctrl-C does, unless the caller ignores or handles them.

    Later ones are ignored: a terminal that closes sends several, and they must not stop the writing of the results
    after the first one.  A shell ignores Ctrl-C for what a script starts in the background; it stops a command there
    too, and the processes that the command starts, and what has been computed is kept.  No signal is lost: where the
    interrupted code would drop the exception, the signal comes once more a moment later.  Does nothing outside the main
    thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, *ENDING)}
    ours = [number for number in ENDING if before[number] in (signal.SIG_DFL, leave)]
    drops = sys.unraisablehook

    def interrupt(number: int, frame: FrameType | None) -> None:
        if _waits(number, frame):
            return
        if number in ours:
            for each in ours:
                signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    def dropped(what: "sys.UnraisableHookArgs") -> None:
        if not issubclass(what.exc_type, KeyboardInterrupt) or not _again(signal.SIGINT):
            drops(what)

    for number in ours:
        signal.signal(number, interrupt)
    if before[signal.SIGINT] in (signal.SIG_IGN, signal.default_int_handler, leave):
        signal.signal(signal.SIGINT, interrupt)
    sys.unraisablehook = dropped
    try:
        yield
    finally:
        sys.unraisablehook = drops
        for number in (signal.SIGINT, *ours):
            signal.signal(number, before[number])
        if _LATER:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, _LATER.pop()[1])
            _LATER.clear()
            raise KeyboardInterrupt


def _waits(number: int, frame: FrameType | None) -> bool:
    """Whether a signal has come to code that must not be left; it then comes once more."""
    while frame is not None:
        code = frame.f_code
        if (
            code.co_name in FINALIZERS
            or code.co_filename.endswith(FINALIZERS)
            or any(part in code.co_filename for part in GUARDED)
        ):
            return _again(number)
        frame = frame.f_back
    return False


def _again(number: int) -> bool:
    """Send this process a signal a moment later; False where the system cannot, or outside the main thread."""
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        return False
    if not _LATER:
        before = signal.getsignal(signal.SIGALRM)

        def send(_: int, frame: FrameType | None) -> None:
            signal.signal(signal.SIGALRM, before)
            first, _LATER[:] = _LATER[0][0], []
            signal.raise_signal(first)

        _LATER.append((number, before))  # before the alarm, which a busy machine may bring at once
        signal.signal(signal.SIGALRM, send)
        signal.setitimer(signal.ITIMER_REAL, PAUSE)
    return True


@contextmanager
def deferred() -> Iterator[None]:
    """Inside, Ctrl-C, SIGTERM and SIGHUP wait until the block has ended, so that results are written completely.

    Ignored signals stay ignored.  Does nothing outside the main thread.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    arrived: list[int] = []
    found = {number: signal.getsignal(number) for number in (signal.SIGINT, *ENDING)}
    handlers = {number: handler for number, handler in found.items() if callable(handler)}
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
    """What a signal does to the command between its blocks: it ends the program with exit code 130."""
    if not _waits(number, frame):
        sys.exit(130)


@contextmanager
def ends_at_once() -> Iterator[None]:
    """Inside, a program that exits ends without the end of Python.

    That takes from threads that still compute what they need, waits for those that never end, and lasts a second in
    which the system's answer to a signal would take the place of the exit code.
    """
    try:
        yield
    except SystemExit as ended:
        code = ended.code or 0
        if not isinstance(code, int):
            raise
        for number in (signal.SIGINT, *ENDING):
            signal.signal(number, signal.SIG_IGN)
        if code == 130:  # what was about to begin has no end of which to tell
            sys.unraisablehook = lambda _: None
        atexit._run_exitfuncs()
        for stream in (sys.stdout, sys.stderr):
            try:
                stream.flush()
            except (OSError, ValueError):  # a closed terminal, or a full disk, of which Python tells
                if code != 130:
                    raise ended from None
        os._exit(code)


def is_fctd() -> bool:
    """Whether the program that runs is the command or a worker of it, not another one that imports the package."""
    path = sys.argv[0] if sys.argv else ""
    command = os.path.splitext(os.path.basename(path))[0]
    # A worker has the arguments of its command.
    return command == "fctd" or sys.orig_argv[1:3] == ["-m", "fctd"] or path.endswith(AS_MODULE)


def is_worker() -> bool:
    """Whether another process of the program has started this one, and ends it."""
    processes = sys.modules.get("multiprocessing.process")  # a worker has imported it
    return processes is not None and processes.parent_process() is not None


@contextmanager
def ends_program() -> Iterator[None]:
    """Inside, Ctrl-C, SIGTERM or SIGHUP end a program with exit code 130, without a traceback.

    It surrounds the imports, which take a second or two.  An interactive session gets KeyboardInterrupt and continues.
    For the command itself they do so until it ends, between two such blocks too.
    The garbage collector rests meanwhile: what is imported stays, and a tenth of the time would go into looking
    through it.
    """
    if is_fctd():
        # Scripts start a command so that it ignores Ctrl-C, and commands their workers.
        keyboard = signal.getsignal(signal.SIGINT)
        if keyboard == signal.default_int_handler or (keyboard == signal.SIG_IGN and not is_worker()):
            signal.signal(signal.SIGINT, leave)
        for number in () if is_worker() else ENDING:
            if signal.getsignal(number) == signal.SIG_DFL:
                signal.signal(number, leave)
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
