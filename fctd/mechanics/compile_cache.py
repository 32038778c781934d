"""The cache of compiled code on disk: its folder, who may write to it, and the check of every file.

Compiled code that is read is also run.  The folder and its files must therefore belong to this user, and no other user
may write to them.  Every file begins with a hash of its name and contents: numba's own cache stores no hash, and a
damaged file crashes the program there.

Processes that begin together compile a function once: the first locks its name, and the others wait for its code.
"""

import atexit
import hashlib
import os
import pickle
import shutil
import stat
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy as np
from numba.core import event
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.runtime.nrt import rtsys
from numba.core.serialize import dumps
from numba.core.sigutils import normalize_signature

from fctd.mechanics.fingerprint import fingerprint

try:
    import fcntl
except ImportError:  # Windows, where processes that begin together all compile
    fcntl = None  # type: ignore[assignment]

CODE = "code"  # the folder, below that of fctd in the user's cache
HASH_SIZE = hashlib.sha256().digest_size
# A function takes a few seconds to compile; a process that is stopped meanwhile holds up no other for longer than this
# [s], and one that has ended not at all.
LONGEST_WAIT, PAUSE = 120.0, 0.02
WAITING = "fctd:waiting"  # numba's event of a process that waits for another one's code


class CompileCacheWarning(RuntimeWarning):
    """Compiled code could not be stored on disk, or a stored file was unusable and is compiled again."""


class Store:
    """The folder of compiled code, None where code is kept in memory only; lasting : whether it outlives this run."""

    def __init__(self, folder: Path | None, trouble: str = "") -> None:
        self.folder = folder
        self.lasting = not trouble
        self._trouble = trouble  # reported when the first function is compiled
        self._locks: dict[str, tuple[int, Path]] = {}  # open files and their places

    def read(self, name: str) -> bytes | None:
        """The data stored under a name; None where there is none or its file is unusable."""
        trouble, self._trouble = self._trouble, ""
        if trouble:  # once, also where a warning is an error
            _warn(trouble)
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

    def lock(self, name: str) -> bool:
        """Keep other processes from compiling for a name until ``unlock``; whether one of them has done so meanwhile.

        Nothing is locked without a folder, where the system has no locks, and once another one has taken too long.
        """
        if self.folder is None or fcntl is None:
            return False
        with suppress(OSError):
            path = self.folder / f".{name}"
            file = os.open(path, os.O_WRONLY | os.O_CREAT, 0o600)
            self._locks[name] = file, path
            if not _locked(file):
                with event.trigger_event(WAITING):
                    return _waited(file)
        return False

    def unlock(self, name: str) -> None:
        """Let other processes compile for a name again."""
        file, path = self._locks.pop(name, (-1, Path()))
        if file < 0:
            return
        try:
            alone = _locked(file)  # not where another one was waited for in vain
        except OSError:  # there are no locks, and the file holds up nobody
            alone = True
        with suppress(OSError):
            if alone:
                path.unlink()
            fcntl.flock(file, fcntl.LOCK_UN)  # closing is not enough: processes that were forked have the file too
        os.close(file)


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
        self._sources, self._locked = "", ""
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
        name = self._name(sig, target_context.codegen())
        data = self._store.read(name)
        if data is None:
            self._locked = name
            if self._store.lock(name):
                data = self._store.read(name)
        if data is None:
            return None
        self.unlock()
        return CompileResult._rebuild(target_context, *pickle.loads(data))

    def unlock(self) -> None:
        """Let other processes compile this function, which is compiled and stored, or could not be."""
        self._store.unlock(self._locked)

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


def _locked(file: int) -> bool:
    """Lock an open file; False where another process has done so."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _waited(file: int) -> bool:
    """Wait for the lock of an open file; whether it came in time."""
    end = time.monotonic() + LONGEST_WAIT
    while time.monotonic() < end:
        time.sleep(PAUSE)
        if _locked(file):
            return True
    return False


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
