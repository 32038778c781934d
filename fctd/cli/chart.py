"""``fctd chart CASE``: steady strings of several operations at many bit depths."""

from collections import Counter
from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.box import SIMPLE_HEAD
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.friction import parse_frictions
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.text import printable
from fctd.case.units import LENGTH
from fctd.cli.options import (
    CaseFile,
    Overrides,
    Quiet,
    Strict,
    changes_of,
    finish,
    messages,
    print_written,
    read_case,
    read_quantity,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.pictures import (
    PICTURE_HELP,
    ShownLoad,
    ShownSideForce,
    draw_chart,
    draw_profiles,
)
from fctd.cli.steady import (
    KIND_HELP,
    ResolveBuckling,
    Rpm,
    Speed,
    Units,
    check_targets,
    file_option,
    in_units,
    metadata_of,
    print_segments,
    read_depth,
    read_drive,
)
from fctd.model.operations import rates_of_all
from fctd.plots.loads import ChartLook
from fctd.results.columns import BUCKLED, DEPTH, IN_CHART
from fctd.results.measured import read_measured
from fctd.results.notes import MEANINGS, meanings_of
from fctd.results.series import FRICTION_LABEL, in_words
from fctd.results.status import SteadyStatus
from fctd.results.tables import write_table
from fctd.results.unit_systems import System, reworded, shown
from fctd.steady.equilibrium import Solver
from fctd.steady.torque_drag import Row, chart_rows, depths_between, with_friction

if TYPE_CHECKING:
    import pandas as pd

DEPTHS_HELP = (
    "Bit depths, 1750:2450:10 in m, with --units field in ft, '5000 ft:8000 ft:30 ft' or shoe:td:50; the last is "
    "always among them."
)
MOST_DEPTHS = 10_000  # more is a slip in the step
SCREEN_ROWS = 36
# Columns of a chart on the screen.
SHOWN = [column for column in (DEPTH, *IN_CHART) if column.heading]


def chart_command(
    case_file: CaseFile,
    operations: Annotated[
        list[str],
        typer.Option("--operation", metavar="KINDS", help=f"{KIND_HELP}; several with commas between them, or all."),
    ],
    depths: Annotated[
        str,
        typer.Option("--depths", metavar="FROM:TO:STEP", help=DEPTHS_HELP),
    ],
    frictions: Annotated[
        list[str],
        typer.Option(
            "--friction",
            metavar="X",
            help="Friction factor of every interval, 0.25, a list, 0.1,0.2,0.3, or by kind, cased=0.2,open=0.3; "
            "may be repeated.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    speed: Speed = None,
    rpm: Rpm = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    out: Annotated[
        Path | None, file_option("--out", "The chart, a row for every string, .csv, .parquet or .xlsx, or its picture.")
    ] = None,
    plot: Annotated[Path | None, file_option("--plot", f"Load and torque against depth, {PICTURE_HELP}.")] = None,
    plot_profile: Annotated[
        Path | None,
        file_option("--plot-profile", f"Profiles at the last possible depth, first friction, {PICTURE_HELP}."),
    ] = None,
    load: ShownLoad = "string",
    side_force: ShownSideForce = "length",
    measured: Annotated[
        Path | None,
        file_option("--measured", "Measured rows to draw, .csv with bit_depth_m, operation, hookload_kN, …"),
    ] = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Compute a torque-and-drag chart: a row for every operation, friction factor and bit depth."""
    out, plot = check_targets(out, plot, plot_profile)
    case = read_case(case_file, changes_of(overrides, resolve=resolve_buckling))
    for key, path in {"--out": out, "--plot": plot, "--plot-profile": plot_profile}.items():
        refuse_sources(case, path, key)
    bit_depths = read_depths(depths, case, units)
    points_measured = None if measured is None else _measured(measured, case, plot)
    names = [name.strip() for text in operations for name in text.split(",")]
    kinds = list(dict.fromkeys(kind for name in names for kind in (KINDS if name == "all" else [name])))
    factors = parse_frictions(frictions, "--friction")
    drive = read_drive(speed, rpm, units)
    warnings = warnings_of(case, kinds, **drive, frictions=factors)
    told = tell(case, warnings, strict=strict, units=units)

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=messages, disable=quiet, transient=True) as bar:
        task = bar.add_task("compiling", total=None)

        def show(done: int, total: int) -> None:
            bar.update(task, description=printable(case.name), completed=done, total=total)

        rows = chart_rows(case, kinds, bit_depths, factors or None, **drive, progress=show)

    # The last depth at which string and hole fit.
    possible = [row["bit_depth_m"] for row in rows if row["status"] != SteadyStatus.NOT_POSSIBLE]
    last = max(possible, default=float("nan"))
    meanings = meanings_of(row["notes"] for row in rows)
    written = []
    try:  # written before anything is printed, as the terminal may be closed
        if out is not None:
            metadata = metadata_of(case, units, kinds, drive, warnings) | {"notes": meanings}
            written += write_table(rows if units == "si" else in_units(units, _frame(rows)), out, metadata)
        if plot is not None:
            look = ChartLook(load, rates_of_all(case, kinds, **drive), points_measured, told)
            written += draw_chart(plot, _frame(rows), units, case, look)
        if plot_profile is not None:
            one = with_friction(case, factors[0]) if factors else case
            solver, rates = Solver(one), rates_of_all(one, kinds, **drive)
            points = [solver.solve(kind, rates[kind], last) for kind in kinds]
            written += draw_profiles(plot_profile, points, units=units, force=side_force, warnings=told)
    finally:
        _print_chart(rows, case.name, units)
        print_segments(case, last, units)
    print_written(written)
    acceptable = all(SteadyStatus(status).acceptable for status in {row["status"] for row in rows})
    finish(acceptable, meanings, strict)


def _frame(rows: list[Row]) -> "pd.DataFrame":
    import pandas as pd  # slow to import

    return pd.DataFrame(rows)


def read_depths(text: str, case: Case, units: System = "si") -> list[float]:
    """Bit depths [m] of FROM:TO:STEP, TO included; ``shoe`` is the last casing shoe, ``td`` the end of the hole.

    Bare numbers are in the system's unit.
    """
    parts = text.split(":")
    if len(parts) != 3:
        raise InputError(
            "FROM:TO:STEP, such as 1750:2450:10, '5000 ft:8000 ft:30 ft' or shoe:td:50", key="--depths", value=text
        )
    first, last = (read_depth(part, case, "--depths", units, given=text) for part in parts[:2])
    step = read_quantity(parts[2], LENGTH, "--depths", units)
    if not (first <= last and step > 0):
        raise InputError("depths that rise: TO at least FROM, and a STEP above 0", key="--depths", value=text)
    steps = (last - first) / step
    if steps >= MOST_DEPTHS:
        raise InputError(f"at most {MOST_DEPTHS} depths", key="--depths", value=text)
    return depths_between(first, last, step)


def _measured(path: Path, case: Case, plot: Path | None) -> "pd.DataFrame":
    """Measured rows, which only a picture shows."""
    if plot is None:
        raise InputError("--plot beside it, the picture to draw them in", key="--measured", value=path)
    return read_measured(path, case)


def _print_chart(rows: list[Row], name: str, units: System) -> None:
    """Print a table that fits the screen, and a line for each run of rows with another status or a note."""
    units_of = {column.name: shown(column.name, units) for column in SHOWN}
    series: dict[tuple[str, str], list[Row]] = {}
    for row in rows:
        series.setdefault((row["operation"], reworded(row[FRICTION_LABEL], units)), []).append(row)
    frictions = list(dict.fromkeys(friction for _, friction in series))
    fan = len(frictions) > 1  # one set of factors, which may be a long text, stands above the table
    screen.print(printable(name if fan else f"{name}; {in_words(frictions[0])}"), style="bold", soft_wrap=True)
    table = Table(box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False)
    table.add_column("operation", no_wrap=True)
    if fan:
        table.add_column("μ", overflow="fold")
    for column in SHOWN:
        table.add_column(f"{column.heading}\n{units_of[column.name].label}", justify="right", overflow="fold")
    buckled = not all(np.isnan(row["buckled_from_md_m"]) for row in rows)
    if buckled:
        table.add_column(f"buckled\n{units_of[DEPTH.name].label}", overflow="fold")
    table.add_column("status", overflow="fold")
    each, printed = max(SCREEN_ROWS // len(series), 1), 0
    for (operation, friction), of in series.items():
        # Evenly spread rows, always with the deepest one.
        picked = np.unique(np.linspace(len(of) - 1, 0, min(each, len(of))).round().astype(int))
        printed += len(picked)
        for k, row in enumerate(of[i] for i in picked):
            values = [
                "–" if np.isnan(row[name]) else f"{row[name] * units_of[name].factor:z.{digits}f}"
                for name, digits in ((column.name, column.digits) for column in SHOWN)
            ]
            if buckled:
                values.append(_buckled(row, units_of[DEPTH.name].factor))
            names = (operation, friction) if fan else (operation,)
            table.add_row(*(("",) * len(names) if k else names), *values, row["status"])
    screen.print(table)
    counts = ", ".join(f"{count} {status}" for status, count in Counter(row["status"] for row in rows).most_common())
    left_out = f"; {printed} of them above, all in the file of --out" if printed < len(rows) else ""
    screen.print(f"{len(rows)} rows: {counts}{left_out}", soft_wrap=True)
    depth = units_of["bit_depth_m"]
    for (operation, friction), of in series.items():
        name = f"{operation}, friction {friction}" if fan else operation
        for line in _exceptions(of, depth.factor, depth.label):
            messages.print(reworded(f"{name}: {line}", units), soft_wrap=True)


def _buckled(row: Row, factor: float) -> str:
    """Mode and depths of the buckled part of a string, "helical 540–1500"."""
    first, last = (row[column.name] * factor for column in BUCKLED)
    return "–" if np.isnan(first) else f"{row['buckling']} {first:.0f}–{last:.0f}"


def _exceptions(rows: list[Row], factor: float, label: str) -> list[str]:
    """The runs of rows of one series that are not converged, and those with the same note, a line each."""
    depths = [row["bit_depth_m"] * factor for row in rows]
    reasons = {row["status"]: row["reason"] for row in rows}  # the last, at the greatest depth, of each status
    lines = [
        f"{status} at {where}: {reasons[status]}"
        for status, where in _runs([row["status"] for row in rows], depths, label)
        if status != SteadyStatus.CONVERGED
    ]
    for code, meaning in MEANINGS.items():
        noted = [code in row["notes"].split(", ") for row in rows]
        lines += [
            f"note {code} at {where}: {meaning.headline}: {meaning.remedy}"
            for has, where in _runs(noted, depths, label)
            if has
        ]
    return lines


def _runs(values: Sequence[Any], depths: Sequence[float], label: str) -> list[tuple[Any, str]]:
    """Every run of equal values, with its depths as text."""
    found = []
    for value, run in groupby(zip(values, depths, strict=True), key=lambda row: row[0]):
        at = [depth for _, depth in run]
        span = f"{at[0]:g}" if len(at) == 1 else f"{at[0]:g} to {at[-1]:g}"
        found.append((value, f"{span} {label} ({len(at)} of {len(depths)})"))
    return found
