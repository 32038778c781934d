"""Compiled code that outlives a test: that of the engine's inner functions, and of two small ones."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from fctd.mechanics import jit
from fctd.mechanics.compile_cache import Store


def kept(function: Any) -> Any:
    """An inner function of the engine for calls from Python, with its code kept on disk as that of an entry is.

    Inner functions are compiled into the entries that call them, so that Python would compile them in every run.
    """
    return jit.entry(getattr(function, "py_func", function))  # a plain function has none (NUMBA_DISABLE_JIT)


def twice(x):
    return 2 * x


def thrice(x):
    return 3 * x


def store_of_one(folder: Path) -> Store:
    """A store in a folder, which holds the compiled code of ``twice``."""
    folder.chmod(0o700)
    store = Store(folder)
    assert jit.entry(twice, store)(1.5) == 3.0
    return store


def hits(store: Store, function: Callable[..., Any], expected: float) -> int:
    """How often the code of ``function`` is found in the store by a new process's first call."""
    fresh = jit.entry(function, store)
    assert fresh(1.5) == expected
    return sum(fresh.stats.cache_hits.values())
