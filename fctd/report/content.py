"""A report from its parts: which sections it has, and in which order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from fctd.case.text import printable
from fctd.model.summary import segments_in_words, summarise
from fctd.plots.loads import ChartLook, Load
from fctd.report import results, well
from fctd.report.answers import Answers
from fctd.report.parts import Report, Section
from fctd.results.unit_systems import System, shown


@dataclass(frozen=True)
class Cover:
    """What the command says of a report: company, who made it, both may be empty; date; a logo (PNG), or None."""

    company: str = ""
    by: str = ""
    date: str = ""
    logo: bytes | None = None


def report_of(
    found: Answers, cover: Cover, units: System, load: Load | None = None, warnings: Sequence[str] = ()
) -> Report:
    """The report on a case.

    load : of the chart, hook load or weight indicator; warnings : on the input, in sentences.
    """
    case, asked = found.case, found.asked
    summary, metre = summarise(case), shown("bit_depth_m", units)
    segments = segments_in_words(case, found.points[0]._shape.laid.string, metre.factor, metre.label)
    look = ChartLook(load, found.rates, asked.measured, (), found.lines)
    sections: list[Section] = [
        well.well(summary, units, cover.company, cover.by, cover.date),
        well.hole(case, units),
        well.string(summary, units),
        well.fluids(case, units),
        well.friction(case, asked.frictions),
        well.rig(case, units),
        well.assumptions(case, found.rates, asked.drive, segments, warnings, units),
        results.loads(found, look, units),
    ]
    if found.margins is not None:
        sections.append(results.margins(found, units))
    sections.append(results.profiles(found, units))
    if found.circulations:
        sections.append(results.mud(found, units))
    sections += [results.notes(found, units), results.made_with(case), results.along(found.points, units)]
    return Report(printable(case.name), cover.company, cover.by, cover.date, cover.logo, units, tuple(sections))
