"""Charts of several cases as one object: one table, one picture, and what differs between the inputs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count, filterfalse
from typing import TYPE_CHECKING, Any

from fctd import plots
from fctd.answers.display import Picture, html_of, picture
from fctd.answers.steady import Chart
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.results.differences import Difference, differences
from fctd.results.series import CASE
from fctd.results.unit_systems import System, in_field_units

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
        chosen = plots.ChartLook(**{"told": self.sentences, **look})
        return picture(lambda: plots.chart_figure(self.rows, self.units, self.charts, chosen))

    def __repr__(self) -> str:
        return f"Comparison({', '.join(self.charts)}: {len(self.differences)} keys differ)"

    def _repr_html_(self) -> str:
        return html_of("; ".join(self.sentences) or "no key differs", self.rows, self.units)


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
    pairs = [(case.name, case.file.stem if case.file else "") for case in cases]
    apart = {name for name, file in pairs if any(name == own and file != other for own, other in pairs)}
    found = [f"{name} ({file})" if name in apart else name for name, file in pairs]
    counts = Counter(found)
    taken = {name for name, number in counts.items() if number == 1}
    # Of each name, with a number behind it, the texts that no case has.
    numbered = {name: filterfalse(taken.__contains__, map(f"{name} ".__add__, map(str, count(1)))) for name in counts}
    return [next(numbered[name]) if counts[name] > 1 else name for name in found]
