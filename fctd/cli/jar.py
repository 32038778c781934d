"""``fctd jar CASE``: forces at a jar of stuck pipe, and the hook loads that they take."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.doubts import warnings_of
from fctd.case.text import printable
from fctd.case.units import FORCE
from fctd.cli.base_command import Silent
from fctd.cli.limits import rows_of
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Strict,
    Units,
    changes_of,
    finish,
    print_written,
    read_case,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.quantities import BIT_DEPTH, TOTAL_DEPTH, Given, QuantityOption, is_number, quantity, several
from fctd.cli.steady import (
    DEPTH_HELP,
    StuckAt,
    check_table,
    file_option,
    in_units,
    metadata_of_case,
)
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, in_words, reworded, shown
from fctd.steady.jar import UP, jar_forces

if TYPE_CHECKING:
    import pandas as pd

# Columns on the screen, with headings.
SHOWN = {
    "force_at_jar_N": "at the\njar", "force_at_stuck_N": "at stuck\npoint", "hookload_N": "hook\nload",
    "weight_indicator_N": "weight\nindicator", "over_free_N": "over\nfree",
}  # fmt: skip
PLACES = {"jar": "jar_md_m", "stuck": "stuck_md_m", "bit": "bit_depth_m"}


def _forces(option: str, what: str) -> Any:
    return quantity(QuantityOption(option, FORCE), "F", f"{what}; several with commas between them.")


def jar_command(
    case_file: CaseFile,
    jar: Annotated[
        str,
        typer.Option("--jar", metavar="MD or NAME", help="Measured depth of the jar, or the name of its component."),
    ],
    stuck_at: StuckAt = None,
    up: Annotated[list[Given], _forces("--up", "Pull at the jar that fires it upwards, '400 kN'")] = [],  # noqa: B006
    down: Annotated[list[Given], _forces("--down", "Push at the jar that fires it downwards")] = [],  # noqa: B006
    hookload: Annotated[
        list[Given],
        _forces("--hookload", "Hook load of the string, without the block, whose force at the jar is asked"),
    ] = [],  # noqa: B006
    bit_depth: Annotated[Given, quantity(BIT_DEPTH, "D", f"{DEPTH_HELP}.")] = TOTAL_DEPTH,
    overrides: Overrides = [],  # noqa: B006
    friction: Friction = None,
    out: Annotated[Path | None, file_option("--out", "A row for every load, .csv, .parquet or .xlsx.")] = None,
    units: Units = "si",
    quiet: Silent = False,
    strict: Strict = False,
) -> None:
    """Find the hook load that brings a force to a jar of stuck pipe, and the force that a hook load brings there.

    The string is pulled for a force upwards and set down for one downwards, with friction on the way.
    """
    check_table(out)
    case = read_case(case_file, changes_of(overrides, friction))
    refuse_sources(case, out, "--out")
    pulls, pushes, hung = (several(given, units) for given in (up, down, hookload))
    bit = bit_depth.depth(case, units)
    warnings = warnings_of(case)
    tell(case, warnings, strict=strict, units=units)
    place = f"{jar} {BIT_DEPTH.bare_unit(units)}" if is_number(jar) else jar
    stuck = None if stuck_at is None else stuck_at.depth(case, units)
    table = jar_forces(case, place, stuck, bit, up=pulls, down=pushes, hookload=hung)
    written: list[Path] = []
    try:  # written before anything is printed, as the terminal may be closed
        if out is not None:
            written += write_table(in_units(units, table), out, metadata_of_case(case, warnings) | {"units": units})
    finally:
        if not quiet:
            _print(table, case.name, units)
    if not quiet:
        print_written(written)
    beyond = {*table.loc[table["share_used"] > 1, "limit"], *(["hoist"] if (table["hoist_share"] > 1).any() else [])}
    finish(bool((table["reason"] == "none").all()), beyond, strict)


def _print(table: "pd.DataFrame", name: str, units: System) -> None:
    screen.print(printable(name), style="bold", soft_wrap=True)
    first = rows_of(table)[0]
    where = [f"{what} at {in_words(first[key], key, units)}" for what, key in PLACES.items()]
    screen.print(f"{', '.join(where)}; forces in {shown('hookload_N', units).label}", soft_wrap=True)
    screen.print(_table(table, units))
    screen.print(
        "a force at the jar is the tension there, below 0 a push; over free is the hook load above that of the free "
        "string; what running pumps add at a jar is left out",
        soft_wrap=True,
    )
    for row in rows_of(table):
        if row["reason"] != "none":
            screen.print(f"{row['direction']}: {reworded(row['reason'], units)}", soft_wrap=True)


def _table(table: "pd.DataFrame", units: System) -> Table:
    headings = (*SHOWN.values(), "used\n%", "hoist\n%")
    found = Table(
        Column("\njar", no_wrap=True), *(Column(name, justify="right", no_wrap=True) for name in headings),
        Column("first\nlimit"), box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False,
    )  # fmt: skip
    for row in rows_of(table):
        cells = ["–" if np.isnan(row[name]) else f"{row[name] * shown(name, units).factor:z.1f}" for name in SHOWN]
        shares = ["–" if np.isnan(row[name]) else f"{100 * row[name]:.0f}" for name in ("share_used", "hoist_share")]
        until = [] if row["limit"] == "none" else [row["limit"].replace("_", " ")]
        until += [] if row["buckling"] == "none" else [row["buckling"]]
        found.add_row("up" if row["direction"] == UP else "down", *cells, *shares, ", ".join(until))
    return found
