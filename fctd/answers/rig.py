"""Answers from the rig's readings: monitored friction, and a calibrated case."""

from html import escape

from fctd import plots
from fctd.answers.display import Picture, answering, html_of, picture
from fctd.calibration import calibrate as calibrating
from fctd.calibration import result
from fctd.case.text import counted
from fctd.monitoring import monitor as monitoring
from fctd.results.unit_systems import System

# Columns of the short table that a notebook shows.
_SHOWN = ("mode", "bit_depth_m", "samples", "friction", "friction_low", "friction_high", "left_out")


class Monitored(monitoring.Monitored):
    def plot(self, units: System | None = None) -> Picture:
        """Readings and apparent friction factor over bit depth, with the alarms."""
        return picture(lambda: plots.monitor_figure(self, self.chart.case, units or self.chart.case.system))

    def __repr__(self) -> str:
        found = f"{counted(len(self.stretches), 'stretch')}, {counted(len(self.alarms), 'alarm')}"
        return f"Monitored({self.chart.case.name!r}: {found})"

    def _repr_html_(self) -> str:
        told = "".join(f"<p>{escape(alarm.sentence)}</p>" for alarm in self.alarms)
        return told + html_of(repr(self), self.stretches, self.chart.case.system, _SHOWN)


class Calibration(result.Calibration):
    def __repr__(self) -> str:
        values = ", ".join(f"{name} {value:.4g}" for name, value in self.values.items())
        return f"Calibration({self.base.name!r}, {counted(len(self.fit.used), 'row')}: {values})"

    def _repr_html_(self) -> str:
        return html_of(repr(self), self.table)

    def plot(self, units: System | None = None) -> Picture:
        """Measured and fitted readings with bands, residuals, and correlations of the unknowns."""
        return picture(lambda: plots.calibration_figure(self, units or self.base.system))


calibrate = answering(Calibration, calibrating.calibrate)
monitor = answering(Monitored, monitoring.monitor)
