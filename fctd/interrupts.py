"""Ctrl-C in the second or two that importing takes."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def ends_program() -> Iterator[None]:
    """Inside, Ctrl-C ends a program with exit code 130, as it does later, without a traceback.

    An interactive session gets its KeyboardInterrupt and goes on.
    """
    try:
        yield
    except KeyboardInterrupt:
        if hasattr(sys, "ps1"):
            raise
        sys.exit(130)
