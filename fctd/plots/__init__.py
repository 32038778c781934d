"""Pictures and pages: the torque-and-drag chart, the profile of a string, runs in time, and calibrations.

Pictures need matplotlib (the package's extra ``plot``), pages plotly (``html``); each is imported where it is asked
for, and nothing else of the package needs them.
"""

from typing import TYPE_CHECKING, Final

from fctd.public import offer

DRAWN: Final = (".png", ".svg", ".pdf")  # suffixes of pictures

if TYPE_CHECKING:  # what ``offer`` reads
    from fctd.plots.calibration import calibration_figure as calibration_figure, prediction_figure as prediction_figure
    from fctd.plots.chart import chart_figure as chart_figure
    from fctd.plots.counts import counts_figure as counts_figure
    from fctd.plots.depth_panels import panels_figure as panels_figure, panels_page as panels_page
    from fctd.plots.feeding import feeding_figure as feeding_figure
    from fctd.plots.loads import ChartLook as ChartLook
    from fctd.plots.monitor import monitor_figure as monitor_figure
    from fctd.plots.page import chart_page as chart_page, profile_page as profile_page, save_page as save_page
    from fctd.plots.profile import profile_figure as profile_figure
    from fctd.plots.run import run_figure as run_figure
    from fctd.plots.style import RC as RC, save as save
    from fctd.plots.sweep import (
        bands_figure as bands_figure,
        map_figure as map_figure,
        tornado_figure as tornado_figure,
    )
else:
    __getattr__, __dir__, __all__ = offer(__name__)
