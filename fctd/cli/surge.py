"""``fctd surge CASE``: what a trip adds to the pressure in the hole, and the fastest trip that the hole bears."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import numpy as np
import typer

from fctd.case.errors import InputError
from fctd.case.systems import SPEED, told
from fctd.case.units import FASTEST as MOST_SPEED
from fctd.cli.hydraulics import Beside, read_eccentricity
from fctd.cli.job import FOLD, Depths, Job, headed, numbers, print_facts, print_table, rows_of
from fctd.cli.options import CaseFile, Overrides, Quiet, Strict, Units, screen
from fctd.cli.pictures import PICTURE_HELP, TABLES, draw_panels
from fctd.cli.quantities import TO_TOTAL_DEPTH, Given, QuantityOption, quantity, several
from fctd.cli.steady import file_option
from fctd.hydraulics.surge import A_MINUTE, ENDS, FASTEST, TRIPS, fastest_trips, surge_pressures
from fctd.results.case_facts import flow_curves
from fctd.results.shown_tables import shown_table
from fctd.results.unit_systems import System, shown

if TYPE_CHECKING:
    import pandas as pd

SCREEN_ROWS: Final = 24  # of an operation and end
# Columns on the screen, with headings: of surges, and of the fastest trips.
SURGES: Final = {
    "bit_depth_m": "bit", "speed_m_s": "speed", "surge_Pa": "at the bit", "shoe_surge_Pa": "at the shoe",
    "density_bit_kg_m3": "density, bit", "into_bore_m3_s": "into bore", "lift_N": "hook load less",
}  # fmt: skip
TRIPPED: Final = {"bit_depth_m": "bit", "fastest_m_s": "fastest", "md_m": "limit at"}


USUAL: Final = QuantityOption("--speed", SPEED, at_most=MOST_SPEED, likely_units=A_MINUTE).parse("0.5 m/s")
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
    depths: Depths = TO_TOTAL_DEPTH,
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
    job = Job(
        case_file, overrides, units=units, strict=strict, quiet=quiet, out=out, plot=plot, draws=True,
        files={"--trips": (trips, TABLES)},
    )  # fmt: skip
    case = job.case
    if trips is not None and not case.wellbore.window:
        raise InputError("a case with a [[wellbore.window]], within which trips stay", key="--trips", value=trips)
    rates, hoist = several(speeds, units), most.si(units)
    asked: dict[str, Any] = {
        "bit_depths": depths.depths(case, units), "operation": _words(operations) or TRIPS,
        "end": list(ENDS) if _words(ends) == ["all"] else _words(ends),
        "eccentricity": read_eccentricity(eccentricity, case),
    }  # fmt: skip
    job.warn()
    with job.bar() as show:
        surges = surge_pressures(case, rates, **asked, progress=show)
        fastest = fastest_trips(case, **asked, most=hoist, progress=show) if case.wellbore.window else None

    def draw(path: Path) -> list[Path]:
        from fctd.plots.flow import surge_panels

        lines = ["constant speed; API RP 13D", *job.lines]
        return draw_panels(path, surge_panels(case, surges, fastest, units, lines))

    job.end({"--out": surges, "--trips": fastest, "--plot": draw}, lambda: _print(job, surges, fastest))


def _words(texts: Sequence[str]) -> list[str]:
    """The parts of options that may be repeated, or have commas between them."""
    return [part.strip() for text in texts for part in text.split(",")]


def _print(job: Job, surges: "pd.DataFrame", fastest: "pd.DataFrame | None") -> None:
    units = job.units
    print_facts(flow_curves(job.case.mud, units))
    for (kind, end), of in surges[surges["reason"] == "none"].groupby(["operation", "end"], sort=False):
        screen.print(f"{kind}, {end} end")
        _print_rows(of, SURGES, "regime", units)
        if fastest is not None:
            trip = fastest[(fastest["operation"] == kind) & (fastest["end"] == end)]
            _print_rows(trip, TRIPPED, "reason", units)
            job.say(_duration(trip, units))
    job.say_reasons(surges)


def _duration(trip: "pd.DataFrame", units: System) -> str:
    """The time of a trip between the first and the last depth, in words."""
    time, metre = float(trip["time_s"].iloc[-1]), shown("bit_depth_m", units)
    ends = sorted(trip["bit_depth_m"].iloc[[0, -1]] * metre.factor)
    if np.isnan(time):
        return "no trip within the window between all of these depths"
    if len(trip) < 2:
        return "several depths (--depths FROM:TO:STEP) give the time of a trip"
    return f"{time / 3600:.2f} h between {ends[0]:.0f} and {ends[1]:.0f} {metre.label}, connections included"


def _print_rows(of: "pd.DataFrame", columns: dict[str, str], last: str, units: System) -> None:
    """Print columns of a table and a last one of words, at evenly spread rows where they are many."""
    rows = (
        (*numbers(row, columns, units), "" if row[last] == "none" else told(row[last], units))
        for row in rows_of(of, SCREEN_ROWS)
    )
    print_table(shown_table([*headed(columns, units), "" if last == "reason" else last], rows), words=FOLD)
