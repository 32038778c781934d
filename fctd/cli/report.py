"""``fctd report CASE``: a well as a page, a PDF and a workbook, made from the same tables."""

from collections.abc import Callable
from datetime import date
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Annotated, Any, Final, cast

import typer

from fctd.calibration.measured import read_measured
from fctd.case.errors import InputError
from fctd.case.friction import parse_frictions
from fctd.case.load import Case
from fctd.case.text import counted, file_name, printable
from fctd.cli import quantities
from fctd.cli.job import Job
from fctd.cli.options import (
    CaseFile,
    Overrides,
    Quiet,
    Strict,
    Units,
    check_target,
    finish,
    messages,
    print_written,
    refuse_source_files,
    warn,
)
from fctd.cli.pictures import ShownLoad
from fctd.cli.quantities import Given, quantity
from fctd.cli.steady import (
    DEPTHS_HELP,
    Flow,
    ResolveBuckling,
    Rpm,
    Speed,
    file_option,
    kinds_option,
    read_drive,
    read_kinds,
)
from fctd.model.new_case import Quantities
from fctd.model.operations import rates_of_all
from fctd.report.logo import read_logo
from fctd.results.notes import meanings_of
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System
from fctd.steady.margin_table import USUAL
from fctd.store.whole_file import whole_file

# What writes each kind of file: its module and function, and the packages that it needs.
WRITERS: Final = {
    ".html": ("html_file", ("jinja2", "matplotlib")),
    ".pdf": ("pdf_file", ("reportlab", "matplotlib")),
    ".xlsx": ("xlsx_file", ("xlsxwriter", "matplotlib")),
}
ON_BOTTOM: Final = "drill_rotating"  # beside the usual ones, where the case has a weight on bit
DEPTHS: Final = 20  # about as many bit depths without --depths
SHALLOWEST: Final = 0.3  # of the hole, where no shoe is: the first of them


def report_command(
    case_file: CaseFile,
    out: Annotated[
        list[Path],
        typer.Option(
            "--out",
            metavar="FILE",
            help="The report, .html, .pdf or .xlsx; may be repeated; default: all three, CASE-NAME-report.",
            show_default=False,
        ),
    ] = [],  # noqa: B006 (typer copies it)
    operations: Annotated[
        list[str], kinds_option(f"; default: {', '.join(USUAL)}, and {ON_BOTTOM} where the case has a weight on bit")
    ] = [],  # noqa: B006
    depths: Annotated[
        Given | None,
        quantity(
            quantities.DEPTHS,
            "FROM:TO:STEP",
            f"{DEPTHS_HELP} Default: about {DEPTHS} from the last shoe to the end of the hole.",
            show_default=False,
        ),
    ] = None,
    frictions: Annotated[
        list[str],
        typer.Option(
            "--friction",
            metavar="X",
            help="Friction factors as of fctd chart; the first of several are those of all but the chart.",
        ),
    ] = [],  # noqa: B006
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006
    measured: Annotated[
        Path | None, file_option("--measured", "Measured rows for the chart, as of fctd chart.")
    ] = None,
    limits: Annotated[
        bool, typer.Option("--limits/--no-limits", help="Search for the limits of the string, which takes longest.")
    ] = True,
    load: ShownLoad = None,
    company: Annotated[
        str, typer.Option("--company", metavar="NAME", help="Name of the company, on each page.", show_default=False)
    ] = "",
    logo: Annotated[Path | None, file_option("--logo", "Logo of the company, .png or .jpg, on each page.")] = None,
    by: Annotated[str, typer.Option("--by", metavar="NAME", help="Who made the report.", show_default=False)] = "",
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Write a report of a well: page, PDF and workbook have the same tables.

    It has datum, hole, string with what it bears, fluids, friction and its origin, assumptions, the chart with limits
    and measured rows, margins, profiles, pumped mud, notes and versions.
    """
    for path in out:
        check_target(path, "--out", tuple(WRITERS))
    job = Job(case_file, overrides, None, resolve_buckling, units=units, strict=strict, quiet=quiet)
    case = job.case
    files = out or [Path(file_name(case.name, f"-report{suffix}")) for suffix in WRITERS]
    _check(files, case, measured, logo)
    picture = None if logo is None else read_logo(logo)
    bit_depths = _default_depths(case, units) if depths is None else depths.depths(case, units)
    rows = None if measured is None else read_measured(measured, case, units, partial(warn, measured))
    kinds = read_kinds(operations, (*USUAL, *([ON_BOTTOM] if case.bit.weight_on_bit else [])))
    factors, drive = parse_frictions(frictions, "--friction"), read_drive(speed, rpm, flow, units)
    rates_of_all(case, kinds, **drive)  # refuses rates before anything is computed
    job.warn(kinds, **drive, frictions=factors, indicator=load == "indicator" or rows is not None)

    from fctd.report.answers import Asked, answer
    from fctd.report.content import Cover, report_of

    with job.bar("compiling") as show:
        found = answer(case, Asked(kinds, bit_depths, factors, drive, limits, rows), show)
        cover = Cover(printable(company), printable(by), date.today().isoformat(), picture)
        made = report_of(found, cover, units, load, job.told)
        for k, path in enumerate(files):
            show("writing", k, len(files))
            content = _writer(path)(made)
            with whole_file(path) as scratch:
                scratch.write_bytes(content)
    for status, count in found.chart["status"].value_counts().items():
        if not SteadyStatus(str(status)).acceptable:
            rows_of = f"{count} of {len(found.chart)} rows"
            messages.print(f"{rows_of} of the chart are {status}: the section Notes says why", soft_wrap=True)
    if not quiet:
        job.say(f"{printable(case.name)}: {counted(len(made.tables), 'table')}")
    print_written(files)
    finish(found.acceptable, meanings_of(found.chart["notes"]), strict)


def _check(files: list[Path], case: Case, measured: Path | None, logo: Path | None) -> None:
    """Raise InputError for files that cannot be written, or without the packages that write them."""
    for path in files:
        check_target(path, "--out", tuple(WRITERS))
        for package in WRITERS[path.suffix.lower()][1]:
            try:
                import_module(package)
            except ModuleNotFoundError as error:
                name = f"the package {error.name} for {path.suffix} (pip install {package}, or the extra fctd[report])"
                raise InputError(name, key="--out", value=path) from None
    if len({path.resolve() for path in files}) < len(files):
        raise InputError("a file of its own for each report", key="--out", value=files[-1])
    refuse_source_files(case, files, "--out", [measured, logo])


def _writer(path: Path) -> Callable[[Any], bytes]:
    """The function that writes a report as the kind of file of a suffix."""
    module = WRITERS[path.suffix.lower()][0]
    name = f"to_{module.removesuffix('_file')}"
    return cast("Callable[[Any], bytes]", getattr(import_module(f"fctd.report.{module}"), name))


def _default_depths(case: Case, units: System) -> list[float]:
    """About ``DEPTHS`` round bit depths [m], from the last shoe that leaves some hole below it, or from higher up."""
    top, end = case.string.top_md, case.deepest
    shoes = [shoe for shoe in case.shoes if top < shoe < 0.9 * end]
    start = shoes[-1] if shoes else top + SHALLOWEST * (end - top)
    step = Quantities(units).round_length((end - start) / DEPTHS)
    unit = quantities.DEPTHS.kind.bare_unit(units)
    return quantities.DEPTHS.parse(f"{start:.10g} m:{end:.10g} m:{step} {unit}").depths(case, units)
