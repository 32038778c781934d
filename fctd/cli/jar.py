"""``fctd jar CASE``: forces at a jar of stuck pipe, and the hook loads that they take."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fctd.case.systems import FORCE, told
from fctd.cli.base_command import Silent
from fctd.cli.job import WHOLE, Job, print_table, right, rows_of
from fctd.cli.options import CaseFile, Friction, Overrides, Strict, Units
from fctd.cli.quantities import BIT_DEPTH, TOTAL_DEPTH, Given, QuantityOption, is_number, quantity, several
from fctd.cli.steady import DEPTH_HELP, StuckAt, file_option
from fctd.results.shown_tables import Head, number, of_column, shown_table
from fctd.results.unit_systems import shown
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
    job = Job(case_file, overrides, friction, units=units, strict=strict, quiet=quiet, out=out, silent=True)
    case = job.case
    pulls, pushes, hung = (several(given, units) for given in (up, down, hookload))
    bit = bit_depth.depth(case, units)
    job.warn()
    place = f"{jar} {BIT_DEPTH.kind.bare_unit(units)}" if is_number(jar) else jar
    stuck = None if stuck_at is None else stuck_at.depth(case, units)
    table = jar_forces(case, place, stuck, bit, up=pulls, down=pushes, hookload=hung)
    beyond = {*table.loc[table["share_used"] > 1, "limit"], *(["hoist"] if (table["hoist_share"] > 1).any() else [])}
    found = bool((table["reason"] == "none").all())
    job.end({"--out": table}, lambda: _print(job, table), acceptable=found, codes=beyond)


def _print(job: Job, table: "pd.DataFrame") -> None:
    units, rows = job.units, rows_of(table)
    where = [f"{what} at {job.words(rows[0], key)}" for what, key in PLACES.items()]
    job.say(f"{', '.join(where)}; forces in {shown('hookload_N', units).label}")
    found = (
        [
            "up" if row["direction"] == UP else "down", *(of_column(name, row[name], units, 1) for name in SHOWN),
            *(number(100 * row[name], 0) for name in ("share_used", "hoist_share")),
            ", ".join(row[name].replace("_", " ") for name in ("limit", "buckling") if row[name] != "none"),
        ]
        for row in rows
    )  # fmt: skip
    print_table(
        shown_table(
            [
                "\njar",
                *(Head(words, numbers=True) for words in SHOWN.values()),
                *right("used\n%", "hoist\n%"),
                "first\nlimit",
            ],
            found,
        ),
        {"\njar": WHOLE},
        numbers=WHOLE,
    )
    job.say(
        "a force at the jar is the tension there, below 0 a push; over free is the hook load above that of the free "
        "string; what running pumps add at a jar is left out",
        *(f"{row['direction']}: {told(row['reason'], units)}" for row in rows if row["reason"] != "none"),
    )
