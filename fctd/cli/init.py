"""``fctd init``: a commented case file to start from."""

import os
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray

from fctd.case.errors import InputError
from fctd.case.specs import WellboreSpec
from fctd.case.text import is_utf8, printable
from fctd.cli.manners import Silent
from fctd.cli.new_case import Plan, Quantities, UnitSystem, aligned, from_survey, from_template
from fctd.cli.options import check_target, messages, screen
from fctd.cli.templates import TEMPLATES, TemplateName
from fctd.results.whole_file import whole_file

Array = NDArray[np.float64]
# A well that is steeper than this gets the string of the template ``horizontal`` [rad].
NEARLY_HORIZONTAL = np.radians(70)
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
    units: Annotated[UnitSystem, typer.Option("--units", help="Units of the case file.")] = "metric",
    out: Annotated[Path, typer.Option("--out", metavar="FILE", help="The case file, .toml.")] = Path("my_well.toml"),
    quiet: Silent = False,
) -> None:
    """Write a commented case file that runs: of your survey, or of one of the templates."""
    check_target(out, "--out", (".toml",))
    if out.exists():
        raise InputError("a file that does not exist yet", key="--out", value=out)
    plan = _plan(survey, template, units, out)
    with whole_file(out) as scratch:
        scratch.write_text(plan.text(), encoding="utf-8")
    if not quiet:
        screen.print(f"Written: {printable(str(out))}, {printable(plan.title)}", soft_wrap=True)
        for line in _next(plan, out):
            screen.print(line, soft_wrap=True)


def _plan(survey: Path | None, template: TemplateName | None, units: UnitSystem, out: Path) -> Plan:
    name = out.stem.replace("_", " ") if is_utf8(out.stem) else "my well"
    if survey is None:
        return from_template(TEMPLATES[template or "build-hold"], name, units)
    columns, stations = read_survey(survey, "m" if units == "metric" else "ft")
    path = Path(os.path.relpath(survey, out.absolute().parent)).as_posix()
    if not is_utf8(path):
        raise InputError("a file whose path is UTF-8, as a case file is", key="SURVEY", value=survey)
    steep = float(stations[:, 1].max()) > NEARLY_HORIZONTAL
    chosen: TemplateName = template or ("horizontal" if steep else "build-hold")
    return from_survey(TEMPLATES[chosen], name, units, path, columns, stations)


def read_survey(path: Path, unit: str) -> tuple[tuple[str, ...], Array]:
    """Lines of TOML that a case needs beside the name of its survey, and the stations (n, 3) [m, rad, rad].

    unit : of measured depth, where the file names none.  Raises InputError for a file that cannot be used.
    """
    if not path.exists():
        raise InputError("a survey file that exists", key="SURVEY", value=path)
    try:
        return (), _hole(path).trajectory
    except InputError as error:
        try:
            stations = _hole(path, columns={"md": {"unit": unit}}).trajectory
        except InputError:
            raise error from None  # of the file as it is
    comment = f"the file names no unit of depth: {unit} is assumed"
    messages.print(f"warning: {path}: {comment}, as in the key wellbore.columns", soft_wrap=True)
    return (aligned(f'columns = {{md = {{unit = "{unit}"}}}}', comment),), stations


def _hole(path: Path, **keys: Any) -> WellboreSpec:
    some = {"to_md": 1.0, "diameter": 0.2, "friction": 0.2}
    return WellboreSpec.model_validate({"survey": path.absolute(), "intervals": [some], **keys})


def _next(plan: Plan, out: Path) -> list[str]:
    """Commands that the case is ready for."""
    step = Quantities(plan.units).round_length((plan.depth - plan.shoe) / DEPTHS)
    file, units = printable(str(out)), " --units field" if plan.units == "field" else ""
    kinds = "all" if plan.template.weight_on_bit else "trip_in"
    return [
        f"Next:    fctd check {file}{units}",
        f"         fctd chart {file} --operation {kinds} --depths shoe:td:{step} --out chart.csv{units}",
        f"         fctd equilibrium {file} --operation trip_in --bit-depth td{units}",
        f"         fctd simulate {file}",
    ]
