"""``fctd monitor CASE SERIES``: apparent friction factors over depth from the rig's readings, and alarms."""

from pathlib import Path
from time import sleep
from typing import Annotated, NoReturn

import numpy as np
import typer

from fctd import plots
from fctd.case.errors import InputError, naming
from fctd.case.friction import parse_frictions
from fctd.case.load import naming_file
from fctd.case.systems import told
from fctd.case.tables.headers import parse_choices
from fctd.case.text import counted, printable
from fctd.cli import quantities
from fctd.cli.job import WHOLE, Job, headed, print_table, right, rows_of
from fctd.cli.options import (
    CaseFile,
    Overrides,
    Quiet,
    Strict,
    Units,
    messages,
    read_share,
    screen,
)
from fctd.cli.pictures import PICTURE_HELP, PICTURES
from fctd.cli.quantities import Given, quantity
from fctd.cli.roadmap import DEPTHS, Drawing, solved
from fctd.cli.steady import DEPTHS_HELP, file_option, in_units
from fctd.monitoring.alarm import Alarm
from fctd.monitoring.chart import Fit
from fctd.monitoring.friction import parse_uncertainty
from fctd.monitoring.monitor import Monitor, Monitored, result_of
from fctd.monitoring.quantities import SERIES
from fctd.monitoring.roadmap import FAN
from fctd.monitoring.series import read_series
from fctd.monitoring.text_series import Tail
from fctd.plots import DRAWN
from fctd.results.shown_tables import number, of_column, shown_table
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System
from fctd.store.origin import versions

SCREEN_ROWS = 30
LONGEST_POLL = 3600.0  # [s]


