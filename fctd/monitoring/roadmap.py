"""The roadmap of a well: steady strings with a fan of friction factors, solved once, and the readings so far."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.case.friction import FrictionSet
from fctd.case.message import Message, frame_of, quantity, span
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.model.operations import SteadyRates, rates_of_all, string_load
from fctd.monitoring.chart import KIND_OF, Chart
from fctd.monitoring.friction import Apparent
from fctd.monitoring.stretches import OF_KIND, ROTATING
from fctd.results.columns import measured_column
from fctd.steady.margin_table import limits_of, of_lines
from fctd.steady.torque_drag import chart_rows

if TYPE_CHECKING:
    import pandas as pd

FAN: Final = (0.1, 0.2, 0.3, 0.4)  # factors where none are given
LOADS: Final = ("hookload_N", "weight_indicator_N", "surface_torque_N_m")
# Called with what is being computed, the number of rows done and their total.
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Roadmap:
    """What a series is drawn over.

    chart : of the monitor; rows : of ``torque_drag``, of the operations that a series shows, with mud at rest; rates :
    theirs; margins : of ``limits_of``, or none.
    """

    chart: Chart
    rows: pd.DataFrame
    rates: Mapping[str, SteadyRates]
    margins: pd.DataFrame | None = None

    def points(self, found: Sequence[Apparent]) -> pd.DataFrame:
        """The steady readings within the hole, as rows of ``read_measured``, with quartiles as ranges [SI].

        They are brought to the mud at rest of the curves.  The torque is what the drive's reading leaves to the string,
        while it rotates.
        """
        import pandas as pd  # slow to import

        rows = [self._row(reading) for reading in found if self.shows(reading)]
        ends = [measured_column(load, end) for load in LOADS for end in ("low", "high")]
        return pd.DataFrame(rows, columns=["operation", "bit_depth_m", *LOADS, *ends])

    def shows(self, reading: Apparent) -> bool:
        """Whether a reading is that of a steady string in the hole of the case."""
        stretch = reading.stretch
        deep = self.chart.case.depths[0] < stretch.bit_depth <= self.chart.deepest
        return deep and stretch.mode in KIND_OF and not stretch.left_out

    def _row(self, reading: Apparent) -> dict[str, Any]:
        stretch, rig = reading.stretch, self.chart.case.rig
        kind = KIND_OF[stretch.mode]
        row: dict[str, Any] = {"operation": kind, "bit_depth_m": stretch.bit_depth}
        for end in ("p25", "median", "p75"):
            gauge, torque = self.chart.at_rest(
                stretch.mode, stretch.bit_depth, stretch.flow, stretch.rpm,
                gauge=getattr(stretch.hook_load, end), torque=getattr(stretch.torque, end),
            )  # fmt: skip
            turning = self.chart.turning(torque, stretch.rpm) if stretch.mode in ROTATING else np.nan
            values = (float(string_load(rig, KINDS[kind].direction, gauge)), gauge, turning)
            for load, value in zip(LOADS, values, strict=True):
                row[_column(load, end)] = value
        return row

    def told(self, found: Sequence[Apparent]) -> list[str]:
        """The last reading, and how many lie outside the depths of the fan, a line each [SI]."""
        drawn = [reading for reading in found if self.shows(reading)]
        if not drawn:
            return ["no steady reading in the hole of the case yet", *map(Message, self._left_out(found))]
        last = drawn[-1].stretch
        what = f"{KINDS[KIND_OF[last.mode]].label} at {quantity(last.bit_depth, 'm', '.1f')}"
        words = [f"{counted(len(drawn), 'reading')}; the last one: {what}"]
        if np.isfinite(last.hook_load.median):
            words.append(f"weight indicator {quantity(last.hook_load.median / 1e3, 'kN', '.1f')}")
        if last.mode in ROTATING and np.isfinite(last.torque.median):
            words.append(f"drive torque {quantity(last.torque.median / 1e3, 'kN·m', '.2f')}")
        if np.isfinite(drawn[-1].factor):
            words.append(f"friction factor of {self.chart.fit} hole {drawn[-1].factor:.2f}")
        pumped = [reading for reading in drawn if self.chart.relieves(reading.stretch.flow)]
        lifted = [f"{counted(len(pumped), 'reading')} with the pumps on, drawn as with mud at rest"] if pumped else []
        top, bottom = (float(end) for end in (self.rows["bit_depth_m"].min(), self.rows["bit_depth_m"].max()))
        outside = sum(not top <= reading.stretch.bit_depth <= bottom for reading in drawn)
        beyond = f"{counted(outside, 'reading')} outside the depths of the curves, {span(top, bottom, 'm', '.1f')}"
        return [
            Message(line)
            for line in (", ".join(words), *lifted, *([beyond] if outside else []), *self._left_out(found))
        ]

    def _left_out(self, found: Sequence[Apparent]) -> list[str]:
        deepest = self.chart.deepest
        deeper = sum(reading.stretch.mode in KIND_OF and reading.stretch.bit_depth > deepest for reading in found)
        text = (
            f"{counted(deeper, 'reading')} not drawn: deeper than the hole of the case, {quantity(deepest, 'm', '.1f')}"
        )
        return [text] if deeper else []


def roadmap(
    chart: Chart,
    bit_depths: Sequence[float],
    friction: Sequence[FrictionSet] = (),
    *,
    limits: bool = False,
    progress: Progress | None = None,
) -> Roadmap:
    """The roadmap of a monitor's case.

    bit_depths [m]; friction : sets of factors, by default ``FAN`` in the intervals whose factor is inferred; limits :
    whether the margins are computed, at the case's own friction.  Raises InputError where string and hole fit at none
    of the depths.
    """
    case, kinds = chart.case, list(OF_KIND)
    sets = list(friction) or [chart.set_of(factor) for factor in FAN]

    def told(what: str) -> Callable[[int, int], None] | None:
        return None if progress is None else lambda done, total: progress(what, done, total)

    rows = frame_of(chart_rows(case, kinds, bit_depths, sets, flow=0.0, progress=told(case.name)))
    margins = None
    if limits:
        margins = limits_of(case, kinds, of_lines(bit_depths), flow=0.0, progress=told("limits"))
    return Roadmap(chart, rows, rates_of_all(case, kinds, flow=0.0), margins)


def _column(load: str, end: str) -> str:
    """The column of a quartile of a load."""
    return load if end == "median" else measured_column(load, {"p25": "low", "p75": "high"}[end])
