"""``fctd check CASE``: what was understood of a case, to compare with the well plan."""

from collections.abc import Sequence

from rich.box import SIMPLE_HEAD
from rich.table import Column, Table

from fctd.case.friction import factors_label
from fctd.case.load import Case, naming_file
from fctd.case.text import printable
from fctd.cli.base_command import Silent
from fctd.cli.options import CaseFile, Friction, Overrides, Strict, Units, changes_of, read_case, screen, tell
from fctd.model.summary import Summary, segments_in_words, summarise
from fctd.results.case_facts import Row, caliper_facts, fitting_facts, flow_curves, load_facts, path_facts
from fctd.results.unit_systems import Shown, System, shown


def check_command(
    case_file: CaseFile,
    overrides: Overrides = [],  # noqa: B006 (typer copies it)
    friction: Friction = None,
    units: Units = "si",
    quiet: Silent = False,
    strict: Strict = False,
) -> None:
    """Print what was understood of a case: path, sizes, weights, clearances, segments; and its probable mistakes."""
    case = read_case(case_file, changes_of(overrides, friction))
    with naming_file(case):
        summary = summarise(case)
        if not quiet:
            _print(summary, units)
        string = summary.string()  # raises InputError where it does not fit the hole: after the tables that show why
    metre = shown("bit_depth_m", units)
    if not quiet:
        screen.print(segments_in_words(case, string, metre.factor, metre.label), soft_wrap=True)
    tell(case, case.warnings, strict=strict, units=units)


def _print(summary: Summary, units: System) -> None:
    metre, across, force = (shown(name, units) for name in ("bit_depth_m", "clearance_m", "hookload_N"))
    screen.print(printable(summary.case.name), style="bold")
    screen.print(facts_table(path_facts(summary, units)))
    screen.print(_hole(summary.case, metre, across))
    if summary.case.wellbore.calipers is not None:
        screen.print(facts_table(caliper_facts(summary.case.wellbore.calipers, units)))
    screen.print(_string(summary, metre, across, force))
    if rows := fitting_facts(summary.case, units):
        screen.print(facts_table(rows))
    screen.print(facts_table(load_facts(summary, units)))
    if rows := flow_curves(summary.case.mud, units):
        screen.print(facts_table(rows))


def facts_table(rows: Sequence[Row]) -> Table:
    """A table of one fact a row."""
    table = Table(box=SIMPLE_HEAD, show_header=False, pad_edge=False)
    for row in rows:
        table.add_row(*row)
    table.columns[1].justify = "right"
    return table


def _hole(case: Case, metre: Shown, across: Shown) -> Table:
    table = _table(["hole", "kind"], [f"from\n{metre.label}", f"to\n{metre.label}", f"diameter\n{across.label}", "μ"])
    start = 0.0
    for k, interval in enumerate(case.wellbore.intervals, start=1):
        sizes = (start * metre.factor, interval.to_md * metre.factor, interval.diameter * across.factor)
        cells = (f"{sizes[0]:.1f}", f"{sizes[1]:.1f}", f"{sizes[2]:.4g}", factors_label([interval]))
        table.add_row(_name(interval.name, k), interval.kind or "–", *cells)
        start = interval.to_md
    return table


def _string(summary: Summary, metre: Shown, across: Shown, force: Shown) -> Table:
    intervals = summary.case.wellbore.intervals
    columns = [f"from\n{metre.label}", f"to\n{metre.label}", f"in air\n{force.label}", f"in mud\n{force.label}"]
    columns += [f"clearance\nin {k + 1}, {across.label}" for k in range(len(intervals))]
    table = _table(["string, the bit at the bottom"], columns)
    for part in summary.parts:
        depths = (f"{part.from_md * metre.factor:.1f}", f"{part.to_md * metre.factor:.1f}")
        weights = (f"{part.air * force.factor:.1f}", f"{part.buoyed * force.factor:.1f}")
        table.add_row(printable(part.name), *depths, *weights, *(f"{c * across.factor:.3g}" for c in part.clearances))
    return table


def _table(names: Sequence[str], numbers: Sequence[str]) -> Table:
    return Table(
        *(Column(heading, overflow="fold") for heading in names),
        *(Column(heading, justify="right", overflow="fold") for heading in numbers),
        box=SIMPLE_HEAD, collapse_padding=True, pad_edge=False,
    )  # fmt: skip


def _name(name: str | None, number: int) -> str:
    return f"{number}" if name is None else f"{number}: {printable(name)}"
