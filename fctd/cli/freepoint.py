"""``fctd freepoint CASE``: where a string is stuck, from its stretch or its twist."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer

from fctd.case.systems import FORCE, LENGTH, TORQUE, told
from fctd.cli.base_command import Silent
from fctd.cli.job import Job, rows_of
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Strict,
    Units,
)
from fctd.cli.quantities import BIT_DEPTH, TOTAL_DEPTH, Given, QuantityOption, quantity, si
from fctd.cli.steady import DEPTH_HELP, file_option
from fctd.steady.free_point import STRETCH, free_point

if TYPE_CHECKING:
    import pandas as pd


NO_TORQUE = QuantityOption("--first-torque", TORQUE).parse("0 N*m")


def freepoint_command(
    case_file: CaseFile,
    pull: Annotated[
        Given | None,
        quantity(
            QuantityOption("--pull", FORCE), "F", "Difference of the hook loads at two marks, '200 kN' or '40 klbf'."
        ),
    ] = None,
    stretch: Annotated[
        Given | None,
        quantity(
            QuantityOption("--stretch", LENGTH), "L", "How far the pipe came up between them, '0.6 m' or '24 in'."
        ),
    ] = None,
    first_hookload: Annotated[
        Given | None,
        quantity(
            QuantityOption("--first-hookload", FORCE),
            "F",
            "Hook load of the string at the first mark; default: that of the free string picking up.",
            show_default=False,
        ),
    ] = None,
    torque: Annotated[
        Given | None,
        quantity(QuantityOption("--torque", TORQUE), "T", "By how much the torque grew, '15 kN*m' or '11 kft*lbf'."),
    ] = None,
    turns: Annotated[
        float | None, typer.Option("--turns", metavar="N", help="By how many turns the pipe was wound up.")
    ] = None,
    first_torque: Annotated[Given, quantity(NO_TORQUE.option, "T", "Torque from which it grew.")] = NO_TORQUE,
    bit_depth: Annotated[Given, quantity(BIT_DEPTH, "D", f"{DEPTH_HELP}.")] = TOTAL_DEPTH,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    out: Annotated[Path | None, file_option("--out", "A row for stretch and twist, .csv, .parquet or .xlsx.")] = None,
    units: Units = "si",
    quiet: Silent = False,
    strict: Strict = False,
) -> None:
    """Find the free point of stuck pipe by its stretch under a pull, or by its twist under a torque.

    The string of the case is laid out, with friction, down to the depth at which it moves as far as was measured.
    """
    job = Job(case_file, overrides, friction, units=units, strict=strict, quiet=quiet, out=out, silent=True)
    measured: dict[str, Any] = {
        "pull": si(pull, units), "stretch": si(stretch, units), "first_hookload": si(first_hookload, units),
        "torque": si(torque, units), "turns": turns, "first_torque": first_torque.si(units),
    }  # fmt: skip
    depth = bit_depth.depth(job.case, units)
    job.warn()
    table = free_point(job.case, depth, **measured)
    job.end({"--out": table}, lambda: _print(job, table), acceptable=bool((table["reason"] == "none").all()))


def _print(job: Job, table: "pd.DataFrame") -> None:
    job.say(*(line for row in rows_of(table) for line in _lines(job, row)))
    job.say("hook loads are those of the string alone, without the block")


def _lines(job: Job, row: dict[str, Any]) -> list[str]:
    """What was measured and what was found, in words."""

    def words(column: str) -> str:
        return job.words(row, column)

    if row["by"] == STRETCH:
        moved, load, first = (words(name) for name in ("stretch_m", "pull_N", "first_hookload_N"))
        arrived = ("first_force_N", "last_force_N")
    else:
        moved, load, first = f"{row['turns']:g} turns", words("torque_N_m"), words("first_torque_N_m")
        arrived = ("first_arrived_N_m", "last_arrived_N_m")
    lines = [f"{row['by']}: {moved} by {load} more than {first}, bit at {words('bit_depth_m')}"]
    if np.isnan(row["free_point_md_m"]):
        lines.append(f"  no free point: {told(row['reason'], job.units)}")
    else:
        lines.append(f"  free point at {words('free_point_md_m')}, {words('per_percent_m')} deeper for 1 % more of it")
        lines.append(f"  there the load grows from {words(arrived[0])} to {words(arrived[1])}")
    straight = f"  drillers' formula, bodies in a straight hole without friction: {words('straight_md_m')}"
    return [*lines, straight]
