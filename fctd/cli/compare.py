"""``fctd compare CASE CASE …``: several cases on one chart and in one table, and what differs between their inputs."""

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from fctd.answers.comparison import FEWEST, compare, names_of
from fctd.answers.steady import Chart, chart
from fctd.case.doubts import warnings_of
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet, parse_frictions
from fctd.case.input_warnings import InputWarning
from fctd.case.load import SAME_DEPTH, Case, naming_file, with_friction
from fctd.case.raw_case import parse_override
from fctd.case.text import counted, printable
from fctd.cli.chart import DEPTHS_HELP, FrictionFan
from fctd.cli.compare_table import print_comparison
from fctd.cli.options import (
    Overrides,
    Quiet,
    Strict,
    Units,
    changes_of,
    finish,
    print_written,
    read_case,
    refuse_sources,
    screen,
    tell,
)
from fctd.cli.pictures import PICTURE_HELP, ShownLoad, draw_chart
from fctd.cli.quantities import DEPTHS, Given, quantity
from fctd.cli.steady import (
    KIND_HELP,
    Flow,
    ResolveBuckling,
    Rpm,
    Speed,
    check_targets,
    file_option,
    metadata_of,
    read_drive,
    read_kinds,
    row_bar,
)
from fctd.plots.loads import ChartLook, usual_load
from fctd.plots.palette import CASES
from fctd.results.differences import differences, in_a_row
from fctd.results.notes import meanings_of
from fctd.results.status import SteadyStatus
from fctd.results.table_files import write_table
from fctd.results.unit_systems import System, reworded, shown
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
    operations: Annotated[
        list[str],
        typer.Option(
            "--operation",
            metavar="KINDS",
            help=f"{KIND_HELP}; several with commas between them, or all; default: {', '.join(USUAL)}.",
        ),
    ] = [],  # noqa: B006 (typer copies it)
    frictions: FrictionFan = [],  # noqa: B006
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
    out, plot = check_targets(out, plot, {})
    cases = _read(sources, changes_of(overrides, resolve=resolve_buckling))
    if plot is not None and len(cases) > len(CASES):
        raise InputError(f"at most {len(CASES)} cases, each with a colour of its own", key="--plot", value=plot)
    for name, path in {"--out": out, "--plot": plot}.items():
        for case in cases.values():
            refuse_sources(case, path, name)
    kinds, factors = read_kinds(operations, USUAL), parse_frictions(frictions, "--friction")
    drive = read_drive(speed, rpm, flow, units)
    bit_depths, ends = _depths(depths, cases, units)
    compared = [_with_factors(case, factors) for case in cases.values()]
    lines = [found.sentence(list(cases), units) for found in differences(compared, units)]
    for line in [*_shortened(lines, ON_SCREEN), *ends]:
        screen.print(line, soft_wrap=True)
    indicator = (load or usual_load(list(cases.values()))) == "indicator"
    warnings = {
        name: warnings_of(case, kinds, **drive, frictions=factors, indicator=indicator) for name, case in cases.items()
    }
    told = _tell(cases, warnings, strict, units)

    charts: dict[str, Chart] = {}
    with row_bar(quiet) as bar:
        task = bar.add_task("compiling", total=None)

        def show(name: str, done: int, total: int) -> None:
            bar.update(task, description=printable(name), completed=done, total=total)

        for name, case in cases.items():
            progress = partial(show, name)
            charts[name] = chart(case, kinds, bit_depths[name], factors or None, **drive, progress=progress)
    found = compare(charts, units)
    meanings = meanings_of(found.rows["notes"])
    written: list[Path] = []
    try:  # written before the tables are printed, as the terminal may be closed
        if out is not None:
            of_cases = {name: metadata_of(case, units, kinds, drive, warnings[name]) for name, case in cases.items()}
            metadata = {"units": units, "differences": lines, "notes": meanings, "cases": of_cases}
            written += write_table(found.table, out, metadata)
        if plot is not None:
            look = ChartLook(load, told=[*_shortened(lines, IN_PICTURE), *ends], warnings=told)
            written += draw_chart(plot, found.rows, units, charts, look)
    finally:
        print_comparison(found, units, load or usual_load(list(cases.values())))
    print_written(written)
    finish(all(SteadyStatus(status).acceptable for status in found.rows["status"].unique()), meanings, strict)


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
                expected = f"a depth that its string reaches, at most {case.deepest:g} m"
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


def _tell(
    cases: Mapping[str, Case], warnings: Mapping[str, Sequence[InputWarning]], strict: bool, units: System
) -> list[str]:
    """Print the warnings of all cases, those of a file once; returns their texts with the cases that have them."""
    said: set[tuple[Path | None, str]] = set()
    owners: dict[str, list[str]] = {}
    for name, case in cases.items():
        new = [warning for warning in warnings[name] if (case.file, str(warning)) not in said]
        tell(case, new, strict=strict, units=units)
        for warning in warnings[name]:
            said.add((case.file, str(warning)))
            owners.setdefault(reworded(str(warning), units), []).append(name)
    return [text if len(of) == len(cases) else f"{text} ({in_a_row(of)})" for text, of in owners.items()]
