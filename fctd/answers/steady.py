"""Answers of the steady string: a chart, one string in balance, and one that is cut finer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from fctd import plots
from fctd.answers.display import MAIN, Picture, answering, html_of, html_table, load_rows, picture
from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice, friction_sets
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case
from fctd.case.message import frame_of
from fctd.case.operation_names import kinds_of
from fctd.case.systems import SYSTEMS
from fctd.case.text import counted
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.results.attrs import attrs_of
from fctd.results.columns import IN_CHART, Column, listing
from fctd.results.notes import RowNote
from fctd.results.shown_tables import facts
from fctd.results.unit_systems import System, in_field_units, shown
from fctd.steady import refine as cut
from fctd.steady import steady_string
from fctd.steady.equilibrium import equilibrium as solve
from fctd.steady.torque_drag import Progress, chart_rows

if TYPE_CHECKING:
    import pandas as pd

# Columns of the short table that a notebook shows.
_SHOWN = (
    "operation",
    "friction_label",
    "bit_depth_m",
    "hookload_N",
    "surface_torque_N_m",
    "buckling",
    "status",
    "notes",
)


@dataclass(frozen=True, repr=False)
class Chart:
    """A chart of a case, as ``fctd.chart`` computes it.

    rows : the table of ``torque_drag`` [SI]; notes : of its rows, in their order; warnings : probable mistakes of the
    case and of what was asked for; rates : by operation; units : of ``table``, notebooks and pictures.
    """

    case: Case
    rows: pd.DataFrame
    notes: tuple[RowNote, ...]
    warnings: tuple[InputWarning, ...]
    rates: Mapping[str, SteadyRates]
    units: System = "si"

    @cached_property
    def table(self) -> pd.DataFrame:
        """The rows in ``units``, with ``attrs`` (``attrs_of``)."""
        if self.units == "si":
            return self.rows
        table = in_field_units(self.rows)
        table.attrs = {**self.rows.attrs, "units": self.units}
        return table

    def to_units(self, units: System) -> Chart:
        """The same chart in "field" units, or in "si"; InputError for others."""
        if units not in SYSTEMS:
            raise InputError('"si" or "field"', key="units", value=units)
        return replace(self, units=units)

    def plot(self, **look: Any) -> Picture:
        """Hook load and torque against bit depth.

        look : of ``fctd.plots.ChartLook``, such as load = "string" or margins = ``limits_of(case, …)``.  Raises
        InputError for another load than "string" and "indicator".
        """
        if look.get("load") not in (None, "string", "indicator"):
            raise InputError('"string" or "indicator"', key="load", value=look["load"])
        told = [warning.told(self.units) for warning in self.warnings]
        chosen = plots.ChartLook(**{"rates": self.rates, "warnings": told, **look})
        return picture(lambda: plots.chart_figure(self.rows, self.units, self.case, chosen))

    def __repr__(self) -> str:
        kinds = ", ".join(self.rates)
        return f"Chart({self.case.name!r}, {counted(len(self.rows), 'row')}: {kinds})"

    def _repr_html_(self) -> str:
        return html_of(repr(self), self.rows, self.units, _SHOWN)


def chart(
    case: Case,
    operation: str | Sequence[str],
    bit_depths: float | str | Sequence[float | str],
    friction: FrictionChoice | Sequence[FrictionChoice] | None = None,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
    units: System | None = None,
) -> Chart:
    """The chart of ``torque_drag``, with the same arguments, as an object that plots itself; raises as it does.

    units : of the chart, by default those of the case, else SI.
    """
    notes: list[RowNote] = []
    drive: dict[str, Any] = {"speed": speed, "rpm": rpm, "flow": flow}
    rows = chart_rows(case, operation, bit_depths, friction, **drive, progress=progress, threads=threads, notes=notes)
    table = frame_of(rows)
    table.attrs = attrs_of(case, kinds_of(operation), drive, () if friction is None else friction_sets(friction))
    warnings = tuple(InputWarning(**told) for told in table.attrs["warnings"])
    rates = rates_of_all(case, list(dict.fromkeys(table["operation"])), **drive)
    return Chart(case, table, tuple(notes), warnings, rates).to_units(units or case.system)


@listing("chart")
def torque_drag(
    case: Case,
    operation: str | Sequence[str],
    bit_depths: float | str | Sequence[float | str],
    friction: FrictionChoice | Sequence[FrictionChoice] | None = None,
    speed: float | str | None = None,
    rpm: float | str | None = None,
    flow: float | str | None = None,
    progress: Progress | None = None,
    threads: int | None = None,
) -> pd.DataFrame:
    """A row per operation, friction and depth.

    operation : kind or kinds.  bit_depths [m], or texts as of ``equilibrium`` : one or several, rising, or those of a
    text FROM:TO:STEP such as "shoe:td:50".  friction : None for the case's own, or what is set in turn, each a kinetic
    factor for every interval or factors by kind, such as {"cased": 0.2, "open": 0.3}; a text "0.3/0.2" is a factor
    along the hole and one around it.  speed [m/s], rpm, flow [m³/s] : see ``equilibrium``; a speed is that of the kinds
    that move, an rpm that of those that rotate by their name, a flow that of all.  threads : by default as many as
    processors; the rows do not depend on it.

    A row without a balance has NaN in place of loads.  So has a row that is ``locked_up`` where no push suffices, and
    one that is ``unstable`` because no steady shape was found.  At a depth where string and hole do not fit the status
    is ``not_possible``.

    ``attrs`` of the table say its units, case, warnings and version (``attrs_of``).  Raises InputError for unusable
    input, and where string and hole fit at none of the depths.
    """
    return chart(case, operation, bit_depths, friction, speed, rpm, flow, progress, threads).rows


class Equilibrium(steady_string.Equilibrium):
    def __repr__(self) -> str:
        loads = ", ".join(f"{label} {value}" for label, value in self._load_rows(MAIN).items())
        return f"Equilibrium({self.operation}, {self._place}: {self.status}, {loads})"

    @property
    def _place(self) -> str:
        factor, metre = shown("bit_depth_m", self.case.system)
        return f"bit at {self.bit_depth * factor:g} {metre}"

    def _repr_html_(self) -> str:
        title = f"{self.case.name}: {self.operation}, {self._place}"
        return html_table(facts(title, [("status", self.status), *self._load_rows(IN_CHART).items()]))

    def plot(self, units: System | None = None) -> Picture:
        """The string from the top to the bit: tension, torque, side force and so on over depth."""
        return picture(lambda: plots.profile_figure([self], units or self.case.system))

    def _load_rows(self, of: Sequence[Column]) -> dict[str, str]:
        loads = {load.name: load.value(self) if self.answered else float("nan") for load in of}
        return load_rows(loads, self.case.system)


class Refinement(cut.Refinement):
    def __repr__(self) -> str:
        found = f"{counted(self.segments, 'segment')}, {100 * self.error:.2g} % left"
        return f"Refinement({self.case.name!r}: {self.status}, {found})"

    def _repr_html_(self) -> str:
        return html_of(repr(self), self.steps, self.case.system)


equilibrium = answering(Equilibrium, solve)
refine = answering(Refinement, cut.refine)
