"""Numbers do not hang on what was compiled before, nor on whether code is compiled or read from a cache."""

import os
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

CASE = """
name = "order"
[wellbore]
stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]
overlap = "0.2 m"
[[wellbore.intervals]]
to_md = "900 m"
diameter = "8.5 in"
friction = 0.2
[string]
[[string.components]]
name = "pipe"
length = "800 m"
outer_diameter = "5 in"
inner_diameter = "4.276 in"
segments = 32
[[operations]]
kind = "rotate_off_bottom"
at_md = "800 m"
duration = "20 s"
rpm = 120
ramp_time = "2 s"
"""
FILES = ("pulled.csv", "buckled.csv")
CACHE = "cache"
TABLES = ("history", "profile", "energy", "operations", "segments")


def simulate(folder: Path) -> None:
    """Run the case; its tables go to ``folder``."""
    run(folder, "simulate", "--out", folder)


def equilibrium(folder: Path) -> None:
    """Balance the string as it is pulled and as it buckles; its profiles go to ``folder``.

    The buckled one is no row of a batch alone: several entries, each with copies of the same functions, work on it.
    """
    run(folder, "equilibrium", "--operation", "trip_out", "--bit-depth", "800 m", "--out", folder / "pulled.csv")
    buckled = ("--set", "bit.weight_on_bit=200 kN", "--set", "solver.buckling=resolve")
    run(
        folder, "equilibrium", "--operation", "drill_sliding", "--bit-depth", "800 m", *buckled,
        "--out", folder / "buckled.csv",
    )  # fmt: skip


def run(folder: Path, command: str, *options: str | Path) -> None:
    """One command in a process of its own; with the user's compile cache, or that beside ``folder`` where one is."""
    folder.mkdir(exist_ok=True)
    (folder / "case.toml").write_text(CASE)
    environment = dict(os.environ)
    if (cache := folder.with_name(CACHE)).exists():
        environment.pop("NUMBA_CACHE_DIR", None)
        environment["XDG_CACHE_HOME"] = str(cache)
    done = subprocess.run(
        [sys.executable, "-m", "fctd", command, str(folder / "case.toml"), *map(str, options)],
        env=environment, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


def bits(file: Path) -> dict[str, bytes]:
    """Every column of a table, bit by bit."""
    return {name: column.to_numpy().tobytes() for name, column in pd.read_parquet(file).select_dtypes("number").items()}


@pytest.mark.compiles
def test_numbers_do_not_hang_on_what_was_compiled_before(tmp_path: Path) -> None:
    """The user's kept code, as a rule that of ``fctd compile``, which simulates first; an empty cache and a balance
    first; then a large function compiled anew beside kept code of those that it calls.
    """
    read, other, again = tmp_path / "read", tmp_path / "other", tmp_path / "again"
    simulate(read)
    equilibrium(read)
    (tmp_path / CACHE).mkdir()
    equilibrium(other)
    simulate(other)
    (kept,) = (tmp_path / CACHE).rglob("fctd.mechanics.dynamics.advance-*")
    kept.unlink()
    simulate(again)
    equilibrium(again)

    assert pd.read_parquet(read / "history.parquet")["contact_count"].max() > 3
    for folder in (other, again):
        for name in TABLES:
            assert bits(folder / f"{name}.parquet") == bits(read / f"{name}.parquet"), (folder.name, name)
        for name in FILES:
            assert (folder / name).read_text() == (read / name).read_text(), (folder.name, name)
