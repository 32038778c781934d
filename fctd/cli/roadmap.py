"""The roadmap of ``fctd monitor --chart``: solved once, and drawn anew where there are new readings."""

from collections.abc import Sequence
from pathlib import Path

from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet
from fctd.case.message import Message, within
from fctd.case.systems import told
from fctd.case.text import printable
from fctd.cli.job import Job
from fctd.cli.options import messages
from fctd.cli.pictures import draw_chart
from fctd.cli.quantities import Given
from fctd.model.depths import usual_depths
from fctd.monitoring.monitor import Monitor
from fctd.monitoring.roadmap import Roadmap, roadmap
from fctd.plots.loads import ChartLook
from fctd.results.unit_systems import System

DEPTHS = 40  # of the curves without --depths
REFRESH = 10.0  # time after which a page that is still being drawn reloads itself [s]


class Drawing:
    """The picture of a roadmap; warnings : lines of the case below its title."""

    def __init__(self, path: Path, road: Roadmap, units: System, warnings: Sequence[str]) -> None:
        self.path, self.road, self.units, self.warnings = path, road, units, warnings
        self._drawn = -1  # stretches in the file

    def follow(self, watch: Monitor) -> None:
        """Draw it anew where the monitor has found more; a file that cannot be written now is tried again later."""
        if len(watch.found) == self._drawn:
            return
        try:
            self.write(watch, REFRESH)
        except InputError as error:
            told = f"warning: {printable(str(error))}; the picture will be drawn with the next reading"
            messages.print(told, soft_wrap=True)
        self._drawn = len(watch.found)

    def write(self, watch: Monitor, refresh: float | None = None) -> list[Path]:
        """Replace the file as a whole; refresh : time after which a page reloads itself [s].  Returns the file."""
        lines = [*self.road.told(watch.found), *(Message(f"alarm: {within(alarm.sentence)}") for alarm in watch.alarms)]
        look = ChartLook(
            rates=self.road.rates, measured=self.road.points(watch.found), warnings=self.warnings,
            margins=self.road.margins, told=[told(line, self.units) for line in lines],
        )  # fmt: skip
        return draw_chart(self.path, self.road.rows, self.units, self.road.chart.case, look, refresh)


def solved(
    job: Job, watch: Monitor, path: Path, depths: Given | None, factors: Sequence[FrictionSet], limits: bool
) -> Drawing:
    """The roadmap of a monitor's case, with a progress bar; depths : of ``--depths``, or none."""
    bit_depths = usual_depths(job.case, DEPTHS) if depths is None else depths.depths(job.case, job.units)
    with job.bar("compiling") as show:
        road = roadmap(watch.chart, bit_depths, factors, limits=limits, progress=show)
    return Drawing(path, road, job.units, job.told)
