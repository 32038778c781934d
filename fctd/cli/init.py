"""``fctd init``: a commented case file to start from."""

import os
from pathlib import Path
from typing import Annotated

import typer

from fctd.case.errors import InputError
from fctd.case.load import load_case
from fctd.case.surveys.form import SURVEY
from fctd.case.tables.headers import Choice, parse_choices
from fctd.case.text import is_utf8, printable
from fctd.cli.base_command import Silent
from fctd.cli.options import check_target, messages, screen, tell, units_option
from fctd.model.from_files import Files, with_files
from fctd.model.new_case import Plan, Quantities, from_survey, from_template, read_survey
from fctd.model.templates import TEMPLATES, TemplateName
from fctd.results.unit_systems import System
from fctd.store.whole_file import whole_file

DEPTHS = 10  # from shoe to end, at most, in the chart that is proposed


def init_command(
    survey: Annotated[
        Path | None, typer.Argument(help="Survey of the well; without it the template's own well.", show_default=False)
    ] = None,
    template: Annotated[
        TemplateName | None,
        typer.Option(
            "--template",
            help="Well and string to start from; default: build-hold, or horizontal for a survey beyond 70°.",
            show_default=False,
        ),
    ] = None,
    units: Annotated[System, units_option("Units of the case file, and of a survey that names none", "si")] = "si",
    columns: Annotated[
        list[str],
        typer.Option(
            "--columns",
            metavar="KEY=HEADER",
            help="Header of a column of the survey, 'azi=Azi Grid', or its unit, md.unit=ft; keys: md, inc, azi; "
            "may be repeated.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    sheet: Annotated[
        str | None,
        typer.Option(
            "--sheet",
            metavar="NAME",
            help="Sheet of a workbook, or trajectory of a WITSML file, where it has several.",
            show_default=False,
        ),
    ] = None,
    string: Annotated[
        Path | None,
        typer.Option(
            "--string",
            metavar="FILE",
            help="WITSML file with the string, a tubular, in place of the template's.",
            show_default=False,
        ),
    ] = None,
    hole: Annotated[
        Path | None,
        typer.Option(
            "--hole",
            metavar="FILE",
            help="WITSML file with the sections of the hole, a wbGeometry.",
            show_default=False,
        ),
    ] = None,
    string_name: Annotated[
        str | None,
        typer.Option(
            "--string-name",
            metavar="NAME",
            help="Name or uid of a tubular, where its file has several.",
            show_default=False,
        ),
    ] = None,
    hole_name: Annotated[
        str | None,
        typer.Option(
            "--hole-name",
            metavar="NAME",
            help="Name or uid of a wbGeometry, where its file has several.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[Path, typer.Option("--out", metavar="FILE", help="The case file, .toml.")] = Path("my_well.toml"),
    quiet: Silent = False,
) -> None:
    """Write a commented case file that runs, for your survey or for one of the templates.

    What the files of string and hole lack is left blank in the case, and named with its line.
    """
    check_target(out, "--out", (".toml",))
    if out.exists():
        raise InputError("a file that does not exist yet: delete it, or name another", key="--out", value=out)
    if survey is None and (columns or sheet is not None):
        raise InputError("a survey beside --columns and --sheet", key="SURVEY")
    files = Files(string, hole, string_name, hole_name)
    if survey is None and any(files):
        raise InputError("a survey beside --string and --hole", key="SURVEY")
    plan = _plan(survey, template, units, out, parse_choices(columns, SURVEY), sheet, files)
    with whole_file(out) as scratch:
        scratch.write_text(plan.text(), encoding="utf-8")
    if not quiet:
        screen.print(f"Written: {printable(str(out))}, {printable(plan.title)}", soft_wrap=True)
    for file, doubt in plan.given.doubts:
        messages.print(f"warning: {file}: {doubt}", soft_wrap=True)
    for number, blank in plan.blanks:
        messages.print(f"fill in: {printable(str(out))}: line {number}, {blank.key}: {blank}", soft_wrap=True)
    case = None if plan.blanks else load_case(out)
    doubted = case is not None and tell(case, case.warnings, strict=False, units=units)
    if doubted and hole is None:
        text = f"depths in {printable(str(out))} follow from the survey as it was read: if that is wrong, delete it"
        messages.print(f"{text} and write it anew", soft_wrap=True)
    for line in () if quiet else _next(plan, out):
        screen.print(line, soft_wrap=True)


def _plan(
    survey: Path | None,
    template: TemplateName | None,
    units: System,
    out: Path,
    columns: dict[str, Choice],
    sheet: str | None,
    files: Files,
) -> Plan:
    name = out.stem.replace("_", " ") if is_utf8(out.stem) else "my well"
    if survey is None:
        return from_template(TEMPLATES[template or "build-hold"], name, units)
    if not survey.exists():
        raise InputError("a survey file that exists", key="SURVEY", value=survey)
    written = Path(os.path.relpath(survey, out.absolute().parent)).as_posix()
    found = read_survey(survey, units, columns, sheet)
    if not is_utf8(written):
        raise InputError("a file whose path is UTF-8, as a case file is", key="SURVEY", value=survey)
    if found.note:
        messages.print(f"warning: {survey}: {found.note}", soft_wrap=True)
    plan = from_survey(template, name, units, written, found.keys, found.stations)
    try:
        return with_files(plan, found.stations, files)
    except InputError as error:
        if error.key not in Files._fields:
            raise
        option = f"--{error.key.replace('_', '-')}"
        raise InputError(error.expected, key=option, value=error.value, file=error.file) from None


def _next(plan: Plan, out: Path) -> list[str]:
    """Commands that the case is ready for, or will be when its blanks are filled in."""
    step = Quantities(plan.units).round_length((plan.depth - plan.shoe) / DEPTHS)
    file = printable(str(out))
    kinds = "all" if plan.template.weight_on_bit else "trip_in"
    first = "shoe" if plan.shoe else step
    lines = [
        f"fctd check {file}",
        f"fctd chart {file} --operation {kinds} --depths {first}:td:{step} --out chart.csv",
        f"fctd equilibrium {file} --operation trip_in --bit-depth td",
        f"fctd simulate {file}",
    ]
    begin = "Next:    " if not plan.blanks else "Fill in these lines, then: "
    return [begin + lines[0], *(" " * len(begin) + line for line in lines[1:])]
