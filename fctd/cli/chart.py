"""``fctd chart CASE``: steady strings of several operations at many bit depths."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any
from uuid import uuid4

import typer

from fctd.calibration.measured import read_measured
from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.friction import parse_frictions
from fctd.case.load import Case, with_friction
from fctd.case.text import printable
from fctd.cli.chart_table import print_chart
from fctd.cli.keeping import (
    EVERY_CHART,
    AcceptChanges,
    CheckpointEvery,
    MemoryLimit,
    OptionalCase,
    Restart,
    Resume,
    SaveOptions,
    TimeLimit,
    begun_folder,
    case_of,
    description_of,
    resumed_folder,
    say_how_to_go_on,
)
from fctd.cli.options import (
    FAILED,
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    finish,
    messages,
    print_written,
    read_case,
    refuse_sources,
    tell,
    warn,
)
from fctd.cli.pictures import (
    PICTURE_HELP,
    ShownLoad,
    ShownSideForce,
    draw_chart,
    draw_profiles,
)
from fctd.cli.quantities import DEPTHS, Given, quantity
from fctd.cli.steady import (
    DRIVE,
    KIND_HELP,
    Flow,
    ResolveBuckling,
    Rpm,
    Speed,
    check_targets,
    file_option,
    in_units,
    metadata_of,
    print_segments,
    read_drive,
    read_kinds,
    row_bar,
)
from fctd.model.operations import rates_of_all
from fctd.plots.loads import ChartLook, usual_load
from fctd.results.notes import meanings_of
from fctd.results.status import SteadyStatus
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System
from fctd.steady.chart_saver import ChartSaver
from fctd.steady.equilibrium import Solver
from fctd.steady.margin_table import limits_of, of_lines
from fctd.steady.torque_drag import Row, chart_rows
from fctd.store.limits import LimitReached

if TYPE_CHECKING:
    import pandas as pd

DEPTHS_HELP = (
    "Bit depths, 1750:2450:10 in m, with --units field in ft, '5000 ft:8000 ft:30 ft' or shoe:td:50; the last is "
    "always among them."
)
FrictionFan = Annotated[
    list[str],
    typer.Option(
        "--friction",
        metavar="X",
        help="Friction factor of every interval, 0.25, a list, 0.1,0.2,0.3, a fan, 0.1:0.4:0.1, or by kind, "
        "cased=0.2,open=0.3; may be repeated.",
    ),
]
PROGRAM = "fctd chart"


def chart_command(
    case_file: OptionalCase = None,
    operations: Annotated[
        list[str],
        typer.Option("--operation", metavar="KINDS", help=f"{KIND_HELP}; several with commas between them, or all."),
    ] = [],  # noqa: B006 (typer copies it)
    depths: Annotated[Given | None, quantity(DEPTHS, "FROM:TO:STEP", DEPTHS_HELP, show_default=False)] = None,
    frictions: FrictionFan = [],  # noqa: B006
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006
    out: Annotated[
        Path | None, file_option("--out", "The chart, a row for every string, .csv, .parquet or .xlsx, or its picture.")
    ] = None,
    plot: Annotated[Path | None, file_option("--plot", f"Load and torque against depth, {PICTURE_HELP}.")] = None,
    plot_profile: Annotated[
        Path | None,
        file_option("--plot-profile", f"Profiles at the last possible depth, first friction, {PICTURE_HELP}."),
    ] = None,
    load: ShownLoad = None,
    side_force: ShownSideForce = "length",
    measured: Annotated[
        Path | None,
        file_option(
            "--measured",
            "Rows to draw, .csv or .xlsx: bit depth, operation, hook load (with the block), or a rig's sheet.",
        ),
    ] = None,
    limits: Annotated[
        bool, typer.Option("--limits", help="Draw the limits of fctd limits as lines, with the first friction factors.")
    ] = False,
    units: Units = "si",
    checkpoint_every: CheckpointEvery = None,
    resume: Resume = None,
    restart: Restart = False,
    accept_changes: AcceptChanges = False,
    time_limit: TimeLimit = None,
    memory_limit: MemoryLimit = None,
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Compute a torque-and-drag chart: a row for every operation, friction factor and bit depth."""
    keeping = SaveOptions(checkpoint_every, resume, restart, accept_changes, time_limit, memory_limit)
    keeping.check({
        "CASE": case_file, "--operation": operations or None, "--depths": depths, "--friction": frictions or None,
        "--speed": speed, "--rpm": rpm, "--flow": flow, "--set": overrides or None,
        "--resolve-buckling": resolve_buckling,
        "--out": out, "--plot": plot, "--plot-profile": plot_profile, "--measured": measured,
        "--limits": limits or None,
    })  # fmt: skip
    if resume is not None:
        with resumed_folder(resume, PROGRAM, accept_changes=accept_changes) as (folder, about):
            asked = ChartRequest.read({**about["options"], "units": units})
            kept = ChartSaver(folder, keeping.interval(EVERY_CHART), key="--resume")
            _chart(case_of(folder.path, about), asked, keeping, quiet, resume, lambda _: nullcontext(kept))
        return
    if case_file is None or depths is None:
        raise InputError("a case file, or --resume with an unfinished chart", key="CASE")
    files = {"out": out, "plot": plot, "plot_profile": plot_profile, "measured": measured}
    asked = ChartRequest(
        operations, depths, frictions, speed, rpm, flow, load, side_force, limits, units, strict, **files
    )
    check_targets(out, plot, {"--plot-profile": plot_profile})
    case = read_case(case_file, changes_of(overrides, resolve=resolve_buckling))
    target = out or plot or plot_profile

    @contextmanager
    def begin(case: Case) -> Iterator[ChartSaver | None]:
        if target is None:
            yield None
            return
        with begun_folder(target, "--out", restart=restart) as folder:
            yield ChartSaver(
                folder, keeping.interval(EVERY_CHART),
                lambda: description_of(case, PROGRAM, "chart", asked.kept, uuid4().hex), "--out",
            )  # fmt: skip

    _chart(case, asked, keeping, quiet, target, begin)


