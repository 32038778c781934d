"""``fctd wear CASE``: grooves that the turning string wears into casing, and the burst pressure that is left."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import typer

from fctd.case.errors import InputError
from fctd.case.systems import HOURS, LENGTH, told
from fctd.case.text import counted, printable
from fctd.cli.job import WHOLE, Job, depths_option, print_table, rows_of
from fctd.cli.options import CaseFile, Friction, Overrides, Quiet, Strict, Units
from fctd.cli.pictures import PICTURE_HELP, draw_panels
from fctd.cli.quantities import PENETRATION, TO_TOTAL_DEPTH, Given, QuantityOption, quantity, si
from fctd.cli.steady import Rpm, file_option
from fctd.results.shown_tables import Head, number, shown_table
from fctd.results.unit_systems import System, in_words, shown
from fctd.steady.wear import STEP, TURNING, USUAL_FACTORS, casing_wear

if TYPE_CHECKING:
    import pandas as pd

SCREEN_ROWS: Final = 16  # of a casing
# Columns on the screen, with headings.
SHOWN: Final = {
    "md_m": "\ndepth", "side_force_N": "side\nforce", "low_groove_m": "groove,\nfrom", "high_groove_m": "\nto",
    "high_worn": "of the\nwall", "burst_Pa": "burst,\nnew", "low_burst_Pa": "burst,\nworn",
}  # fmt: skip
# Columns of a range, from the lowest to the highest wear factor.
GROOVES: Final = ("low_groove_m", "high_groove_m")
WORN: Final = ("low_worn", "high_worn")
LEFT: Final = ("high_burst_Pa", "low_burst_Pa")
# Digits after the point of these columns, in SI and in field units.
DIGITS: Final = {
    "md_m": (0, 0), "side_force_N": (2, 3), "low_groove_m": (2, 4), "high_groove_m": (2, 4), "high_worn": (1, 1),
    "burst_Pa": (0, 0), "low_burst_Pa": (0, 0),
}  # fmt: skip


ROW: Final = QuantityOption("--step", LENGTH).parse(f"{STEP:g} m")


def wear_command(
    case_file: CaseFile,
    depths: Annotated[Given, depths_option("td")] = TO_TOTAL_DEPTH,
    hours: Annotated[
        Given | None,
        quantity(QuantityOption("--hours", HOURS), "T", "Time in all with the string turning, 100 or '100 h'."),
    ] = None,
    penetration: Annotated[
        Given | None,
        quantity(
            PENETRATION, "V", "Rate of penetration from FROM to TO, '20 m/h', bare in m/h or ft/h; in place of --hours."
        ),
    ] = None,
    rpm: Rpm = None,
    wear_factor: Annotated[
        str,
        typer.Option("--wear-factor", metavar="X or LOW:HIGH", help="Wear factor in 1e-10/psi, or its range."),
    ] = f"{USUAL_FACTORS[0]:g}:{USUAL_FACTORS[1]:g}",
    operation: Annotated[
        str, typer.Option("--operation", metavar="KIND", help=f"Kind of operation: {', '.join(TURNING)}.")
    ] = "drill_rotating",
    step: Annotated[
        Given, quantity(ROW.option, "L", "Length of casing in a row, bare in m, with --units field in ft.")
    ] = ROW,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    out: Annotated[
        Path | None, file_option("--out", "A row for every step of casing, .csv, .parquet or .xlsx, or its picture.")
    ] = None,
    plot: Annotated[
        Path | None, file_option("--plot", f"Side force, grooves and burst pressure by depth, {PICTURE_HELP}.")
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Find the wear of casing by a string that turns: the depth of its groove, and the burst pressure that is left.

    The casing is a `casing` of an interval of the hole.  Its groove is V = WF·F·s for every metre: wear factor, side
    force, sliding distance.
    """
    job = Job(case_file, overrides, friction, units=units, strict=strict, quiet=quiet, out=out, plot=plot, draws=True)
    asked: dict[str, Any] = {
        "bit_depths": depths.depths(job.case, units),
        "duration": si(hours, units), "penetration": si(penetration, units), "rpm": si(rpm, units),
        "wear_factor": _read_factors(wear_factor), "operation": operation, "step": step.si(units),
    }  # fmt: skip
    if operation not in TURNING:
        raise InputError(" or ".join(TURNING), key="--operation", value=operation)
    job.warn([operation], rpm=asked["rpm"])
    with job.bar() as show:
        table = casing_wear(job.case, **asked, progress=show)
    lines = _facts(table, units)

    def draw(path: Path) -> list[Path]:
        from fctd.plots.wear import wear_panels

        return draw_panels(path, wear_panels(job.case, table, units, [*lines, *job.lines]))

    job.end(
        {"--out": table, "--plot": draw}, lambda: _print(job, table, lines), rates=([operation], {"rpm": asked["rpm"]}),
        more={key: table.attrs[key] for key in ("turns", "time_s", "wear_factors", "doubted")},
        acceptable=not table.attrs["doubted"], codes=["worn_through"] if (table["high_worn"] >= 1).any() else [],
    )  # fmt: skip


