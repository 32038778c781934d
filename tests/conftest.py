"""Settings of every test."""

import functools
import gc
import sys

import hypothesis
import pytest
import typer.main

# The first call of a compiled function takes seconds, and CI must fail the same way twice.  Tests of text and files
# from outside, whose faults are rare, ask for Hypothesis' own 100 examples.
hypothesis.settings.register_profile("fctd", deadline=None, derandomize=True, max_examples=40)
hypothesis.settings.load_profile("fctd")

# A program builds its command line once and runs one command; the tests run hundreds.
typer.main.get_command = functools.cache(typer.main.get_command)


def pytest_sessionfinish() -> None:
    """The browser of all tests is open until the end."""
    if browsers := sys.modules.get("tests.browsers"):
        browsers.close()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long tests begin first: one that began last would run alone, beside idle processors."""
    items.sort(key=lambda item: -sum(mark.kwargs.get("seconds", 0) for mark in item.iter_markers("slow")))


def pytest_collection_finish() -> None:
    """What was imported stays: the garbage collector need not go through it again and again."""
    gc.collect()
    gc.freeze()
