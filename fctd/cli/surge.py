"""``fctd surge CASE``: what a trip adds to the pressure in the hole, and the fastest trip that the hole bears."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.text import printable
from fctd.case.units import SPEED
from fctd.cli.chart import DEPTHS_HELP
from fctd.cli.check import facts_table
from fctd.cli.hydraulics import Beside, number, read_eccentricity
from fctd.cli.limits import rows_of
from fctd.cli.options import (
    CaseFile,
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    print_written,
    read_case,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.pictures import PICTURE_HELP, draw_panels
from fctd.cli.quantities import DEPTHS, TO_TOTAL_DEPTH, Given, QuantityOption, quantity, several
from fctd.cli.steady import check_targets, file_option, in_units, metadata_of_case, row_bar
from fctd.hydraulics.surge import ENDS, FASTEST, TRIPS, fastest_trips, surge_pressures
from fctd.results.case_facts import flow_curves
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, reworded, shown

if TYPE_CHECKING:
    import pandas as pd

SCREEN_ROWS: Final = 24  # of an operation and end
# Columns on the screen, with headings: of surges, and of the fastest trips.
SURGES: Final = {
    "bit_depth_m": "bit", "speed_m_s": "speed", "surge_Pa": "at the bit", "shoe_surge_Pa": "at the shoe",
    "density_bit_kg_m3": "density, bit", "into_bore_m3_s": "into bore", "lift_N": "hook load less",
}  # fmt: skip
TRIPPED: Final = {"bit_depth_m": "bit", "fastest_m_s": "fastest", "md_m": "limit at"}


USUAL: Final = QuantityOption("--speed", SPEED).parse("0.5 m/s")
MOST: Final = QuantityOption("--most", SPEED).parse(f"{FASTEST:g} m/s")


def surge_command(
    case_file: CaseFile,
    operations: Annotated[
        list[str], typer.Option("--operation", metavar="KINDS", help=f"{' or '.join(TRIPS)}; default: both.")
    ] = [],  # noqa: B006 (typer copies it)
    ends: Annotated[
        list[str],
        typer.Option(
            "--end", metavar="ENDS", help=f"{', '.join(ENDS)}, several with commas, or all; default: the case's."
        ),
    ] = [],  # noqa: B006
    speeds: Annotated[
        list[Given],
        quantity(USUAL.option, "V", "Speeds of the pipe, '0.5 m/s,1 m/s'; bare with --units field in ft/min."),
    ] = [USUAL],  # noqa: B006
    depths: Annotated[
        Given, quantity(DEPTHS, "D or FROM:TO:STEP", f"{DEPTHS_HELP} Or one depth, such as shoe.")
    ] = TO_TOTAL_DEPTH,
    most: Annotated[
        Given, quantity(MOST.option, "V", "Fastest speed of the hoist, of trips within the window.")
    ] = MOST,
    eccentricity: Beside = None,
    overrides: Overrides = [],  # noqa: B006
    out: Annotated[
        Path | None,
        file_option("--out", "A row for every trip, speed and depth, .csv, .parquet or .xlsx, or its picture."),
    ] = None,
    trips: Annotated[
        Path | None, file_option("--trips", "The fastest trip at every depth, .csv, .parquet or .xlsx.")
    ] = None,
    plot: Annotated[Path | None, file_option("--plot", f"Surges and fastest trips by depth, {PICTURE_HELP}.")] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Find surge and swab of trips, and with a `wellbore.window` the fastest trip within it.

    The string moves at constant speed, with its end open, closed, or with a float.
    """
    table_out, plot = check_targets(out, plot, {})
    check_targets(trips, None, {})
    case = read_case(case_file, changes_of(overrides))
    for key, path in (("--out", out), ("--trips", trips), ("--plot", plot)):
        refuse_sources(case, path, key)
    if trips is not None and not case.wellbore.window:
        raise InputError("a case with a [[wellbore.window]], within which trips stay", key="--trips", value=trips)
    rates, hoist = several(speeds, units), most.si(units)
    closed = list(ENDS) if _words(ends) == ["all"] else _words(ends)
    asked: dict[str, Any] = {
        "bit_depths": depths.depths(case, units), "operation": _words(operations) or TRIPS,
        "end": closed, "eccentricity": read_eccentricity(eccentricity, case),
    }  # fmt: skip
    warnings = warnings_of(case)
    told = tell(case, warnings, strict=strict, units=units)
    with row_bar(quiet) as bar:
        task = bar.add_task(printable(case.name), total=None)

        def show(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)

        surges = surge_pressures(case, rates, **asked, progress=show)
        fastest = fastest_trips(case, **asked, most=hoist, progress=show) if case.wellbore.window else None
    metadata, written = metadata_of_case(case, warnings) | {"units": units}, []
    try:  # written before anything is printed, as the terminal may be closed
        if table_out is not None:
            written += write_table(in_units(units, surges), table_out, metadata)
        if trips is not None and fastest is not None:
            written += write_table(in_units(units, fastest), trips, metadata)
        if plot is not None:
            from fctd.plots.flow import surge_panels

            lines = ["constant speed; API RP 13D", *(f"warning {text}" for text in told)]
            written += draw_panels(plot, surge_panels(case, surges, fastest, units, lines))
    finally:
        _print(case, surges, fastest, units)
    print_written(written)


