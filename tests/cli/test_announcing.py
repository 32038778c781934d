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

# Packages that a chart as CSV does without; each takes a tenth to half a second to import.
SPARED = {"pandas", "pyarrow", "pint", "matplotlib", "plotly", "scipy.linalg", "scipy.optimize"}


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


@pytest.mark.slow
def test_a_chart_as_csv_imports_no_package_that_it_does_not_use(tmp_path: Path) -> None:
    """Nor SciPy's linear algebra, which numba's own sums and extremes of arrays import: a fifth of a second."""
    asked = "import sys; from fctd.cli.main import main; sys.argv[1:] = {}\ntry: main()\nexcept SystemExit: pass\n"
    out = tmp_path / "chart.csv"
    chart = ["chart", "examples/my_well.toml", "--operation", "trip_out", "--depths", "3000", "--out", str(out)]
    program = asked.format(chart) + f"print({SPARED} & sys.modules.keys())"
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=Path(__file__).parents[2], capture_output=True, text=True, check=True
        )
        if done.stdout.splitlines()[-1] == "set()":
            break  # else it may have had to compile
    assert done.stdout.splitlines()[-1] == "set()"
    assert len(out.read_text().splitlines()) == 2
