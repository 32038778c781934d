"""A comparison as a page: the sections of the screen, with pictures, in one file that needs no network."""

from dataclasses import replace
from pathlib import Path

from fctd.arena.result import Comparison
from fctd.case.text import printable
from fctd.report.parts import Picture, Report, Section, Text
from fctd.store.whole_file import whole_file
from references.methods.tables import counts_of, ending, sections

CAPTION = (
    "Left: largest error of a method's wall over the processor time of a point. Right: contact forces along the string "
    "less those of the engine's own wall. Grey: broken or invalid."
)
COUNTS = "Errors of the loads against the number of segments; the dashed line is the tolerance."
LIMITS = (
    "Errors, costs and loads are those of this hole, this string and this operation.",
    "Times are those of this machine while it had the load above. Other programs that share its caches and its memory "
    "make steps slower; a time in columns of the reference kernel changes less.",
    "A method that breaks the contract, an engine that fails the gate, and a run that is invalid are struck through. "
    "Their numbers describe the fault.",
    "A row without loads says why below the verdicts.",
)  # fmt: skip


def report_of(comparison: Comparison) -> Report:
    """The comparison as a report; a comparison that was read from its JSON gives the same."""
    from fctd.plots.counts import counts_figure
    from fctd.plots.methods import methods_figure

    shown = list(sections(comparison))
    if (counts := comparison.counts) is not None:
        picture = counts_figure(comparison.case, *counts_of(counts), counts.tolerance)
        shown[-1] = replace(shown[-1], parts=(Picture(COUNTS, picture), *shown[-1].parts))
    if comparison.rows:
        shown.insert(2, Section("Pictures", (Picture(CAPTION, methods_figure(comparison)),)))
    shown.append(Section("Limits", tuple(map(Text, (*LIMITS, f"{ending(comparison)}.")))))
    return Report(
        printable(comparison.case), "", "", comparison.date, None, comparison.units, tuple(shown),
        "Contact methods and engines",
    )  # fmt: skip


def write_page(comparison: Comparison, path: Path) -> list[Path]:
    """Write a comparison as a page; returns the file.

    Needs jinja2 and matplotlib.  Raises InputError where the page cannot be written.
    """
    from fctd.report.html_file import to_html

    content = to_html(report_of(comparison))
    with whole_file(path) as scratch:
        scratch.write_bytes(content)
    return [path]