@dataclass(frozen=True)
class ChartRequest:
    """What a chart is to have; the options of ``chart_command``."""

    operations: list[str]
    depths: Given
    frictions: list[str]
    speed: Given | None
    rpm: Given | None
    flow: Given | None
    load: ShownLoad
    side_force: ShownSideForce
    limits: bool
    units: Units
    strict: bool
    out: Path | None
    plot: Path | None
    plot_profile: Path | None
    measured: Path | None

    @property
    def kept(self) -> dict[str, Any]:
        """All of it as JSON takes it."""
        files = {name: str(value.absolute()) for name, value in vars(self).items() if isinstance(value, Path)}
        texts = {name: value.text for name, value in vars(self).items() if isinstance(value, Given)}
        return vars(self) | files | texts

    @classmethod
    def read(cls, kept: Mapping[str, Any]) -> "ChartRequest":
        """The options that ``kept`` gave."""
        files = {name: kept[name] for name in ("out", "plot", "plot_profile", "measured")}
        rates = {of.name.removeprefix("--"): of for of in (DEPTHS, *DRIVE)}
        return cls(**{
            **kept, **{name: None if path is None else Path(path) for name, path in files.items()},
            **{name: None if kept[name] is None else of.parse(kept[name]) for name, of in rates.items()},
        })  # fmt: skip


