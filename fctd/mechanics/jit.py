"""How the engine's functions are compiled: three decorators that leave no option open.

numba lets a function that does not set ``fastmath``, ``error_model`` or ``forceinline`` take it from the caller that
happens to compile it first.  The same source then became other machine code, with other roundings, depending on
which command had run before.
"""

from collections.abc import Callable
from typing import Any

from numba import njit

from fctd.mechanics.compile_cache import STORE, KeptCode, Store

# Products and sums may be contracted into one instruction, which rounds once.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "forceinline": False}
# Expanded wherever they are called: LLVM cannot pack a loop with calls.
INLINED: Any = OPTIONS | {"forceinline": True}


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call."""
    return njit(**OPTIONS)(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function into every function that calls it."""
    return njit(**INLINED)(function)


def entry(function: Callable[..., Any], store: Store = STORE) -> Any:
    """Compile a function that Python calls, and keep it in a store on disk."""
    compiled: Any = njit(**OPTIONS)(function)
    if hasattr(compiled, "_cache"):  # a plain function has none (NUMBA_DISABLE_JIT)
        compiled._cache = KeptCode(function, store)
    return compiled
