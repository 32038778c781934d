"""What the machine code of a compiled function hangs on: sources and constants that it reaches.

numba does not notice an edit in a function that a cached function calls, nor another value of a constant.  A key for
each function that carries both keeps the code of all others after an edit.
"""

import hashlib
import sys
from collections.abc import Callable, Iterator
from functools import lru_cache
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np

# Their functions change with their versions, which the key of stored code carries.
_LIBRARIES = {*sys.stdlib_module_names, "numpy", "numba", "llvmlite", "scipy"}


def fingerprint(function: Callable[..., Any]) -> str:
    """Hash of the files of all functions and classes that a function reaches, and of the constants that they read."""
    files = {Path(__file__).with_name("jit.py")}  # which sets the options of all
    constants: set[tuple[str, bytes]] = set()
    _reach(function, files, constants, set())
    digest = hashlib.sha256()
    for data in sorted({_hash_of(path) for path in files}):
        digest.update(data)
    for name, value in sorted(constants):
        digest.update(name.encode() + b"\0" + value)
    return digest.hexdigest()


def _reach(function: Any, files: set[Path], constants: set[tuple[str, bytes]], seen: set[int]) -> None:
    if id(function) in seen:
        return
    seen.add(id(function))
    files.add(Path(function.__code__.co_filename))
    for name, value in _read_by(function):
        name = f"{function.__module__}.{name}"
        value = getattr(value, "py_func", value)  # of a compiled function
        home = str(getattr(value, "__module__", None) or "")
        if isinstance(value, ModuleType) or home.partition(".")[0] in _LIBRARIES:
            continue
        if isinstance(value, FunctionType):
            _reach(value, files, constants, seen)
        elif isinstance(value, type):
            files.add(Path(str(sys.modules[home].__file__)))
        elif isinstance(value, np.ndarray):
            constants.add((name, repr((value.dtype, value.shape)).encode() + value.tobytes()))
        else:
            constants.add((name, repr(value).encode()))


def _read_by(function: FunctionType) -> Iterator[tuple[str, Any]]:
    """Names and values of all that a function reads from outside; of a module, what it reads from that."""
    names = set(_names(function.__code__))
    cells = function.__closure__ or ()
    yield from zip(function.__code__.co_freevars, (cell.cell_contents for cell in cells), strict=True)
    for name in names:
        if name not in function.__globals__:
            continue
        value = function.__globals__[name]
        yield name, value
        if isinstance(value, ModuleType) and value.__name__.partition(".")[0] not in _LIBRARIES:
            yield from ((f"{name}.{inner}", getattr(value, inner)) for inner in names if hasattr(value, inner))


def _names(code: CodeType) -> Iterator[str]:
    yield from code.co_names
    for part in code.co_consts:
        if isinstance(part, CodeType):
            yield from _names(part)


@lru_cache
def _hash_of(path: Path) -> bytes:
    return hashlib.sha256(path.read_bytes()).digest()
