"""``fctd compile``: the engine's code, compiled ahead."""

import time
from collections.abc import Callable
from typing import Any

import typer

from fctd.case.load import Case
from fctd.case.solver import RESOLVING
from fctd.case.text import counted
from fctd.cli.announcing import listening
from fctd.cli.options import FAILED, Quiet, messages, screen
from fctd.mechanics.compile_cache import STORE, Store
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