def _chart(
    case: Case, asked: ChartRequest, keeping: SaveOptions, quiet: bool, target: Path | None,
    opened: Callable[[Case], AbstractContextManager[ChartSaver | None]],
) -> None:  # fmt: skip
    """Compute a chart, or the rest of one, write and print it.

    target : of its folder; opened : makes what keeps its rows there, once all input has been checked.
    """
    units, plot_profile = asked.units, asked.plot_profile
    out, plot = check_targets(asked.out, asked.plot, {"--plot-profile": plot_profile})
    for key, path in {"--out": out, "--plot": plot, "--plot-profile": plot_profile}.items():
        refuse_sources(case, path, key, [asked.measured])
    bit_depths = asked.depths.depths(case, units)
    points_measured = None if asked.measured is None else _measured(asked.measured, case, plot, units)
    kinds = read_kinds(asked.operations)
    if points_measured is not None:
        _tell_not_drawn(points_measured["operation"], kinds)
    if asked.limits and plot is None:
        raise InputError("--plot beside it, the picture to draw them in", key="--limits", value=True)
    factors = parse_frictions(asked.frictions, "--friction")
    drive = read_drive(asked.speed, asked.rpm, asked.flow, units)
    gauge = asked.load == "indicator" or points_measured is not None
    warnings = warnings_of(case, kinds, **drive, frictions=factors, indicator=gauge)
    told = tell(case, warnings, strict=asked.strict, units=units)
    limits = keeping.limits

    with opened(case) as kept:
        with (
            _kept_on_the_way_out(kept, target, total := len(bit_depths) * len(kinds) * max(len(factors), 1)),
            row_bar(quiet) as bar,
        ):
            task = bar.add_task("compiling", total=None)

            def show(done: int, total: int) -> None:
                bar.update(task, description=printable(case.name), completed=done, total=total)
                limits.check()

            keep: dict[str, Any] = {}
            if kept is not None:
                keep = {"known": kept.known, "above": kept.above, "keep": lambda rows: kept.keep(rows, total)}
            rows = chart_rows(case, kinds, bit_depths, factors or None, **drive, progress=show, **keep)
            margins = None
            if asked.limits:

                def show_limits(done: int, total: int) -> None:
                    bar.update(task, description="limits", completed=done, total=total)
                    limits.check()

                margins = limits_of(
                    case, kinds, of_lines(bit_depths), factors[0] if factors else None, **drive, progress=show_limits
                )

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
                look = ChartLook(asked.load, rates_of_all(case, kinds, **drive), points_measured, told, margins)
                written += draw_chart(plot, _frame(rows), units, case, look)
            if plot_profile is not None:
                one = with_friction(case, factors[0]) if factors else case
                solver, rates = Solver(one), rates_of_all(one, kinds, **drive)
                points = [solver.solve(kind, rates[kind], last) for kind in kinds]
                look_of = {"force": asked.side_force, "warnings": told, "sets": max(len(factors), 1)}
                written += draw_profiles(plot_profile, points, units=units, **look_of)
            if kept is not None:
                kept.folder.clear()
        finally:
            print_chart(rows, case.name, units, asked.load or usual_load([case]))
            print_segments(case, last, units)
    print_written(written)
    acceptable = all(SteadyStatus(status).acceptable for status in {row["status"] for row in rows})
    finish(acceptable, meanings, asked.strict)


@contextmanager
def _kept_on_the_way_out(kept: ChartSaver | None, target: Path | None, total: int) -> Iterator[None]:
    """A chart that reaches a limit or is interrupted keeps its rows, and says how to go on with it.

    Interrupted before the first of them were due, it leaves nothing behind.
    """
    try:
        yield
    except (LimitReached, KeyboardInterrupt) as stop:
        limit = isinstance(stop, LimitReached)
        if kept is not None and target is not None:
            if limit or kept.kept:
                kept.write_new(total)
            say_how_to_go_on(target)
        if not limit:
            raise
        messages.print(f"stopped: {stop}", soft_wrap=True)
        raise typer.Exit(FAILED) from None


def _frame(rows: list[Row]) -> "pd.DataFrame":
    import pandas as pd  # slow to import

    return pd.DataFrame(rows)


def _tell_not_drawn(measured: "pd.Series[str]", kinds: Sequence[str]) -> None:
    """Say how many measured rows the picture does not show, as their operation is not asked for."""
    others = measured[~measured.isin(kinds)]
    if len(others):
        told = f"{len(others)} of {len(measured)} measured rows are not drawn"
        messages.print(f"{told}, of operations that are not asked for: {', '.join(others.unique())}", soft_wrap=True)


def _measured(path: Path, case: Case, plot: Path | None, units: System) -> "pd.DataFrame":
    """Measured rows, which only a picture shows."""
    if plot is None:
        raise InputError("--plot beside it, the picture to draw them in", key="--measured", value=path)
    return read_measured(path, case, units, partial(warn, path))
