"""``fctd chart CASE``: steady strings of several operations at many bit depths."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any
from uuid import uuid4

import typer

from fctd.calibration.measured import read_measured
from fctd.case.errors import InputError
from fctd.case.friction import parse_frictions
from fctd.case.load import Case, with_friction
from fctd.cli.chart_table import print_chart, title_of
from fctd.cli.job import Job
from fctd.cli.keeping import (
    EVERY_CHART,
    OptionalCase,
    SaveOptions,
    begun_folder,
    case_of,
    description_of,
    resumed_folder,
    say_how_to_go_on,
)
from fctd.cli.option_classes import beside, given_options, to_keep, with_options
from fctd.cli.options import FAILED, Overrides, Quiet, Strict, Units, messages, warn
from fctd.cli.pictures import PICTURE_HELP, PICTURES, ShownLoad, ShownSideForce, draw_chart, draw_profiles
from fctd.cli.quantities import DEPTHS, Given, quantity
from fctd.cli.steady import (
    DEPTHS_HELP,
    Flow,
    FrictionFan,
    ResolveBuckling,
    Rpm,
    Speed,
    file_option,
    kinds_option,
    print_segments,
    read_drive,
    read_kinds,
)
from fctd.model.operations import rates_of_all
from fctd.plots.loads import ChartLook, usual_load
from fctd.results.status import SteadyStatus
from fctd.steady.chart_saver import ChartSaver
from fctd.steady.equilibrium import Solver
from fctd.steady.margin_table import limits_of, of_lines
from fctd.steady.torque_drag import chart_rows
from fctd.store.limits import LimitReached

if TYPE_CHECKING:
    import pandas as pd

PROGRAM = "fctd chart"


@dataclass(frozen=True, kw_only=True)
class ChartOptions:
    """The options of ``fctd chart``, in the order of its help."""

    case_file: OptionalCase = None
    operations: Annotated[list[str], kinds_option()] = field(default_factory=list)
    depths: Annotated[Given | None, quantity(DEPTHS, "FROM:TO:STEP", DEPTHS_HELP, show_default=False)] = None
    frictions: FrictionFan = field(default_factory=list)
    speed: Speed = None
    rpm: Rpm = None
    flow: Flow = None
    resolve_buckling: ResolveBuckling = None
    overrides: Overrides = field(default_factory=list)
    out: Annotated[
        Path | None, file_option("--out", "The chart, a row for every string, .csv, .parquet or .xlsx, or its picture.")
    ] = None
    plot: Annotated[Path | None, file_option("--plot", f"Load and torque against depth, {PICTURE_HELP}.")] = None
    plot_profile: Annotated[
        Path | None,
        file_option("--plot-profile", f"Profiles at the last possible depth, first friction, {PICTURE_HELP}."),
    ] = None
    load: ShownLoad = None
    side_force: ShownSideForce = "length"
    measured: Annotated[
        Path | None,
        file_option(
            "--measured",
            "Rows to draw, .csv or .xlsx: bit depth, operation, hook load (with the block), or a rig's sheet.",
        ),
    ] = None
    limits: Annotated[
        bool, typer.Option("--limits", help="Draw the limits of fctd limits as lines, with the first friction factors.")
    ] = False
    units: Units = "si"
    keeping: SaveOptions
    quiet: Quiet = False
    strict: Strict = False


@with_options
def chart_command(options: ChartOptions) -> None:
    """Compute a torque-and-drag chart: a row for every operation, friction factor and bit depth."""
    keeping = options.keeping
    keeping.check(given_options(options))
    if keeping.resume is not None:
        with resumed_folder(keeping.resume, PROGRAM, accept_changes=keeping.accept_changes) as (folder, about):
            kept = ChartSaver(folder, keeping.interval(EVERY_CHART), key="--resume")
            case = case_of(folder.path, about)
            _chart(case, beside(options, about["options"]), keeping.resume, lambda *_: nullcontext(kept))
        return

    @contextmanager
    def begin(case: Case, target: Path | None) -> Iterator[ChartSaver | None]:
        if target is None:
            yield None
            return
        with begun_folder(target, "--out", restart=keeping.restart) as folder:
            yield ChartSaver(
                folder, keeping.interval(EVERY_CHART),
                lambda: description_of(case, PROGRAM, "chart", to_keep(options, options.units), uuid4().hex), "--out",
            )  # fmt: skip

    _chart(options.case_file, options, None, begin)


def _chart(
    source: Path | Case | None, asked: ChartOptions, resumed: Path | None,
    opened: Callable[[Case, Path | None], AbstractContextManager[ChartSaver | None]],
) -> None:  # fmt: skip
    """Compute a chart, or the rest of one, write and print it.

    opened : makes what keeps the rows of a case in the folder of a result, once all input has been checked.
    """
    units, measured = asked.units, asked.measured
    if source is None or asked.depths is None:
        raise InputError("a case file, or --resume with an unfinished chart", key="CASE")
    job = Job(
        source, asked.overrides, None, asked.resolve_buckling, units=units, strict=asked.strict, quiet=asked.quiet,
        out=asked.out, plot=asked.plot, draws=True, files={"--plot-profile": (asked.plot_profile, PICTURES)},
        reads=[measured],
    )  # fmt: skip
    case, plot = job.case, job.paths["--plot"]
    bit_depths, kinds = asked.depths.depths(case, units), read_kinds(asked.operations)
    for key, value in {"--measured": measured, "--limits": asked.limits or None}.items():
        if value is not None and plot is None:
            raise InputError("--plot beside it, the picture to draw them in", key=key, value=value)
    points = None if measured is None else read_measured(measured, case, units, partial(warn, measured))
    if points is not None:
        _tell_not_drawn(points["operation"], kinds)
    factors = parse_frictions(asked.frictions, "--friction")
    drive = read_drive(asked.speed, asked.rpm, asked.flow, units)
    job.warn(kinds, **drive, frictions=factors, indicator=asked.load == "indicator" or points is not None)
    limits, target = asked.keeping.limits, resumed or next(filter(None, job.paths.values()), None)

    with opened(case, target) as kept:
        total = len(bit_depths) * len(kinds) * max(len(factors), 1)
        with _kept_on_the_way_out(kept, target, total), job.bar("compiling") as bar:

            def show(what: str, done: int, total: int) -> None:
                bar(what, done, total)
                limits.check()

            keep: dict[str, Any] = {"progress": partial(show, case.name)}
            if kept is not None:
                keep |= {"known": kept.known, "above": kept.above, "keep": lambda rows: kept.keep(rows, total)}
            rows = chart_rows(case, kinds, bit_depths, factors or None, **drive, **keep)
            one = with_friction(case, factors[0]) if factors else case
            margins = None if not asked.limits else limits_of(
                one, kinds, of_lines(bit_depths), **drive, progress=partial(show, "limits")
            )  # fmt: skip

        # The last depth at which string and hole fit.
        possible = [row["bit_depth_m"] for row in rows if row["status"] != SteadyStatus.NOT_POSSIBLE]
        last = max(possible, default=float("nan"))

        def draw(path: Path) -> list[Path]:
            look = ChartLook(asked.load, rates_of_all(case, kinds, **drive), points, job.told, margins)
            return draw_chart(path, rows, units, case, look)

        def draw_last(path: Path) -> list[Path]:
            solver, rates = Solver(one), rates_of_all(one, kinds, **drive)
            strings = [solver.solve(kind, rates[kind], last) for kind in kinds]
            look = {"force": asked.side_force, "warnings": job.told, "sets": max(len(factors), 1)}
            return draw_profiles(path, strings, units=units, **look)

        def show_all() -> None:
            print_chart(rows, units, asked.load or usual_load([case]))
            print_segments(case, last, units)

        job.end(
            {"--out": rows, "--plot": draw, "--plot-profile": draw_last}, show_all,
            title=title_of(rows, case.name, units), rates=(kinds, drive),
            notes=(row["notes"] for row in rows), then=lambda: None if kept is None else kept.folder.clear(),
            acceptable=all(SteadyStatus(status).acceptable for status in {row["status"] for row in rows}),
        )  # fmt: skip


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


def _tell_not_drawn(measured: "pd.Series[str]", kinds: Sequence[str]) -> None:
    """Say how many measured rows the picture does not show, as their operation is not asked for."""
    others = measured[~measured.isin(kinds)]
    if len(others):
        told = f"{len(others)} of {len(measured)} measured rows are not drawn"
        messages.print(f"{told}, of operations that are not asked for: {', '.join(others.unique())}", soft_wrap=True)
