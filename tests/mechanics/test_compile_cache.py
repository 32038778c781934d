"""Compiled code on disk: damage, full disks, folders of other users."""

import errno
import os
import pickle
import resource
import shutil
import signal
import threading
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import Mock

import numba
import pytest
from numba.core import event
from numba.core.cpu import CPUContext
from numba.core.errors import TypingError
from numba.core.registry import cpu_target

from fctd.mechanics import compile_cache, jit
from fctd.mechanics.compile_cache import CompileCacheWarning, Store, open_store
from tests.compiled import hits, store_of_one, thrice, twice


@pytest.fixture
def store(tmp_path: Path) -> Store:
    """A folder of compiled code that holds one function's."""
    return store_of_one(tmp_path)


@pytest.fixture
def file(store: Store) -> Path:
    """The only file of that folder."""
    assert store.folder is not None
    (path,) = store.folder.iterdir()
    return path


def test_code_is_read_back(store: Store, file: Path) -> None:
    assert file.stat().st_mode & 0o777 == 0o600
    assert hits(store, twice, 3.0) == 1


def test_stored_code_needs_no_registries(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """numba's registries of types and functions, most of a second, are for compiling alone."""
    monkeypatch.setattr(
        CPUContext, "load_additional_registries", Mock(side_effect=AssertionError("the registries are loaded"))
    )
    assert hits(store, twice, 3.0) == 1
    with pytest.raises(AssertionError, match="registries"):
        jit.entry(thrice, store)(1.5)


def other_code(file: Path) -> bytes:
    """The sound file of another function."""
    assert jit.entry(thrice, Store(file.parent))(1.5) == 4.5
    (other,) = set(file.parent.iterdir()) - {file}
    return other.read_bytes()


DAMAGES: dict[str, Callable[[Path], bytes]] = {
    "truncated": lambda file: file.read_bytes()[:-1],
    "truncated to its hash": lambda file: file.read_bytes()[: compile_cache.HASH_SIZE],
    "empty": lambda _: b"",
    "garbage": lambda _: bytes(range(256)) * 40,
    "a bit of its machine code": lambda file: (
        (data := file.read_bytes())[:5000] + bytes([data[5000] ^ 1]) + data[5001:]
    ),
    "another pickle": lambda _: pickle.dumps({"a": 1}),
    "another function's": other_code,
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_damaged_code_is_compiled_again_once(damage: str, store: Store, file: Path) -> None:
    file.write_bytes(DAMAGES[damage](file))
    with pytest.warns(CompileCacheWarning, match=r"twice-\w+ is damaged: it is compiled again and replaced"):
        assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 1


def test_a_folder_in_place_of_a_file_is_replaced(store: Store, file: Path) -> None:
    file.unlink()
    (file / "inside").mkdir(parents=True)
    with pytest.warns(CompileCacheWarning, match="cannot be read \\(Is a directory\\)"):
        assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 1


def test_code_that_another_user_may_have_written_is_not_run(store: Store, file: Path) -> None:
    file.chmod(0o620)
    with pytest.warns(CompileCacheWarning, match="may be written by other users: it is compiled again"):
        assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 1


def test_an_error_in_sound_code_is_not_taken_for_damage(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_cache.CompileResult, "_rebuild", Mock(side_effect=EOFError("of our own")))
    with pytest.raises(EOFError, match="of our own"):
        hits(store, twice, 3.0)


@contextmanager
def files_limited_to(size: int) -> Iterator[None]:
    """A context in which no file can exceed a size, as on a full disk."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_full_disk_gives_one_warning_and_everything_still_runs(store: Store, file: Path) -> None:
    warned = pytest.warns(CompileCacheWarning, match="cannot be kept in .*: it is kept for this run only")
    with warned, files_limited_to(1000):
        assert hits(store, thrice, 4.5) == 0
    assert not store.lasting
    assert list(file.parent.iterdir()) == [file]  # what was there, and no scratch file
    assert hits(store, thrice, 4.5) == 0


def test_a_folder_removed_meanwhile_gives_a_warning(store: Store, file: Path) -> None:
    shutil.rmtree(file.parent)
    with pytest.warns(CompileCacheWarning, match="cannot be kept in .* \\(No such file or directory\\)"):
        assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 0


@pytest.fixture
def held(store: Store, file: Path, monkeypatch: pytest.MonkeyPatch) -> Store:
    """Another process's view of the folder, from which the code was removed; it compiles the same function."""
    monkeypatch.setattr(compile_cache, "PAUSE", 0.001)
    file.rename(file.parent.with_name("moved"))
    other = Store(file.parent)
    assert not other.lock(file.name)
    return other


def locks(folder: Path) -> list[str]:
    """Names of the lock files of a folder."""
    return [path.name for path in folder.glob(".*")]


def test_a_function_that_another_process_compiles_is_waited_for(held: Store, store: Store, file: Path) -> None:
    waits = threading.Event()

    class Finishes(event.Listener):
        def on_start(self, event: event.Event) -> None:
            waits.set()
            file.parent.with_name("moved").rename(file)
            held.unlock(file.name)

        def on_end(self, event: event.Event) -> None:
            pass

    with event.install_listener(compile_cache.WAITING, Finishes()):
        assert hits(store, twice, 3.0) == 1
    assert waits.is_set()
    assert locks(file.parent) == []


def test_one_that_takes_too_long_is_not_waited_for(
    held: Store, store: Store, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(compile_cache, "LONGEST_WAIT", 0.05)
    assert hits(store, twice, 3.0) == 0
    assert locks(file.parent) == [f".{file.name}"]  # it is still the other's
    held.unlock(file.name)
    assert locks(file.parent) == []


def test_one_that_was_killed_is_not_waited_for(store: Store, monkeypatch: pytest.MonkeyPatch) -> None:
    """The system gives its lock back."""
    monkeypatch.setattr(compile_cache, "_waited", refuse)
    ready, tell = os.pipe()
    if not (child := os.fork()):
        store.lock("function")
        os.write(tell, b"x")
        signal.pause()
    os.read(ready, 1)
    with pytest.raises(AssertionError):
        Store(store.folder).lock("function")
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    assert not Store(store.folder).lock("function")


def refuse(_: int) -> bool:
    raise AssertionError("another process is waited for")


def test_code_that_cannot_be_compiled_leaves_no_lock(store: Store, file: Path) -> None:
    with pytest.raises(TypingError):
        jit.entry(twice, store)({})
    assert set(file.parent.iterdir()) == {file}


@pytest.mark.parametrize("flock", [None, OSError(errno.ENOLCK, "No locks available"), OSError(errno.EIO, "Input")])
def test_without_locks_everything_still_runs(
    flock: OSError | None, store: Store, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Windows has none, nor have some folders of a network."""

    def fails(*_: int) -> None:
        assert flock is not None
        raise flock

    system = None if flock is None else SimpleNamespace(LOCK_EX=0, LOCK_NB=0, LOCK_UN=0, flock=fails)
    monkeypatch.setattr(compile_cache, "fcntl", system)
    assert hits(store, thrice, 4.5) == 0
    assert hits(store, thrice, 4.5) == 1
    assert locks(file.parent) == []


def test_a_new_folder_is_this_users_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "new"))
    before = os.umask(0)
    try:
        store = open_store()
    finally:
        os.umask(before)
    assert store.folder == tmp_path / "new"
    assert store.folder.stat().st_mode & 0o777 == 0o700


def refused(monkeypatch: pytest.MonkeyPatch, folder: Path, message: str) -> None:
    """A store beside a folder that cannot be used: private, for this run only, with one warning."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(folder))
    store = open_store()
    assert store.folder != folder
    assert store.folder is not None
    assert store.folder.stat().st_mode & 0o777 == 0o700
    assert not store.lasting
    with pytest.warns(CompileCacheWarning, match=message):
        assert store.read("function") is None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert store.read("function") is None


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o1777])
def test_a_folder_that_others_may_write_is_refused(mode: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tmp_path.chmod(mode)
    refused(monkeypatch, tmp_path, "may be written by other users: every run compiles again")


def test_another_users_folder_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
    monkeypatch.setattr(compile_cache.tempfile, "TemporaryDirectory", Nowhere)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    store = open_store()
    assert store.folder is None
    with pytest.warns(CompileCacheWarning, match="belongs to another user"):
        store.read("function")


def test_a_folder_that_cannot_be_written_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    refused(monkeypatch, tmp_path, "cannot be written: every run compiles again; set NUMBA_CACHE_DIR to")


class Nowhere:
    """A system without room for a temporary folder."""

    def __init__(self, **_: object) -> None:
        raise FileNotFoundError("no usable temporary directory")


def test_without_any_folder_code_is_kept_in_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setattr(compile_cache.tempfile, "TemporaryDirectory", Nowhere)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file" / "cache"))
    store = open_store()
    with pytest.warns(CompileCacheWarning, match="there is no cache folder"):
        assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 0


def test_code_for_another_processor_is_another_file(store: Store, file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The name of a processor alone says nothing of the instructions that are switched off."""
    codegen = cpu_target.target_context.codegen()
    found = codegen._tm_features
    monkeypatch.setattr(codegen, "_tm_features", f"{found},-fma")
    assert hits(store, twice, 3.0) == 0
    assert hits(store, twice, 3.0) == 1
    monkeypatch.setattr(codegen, "_tm_features", found)
    assert hits(store, twice, 3.0) == 1
    assert len(list(file.parent.iterdir())) == 2
    other = "x86-64-v3" if numba.config.CPU_NAME == "x86-64-v2" else "x86-64-v2"
    monkeypatch.setattr(numba.config, "CPU_NAME", other)
    assert hits(store, twice, 3.0) == 0


def test_where_a_warning_is_an_error_code_is_compiled_after_it(tmp_path: Path) -> None:
    store = Store(tmp_path, "compiled code is not kept")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(CompileCacheWarning):
            store.read("function")
        assert store.read("function") is None
