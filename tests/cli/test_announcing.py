"""What every command says of compiling."""

import subprocess
import sys
import warnings
from io import StringIO
from pathlib import Path

import pytest
from numba.core import event
from rich.console import Console

from fctd.cli.announcing import announcing, listening
from fctd.mechanics.compile_cache import WAITING, CompileCacheWarning, Store
from tests.compiled import hits, store_of_one, thrice, twice


@pytest.fixture
def store(tmp_path: Path) -> Store:
    """A folder of compiled code that holds one function's."""
    return store_of_one(tmp_path)


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


def test_the_stored_code_of_a_chart_needs_no_linear_algebra() -> None:
    """numba's own sums and extremes of arrays import SciPy's, a fifth of a second of every command."""
    asked = "import sys; from fctd.cli.main import main; sys.argv[1:] = {}\ntry: main()\nexcept SystemExit: pass\n"
    chart = ["chart", "examples/my_well.toml", "--operation", "trip_out", "--depths", "3000"]
    program = asked.format(chart) + "print({'scipy.linalg', 'scipy.optimize'} & sys.modules.keys())"
    for _ in range(2):  # the first may have to compile
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=Path(__file__).parents[2], capture_output=True, text=True, check=True
        )
    assert done.stdout.splitlines()[-1] == "set()"
