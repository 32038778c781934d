"""How the engine's functions are compiled: four decorators that set every option.

In numba a function that does not set ``fastmath``, ``error_model`` or ``forceinline`` takes it from the caller that
compiles it first.  The same source would then give different machine code, with different rounding, depending on
the command that ran before.

A library of machine code holds copies of all functions that its entry calls, each optimised beside that entry.  numba
gives the copies of one function one name, and whichever library is loaded first lends its copy to all others: numbers
would depend on what a process ran before, and on whether it compiled its code or read it.  A library of an entry
therefore keeps its copies to itself.

Packed loops use the widest registers of the processor.  For many of Intel's LLVM takes half of them, since other code
may run at a lower clock beside it; here the loops are all the work.
"""

from collections.abc import Callable
from typing import Any

from llvmlite import binding
from numba import njit
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler

from fctd.mechanics.compile_cache import STORE, KeptCode, Store

# Products and sums may be contracted into one instruction, which rounds once.
OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}, "forceinline": False}
# Expanded wherever they are called: LLVM cannot pack a loop with calls.
INLINED: Any = OPTIONS | {"forceinline": True}
# Every product and sum is rounded, as numpy does.
ROUNDED: Any = OPTIONS | {"fastmath": False}


# An attribute of a function in LLVM's language; llvmlite's own names leave it out.
WIDEST = '"prefer-vector-width"="512"'


class Library(JITCodeLibrary):
    """The library of a function, packed for the widest registers."""

    def add_ir_module(self, ir_module: Any) -> None:
        for function in ir_module.functions:
            if function.blocks:
                set.add(function.attributes, WIDEST)
        super().add_ir_module(ir_module)


class OwnCopies(Library):
    """The library of an entry, whose copies of other functions no other library sees."""

    def _finalize_final_module(self) -> None:
        # An entry that calls this one links the shared names, or it would hold the same function many times.
        self._shared_module = self._final_module.clone()
        relink(self._shared_module, binding.Linkage.external, binding.Linkage.linkonce_odr)
        relink(self._final_module, binding.Linkage.linkonce_odr, binding.Linkage.internal)
        super()._finalize_final_module()


def relink(module: binding.ModuleRef, old: binding.Linkage, new: binding.Linkage) -> None:
    """Give the functions that a module defines with an old linkage a new one."""
    for function in module.functions:
        if not function.is_declaration and function.linkage == old:
            function.linkage = new


class KernelCompiler(Compiler):
    """numba's compiler of one function, into a library of its own kind."""

    library: type[Library] = Library

    def _compile_bytecode(self) -> Any:
        self.state.library = self.library(self.state.targetctx.codegen(), self.state.func_id.func_qualname)
        self.state.library.enable_object_caching()
        return super()._compile_bytecode()


class EntryCompiler(KernelCompiler):
    """The compiler of a function that Python calls."""

    library = OwnCopies


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call."""
    return njit(**OPTIONS, pipeline_class=KernelCompiler)(function)


def inlined(function: Callable[..., Any]) -> Any:
    """Compile a function into every function that calls it."""
    return njit(**INLINED, pipeline_class=KernelCompiler)(function)


def rounded(function: Callable[..., Any]) -> Any:
    """Compile a function that other compiled functions call, with the rounding of numpy."""
    return njit(**ROUNDED, pipeline_class=KernelCompiler)(function)


def entry(function: Callable[..., Any], store: Store = STORE) -> Any:
    """Compile a function that Python calls, and keep its code in a store on disk.

    Other threads run while it does: what it writes to belongs to one thread.
    """
    compiled: Any = njit(**OPTIONS, nogil=True, pipeline_class=EntryCompiler)(function)
    if hasattr(compiled, "_cache"):  # a plain function has none (NUMBA_DISABLE_JIT)
        compiled._cache = kept = KeptCode(function, store)
        compiled.compile = _unlocking(compiled.compile, kept)
    return compiled


def _unlocking(compiling: Callable[..., Any], kept: KeptCode) -> Callable[..., Any]:
    """``compile`` of a dispatcher, which looks for stored code, compiles and stores; then no other process waits."""

    def compile(signature: Any) -> Any:
        try:
            return compiling(signature)
        finally:
            kept.unlock()

    return compile
