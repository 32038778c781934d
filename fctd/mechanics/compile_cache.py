"""The cache of compiled code on disk: its folder, who may write to it, and the check of every file.

Compiled code that is read is also run.  The folder and its files must therefore belong to this user, and no other user
may write to them.  Every file begins with a hash of its name and contents: numba's own cache stores no hash, and a
damaged file crashes the program there.
"""

import atexit
import hashlib
import os
import pickle
import shutil
import stat
import sys
import tempfile
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy as np
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature

from fctd.mechanics.fingerprint import fingerprint

CODE = "code"  # the folder, below that of fctd in the user's cache
HASH_SIZE = hashlib.sha256().digest_size


class CompileCacheWarning(RuntimeWarning):
    """Compiled code could not be stored on disk, or a stored file was unusable and is compiled again."""


class Store:
    """The folder of compiled code, None where code is kept in memory only; lasting : whether it outlives this run."""

    def __init__(self, folder: Path | None, trouble: str = "") -> None:
        self.folder = folder
        self.lasting = not trouble
        self._trouble = trouble  # reported when the first function is compiled

    def read(self, name: str) -> bytes | None:
        """The data stored under a name; None where there is none or its file is unusable."""
        if self._trouble:
            _warn(self._trouble)
            self._trouble = ""
        if self.folder is None:
            return None
        path = self.folder / name
        try:
            with path.open("rb") as file:
                exposed = _exposed(os.fstat(file.fileno()))
                data = file.read()
        except FileNotFoundError:
            return None
        except OSError as error:
            wrong = f"cannot be read ({error.strerror})"
        else:
            if exposed:
                wrong = exposed
            elif data[:HASH_SIZE] == _hash(name, data[HASH_SIZE:]):
                return data[HASH_SIZE:]
            else:
                wrong = "is damaged"
        _warn(f"compiled code in {path} {wrong}: it is compiled again and replaced")
        with suppress(OSError):
            if path.is_dir():  # a file is replaced, a folder cannot be
                shutil.rmtree(path)
        return None

    def write(self, name: str, data: bytes) -> None:
        """Store data under a name, completely or not at all; after the first failure nothing is stored any more."""
        if self.folder is None:
            return
        scratch = None
        try:
            handle, scratch = tempfile.mkstemp(prefix=".", dir=self.folder)  # readable by this user alone
            with open(handle, "wb") as file:
                file.write(_hash(name, data) + data)
            os.replace(scratch, self.folder / name)
        except OSError as error:
            _warn(f"compiled code cannot be kept in {self.folder} ({error.strerror}): it is kept for this run only")
            self.folder, self.lasting = None, False
        finally:
            if scratch is not None:
                with suppress(OSError):  # it no longer exists once it is renamed to the file
                    os.unlink(scratch)


def open_store() -> Store:
    """The user's folder for compiled code, or the one that NUMBA_CACHE_DIR names.

    Where that folder cannot be used, a temporary one serves this run.
    """
    try:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
        folder = Path(os.environ.get("NUMBA_CACHE_DIR") or base / "fctd" / CODE).absolute()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        wrong = _exposed(folder.stat())
        if not wrong and os.access(folder, os.W_OK | os.X_OK):
            return Store(folder)
        wrong = f"compiled code is not kept, since {folder} {wrong or 'cannot be written'}"
    except OSError as error:
        wrong = f"compiled code is not kept, since there is no cache folder ({error})"
    except RuntimeError:
        wrong = "compiled code is not kept, since there is no home folder"
    name = "NUMBA_CACHE_DIR" if os.environ.get("NUMBA_CACHE_DIR") else "XDG_CACHE_HOME"
    trouble = f"{wrong}: every run compiles again; set {name} to a folder of your own"
    try:
        scratch = tempfile.TemporaryDirectory(prefix="fctd-")
    except OSError:
        return Store(None, trouble)
    atexit.register(scratch.cleanup)
    return Store(Path(scratch.name), trouble)


class KeptCode(_Cache):
    """The compiled forms of one function in a store, as numba's dispatcher asks for them."""

    def __init__(self, function: Callable[..., Any], store: Store) -> None:
        self._store = store
        self._label = f"{function.__module__}.{function.__qualname__}"
        self._function = function
        self._sources = ""
        self._enabled = True

    @property
    def cache_path(self) -> str:
        """The folder, empty where there is none."""
        return str(self._store.folder or "")

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The compiled form for argument types; None where it has to be compiled."""
        rtsys.initialize(target_context)
        if not self._enabled:
            return None
        data = self._store.read(self._name(sig, target_context.codegen()))
        return None if data is None else CompileResult._rebuild(target_context, *pickle.loads(data))

    def save_overload(self, sig: Any, data: Any) -> None:
        """Store a compiled form."""
        if self._enabled:
            if data.lifted or data.library.has_dynamic_globals:
                raise ValueError(f"{self._label} refers to objects of this process and cannot be stored on disk")
            self._store.write(self._name(sig, data.codegen), dumps(data._reduce()))

    def _name(self, sig: Any, codegen: Any) -> str:
        types, _ = normalize_signature(sig)
        if not self._sources:
            self._sources = fingerprint(self._function)
        versions = numba.__version__, llvmlite.__version__, np.__version__, sys.version
        key = repr((versions, self._sources, types, codegen.magic_tuple()))
        return f"{self._label}-{hashlib.sha256(key.encode()).hexdigest()[:16]}"

    def enable(self) -> None:
        """Read and write from now on."""
        self._enabled = True

    def disable(self) -> None:
        """Neither read nor write from now on."""
        self._enabled = False

    def flush(self) -> None:
        """Delete the stored code of this function."""
        for path in self._store.folder.glob(f"{self._label}-*") if self._store.folder else ():
            path.unlink()


def _exposed(info: os.stat_result) -> str:
    """Why another user can write code here; empty where none can."""
    if os.name == "posix" and info.st_uid != os.geteuid():
        return "belongs to another user"
    if os.name == "posix" and info.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        return "may be written by other users"
    return ""


def _hash(name: str, data: bytes) -> bytes:
    """Hash that reveals damage, and a file stored under another function's name."""
    return hashlib.sha256(name.encode() + b"\0" + data).digest()


@cache
def hash_of_sources() -> str:
    """Hash of all source files of the engine."""
    digest, package = hashlib.sha256(), Path(__file__).parents[1]
    for source in sorted(package.rglob("*.py")):
        digest.update(str(source.relative_to(package)).encode() + source.read_bytes())
    return digest.hexdigest()[:16]


def _warn(text: str) -> None:
    warnings.warn(text, CompileCacheWarning, stacklevel=2)


STORE = open_store()
if STORE.folder is not None:
    if not STORE.lasting:  # the processes that this one starts use it too
        os.environ["NUMBA_CACHE_DIR"] = str(STORE.folder)
    # For functions outside the engine, which numba stores itself.  It does not notice an edit in a function that a
    # cached function calls, so the folder carries a hash of all sources.
    setattr(numba.config, "CACHE_DIR", str(STORE.folder / hash_of_sources()))  # noqa: B010 (defined at run time)
