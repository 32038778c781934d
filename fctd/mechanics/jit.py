"""How the engine's functions are compiled: four decorators that set every option.

In numba a function that does not set ``fastmath``, ``error_model`` or ``forceinline`` takes it from the caller that
compiles it first.  The same source would then give different machine code, with different rounding, depending on
the command that ran before.
"""

from collections.abc import Callable
from typing import Any

from numba import njit

from fctd.mechanics.compile_cache import STORE, KeptCode, Store

# Products and sums may be contracted into one instruction, which rounds once.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "forceinline": False}
# Expanded wherever they are called: LLVM cannot pack a loop with calls.
INLINED: Any = OPTIONS | {"forceinline": True}
# Every product and sum is rounded, as numpy does.
ROUNDED: Any = OPTIONS | {"fastmath": False}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call."""
    return njit(**OPTIONS)(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function into every function that calls it."""
    return njit(**INLINED)(function)


def rounded(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call, with the rounding of numpy."""
    return njit(**ROUNDED)(function)


def entry(function: Callable[..., Any], store: Store = STORE) -> Any:
    """Compile a function that Python calls, and keep its code in a store on disk.

    Other threads run while it does: what it writes to belongs to one thread.
    """
    compiled: Any = njit(**OPTIONS, nogil=True)(function)
    if hasattr(compiled, "_cache"):  # a plain function has none (NUMBA_DISABLE_JIT)
        compiled._cache = KeptCode(function, store)
    return compiled
