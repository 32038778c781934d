"""What was understood of a case, as tables: ``fctd check`` from Python."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING

from fctd.answers.display import html_table
from fctd.case.friction import factors_label
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case, naming_file
from fctd.case.systems import LENGTH
from fctd.case.text import counted
from fctd.model.summary import Summary, segments_in_words, summarise
from fctd.results.case_facts import hole_table, load_facts, path_facts, string_table
from fctd.results.shown_tables import facts

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, repr=False)
class CheckedCase:
    """What was understood of a case, to compare with a well plan.

    summary : path, weights and parts of the string; segments : their number and lengths, in words; warnings : probable
    mistakes.
    """

    summary: Summary
    segments: str
    warnings: tuple[InputWarning, ...]

    @property
    def facts(self) -> dict[str, str]:
        """Path and weights with their units, those of the case."""
        units = self.summary.case.system
        rows = path_facts(self.summary, units).rows + load_facts(self.summary, units).rows
        told = {what.text: f"{value.text} {more.text}".replace(" °", "°").rstrip() for what, value, more in rows}
        return told | {"segments": self.segments}

    @property
    def hole(self) -> pd.DataFrame:
        """A row for each interval: name, kind, from_md_m, to_md_m, diameter_m, friction (its factors)."""
        import pandas as pd  # slow to import

        intervals = self.summary.case.wellbore.intervals
        starts = [0.0, *(interval.to_md for interval in intervals)]
        return pd.DataFrame(
            {
                "name": interval.name or "", "kind": interval.kind or "", "from_md_m": start, "to_md_m": interval.to_md,
                "diameter_m": interval.diameter, "friction": factors_label([interval]),
            }
            for start, interval in zip(starts, intervals, strict=False)
        )  # fmt: skip

    @property
    def string(self) -> pd.DataFrame:
        """A row for each component from the top down, the bit at the bottom.

        Columns: name, from_md_m, to_md_m, mass_kg_m, air_N and buoyed_N (its weight), and clearance_m in each interval,
        clearance_1_m, clearance_2_m and so on.
        """
        import pandas as pd

        return pd.DataFrame(
            {
                "name": part.name, "from_md_m": part.from_md, "to_md_m": part.to_md, "mass_kg_m": part.mass,
                "air_N": part.air, "buoyed_N": part.buoyed,
                **{f"clearance_{k}_m": of for k, of in enumerate(part.clearances, start=1)},
            }
            for part in self.summary.parts
        )  # fmt: skip

    def __repr__(self) -> str:
        return f"CheckedCase({self.summary.case.name!r}: {counted(len(self.warnings), 'warning')}, {self.segments})"

    def _repr_html_(self) -> str:
        told = "".join(f"<p>warning: {escape(str(warning))}</p>" for warning in self.warnings)
        case, units = self.summary.case, self.summary.case.system
        tables = facts(case.name, self.facts.items()), hole_table(case, units), string_table(self.summary, units)
        return told + "".join(map(html_table, tables))


def check_case(case: Case) -> CheckedCase:
    """What was understood of a case, and its probable mistakes.

    Raises InputError for a survey that cannot be used, and for a string that does not fit the hole.
    """
    with naming_file(case):
        summary = summarise(case)
        return CheckedCase(
            summary, segments_in_words(case, summary.string(), *LENGTH.shown(case.system)), case.warnings
        )
