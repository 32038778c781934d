"""The command that compiles, and what every command says of compiling."""

import subprocess
import sys
import warnings
from io import StringIO
from pathlib import Path
from types import SimpleNamespace

import pytest
from numba.core import event
from rich.console import Console

from fctd.cli import compile as command
from fctd.cli.announcing import announcing, listening
from fctd.cli.compile import compile_into
from fctd.mechanics.compile_cache import WAITING, CompileCacheWarning, Store
from tests.compiled import hits, store_of_one, thrice, twice


@pytest.fixture
def store(tmp_path: Path) -> Store:
    """A folder of compiled code that holds one function's."""
    return store_of_one(tmp_path)


EVERY_SIGNATURE = """
import fctd
from fctd.cli import compile as cli_compile
from tests import cases
from tests.mechanics.test_jit import dispatchers

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
# With the friction of rates, and with friction that remembers.
both = {"assemble", "relax", "read_top"}
several = {name: f.signatures for name, f in kept.items() if len(f.signatures) > 1 + (f.py_func.__name__ in both)}
assert not several, several
"""


@pytest.mark.slow
def test_compile_reaches_every_function_with_every_signature() -> None:
    done = subprocess.run(
        [sys.executable, "-c", EVERY_SIGNATURE], cwd=Path(__file__).parents[2], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr


def test_the_command_says_what_it_compiled_and_where(
    store: Store, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def compile_one() -> None:
        hits(store, thrice, 4.5)

    with monkeypatch.context() as patched:
        patched.setattr(command, "time", SimpleNamespace(perf_counter=iter([10.0, 12.6]).__next__))
        compile_into(store, compile_one)
    seen = capsys.readouterr()
    assert "thrice" in seen.err
    assert "Compiled: 1 function in 3 s, kept in" in seen.out
    compile_into(store, compile_one)
    assert "Compiled: nothing to do, kept in" in capsys.readouterr().out


def test_listening_names_what_is_compiled(store: Store) -> None:
    names: list[str] = []
    with listening(names.append):
        hits(store, twice, 3.0)
        hits(store, thrice, 4.5)
    assert names == ["thrice"]


def test_a_first_run_says_once_why_it_waits(store: Store) -> None:
    seen = StringIO()
    with announcing(Console(file=seen, force_terminal=True)):
        assert hits(store, twice, 3.0) == 1
        assert seen.getvalue() == ""
        hits(store, thrice, 4.5)
        hits(store, lambda x: x, 1.5)
    assert seen.getvalue().count("compiling, once for this version") == 1


def test_a_run_that_waits_for_the_code_of_another_one_says_the_same() -> None:
    seen = StringIO()
    with announcing(Console(file=seen, force_terminal=True)), event.trigger_event(WAITING):
        assert seen.getvalue().count("compiling, once for this version") == 1


def test_a_command_says_plainly_what_is_wrong_with_the_cache(capsys: pytest.CaptureFixture[str]) -> None:
    with announcing(), warnings.catch_warnings():
        warnings.simplefilter("default")
        warnings.warn("x[b] is damaged", CompileCacheWarning, stacklevel=1)
    assert capsys.readouterr().err == "warning: x[b] is damaged\n"
