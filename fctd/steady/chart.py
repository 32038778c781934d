"""A torque-and-drag chart as an object: its table in either system of units, its notes, its picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from fctd.case.errors import InputError
from fctd.case.friction import FrictionChoice
from fctd.case.input_warnings import InputWarning
from fctd.case.load import Case
from fctd.case.systems import SYSTEMS
from fctd.case.text import counted
from fctd.model.operations import SteadyRates, rates_of_all
from fctd.results.display import Picture, drawers, html_of, picture
from fctd.results.notes import RowNote
from fctd.results.unit_systems import System, in_field_units, reworded
from fctd.steady.torque_drag import Progress, chart_rows, table_of_rows

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
        told = [reworded(str(warning), self.units) for warning in self.warnings]
        chosen = drawers().ChartLook(**{"rates": self.rates, "warnings": told, **look})
        return picture("chart_figure", self.rows, self.units, self.case, chosen)

    def __repr__(self) -> str:
        kinds = ", ".join(self.rates)
        return f"Chart({self.case.name!r}, {counted(len(self.rows), 'row')}: {kinds})"

    def _repr_html_(self) -> str:
        names = dict(zip(self.rows.columns, self.table.columns, strict=True))  # in SI units, and as they are shown
        return html_of(repr(self), self.table[[names[name] for name in _SHOWN]])


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
    table = table_of_rows(rows, case, operation, friction, drive)
    warnings = tuple(InputWarning(**told) for told in table.attrs["warnings"])
    rates = rates_of_all(case, list(dict.fromkeys(table["operation"])), **drive)
    return Chart(case, table, tuple(notes), warnings, rates).to_units(units or case.system)