def _words(texts: Sequence[str]) -> list[str]:
    """The parts of options that may be repeated, or have commas between them."""
    return [part.strip() for text in texts for part in text.split(",")]


def _print(case: Case, surges: "pd.DataFrame", fastest: "pd.DataFrame | None", units: System) -> None:
    screen.print(printable(case.name), style="bold", soft_wrap=True)
    screen.print(facts_table(flow_curves(case.mud, units)))
    for (kind, end), of in surges[surges["reason"] == "none"].groupby(["operation", "end"], sort=False):
        screen.print(f"{kind}, {end} end")
        screen.print(_table(of, SURGES, "regime", units))
        if fastest is not None:
            trip = fastest[(fastest["operation"] == kind) & (fastest["end"] == end)]
            screen.print(_table(trip, TRIPPED, "reason", units))
            screen.print(_duration(trip, units), soft_wrap=True)
    metre = shown("bit_depth_m", units)
    for reason, of in surges[surges["reason"] != "none"].groupby("reason", sort=False):
        depths = ", ".join(f"{depth * metre.factor:.0f}" for depth in of["bit_depth_m"].unique())
        screen.print(f"at {depths} {metre.label}: {reworded(str(reason), units)}", soft_wrap=True)


def _duration(trip: "pd.DataFrame", units: System) -> str:
    """The time of a trip between the first and the last depth, in words."""
    time, metre = float(trip["time_s"].iloc[-1]), shown("bit_depth_m", units)
    ends = sorted(trip["bit_depth_m"].iloc[[0, -1]] * metre.factor)
    if np.isnan(time):
        return "no trip within the window between all of these depths"
    if len(trip) < 2:
        return "several depths (--depths FROM:TO:STEP) give the time of a trip"
    return f"{time / 3600:.2f} h between {ends[0]:.0f} and {ends[1]:.0f} {metre.label}, connections included"


def _table(of: "pd.DataFrame", columns: dict[str, str], last: str, units: System) -> Table:
    """Columns of a table and a last one of words, at evenly spread rows where they are many."""
    unit = {name: shown(name, units) for name in columns}
    table = Table(
        *(Column(f"{words}\n{unit[name].label}", justify="right") for name, words in columns.items()),
        Column("" if last == "reason" else last, overflow="fold"), box=SIMPLE_HEAD, collapse_padding=True,
        pad_edge=False,
    )  # fmt: skip
    rows = rows_of(of)
    for k in np.unique(np.linspace(len(rows) - 1, 0, min(SCREEN_ROWS, len(rows))).round().astype(int)):
        words = "" if rows[k][last] == "none" else reworded(str(rows[k][last]), units)
        table.add_row(*(number(rows[k][name] * unit[name].factor) for name in columns), words)
    return table
