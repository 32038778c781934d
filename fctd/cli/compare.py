"""``fctd compare CASE CASE …``: several cases on one chart and in one table, and what differs between their inputs."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from fctd.answers.comparison import FEWEST, compare, names_of
from fctd.answers.steady import chart
from fctd.case import message
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet, parse_frictions
from fctd.case.load import SAME_DEPTH, Case, naming_file, with_friction
from fctd.case.raw_case import parse_override
from fctd.case.text import counted
from fctd.cli.compare_table import print_comparison
from fctd.cli.job import Job
from fctd.cli.options import (
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    read_case,
)
from fctd.cli.pictures import PICTURE_HELP, ShownLoad, draw_chart
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
    read_drive,
    read_kinds,
)
from fctd.plots.loads import ChartLook, usual_load
from fctd.plots.palette import CASES
from fctd.results.differences import differences
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, shown
from fctd.steady.margin_table import USUAL

# Keys that differ, on the screen and in a picture.
ON_SCREEN, IN_PICTURE = 20, 8


def compare_command(
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="CASE [KEY=VALUE]…",
            help="Case files (TOML), two or more; a key=value behind a case changes that one alone: "
            "my.toml my.toml mud.density='1.4 sg'.",
            show_default=False,
        ),
    ],
    depths: Annotated[Given, quantity(DEPTHS, "FROM:TO:STEP", DEPTHS_HELP)],
    operations: Annotated[list[str], kinds_option(f"; default: {', '.join(USUAL)}")] = [],  # noqa: B006
    frictions: FrictionFan = [],  # noqa: B006 (typer copies it)
    speed: Speed = None,
    rpm: Rpm = None,
    flow: Flow = None,
    resolve_buckling: ResolveBuckling = None,
    overrides: Overrides = [],  # noqa: B006
    out: Annotated[
        Path | None, file_option("--out", "The charts, a row for every string, .csv, .parquet or .xlsx, or a picture.")
    ] = None,
    plot: Annotated[
        Path | None, file_option("--plot", f"Load and torque of all cases against depth, {PICTURE_HELP}.")
    ] = None,
    load: ShownLoad = None,
    units: Units = "si",
    quiet: Quiet = False,
    strict: Strict = False,
) -> None:
    """Compare cases: what differs between their inputs, and their charts in one table and one picture."""
    cases = _read(sources, changes_of(overrides, resolve=resolve_buckling))
    job = Job(cases, units=units, strict=strict, quiet=quiet, out=out, plot=plot, draws=True)
    if (plot := job.paths["--plot"]) is not None and len(cases) > len(CASES):
        raise InputError(f"at most {len(CASES)} cases, each with a colour of its own", key="--plot", value=plot)
    kinds, factors = read_kinds(operations, USUAL), parse_frictions(frictions, "--friction")
    drive = read_drive(speed, rpm, flow, units)
    bit_depths, ends = _depths(depths, cases, units)
    compared = [_with_factors(case, factors) for case in cases.values()]
    lines = [found.sentence(list(cases), units) for found in differences(compared, units)]
    job.say(*_shortened(lines, ON_SCREEN), *ends)
    shown_load = load or usual_load(list(cases.values()))
    job.warn(kinds, **drive, frictions=factors, indicator=shown_load == "indicator")
    with job.bar("compiling") as show:
        charts = {
            name: chart(case, kinds, bit_depths[name], factors or None, **drive, progress=partial(show, name))
            for name, case in cases.items()
        }
    found = compare(charts, units)
    look = ChartLook(load, told=[*_shortened(lines, IN_PICTURE), *ends], warnings=job.told)

    job.end(
        {"--out": found.rows, "--plot": lambda path: draw_chart(path, found.rows, units, charts, look)},
        lambda: print_comparison(found, units, shown_load), title="", rates=(kinds, drive),
        more={"differences": lines}, notes=found.rows["notes"],
        acceptable=all(SteadyStatus(status).acceptable for status in found.rows["status"].unique()),
    )  # fmt: skip


def _read(sources: Sequence[str], shared: Mapping[str, Any]) -> dict[str, Case]:
    """The cases by their names; shared : changes of all of them, before the changes of each."""
    given: list[tuple[Path, dict[str, Any]]] = []
    for text in sources:
        if "=" not in text or Path(text).exists():
            given.append((Path(text), {}))
        elif not given:
            raise InputError("a case file before it, which it changes", key="CASE", value=text)
        else:
            given[-1][1].update([parse_override(text)])
    if len(given) < FEWEST:
        expected = f"{FEWEST} case files or more; to compare one with a change of it, name it twice"
        raise InputError(f"{expected}: {given[0][0]} {given[0][0]} mud.density='1.4 sg'", key="CASE", value=sources[0])
    cases = [read_case(path, {**shared, **changes}) for path, changes in given]
    return dict(zip(names_of(cases), cases, strict=True))


def _with_factors(case: Case, factors: Sequence[FrictionSet]) -> Case:
    """The case with the first factors of the option, which stand in place of its own; InputError names its file."""
    with naming_file(case):
        return with_friction(case, factors[0] if factors else None)


def _depths(given: Given, cases: Mapping[str, Case], units: System) -> tuple[dict[str, list[float]], list[str]]:
    """The bit depths [m] of each case that it reaches, and a line for each that does not reach all of them.

    Raises InputError, which names the file, for a case that reaches none.
    """
    found, ends = {}, []
    metre = shown("bit_depth_m", units)
    for name, case in cases.items():
        with naming_file(case):
            wanted = given.depths(case, units)
            found[name] = [depth for depth in wanted if depth <= case.deepest + SAME_DEPTH]
            if not found[name]:
                expected = f"a depth that its string reaches, at most {message.quantity(case.deepest, 'm')}"
                raise InputError(expected, key="--depths", value=given.text)
        if len(found[name]) < len(wanted):
            end = f"{case.deepest * metre.factor:.10g} {metre.label}"
            deeper = f"{len(wanted) - len(found[name])} of {counted(len(wanted), 'depth')}"
            ends.append(f"{name}: the string reaches {end}; {deeper} lie deeper and are left out")
    return found, ends


def _shortened(lines: Sequence[str], most: int) -> list[str]:
    """What differs, a line for each key, and how many keys more."""
    if not lines:
        return ["no key of the cases differs"]
    more = [f"and {counted(len(lines) - most, 'key')} more, which a file of --out lists"] if len(lines) > most else []
    return [*lines[:most], *more]
