"""Pictures and pages: the torque-and-drag chart, the profile of a string, runs in time, and calibrations.

Pictures need matplotlib (the package's extra ``plot``), pages plotly (``html``); each is imported where it is asked
for, and nothing else of the package needs them.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fctd.plots.calibration import calibration_figure, prediction_figure
    from fctd.plots.chart import chart_figure
    from fctd.plots.depth_panels import panels_figure, panels_page
    from fctd.plots.feeding import feeding_figure
    from fctd.plots.loads import ChartLook
    from fctd.plots.monitor import monitor_figure
    from fctd.plots.page import chart_page, profile_page, save_page
    from fctd.plots.profile import profile_figure
    from fctd.plots.run import run_figure
    from fctd.plots.style import RC, save
    from fctd.plots.sweep import bands_figure, map_figure, tornado_figure

__all__ = [
    "RC",
    "ChartLook",
    "bands_figure",
    "calibration_figure",
    "chart_figure",
    "chart_page",
    "feeding_figure",
    "map_figure",
    "monitor_figure",
    "panels_figure",
    "panels_page",
    "prediction_figure",
    "profile_figure",
    "profile_page",
    "run_figure",
    "save",
    "save_page",
    "tornado_figure",
]

_HOMES = {
    "RC": "style",
    "ChartLook": "loads",
    "bands_figure": "sweep",
    "calibration_figure": "calibration",
    "chart_figure": "chart",
    "chart_page": "page",
    "feeding_figure": "feeding",
    "map_figure": "sweep",
    "monitor_figure": "monitor",
    "panels_figure": "depth_panels",
    "panels_page": "depth_panels",
    "prediction_figure": "calibration",
    "profile_figure": "profile",
    "profile_page": "page",
    "run_figure": "run",
    "save": "style",
    "save_page": "page",
    "tornado_figure": "sweep",
}


def __getattr__(name: str) -> Any:
    """A public name, from the module that has it."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)


def __dir__() -> list[str]:
    """The public names."""
    return sorted(__all__)
