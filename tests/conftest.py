"""Settings of every test."""

import functools
import gc
import signal
import sys
from collections.abc import Generator

import hypothesis
import pytest
import typer.main

# The first call of a compiled function takes seconds, and CI must fail the same way twice.  Tests of text and files
# from outside, whose faults are rare, ask for Hypothesis' own 100 examples.
hypothesis.settings.register_profile("fctd", deadline=None, derandomize=True, max_examples=40)
hypothesis.settings.load_profile("fctd")

# A program builds its command line once and runs one command; the tests run hundreds.
typer.main.get_command = functools.cache(typer.main.get_command)


def pytest_configure() -> None:
    """A shell ignores Ctrl-C for what it starts in the background, and nohup the end of a terminal: tests do not."""
    for name, usual in {"SIGINT": signal.default_int_handler, "SIGHUP": signal.SIG_DFL}.items():
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, usual)


def pytest_sessionfinish() -> None:
    """The browser of all tests is open until the end."""
    if browsers := sys.modules.get("tests.browsers"):
        browsers.close()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests begin first: one that began last would run alone, beside idle processors."""
    items.sort(key=lambda item: -sum(mark.kwargs.get("seconds", 0) for mark in item.iter_markers("slow")))


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, object, object]:
    """What is imported stays: the garbage collector need not go through it again and again."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()
