"""Charts of several cases as one object: one table, one picture, and what differs between the inputs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.results.differences import Difference, differences
from fctd.results.display import Picture, drawers, html_of, picture
from fctd.results.series import CASE
from fctd.results.unit_systems import System, in_field_units
from fctd.steady.chart import Chart

if TYPE_CHECKING:
    import pandas as pd

FEWEST = 2


@dataclass(frozen=True, repr=False)
class Comparison:
    """Charts of cases, as ``fctd.compare`` puts them together.

    charts : by the names of the cases, each once; units : of ``table``, notebooks and pictures.
    """

    charts: Mapping[str, Chart]
    units: System = "si"

    @cached_property
    def rows(self) -> pd.DataFrame:
        """The rows of all charts [SI], with the name of their case in the first column, ``case``."""
        import pandas as pd

        parts = [chart.rows.assign(**{CASE: name}) for name, chart in self.charts.items()]
        table = pd.concat(parts, ignore_index=True)
        return table[[CASE, *parts[0].columns.drop(CASE)]]

    @property
    def table(self) -> pd.DataFrame:
        """The rows in ``units``."""
        return self.rows if self.units == "si" else in_field_units(self.rows)

    @cached_property
    def differences(self) -> tuple[Difference, ...]:
        """What differs between the inputs of the cases."""
        return tuple(differences([chart.case for chart in self.charts.values()], self.units))

    @property
    def sentences(self) -> list[str]:
        """The same, a line for each key."""
        return [found.sentence(list(self.charts), self.units) for found in self.differences]

    def plot(self, **look: Any) -> Picture:
        """The curves of all cases; look : of ``fctd.plots.ChartLook``, such as load = "string"."""
        chosen = drawers().ChartLook(**{"told": self.sentences, **look})
        return picture("chart_figure", self.rows, self.units, self.charts, chosen)

    def __repr__(self) -> str:
        return f"Comparison({', '.join(self.charts)}: {len(self.differences)} keys differ)"

    def _repr_html_(self) -> str:
        return html_of("; ".join(self.sentences) or "no key differs", self.table)


def compare(charts: Iterable[Chart] | Mapping[str, Chart], units: System | None = None) -> Comparison:
    """Charts of cases beside one another; what differs between the inputs of the cases comes with them.

    charts : of ``fctd.chart``, two or more, or by names that are better than those of their cases.  units : by
    default those of the charts, of charts in both systems SI.  Raises InputError for fewer.

    >>> import fctd
    >>> cases = [fctd.load_case("examples/my_well.toml", {"mud.density": mud}) for mud in ("1250 kg/m^3", "1.4 sg")]
    >>> found = fctd.compare([fctd.chart(case, "trip_out", "td") for case in cases])
    >>> found.sentences
    ['mud.density: 1250 kg/m³ (my well 1), 1400 kg/m³ (my well 2)']
    >>> found.table[["case", "hookload_N"]].round(-3)
            case  hookload_N
    0  my well 1    932000.0
    1  my well 2    911000.0
    """
    if not isinstance(charts, Mapping):
        found = list(charts)
        charts = dict(zip(names_of([chart.case for chart in found]), found, strict=True))
    if len(charts) < FEWEST:
        raise InputError(f"{FEWEST} charts or more", key="charts", value=len(charts))
    return Comparison(charts, units or ("field" if {of.units for of in charts.values()} == {"field"} else "si"))


def names_of(cases: Sequence[Case]) -> list[str]:
    """The names of cases; of those with one name, its file is told too where files differ, and else a number."""
    names = [case.name for case in cases]
    repeated = {name for name, count in Counter(names).items() if count > 1}
    files = [case.file.stem if case.file else "" for case in cases]
    found = [
        f"{name} ({file})" if name in repeated and file and _told_apart(name, names, files) else name
        for name, file in zip(names, files, strict=True)
    ]
    counts, numbers = Counter(found), Counter[str]()
    taken = {name for name, count in counts.items() if count == 1}
    for k, name in enumerate(found):
        if counts[name] > 1:
            while (numbered := f"{name} {numbers[name] + 1}") in taken:
                numbers[name] += 1
            numbers[name] += 1
            found[k] = numbered
    return found


def _told_apart(name: str, names: Sequence[str], files: Sequence[str]) -> bool:
    """Whether the files of the cases with a name have more than one name."""
    return len({file for own, file in zip(names, files, strict=True) if own == name}) > 1