def _read_factors(text: str) -> list[float]:
    """The wear factors of X or LOW:HIGH [1e-10/psi]."""
    try:
        return [float(part) for part in text.split(":")]
    except ValueError:
        expected = "a wear factor in 1e-10/psi, or LOW:HIGH, such as 2:10"
        raise InputError(expected, key="--wear-factor", value=text) from None


def _facts(table: "pd.DataFrame", units: System) -> list[str]:
    """The schedule and the deepest groove of each casing, as lines."""
    turns, hours, (low, high) = table.attrs["turns"], table.attrs["time_s"] / 3600, table.attrs["wear_factors"]
    factors = f"wear factor {low:g}" + ("" if low == high else f" to {high:g}") + "e-10/psi"
    lines = [f"{turns:.0f} turns in {hours:.4g} h, {factors}"]
    for name, of in table.groupby("casing", sort=False):
        row = rows_of(of)[int(np.argmax(of["high_groove_m"].to_numpy()))]
        if row["high_groove_m"] == 0:
            lines.append(f"{name}: no wear")
            continue
        depth, groove, worn = (_span(row, *names, units) for names in (GROOVES, WORN, LEFT))
        lines.append(
            f"{name}: deepest groove at {in_words(row['md_m'], 'md_m', units)}, {depth}, {groove} of the wall; "
            f"burst {worn} of {in_words(row['burst_Pa'], 'burst_Pa', units)}"
            + ("; the wall may be worn through" if row["high_worn"] >= 1 else "")
        )
    if doubted := table.attrs["doubted"]:
        last = max(doubted)
        place = in_words(last, "bit_depth_m", units)
        words = told(doubted[last], units)
        lines.append(f"the string is doubtful at {counted(len(doubted), 'bit depth')}, the last {place}: {words}")
    return lines


def _span(row: dict[str, Any], first: str, last: str, units: System) -> str:
    """Two numbers of a row as a range with one unit, one number where they are equal."""
    factor, unit = _unit(first, units)
    values = [row[name] * factor for name in (first, last)]
    numbers = [f"{value:.0f}" if value >= 100 else f"{value:.3g}" for value in values]
    return f"{numbers[0] if numbers[0] == numbers[1] else ' to '.join(numbers)} {unit}"


def _unit(column: str, units: System) -> tuple[float, str]:
    """Factor and label of a column; shares in per cent."""
    return (100.0, "%") if column in WORN else shown(column, units)


def _print(job: Job, table: "pd.DataFrame", lines: list[str]) -> None:
    """Rows of each casing, with that of its deepest groove, and the lines."""
    unit = {name: _unit(name, job.units) for name in SHOWN}
    for casing, of in table.groupby("casing", sort=False):
        job.say(printable(str(casing)))
        rows = (
            [number(row[name] * unit[name][0], DIGITS[name][job.units == "field"]) for name in SHOWN]
            for row in rows_of(of, SCREEN_ROWS, [int(np.argmax(of["high_groove_m"].to_numpy()))])
        )
        heads = (Head(words, unit[name][1], numbers=True) for name, words in SHOWN.items())
        print_table(shown_table(heads, rows), numbers=WHOLE)
    job.say(
        *map(printable, lines),
        "side forces are those on 30 ft of string; burst is 0.875·2Yt/D of the wall t that is left, which a groove "
        "weakens all around",
    )
