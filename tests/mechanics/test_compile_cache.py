"""Compiled code on disk: damage, full disks, folders of others, and that no function leaves an option open."""

import os
import pickle
import pkgutil
import resource
import shutil
import subprocess
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from numba.core.dispatcher import Dispatcher
from rich.console import Console

import fctd
from fctd.cli.compile import announcing, compile_command, listening
from fctd.mechanics import compile_cache, jit
from fctd.mechanics.compile_cache import CompileCacheWarning, Store, open_store


def twice(x):
    return 2 * x


def thrice(x):
    return 3 * x


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of compiled code that holds one function's."""
    tmp_path.chmod(0o700)
    monkeypatch.setattr(compile_cache, "STORE", Store(tmp_path))
    assert jit.entry(twice)(1.5) == 3.0
    return tmp_path


def hits(function: Callable[..., Any], expected: float) -> int:
    """How often the code of ``function`` is found on disk by a new process's first call."""
    fresh = jit.entry(function)
    assert fresh(1.5) == expected
    return sum(fresh.stats.cache_hits.values())


def test_code_is_read_back(folder: Path) -> None:
    (file,) = folder.iterdir()
    assert file.stat().st_mode & 0o777 == 0o600
    assert hits(twice, 3.0) == 1


def other_code(file: Path) -> bytes:
    """The sound file of another function."""
    assert jit.entry(thrice)(1.5) == 4.5
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
def test_damaged_code_is_compiled_anew_once(damage: str, folder: Path) -> None:
    (file,) = folder.iterdir()
    file.write_bytes(DAMAGES[damage](file))
    with pytest.warns(CompileCacheWarning, match=r"twice-\w+ is damaged: it is compiled anew and replaced"):
        assert hits(twice, 3.0) == 0
    assert hits(twice, 3.0) == 1


def test_a_folder_in_place_of_a_file_is_replaced(folder: Path) -> None:
    (file,) = folder.iterdir()
    file.unlink()
    (file / "inside").mkdir(parents=True)
    with pytest.warns(CompileCacheWarning, match="cannot be read \\(Is a directory\\)"):
        assert hits(twice, 3.0) == 0
    assert hits(twice, 3.0) == 1


def test_code_that_another_user_may_have_written_is_not_run(folder: Path) -> None:
    (file,) = folder.iterdir()
    file.chmod(0o620)
    with pytest.warns(CompileCacheWarning, match="may be written by other users: it is compiled anew"):
        assert hits(twice, 3.0) == 0
    assert hits(twice, 3.0) == 1


