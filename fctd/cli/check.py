"""``fctd check CASE``: what was understood of a case, to compare with the well plan."""

from fctd.case.load import naming_file
from fctd.case.text import printable
from fctd.cli.base_command import Silent
from fctd.cli.job import FOLD, print_facts, print_table
from fctd.cli.options import (
    CaseFile,
    Friction,
    Overrides,
    Strict,
    Units,
    changes_of,
    finish,
    print_notes,
    read_case,
    screen,
    tell,
)
from fctd.model.summary import Summary, segments_in_words, summarise
from fctd.results.case_facts import (
    caliper_facts,
    fitting_facts,
    flow_curves,
    hole_table,
    load_facts,
    path_facts,
    string_table,
)
from fctd.results.mesh_notes import mesh_notes
from fctd.results.unit_systems import System, shown


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
    notes = mesh_notes(case, string)
    print_notes(notes, units)
    finish(True, [note.code for note in notes], strict)


def _print(summary: Summary, units: System) -> None:
    case = summary.case
    screen.print(printable(case.name), style="bold")
    print_facts(path_facts(summary, units))
    print_table(hole_table(case, units), words=FOLD, numbers=FOLD)
    if case.wellbore.calipers is not None:
        print_facts(caliper_facts(case.wellbore.calipers, units))
    print_table(string_table(summary, units), words=FOLD, numbers=FOLD)
    for told in (fitting_facts(case, units), load_facts(summary, units), flow_curves(case.mud, units)):
        print_facts(told)
