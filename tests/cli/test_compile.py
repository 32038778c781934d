"""The command that compiles."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from fctd.cli import compile as command
from fctd.cli.compile import compile_into
from fctd.mechanics.compile_cache import Store
from tests.compiled import hits, store_of_one, thrice


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