def monitor_command(
    case_file: CaseFile,
    series: Annotated[
        Path,
        typer.Argument(
            help="Readings of the rig over time or depth: text, Parquet, LAS, WITSML log.", show_default=False
        ),
    ],
    columns: Annotated[
        list[str],
        typer.Option(
            "--columns",
            metavar="QUANTITY=HEADER",
            help="Header of a quantity, 'torque=TQA [kN.m]', or its unit, torque.unit=kN.m; quantities: "
            f"{', '.join(field.key for field in SERIES.fields)}; may be repeated.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    fit: Annotated[
        Fit | None,
        typer.Option(
            "--fit",
            help="Intervals whose factor is inferred; default: open where the case names kinds.",
            show_default=False,
        ),
    ] = None,
    uncertainty: Annotated[
        list[str],
        typer.Option(
            "--uncertainty",
            metavar="NAME=VALUE",
            help="Standard deviation of hook_load, torque, cased, block_weight or torque_offset; default: "
            "'hook_load=1 t', torque=4%; may be repeated.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    step: Annotated[str, typer.Option("--step", metavar="SHARE", help="Change of the factor to be found.")] = "25%",
    readings: Annotated[
        float, typer.Option("--false-alarm-in", metavar="N", help="Readings in which one false alarm is accepted.")
    ] = 50.0,
    follow: Annotated[
        bool, typer.Option("--follow", help="Wait for rows of a growing text file, until Ctrl-C.")
    ] = False,
    poll: Annotated[
        float, typer.Option("--poll", metavar="SECONDS", help="With --follow: time between two looks.")
    ] = 1.0,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    out: Annotated[Path | None, file_option("--out", "The stretches, a row for each, .csv, .parquet or .xlsx.")] = None,
    plot: Annotated[
        Path | None, file_option("--plot", "Stretches and apparent friction over depth, .png, .svg or .pdf.")
    ] = None,
    chart: Annotated[
        Path | None,
        file_option(
            "--chart", f"The readings over a fan of friction factors, drawn anew as they come, {PICTURE_HELP}."
        ),
    ] = None,
    depths: Annotated[
        Given | None,
        quantity(
            quantities.DEPTHS,
            "FROM:TO:STEP",
            f"With --chart: {DEPTHS_HELP} Default: {DEPTHS} depths from the last shoe to the end of the hole.",
        ),
    ] = None,
    frictions: Annotated[
        list[str],
        typer.Option(
            "--friction",
            metavar="X",
            help="With --chart: the fan, as of fctd chart; default: "
            f"{', '.join(f'{factor:g}' for factor in FAN)} in the intervals of --fit.",
        ),
    ] = [],  # noqa: B006
    limits: Annotated[
        bool, typer.Option("--limits", help="With --chart: draw the limits of fctd limits as lines.")
    ] = False,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Infer friction factors over depth from the rig's readings, and say where they change."""
    for key, value in {"--depths": depths, "--friction": frictions, "--limits": limits}.items():
        if value and chart is None:
            raise InputError("--chart beside it, the picture that shows it", key=key, value=value)
    factors = parse_frictions(frictions, "--friction")
    job = Job(
        case_file, overrides, units=units, strict=strict, quiet=quiet, out=out, reads=[series],
        files={"--plot": (plot, DRAWN), "--chart": (chart, PICTURES)},
    )  # fmt: skip
    said = parse_choices(columns, SERIES)
    with naming_file(job.case):
        spread = parse_uncertainty(uncertainty, "--uncertainty")
        watch = Monitor(job.case, fit, spread, None, read_share(step, "--step"), readings)
    if not 0 < poll <= LONGEST_POLL:
        raise InputError(f"seconds above 0 and at most {LONGEST_POLL:g}", key="--poll", value=poll)
    job.warn()
    table = None if follow else read_series(series, said)
    drawing = None
    if chart is not None:
        with naming_file(job.case):
            drawing = solved(job, watch, chart, depths, factors, limits)
    if table is None:
        try:
            _follow(watch, Tail(series, said), poll, units, drawing)
        except KeyboardInterrupt:
            _print_alarms(watch.finish(), units)
            _end(job, watch, drawing, interrupted=True)
            raise
    with naming(series):
        _print_alarms([*watch.feed(table), *watch.finish()], units)
    _end(job, watch, drawing)


def _follow(watch: Monitor, tail: Tail, poll: float, units: System, drawing: Drawing | None) -> NoReturn:
    """Print alarms as their rows come, and draw the roadmap; ends by KeyboardInterrupt alone."""
    while True:
        with naming(tail.path):
            rows = tail.rows()
            if rows is not None:
                _print_alarms(watch.feed(rows), units)
        if drawing is not None:
            drawing.follow(watch)
        sleep(poll)


def _print_alarms(alarms: list[Alarm], units: System) -> None:
    for alarm in alarms:
        screen.print(f"alarm: {told(alarm.sentence, units)}", soft_wrap=True, style="bold")


def _end(job: Job, watch: Monitor, drawing: Drawing | None, *, interrupted: bool = False) -> None:
    """Write table and pictures, print what was found, and end the command, or leave that to what interrupted it."""
    found, units = result_of(watch), job.units
    about = {
        "case": job.case.model_dump(mode="json"), "units": units, "fit": watch.chart.fit, "told": list(found.told),
        "alarms": [alarm.sentence for alarm in found.alarms], "versions": versions(),
    }  # fmt: skip

    def show() -> None:
        if not job.quiet:
            _print(job, found)
        for line in found.told:
            messages.print(line, soft_wrap=True)

    job.end(
        {
            "--out": lambda path: write_table(in_units(units, found.stretches), path, about),
            "--plot": lambda path: plots.save(plots.monitor_figure(found, job.case, units=units), path),
            "--chart": None if drawing is None else lambda _: drawing.write(watch),
        },
        show, title="", codes=["alarm"] if watch.alarms and not interrupted else [],
        acceptable=interrupted or any(np.isfinite(one.factor) for one in watch.found),
    )  # fmt: skip


def _print(job: Job, found: Monitored) -> None:
    """Print a line for each stretch with a factor, evenly picked, and what else there is."""
    stretches = found.stretches
    inferred = stretches[stretches["friction"].notna()]
    title = f"{job.case.name}; friction factor of {found.chart.fit} hole"
    screen.print(printable(title), style="bold", soft_wrap=True)
    bit, *loads = headed(
        {"bit_depth_m": "bit", "weight_indicator_N": "weight ind.", "drive_torque_N_m": "torque"}, job.units
    )
    rows = (
        (
            row["mode"], of_column("bit_depth_m", row["bit_depth_m"], job.units, 0), row["samples"],
            of_column("weight_indicator_N", row["weight_indicator_N"], job.units, 1),
            of_column("drive_torque_N_m", row["drive_torque_N_m"], job.units, 2),
            number(row["friction"], 2), f"{row['friction_low']:z.2f} to {row['friction_high']:z.2f}",
        )
        for row in rows_of(inferred, SCREEN_ROWS)
    )  # fmt: skip
    print_table(
        shown_table(["stretch", bit, *right("rows"), *loads, *right("μ", "95 % band")], rows),
        words=WHOLE,
        collapse_padding=False,
    )
    left = stretches.loc[stretches["friction"].isna(), "left_out"].value_counts()
    reasons = "".join(f"; {count}: {why}" for why, count in left.items())
    alarms = counted(len(found.alarms), "alarm")
    job.say(f"{counted(len(stretches), 'stretch')}, {len(inferred)} with a friction factor{reasons}; {alarms}")
