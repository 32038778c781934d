"""Runs in time that show themselves."""

from fctd import plots
from fctd.answers.display import MAIN, Picture, answering, html_table, load_rows, picture
from fctd.case.text import counted
from fctd.results import tables
from fctd.results.shown_tables import facts
from fctd.results.unit_systems import System, shown
from fctd.simulation import simulate as in_time


class SimulationResult(tables.SimulationResult):
    def __repr__(self) -> str:
        return f"SimulationResult({self.case.name!r}: {self.status}, {counted(len(self.history), 'record')}{self._end})"

    def _repr_html_(self) -> str:
        loads = {load.name: float(self.history[load.name].iloc[-1]) for load in MAIN} if len(self.history) else {}
        rows = {"status": str(self.status), "records": str(len(self.history)), **load_rows(loads, self.case.system)}
        return html_table(facts(f"{self.case.name}{self._end}", rows.items()))

    def plot(self, units: System | None = None) -> Picture:
        """Hook load, torque, rotation and depth over time, and where the string touched."""
        return picture(lambda: plots.run_figure(self, units or self.case.system))

    @property
    def _end(self) -> str:
        if self.history.empty:
            return ""
        last = self.history.iloc[-1]
        factor, metre = shown("bit_depth_m", self.case.system)
        return f", {last['operation']} at {last['bit_depth_m'] * factor:.1f} {metre}"


class Simulation(in_time.Simulation):
    __doc__ = in_time.Simulation.__doc__

    def result(self) -> SimulationResult:
        """The records so far, with status ``interrupted`` before the end.  A complete schedule gets its final notes."""
        return answering(SimulationResult, in_time.Simulation.result)(self)


simulate = answering(SimulationResult, in_time.simulate)
open_result = answering(SimulationResult, tables.open_result)
