"""``fctd compile``, and the messages of all commands about compiling."""

import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TextIO

import typer
from numba.core import event
from rich.console import Console

from fctd.case.load import Case
from fctd.case.solver import RESOLVING
from fctd.case.text import counted
from fctd.cli.options import FAILED, Quiet, messages, screen
from fctd.mechanics.compile_cache import STORE, WAITING, CompileCacheWarning, KeptCode, Store
from fctd.simulation.simulate import simulate
from fctd.steady.equilibrium import equilibrium

# The smallest case that calls every function: a string hung in a straight hole, with a long segment at its top.
SMALL: dict[str, Any] = {
    "name": "compile",
    "wellbore": {
        "stations": [[0, 0, 0], [100, 0, 0]],
        "intervals": [{"to_md": 100.0, "diameter": 0.2, "friction": 0.2}],
    },
    "string": {
        "components": [
            {"name": "pipe", "length": 50.0, "outer_diameter": 0.1, "inner_diameter": 0.05, "segments": 2},
            {"name": "pipe to surface", "outer_diameter": 0.1, "inner_diameter": 0.05, "segments": 1},
        ]
    },
    "operations": [{"kind": "rotate_off_bottom", "at_md": 90.0, "duration": 0.1, "rpm": 60.0, "ramp_time": 0.1}],
}
# What it leaves out: a stand is added, and the wall is not linear; an autodriller drills rock.
IN_STANDS: dict[str, Any] = {
    "string": {
        "components": [
            {"name": "pipe", "length": 80.0, "outer_diameter": 0.1, "inner_diameter": 0.05, "segment_length": 20.0}
        ]
    },
    "contact": {"law": "power"},
    "rig": {"feed": "stands", "stand_length": 20.0, "connection_time": 0.1},
    "operations": [{"kind": "trip_in", "from_md": 39.0, "to_md": 41.0, "speed": 10.0, "ramp_time": 0.1}],
}
DRILLING: dict[str, Any] = {
    "rig": {"autodriller": True},
    "bit": {"weight_on_bit": 100.0, "rock": {}},
    "operations": [
        {"kind": "drill_rotating", "from_md": 90.0, "to_md": 90.001, "speed": 0.01, "rpm": 60.0, "ramp_time": 0.1}
    ],
}

OVAL: dict[str, Any] = {
    "wellbore": SMALL["wellbore"] | {
        "geometry": "sampled", "caliper": {"rows": [[40.0, 0.25, 0.2], [60.0, 0.25, 0.2]]}, "cell": 10.0,
    },
}  # fmt: skip


def compile_command(quiet: Quiet = False) -> None:
    """Compile the engine now; otherwise the first command that needs it compiles it."""
    compile_into(STORE, compile_all, quiet)


def compile_into(store: Store, compiling: Callable[[], object], quiet: bool = False) -> None:
    """Call ``compiling``; print the functions it compiled and the store's folder; exit code 1 without a folder."""
    began, names = time.perf_counter(), set[str]()

    def progress(name: str) -> None:
        names.add(name)
        if not quiet:
            messages.print(f"  {name}", highlight=False, markup=False)

    with listening(progress):
        compiling()
    if not store.lasting:
        advice = "set NUMBA_CACHE_DIR to a folder that can be written"
        messages.print(f"compiled code could not be kept: {advice}", style="bold")
        raise typer.Exit(FAILED)
    taken = f"{counted(len(names), 'function')} in {time.perf_counter() - began:.0f} s" if names else "nothing to do"
    screen.print(f"Compiled: {taken}, kept in {store.folder}", soft_wrap=True, highlight=False, markup=False)


def compile_all() -> None:
    """Compile, and keep, every function that a run or a steady string calls."""
    case = Case.model_validate(SMALL)
    simulate(case)
    for more in (IN_STANDS, DRILLING, OVAL):
        simulate(Case.model_validate(SMALL | more))
    equilibrium(case, operation="trip_out", bit_depth=90.0)
    tables = *({"solver": {"buckling": way}} for way in RESOLVING), {"contact": {"helical_force": "analytic"}}
    for table in (*tables, OVAL):
        buckled = Case.model_validate(SMALL | {"bit": {"weight_on_bit": 1e5}} | table)
        equilibrium(buckled, operation="drill_sliding", bit_depth=90.0)


@contextmanager
def listening(report: Callable[[str], object], wait: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Inside, call ``report`` with the name of every cached function whose compilation begins.

    wait : called where another process compiles one, for which this one waits.
    """
    listener = _Listener(report, wait)
    with event.install_listener("numba:compile", listener), event.install_listener(WAITING, listener):
        yield


class _Listener(event.Listener):
    def __init__(self, report: Callable[[str], object], wait: Callable[[], object]) -> None:
        self._report, self._wait = report, wait

    def on_start(self, event: event.Event) -> None:
        if event.kind == WAITING:
            self._wait()
            return
        function = event.data["dispatcher"]
        if isinstance(function._cache, KeptCode):
            self._report(function.py_func.__name__)

    def on_end(self, event: event.Event) -> None:
        pass


@contextmanager
def announcing(messages: Console = messages) -> Iterator[None]:
    """Inside, print on standard error that functions are compiled, and every warning about the compile cache."""
    said = False

    def first(_: str = "") -> None:
        nonlocal said
        if not said and messages.is_terminal:
            messages.print("compiling, once for this version: about half a minute", highlight=False)
        said = True

    others = warnings.showwarning

    def show(
        message: Warning | str, category: type[Warning], filename: str, lineno: int,
        file: TextIO | None = None, line: str | None = None,
    ) -> None:  # fmt: skip
        if issubclass(category, CompileCacheWarning):
            messages.print(f"warning: {message}", soft_wrap=True, highlight=False, markup=False)
        else:
            others(message, category, filename, lineno, file, line)

    warnings.showwarning = show
    try:
        with listening(first, wait=first):
            yield
    finally:
        warnings.showwarning = others
