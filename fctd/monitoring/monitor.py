"""Friction over depth from a series of the rig's readings, and where it changes: ``fctd.monitor``."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape
from os import PathLike
from typing import Final

import numpy as np
import pandas as pd

from fctd.case.errors import InputError, naming
from fctd.case.load import Case, naming_file
from fctd.case.text import counted
from fctd.monitoring.alarm import Alarm, Detector, kind_of
from fctd.monitoring.chart import Chart, Fit
from fctd.monitoring.friction import Apparent, Uncertainty, apparent
from fctd.monitoring.rows import Cleaner
from fctd.monitoring.series import read_series
from fctd.monitoring.stretches import Finder, Rules, Stretch, by_depth
from fctd.results.display import Picture, html_of, picture
from fctd.results.unit_systems import System

READINGS: Final = {"weight_indicator": "N", "drive_torque": "N_m"}
ENDS: Final = ("_p25", "", "_p75", "_error")
COLUMNS: Final = (
    "mode", "start_s", "end_s", "first_row", "last_row", "bit_depth_m", "samples", "rpm", "speed_m_s", "flow_m3_s",
    *(f"{name}{end}_{unit}" for name, unit in READINGS.items() for end in ENDS),
    "friction", "friction_low", "friction_high", "friction_baseline", "friction_baseline_error", "lift_N", "left_out",
)  # fmt: skip

# Columns of the short table that a notebook shows.
SHOWN: Final = ("mode", "bit_depth_m", "samples", "friction", "friction_low", "friction_high", "left_out")


class Monitor:
    """Takes the rows of a series in one piece or as they come, with the same result.

    case : hole, string, mud and rig; fit : the intervals whose factor is inferred (open hole where the case names
    kinds, else all); step, readings : see ``alarm.Detector``.  found : the stretches with their factors; alarms; counts
    of rows left out in ``cleaner``, of stretches too short in ``finder``.
    """

    def __init__(
        self, case: Case, fit: Fit | None = None, uncertainty: Uncertainty | None = None, rules: Rules | None = None,
        step: float = 0.25, readings: float = 50.0,
    ) -> None:  # fmt: skip
        if not 0 < step <= 10:
            raise InputError("a share above 0, such as 0.25", key="step", value=step)
        if not 1 <= readings < np.inf:
            raise InputError("a number of readings of at least 1", key="readings", value=readings)
        self.chart = Chart(case, fit)
        self.uncertainty = Uncertainty() if uncertainty is None else uncertainty
        self.cleaner = Cleaner()
        self.finder = Finder(self.chart, rules)
        self.detector = Detector(step, readings)
        self.found: list[Apparent] = []
        self.alarms: list[Alarm] = []
        self._bands: list[tuple[float, float]] = []

    def feed(self, table: pd.DataFrame) -> list[Alarm]:
        """The alarms that the next rows raise; table : of ``series.read_series``.  Raises InputError for bad rows."""
        rows = self.cleaner.take(table)
        return self._judge(self.finder.feed(rows) if "time_s" in rows else by_depth(rows))

    def finish(self) -> list[Alarm]:
        """The alarms of the stretch that is under way at the end."""
        return self._judge(self.finder.finish())

    def _judge(self, stretches: Iterator[Stretch]) -> list[Alarm]:
        new = []
        for stretch in stretches:
            reading = apparent(stretch, self.chart, self.uncertainty)
            kind = kind_of(stretch.mode)
            self._bands.append(self.detector.band(kind) if stretch.mode != "in_slips" else (np.nan, np.nan))
            self.found.append(reading)
            alarm = self.detector.feed(reading)
            if alarm is not None:
                new.append(alarm)
        self.alarms += new
        return new

    def table(self) -> pd.DataFrame:
        """A row per stretch [SI]: mode, times, rows, depth, quartiles of the readings, friction factor with its band.

        friction_baseline and friction_baseline_error : of the readings of its kind before it, NaN at their beginning.
        """
        rows = []
        for reading, (baseline, error) in zip(self.found, self._bands, strict=True):
            s = reading.stretch
            rows.append(
                (
                    s.mode, s.start, s.end, s.first_row, s.last_row, s.bit_depth, s.samples, s.rpm, s.speed, s.flow,
                    *s.hook_load, *s.torque, reading.factor, reading.low, reading.high, baseline, error,
                    reading.lift, reading.left_out,
                )
            )  # fmt: skip
        return pd.DataFrame(rows, columns=list(COLUMNS))


@dataclass(frozen=True, repr=False)
class Monitored:
    """What a series says.

    stretches : see ``Monitor.table``; alarms; told : rows and stretches that were left out, a line for each reason.
    """

    stretches: pd.DataFrame
    alarms: tuple[Alarm, ...]
    told: tuple[str, ...]
    chart: Chart

    def plot(self, units: System | None = None) -> Picture:
        """Readings and apparent friction factor over bit depth, with the alarms."""
        return picture("monitor_figure", self, self.chart.case, units or self.chart.case.system)

    def __repr__(self) -> str:
        found = f"{counted(len(self.stretches), 'stretch')}, {counted(len(self.alarms), 'alarm')}"
        return f"Monitored({self.chart.case.name!r}: {found})"

    def _repr_html_(self) -> str:
        told = "".join(f"<p>{escape(alarm.sentence)}</p>" for alarm in self.alarms)
        return told + html_of(repr(self), self.stretches[list(SHOWN)])


def monitor(
    case: Case,
    series: str | PathLike[str] | pd.DataFrame,
    fit: Fit | None = None,
    uncertainty: Uncertainty | None = None,
    columns: Mapping[str, tuple[str, str | None]] | None = None,
    step: float = 0.25,
    readings: float = 50.0,
) -> Monitored:
    """Apparent friction factors of the off-bottom stretches of a series, and alarms where they change.

    series : a file of any kind that ``series.read_series`` reads, or its table; fit, uncertainty, step, readings : see
    ``Monitor``; columns : see ``read_series``.  Raises InputError for bad input.
    """
    with naming_file(case):
        watch = Monitor(case, fit, uncertainty, None, step, readings)
    table = series if isinstance(series, pd.DataFrame) else read_series(series, columns)
    with naming(None if isinstance(series, pd.DataFrame) else series):
        watch.feed(table)
        watch.finish()
    return result_of(watch)


def result_of(watch: Monitor) -> Monitored:
    """What a monitor has found so far."""
    told = [
        *watch.cleaner.told(),
        *(f"{counted(count, 'stretch')} left out: {why}" for why, count in watch.finder.counts.items()),
    ]
    return Monitored(watch.table(), tuple(watch.alarms), tuple(told), watch.chart)