def test_an_error_in_sound_code_is_not_taken_for_damage(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise EOFError("of our own")

    monkeypatch.setattr(compile_cache.CompileResult, "_rebuild", broken)
    with pytest.raises(EOFError, match="of our own"):
        hits(twice, 3.0)


@contextmanager
def files_limited_to(size: int) -> Iterator[None]:
    """Inside, no file can be written beyond a size, as on a disk that is full."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_full_disk_is_told_once_and_everything_still_runs(folder: Path) -> None:
    told = pytest.warns(CompileCacheWarning, match="cannot be kept in .*: it is kept for this run only")
    with told, files_limited_to(1000):
        assert hits(thrice, 4.5) == 0
    assert not compile_cache.STORE.lasting
    assert len(list(folder.iterdir())) == 1  # what was there, and no scratch file
    assert hits(thrice, 4.5) == 0


def test_a_folder_removed_meanwhile_is_told(folder: Path) -> None:
    shutil.rmtree(folder)
    with pytest.warns(CompileCacheWarning, match="cannot be kept in .* \\(No such file or directory\\)"):
        assert hits(twice, 3.0) == 0
    assert hits(twice, 3.0) == 0


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
    """A store beside a folder that cannot be used: private, for this run only, and said once."""
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
    refused(monkeypatch, tmp_path, "may be written by other users: every run compiles anew")


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
    refused(monkeypatch, tmp_path, "cannot be written: every run compiles anew; let NUMBA_CACHE_DIR name")


class Nowhere:
    """A system without room for a temporary folder."""

    def __init__(self, **_: object) -> None:
        raise FileNotFoundError("no usable temporary directory")


def test_without_any_folder_code_is_kept_in_memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setattr(compile_cache.tempfile, "TemporaryDirectory", Nowhere)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file" / "cache"))
    monkeypatch.setattr(compile_cache, "STORE", open_store())
    with pytest.warns(CompileCacheWarning, match="there is no cache folder"):
        assert hits(twice, 3.0) == 0
    assert hits(twice, 3.0) == 0


def dispatchers() -> dict[str, Any]:
    """Every compiled function of the engine."""
    modules = [import_module(module.name) for module in pkgutil.walk_packages(fctd.__path__, "fctd.")]
    return {
        f"{value.py_func.__module__}.{name}": value
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, Dispatcher)
    }


def test_no_compiled_function_leaves_an_option_open() -> None:
    """What is open numba takes from whichever caller compiles a function first: numbers then hang on the order."""
    found = dispatchers()
    assert len(found) > 100
    for name, function in found.items():
        options = {key: function.targetoptions.get(key) for key in jit.OPTIONS}
        assert options in (jit.OPTIONS, jit.INLINED), name


EVERY_SIGNATURE = """
import fctd
from fctd.cli import compile as cli_compile
from tests import cases
from tests.mechanics.test_compile_cache import dispatchers

kept = {name: f for name, f in dispatchers().items() if hasattr(f._cache, "_label") and "external_contact" not in name}
cli_compile.compile_all()
# Compiled together with what calls them, and from Python called only where that fails.
inside = {"eliminate", "add_pseudo_mass", "take_step"}
missed = {name for name, f in kept.items() if not f.overloads and f.py_func.__name__ not in inside}
assert not missed, missed
stations = [[0, 0, 0], [700, 0, 0], [1000, 60, 45]]
case = cases.make_case(
    stations, [cases.pipe(200, 10), cases.pipe(None, 1)], [cases.trip(800, 801)],
    wellbore={"geometry": "arcs"}, contact={"friction_law": "paper"},
)
fctd.simulate(case)
fctd.torque_drag(case, operation=["trip_out", "rotate_off_bottom"], bit_depths=[750, 800])
fctd.refine(case, tolerance=0.1)
several = {name: f.signatures for name, f in kept.items() if len(f.signatures) > 1}
assert not several, several
"""


def test_compile_reaches_every_function_with_every_signature() -> None:
    done = subprocess.run(
        [sys.executable, "-c", EVERY_SIGNATURE], cwd=Path(__file__).parents[2], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


def test_the_command_says_what_it_compiled_and_where(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("fctd.cli.compile.STORE", compile_cache.STORE)
    monkeypatch.setattr("fctd.cli.compile.compile_all", lambda: hits(thrice, 4.5))
    compile_command()
    seen = capsys.readouterr()
    assert "thrice" in seen.err
    assert "Compiled: 1 functions in 0 s, kept in" in seen.out
    compile_command()
    assert "Compiled: nothing to do, kept in" in capsys.readouterr().out


def test_listening_names_what_is_compiled(folder: Path) -> None:
    names: list[str] = []
    with listening(names.append):
        hits(twice, 3.0)
        hits(thrice, 4.5)
    assert names == ["thrice"]


def test_a_first_run_says_once_why_it_waits(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = StringIO()
    monkeypatch.setattr("fctd.cli.compile.messages", Console(file=seen, force_terminal=True))
    with announcing():
        assert hits(twice, 3.0) == 1
        assert seen.getvalue() == ""
        hits(thrice, 4.5)
        hits(lambda x: x, 1.5)
    assert seen.getvalue().count("compiling, once for this version") == 1


def test_a_command_says_plainly_what_is_wrong_with_the_cache(capsys: pytest.CaptureFixture[str]) -> None:
    with announcing(), warnings.catch_warnings():
        warnings.simplefilter("default")
        warnings.warn("x[b] is damaged", CompileCacheWarning, stacklevel=1)
    assert capsys.readouterr().err == "warning: x[b] is damaged\n"
