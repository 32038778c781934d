"""What a picture says beside its curves: title, mud, loads at the bit, rates, block, warnings, notes, casing shoes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from fctd.case.friction import factors_label
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.model.operations import rates_of_all
from fctd.plots.loads import ChartLook, Compared
from fctd.results.differences import in_a_row
from fctd.results.doing import facts_of, unlike
from fctd.results.notes import meanings_of, worst
from fctd.results.profile import place_in_words
from fctd.results.series import frictions_of, in_words, series_of
from fctd.results.unit_systems import System, shown
from fctd.steady.steady_string import Equilibrium

if TYPE_CHECKING:
    import pandas as pd


def heading_of_chart(chart: pd.DataFrame, units: System, case: Compared, look: ChartLook) -> tuple[str, list[str]]:
    """Title of a chart, and the lines below it: what is told, facts that all cases share, warnings, notes."""
    series = series_of(chart, units)
    kinds, frictions = list(dict.fromkeys(one.operation for one in series)), frictions_of(series)
    if isinstance(case, Mapping):
        words, all_of = [in_a_row(list(case))], [(of.case, of.rates) for of in case.values()]
    else:
        words = [] if case is None else [case.name]
        all_of = [] if case is None else [(case, look.rates or rates_of_all(case, kinds))]
    all_facts = [facts_of(of, rates, units) for of, rates in all_of]
    differ = list(dict.fromkeys(line for of, rates in all_of for line in unlike(of, rates, units)))
    facts = [fact for fact in all_facts[0] if all(fact in of for of in all_facts)] if all_facts else []
    words += [KINDS[kinds[0]].label] if len(kinds) == 1 else []
    words += [in_words(frictions[0])] if len(frictions) == 1 else []
    notes = [
        f"note {code}: {found['headline']}: {found['remedy']}"
        for code, found in meanings_of(chart.get("notes", ())).items()
    ]
    return "; ".join(words), [*look.told, "; ".join(facts), *differ, *_told(look.warnings), *notes]


def heading_of_profile(
    points: Sequence[Equilibrium], units: System, warnings: Sequence[str], sets: int = 1
) -> tuple[str, list[str]]:
    """Title of profiles, and the lines below it, the first of facts; sets : of friction factors, of which the points
    have the first.
    """
    case, depth = points[0].case, shown("bit_depth_m", units)
    friction = told(factors_label(case.wellbore.intervals), units)
    bit, ends = points[0].bit_depth, [point.profile["md_m"].iloc[-1] for point in points if point.answered]
    words = [case.name, f"bit at {place_in_words(max([bit, *ends]), bit, *depth)}", in_words(friction)]
    words += [f"the first of {sets} sets of factors"] if sets > 1 else []
    facts = "; ".join(facts_of(case, {point.operation: point.rates for point in points}, units))
    found = worst(note for point in points if point.answered for note in point.notes)
    return "; ".join(words), [facts, *_told(warnings), *(f"note {note.code}: {note.told(units)}" for note in found)]


def _told(warnings: Sequence[str]) -> list[str]:
    """Warnings as lines below a title."""
    return [f"warning {text}" for text in warnings]
